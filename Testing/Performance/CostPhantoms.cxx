#include "CostPhantoms.h"

#include "ChildProcess.h"
#include "voxelcore/Imaging/LabelVolume.h"

namespace voxelcore::performance
{

namespace fs = std::filesystem;

const std::vector<Phantom> kFittedPhantoms{
  { "ellipsoid", 96, {} },
  { "ellipsoid", 320, {}, true },
  { "torus", 192, {} },
  { "gyroid", 96, {} },
  { "gyroid", 176, { "--thickness", "5" }, true },
  { "gyroid", 128, { "--thickness", "3" } },
  { "porous", 96, {}, true },
  { "porous", 160, { "--density", "0.2" } },
  { "porous", 96, { "--density", "0.7" } },
  { "root", 192, {} },
  { "root", 448, {}, true },
  { "shell", 160, {} },
  { "shell", 192, { "--thickness", "12" }, true },
  { "plate", 192, {} },
  { "plate", 256, { "--thickness", "2" } },
  { "plate", 320, { "--thickness", "24" } },
  { "box", 128, {} },
  { "noise", 80, {} },
  { "noise", 64, { "--density", "0.1" } },
  { "noise", 48, { "--density", "0.9" } },
  { "cells", 96, { "--cells", "500" } }, // many labels: these count for seconds alone
  { "cells", 144, { "--cells", "60" } },
};

const std::vector<Phantom> kOtherPhantoms{
  { "ball", 160, {} },
  { "capsule", 256, {} },
  { "tanglecube", 192, {} },
  { "rod", 320, {} },
  { "thick-and-thin", 256, {} },
  { "ellipsoid", 448, {} },
  { "gyroid", 192, { "--thickness", "4" } },
  { "gyroid", 160, {} },
  { "gyroid", 112, { "--period", "20" } },
  { "porous", 144, {} },
  { "porous", 96, { "--period", "4" } },
  { "root", 384, { "--seed", "5" } },
  { "root", 576, { "--seed", "3" } },
  { "torus", 256, { "--radius", "9" } },
  { "plate", 256, { "--thickness", "9" } },
  { "plate", 256, { "--thickness", "40" } },
  { "box", 144, {} },
  { "noise", 64, { "--density", "0.3" } },
  { "noise", 64, { "--density", "0.7" } },
};

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
