// `voxelcore reconstruct`: its options, and what it runs.

#include "voxelcore/Options/Requests.h"
#include "voxelcore/Options/SharedRows.h"

namespace voxelcore
{

namespace table
{

constexpr auto kReconstructOwn = std::to_array<Parameter>({
  { "scan", "--scan", Input, "SCAN", "", false, Group::Input, "Compare with the scan the core was computed from" },
  { "like", "--like", Input, "SCAN", "", false, Group::Input, "Use the grid of this scan; default: that of the core" },
});

constexpr auto kReconstructRows =
  Joined(kRunRows, kCoreArgument, kVolumeOutput, kReconstructOwn, kReportRows, kForceRows);

} // namespace table

namespace
{

constexpr std::string_view kReconstructFooter =
  R"(A voxel belongs to the result if its centre lies in a ball of the core. A whole core of cubic voxels reproduces
its label exactly. A pruned one shows what was treated as noise. On thick slices, balls bulge out between the
corners of the slices.

Example:
  voxelcore core scan.nii.gz --tolerance 2diag -o medial.vtp
  voxelcore reconstruct medial.vtp -o rebuilt.nii.gz --scan scan.nii.gz --report rebuilt.json)";

Outcome
RunReconstruct(const Invocation & call)
{
  ReconstructOptions options = ReconstructOptionsFrom(call.values);
  options.command = call.whole;
  const ReconstructResult result = RunReconstructJob(options, call.context);
  return { .warnings = result.warnings, .text = ReconstructText(result), .notes = result.notes };
}

} // namespace

constinit const Command kReconstructCommand{ .name = "reconstruct",
                                             .description = "Rebuild a volume from the balls of a medial surface",
                                             .footer = kReconstructFooter,
                                             .place = 140,
                                             .rows = table::kReconstructRows,
                                             .run = RunReconstruct };

} // namespace voxelcore
