#pragma once
// Options of `batch` alone.

#include "CommandBits.h"

#include <array>

namespace voxelcore::table
{

inline constexpr auto kCohortRows = std::to_array<Parameter>({
  { "jobs", "-j,--jobs", Integer, "N", "0", false, kBatch, "Run N cases at a time; 0 means one per processor" },
  { "memory",
    "--memory",
    Text,
    "SIZE",
    "",
    false,
    kBatch,
    "Memory limit for all cases together, such as 12GB; default: 90 % of what is free" },
  { "timeout", "--timeout", Text, "TIME", "", false, kBatch, "Time limit per case: 90s, 10m, 2h; default: none" },
  { "roots",
    "--roots",
    Flag,
    "",
    "",
    false,
    kBatch,
    "Run 'voxelcore roots' on each scan, with the options of that command; compare plants by their traits" },
  { "thickness",
    "--thickness",
    Flag,
    "",
    "",
    false,
    kBatch,
    "Run 'voxelcore thickness' on each scan, with the options of that command: a map per case; compare scans by their "
    "numbers" },
  { "no-skeleton", "--no-skeleton", Flag, "", "", false, kBatch, "Compute medial surfaces only" },
  { "bids",
    "--bids",
    Flag,
    "",
    "",
    false,
    kBatch,
    "Also write the results as BIDS derivatives into OUTDIR/bids: names with the scan's entities, tables as .tsv, and "
    "JSON sidecars" },
  { "list", "--list", Flag, "", "", false, kBatch, "Print each case's number, folder, id and scan, and run nothing" },
  { "case",
    "--case",
    Integer,
    "K",
    "",
    false,
    kBatch,
    "Run only case K, counted from 1, and write no tables; for clusters" },
  { "gather",
    "--gather",
    Flag,
    "",
    "",
    false,
    kBatch,
    "Write tables and page from the results in OUTDIR, and run nothing; give the options of that run" },
});

} // namespace voxelcore::table
