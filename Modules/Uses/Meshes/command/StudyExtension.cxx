// `voxelcore core --resolution N,N,..`: what it runs.

#include "voxelcore/Meshes/VoxelizeJob.h"
#include "voxelcore/Options/SharedValues.h"

namespace voxelcore
{

namespace
{

/** Blocks refuse several. */
bool
IsAsked(const ParameterValues & values)
{
  return ResolutionsFrom(values).size() > 1 && !values.contains("block");
}

Outcome
Run(const Invocation & call)
{
  const auto  resolutions = ResolutionsFrom(call.values);
  CoreOptions options = CoreOptionsFrom(call.values);
  options.threads = call.threads;
  options.command = call.whole;
  const StudyResult study = RunStudyJob(options, resolutions, call.context);
  Outcome           all{ .saysTime = true };
  for (std::size_t i = 0; i < resolutions.size(); ++i)
  {
    const Outcome one = OutcomeOf(study.runs[i]);
    all.warnings.insert(all.warnings.end(), one.warnings.begin(), one.warnings.end());
    all.text += "resolution " + std::to_string(resolutions[i]) + "\n" + one.text;
    for (const std::string & note : one.notes)
    {
      all.text += note + "\n";
    }
  }
  return all;
}

} // namespace

extern constinit const Extension kStudyExtension{ .command = "core", .rows = {}, .isAsked = IsAsked, .run = Run };

} // namespace voxelcore
