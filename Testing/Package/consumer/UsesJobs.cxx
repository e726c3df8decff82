// The whole job as the program does it. usage: UsesJobs SCAN OUT.vtp

#include "voxelcore/Jobs/CoreJob.h"
#include "voxelcore/Report/ReportTable.h"

#include <cstdio>
#include <exception>

int
main(int argc, char ** argv)
{
  try
  {
    if (argc != 3)
    {
      return 2;
    }
    voxelcore::CoreOptions options;
    options.scan = argv[1];
    options.output = argv[2];
    options.lambdas = { voxelcore::ParseLambda("1.5vox") };
    const auto result = voxelcore::RunCoreJob(options);
    std::printf("%s", voxelcore::ReportTable(result.report).c_str());
    return result.report.labels.at(0).Passed() ? 0 : 1;
  }
  catch (const std::exception & error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
