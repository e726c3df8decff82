// A plugin of somebody else's program, with all of VoxelCore in it and one function that can be called.

#include "voxelcore/Jobs/CoreJob.h"

extern "C" __attribute__((visibility("default"))) int
PluginMakesCore(const char * scan, const char * output)
{
  try
  {
    voxelcore::CoreOptions options;
    options.scan = scan;
    options.output = output;
    options.lambdas = { voxelcore::ParseLambda("1.5vox") };
    return voxelcore::RunCoreJob(options).report.labels.at(0).Passed() ? 0 : 4;
  }
  catch (const voxelcore::UsageError &)
  {
    return 2;
  }
  catch (const voxelcore::InputError &)
  {
    return 3;
  }
  catch (const std::exception &)
  {
    return 1;
  }
}
