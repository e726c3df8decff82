// `voxelcore measure`: its options, and what it runs.

#include "voxelcore/Options/Requests.h"
#include "voxelcore/Options/SharedRows.h"
#include "voxelcore/Report/ReportTable.h"

namespace voxelcore
{

namespace table
{

constexpr auto kMeasureOwn = std::to_array<Parameter>({
  { "output",
    "-o,--output",
    Output,
    "OUT",
    "",
    true,
    Group::Output,
    "Write tables named after OUT.csv, or the skeleton with the changes asked for as .vtp" },
  { "prune-branches",
    "--prune-branches",
    Text,
    "L|Nr",
    "",
    false,
    Group::Skeleton,
    "Remove terminal branches shorter than L: 5mm, 8vox, or 1.5r (times the radius at their base)" },
});

constexpr auto kMeasureRows =
  Joined(kRunRows, kSkeletonArgument, kMeasureOwn, kTableRows, kForceRows, kBranchRows, kNetworkRows);

} // namespace table

namespace
{

constexpr std::string_view kMeasureFooter =
  R"(OUT.csv writes OUT_branches.csv, OUT_summary.csv, and OUT_columns.json, which explains the columns.

Examples:
  voxelcore measure root.vtp -o root.csv --root top
  voxelcore measure vessels.vtp -o vessels.csv --prune-branches 5mm)";

Outcome
RunMeasure(const Invocation & call)
{
  const SkeletonResult result = RunMeasureJob(MeasureOptionsFrom(call.values), call.context);
  return { .warnings = result.warnings, .text = SkeletonTable(result.report), .notes = result.notes };
}

} // namespace

constinit const Command kMeasureCommand{ .name = "measure",
                                         .description = "Write tables of a skeleton's branches",
                                         .footer = kMeasureFooter,
                                         .place = 90,
                                         .rows = table::kMeasureRows,
                                         .run = RunMeasure };

} // namespace voxelcore
