// `voxelcore info`: its options, and what it runs.

#include "voxelcore/Options/Requests.h"
#include "voxelcore/Options/SharedRows.h"

namespace voxelcore
{

namespace table
{

constexpr auto kInfoOwn = std::to_array<Parameter>({
  { "json", "--json", Flag, "", "", false, Group::Running, "Print JSON" },
});

constexpr auto kInfoRows =
  Joined(kRunRows, kScanArgument, kSeparateRows, kScanRows, kInfoOwn, kResolutionRows, kCavityRows, kTreeRows);

} // namespace table

namespace
{

constexpr std::string_view kInfoFooter =
  R"(The forecast of time and memory holds for a machine like the one it was measured on.

Examples:
  voxelcore info scan.nii.gz
  voxelcore info ct.nrrd --threshold 300:3000 --json)";

Outcome
RunInfo(const Invocation & call)
{
  const ScanInfo info = RunInfoJob(InfoOptionsFrom(call.values), call.context);
  return { .warnings = info.warnings, .text = call.values.contains("json") ? InfoJson(info) : InfoText(info) };
}

} // namespace

constinit const Command kInfoCommand{ .name = "info",
                                      .description = "Show what is in a scan, and the time and memory it will need",
                                      .footer = kInfoFooter,
                                      .place = 60,
                                      .rows = table::kInfoRows,
                                      .run = RunInfo };

} // namespace voxelcore
