// In the place of ChildProcess.cxx, where no processes can be started (VOXELCORE_PORTABLE).

#include "ChildProcess.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Cohort/Admission.h"

namespace voxelcore
{

void
RequireChildProcesses()
{
  throw UsageError("batch starts a process for each case, which this build cannot; run core or roots on each scan");
}

std::vector<bool>
WaitUntilReadable(const std::vector<int> & descriptors, int)
{
  return std::vector<bool>(descriptors.size());
}

ChildProcess::ChildProcess(const std::vector<std::string> &, int)
{
  RequireChildProcesses();
}

ChildProcess::~ChildProcess() = default;

std::optional<double>
ChildProcess::TakeRequest()
{
  return std::nullopt;
}

void
ChildProcess::Grant()
{}

void
ChildProcess::Kill() const
{}

ChildEnd
ChildProcess::Collect()
{
  return {};
}

std::function<void(double)>
AdmissionFromEnvironment(std::function<bool()>)
{
  return {};
}

} // namespace voxelcore
