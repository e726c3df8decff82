// `voxelcore prune`: its options, and what it runs.

#include "voxelcore/Options/Requests.h"
#include "voxelcore/Options/SharedRows.h"
#include "voxelcore/Report/ReportTable.h"

namespace voxelcore
{

namespace table
{

constexpr auto kPruneOwn = std::to_array<Parameter>({
  { "output",
    "-o,--output",
    Output,
    "OUT",
    "",
    true,
    Group::Output,
    "Write the pruned surface: .vtp .vtk .ply .obj .stl .ma" },
  { "lambda",
    "-l,--lambda",
    Text,
    "L[,L..]",
    "",
    false,
    Group::Pruning,
    "Prune at this threshold: 1.5mm, 2.5vox, 2.5%; several L write OUT_lambda-1mm.vtp and so on",
    "lambda_" },
  { "tolerance",
    "--tolerance",
    Text,
    "H[,H..]",
    "",
    false,
    Group::Pruning,
    "Prune so that the boundary stays within H of the remaining balls: 1.2diag (voxel diagonals), 2vox, 1.5mm; several "
    "H write OUT_tolerance-1.2diag.vtp and so on" },
});

constexpr auto kPruneRows = Joined(kRunRows, kCoreArgument, kPruneOwn, kReportRows, kModelRows, kForceRows);

} // namespace table

namespace
{

constexpr std::string_view kPruneFooter =
  R"(The result equals that of 'voxelcore core --refine off' at the same lambda or tolerance, bit for bit. For
--lambda, make the file with --keep-edges. For --tolerance, make it with a smaller --tolerance, best 0. What
remains of a refined core keeps its places and radii.

Examples:
  voxelcore core scan.nii.gz --lambda 0 --keep-edges -o whole.vtp
  voxelcore prune whole.vtp --lambda 1.5mm,3mm -o medial.vtp
  voxelcore core scan.nii.gz --tolerance 0 -o every.vtp
  voxelcore prune every.vtp --tolerance 1diag,2diag -o medial.vtp)";

Outcome
RunPrune(const Invocation & call)
{
  PruneOptions options = PruneOptionsFrom(call.values);
  options.threads = call.threads;
  options.command = call.whole;
  const PruneResult result = RunPruneJob(options, call.context);
  return { .warnings = result.warnings, .text = ReportTable(result.report), .notes = result.notes, .saysTime = true };
}

} // namespace

constinit const Command kPruneCommand{ .name = "prune",
                                       .description = "Prune a medial surface further, without its scan",
                                       .footer = kPruneFooter,
                                       .place = 120,
                                       .rows = table::kPruneRows,
                                       .run = RunPrune };

} // namespace voxelcore
