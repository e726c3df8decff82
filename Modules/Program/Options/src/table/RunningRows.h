#pragma once
// Options that say how a command runs; none changes a result.

#include "CommandBits.h"

#include <array>

namespace voxelcore::table
{

inline constexpr auto kRunningRows = std::to_array<Parameter>({
  { "threads", "--threads", Integer, "N", "0", false, kAll, "Number of processors to use; 0 means all", "threads" },
  { "memory",
    "--memory",
    Text,
    "8GB",
    "",
    false,
    kCore,
    "Stop before computing if more memory is expected to be needed; see 'voxelcore info'" },
  { "json", "--json", Flag, "", "", false, kInfo, "Print JSON" },
  { "progress",
    "--progress",
    Choice,
    "bar|plain|json|none",
    "",
    false,
    kAll,
    "Show progress on stderr; default: a bar on a terminal, else none",
    "progress" },
  { "quiet", "-q,--quiet", Flag, "", "", false, kAll, "Print errors only" },
  { "engine",
    "--engine",
    Choice,
    "auto|lattice|tetgen",
    "auto",
    false,
    kStages | kRoots | kMaps,
    "Choose the Delaunay engine; the result is the same",
    "engine" },
  { "cross-check",
    "--cross-check",
    Flag,
    "",
    "",
    false,
    kCore,
    "Run both engines for each label and require identical results",
    "cross_check" },
  { "blocks",
    "--blocks",
    Integer,
    "N",
    "",
    false,
    kCore,
    "Cut each label into N blocks; compute one with --block, combine all with --join" },
  { "block",
    "--block",
    Integer,
    "K",
    "",
    false,
    kCore,
    "Compute block K of --blocks, counted from 1, into the folder OUT/; each can run on its own machine" },
  { "block-size",
    "--block-size",
    Integer,
    "N",
    "",
    false,
    kCore,
    "Cut the scan into blocks of N voxels a side instead of a number of blocks; a block reads the voxels it needs, and "
    "none the whole scan" },
  { "join", "--join", Input, "DIR", "", false, kCore, "Combine the blocks in DIR; the result is that of a single run" },
});

} // namespace voxelcore::table
