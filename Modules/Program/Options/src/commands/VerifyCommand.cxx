// `voxelcore verify`: its options, and what it runs.

#include "voxelcore/Options/Requests.h"
#include "voxelcore/Options/SharedRows.h"

namespace voxelcore
{

namespace table
{

constexpr auto kVerifyRows = Joined(kRunRows, kScanArgument, kCoreArgument);

} // namespace table

namespace
{

constexpr std::string_view kVerifyFooter =
  R"(Rechecks the file independently of the code that made it. Every vertex must lie inside the shape, with two or
more nearest boundary vertices at equal distance and none nearer. Faces must be planar and convex; measures,
order and topology must agree. A failed check ends with exit code 4. The scan is read with the options recorded
in the file.

Example:
  voxelcore verify scan.nii.gz medial.vtp)";

Outcome
RunVerify(const Invocation & call)
{
  const VerifyOptions options = VerifyOptionsFrom(call.values);
  const VerifyResult  result = RunVerifyJob(options, call.context);
  Outcome             outcome{ .warnings = result.warnings, .text = VerifyText(result) };
  if (!result.passed)
  {
    outcome.disagreement = options.core.string() + ": does not agree with " + options.scan.string();
  }
  return outcome;
}

} // namespace

constinit const Command kVerifyCommand{ .name = "verify",
                                        .description = "Recheck a medial surface against its scan",
                                        .footer = kVerifyFooter,
                                        .place = 70,
                                        .rows = table::kVerifyRows,
                                        .run = RunVerify };

} // namespace voxelcore
