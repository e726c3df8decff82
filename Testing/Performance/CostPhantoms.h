#pragma once
// The phantoms whose cost is measured, and what the fits print.

#include "CostSamples.h"
#include "voxelcore/Shape/BoundaryCounts.h"

#include <array>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace voxelcore::performance
{

struct Phantom
{
  std::string              kind;
  int                      side;
  std::vector<std::string> options;
  bool                     atTwo = false; ///< fitted with two threads as well
};

/** What every run stands between. */
inline const Phantom kReference{ "ellipsoid", 192, {} };

/** What the constants of cores are fitted to, and what tells how far these miss on others. */
extern const std::vector<Phantom> kFittedPhantoms;
extern const std::vector<Phantom> kOtherPhantoms;

std::string
NameOf(const Phantom & phantom);

/** Makes the phantom's file, if it is not there yet. */
CostTask
TaskOf(const Phantom & phantom, const std::filesystem::path & folder, int threads, CostJob job = CostJob::Core);

/** Of each label. */
std::vector<BoundaryCounts>
CountScan(const std::filesystem::path & scan);

template <std::size_t n>
void
PrintConstants(const std::array<double, n> & constants)
{
  std::printf("  {");
  for (std::size_t i = 0; i < constants.size(); ++i)
  {
    std::printf("%s %.3g", i > 0 ? "," : "", constants[i]);
  }
  std::printf(" },\n");
}

} // namespace voxelcore::performance
