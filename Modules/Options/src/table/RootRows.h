#pragma once
// Options of `roots`, and of `batch --roots`.

#include "CommandBits.h"

#include <array>

namespace voxelcore::table
{

inline constexpr auto kRootRows = std::to_array<Parameter>({
  { "up",
    "--up",
    Text,
    "auto|x+|x-|y+|y-|z+|z-",
    "auto",
    false,
    kRoots | kBatch,
    "Direction that was up, along an axis of the scan's space (LPS); auto finds it by the stem" },
  { "stems",
    "--stems",
    Text,
    "N|auto",
    "1",
    false,
    kRoots | kBatch,
    "Number of stems; auto counts those about as thick and high" },
  { "stem",
    "--stem",
    Text,
    "X,Y,Z[;X,Y,Z...]",
    "",
    false,
    kRoots,
    "Where the stem begins, in the scan's space; further places say what it passes. By default it is the thickest long "
    "way through the skeleton" },
  { "edits",
    "--edits",
    Input,
    "FILE",
    "",
    false,
    kRoots,
    "Edit and name single roots as annotations.csv or annotations.mrk.json of an earlier run says, edited by hand" },
  { "soil-depth",
    "--soil-depth",
    Real,
    "MM",
    "",
    false,
    kRoots | kBatch,
    "Depth of the soil plane below the base of the stem; counts roots and whorls above and below it" },
  { "as-is",
    "--as-is",
    Flag,
    "",
    "",
    false,
    kRoots | kBatch,
    "Do not clean the mask; without this it is mended, hollow roots (--fill-hollows, by a width found) and cavities "
    "are "
    "filled, and the largest piece is kept" },
  { "keep-loops",
    "--keep-loops",
    Flag,
    "",
    "",
    false,
    kRoots | kBatch,
    "Leave the mask joined where roots touch; without this it is cut there, so that there are no loops, or --loops N" },
  { "kernel",
    "--kernel",
    Real,
    "VALUE",
    "",
    false,
    kRoots | kBatch,
    "Never cut voxels of a grey scan with this value or more; without this bright voxels are cut last" },
  { "neighborhood",
    "--neighborhood",
    Real,
    "VALUE",
    "",
    false,
    kRoots | kBatch,
    "Never fill voxels of a grey scan with less than this value; without this a level is proposed by how pieces, loops "
    "and cavities change with it" },
  { "no-pictures", "--no-pictures", Flag, "", "", false, kRoots, "Leave out roots.png and roots.html" },
  { "prefix", "--prefix", Text, "TEXT", "", false, kRoots, "Begin the names of all files in OUTDIR with this" },
});

} // namespace voxelcore::table
