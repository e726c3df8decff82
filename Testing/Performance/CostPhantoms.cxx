#include "CostPhantoms.h"

#include "ChildProcess.h"
#include "voxelcore/LabelVolume.h"

namespace voxelcore::performance
{

namespace fs = std::filesystem;

std::string
NameOf(const Phantom & phantom)
{
  std::string name = phantom.kind + " " + std::to_string(phantom.side);
  for (const std::string & option : phantom.options)
  {
    name += " " + option;
  }
  return name;
}

CostTask
TaskOf(const Phantom & phantom, const fs::path & folder, int threads, CostJob job)
{
  const std::string name = NameOf(phantom);
  const fs::path    scan = folder / (name + ".nrrd");
  if (!fs::exists(scan))
  {
    std::vector<std::string> command{
      VOXELCORE_PROGRAM, "phantom", phantom.kind, "--size", std::to_string(phantom.side), "-o", scan.string(), "-q"
    };
    command.insert(command.end(), phantom.options.begin(), phantom.options.end());
    RunChild(command);
  }
  return { name, scan, threads, job };
}

std::vector<BoundaryCounts>
CountScan(const fs::path & scan)
{
  std::vector<BoundaryCounts> counts;
  const ReadOptions           options;
  const auto                  volume = ReadLabelVolume(scan, options);
  for (const LabelShape & label : volume.labels)
  {
    counts.push_back(CountBoundary(label.shape));
  }
  return counts;
}

} // namespace voxelcore::performance
