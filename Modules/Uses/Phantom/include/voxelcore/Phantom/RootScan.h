#pragma once
// A grey scan of the phantom `root` as CT would show it, with everything known: hollow roots with holes in their walls,
// broken and touching roots, soil, noise, ring artefacts. Voxels at a surface hold the part of them that is root.
//
// The same options give the same values on every machine (see Phantom.h).

#include "voxelcore/Phantom/Phantom.h"

#include <cstdint>
#include <vector>

namespace voxelcore
{

struct RootScanOptions
{
  PhantomOptions root;       ///< of kind root
  double         hollow = 0; ///< 0 to 0.9: radius of the lumen as part of the root's, where a wall of 1.8 voxels and a
                             ///< lumen 2.4 voxels wide fit
  int                   holes = 0;  ///< through the walls of hollow roots, two voxels wide
  int                   breaks = 0; ///< places where a root is torn, a voxel or two long
  double                noise = 0;  ///< standard deviation, as part of the contrast
  double                rings = 0;  ///< amplitude of rings around the middle of each slice, as part of the contrast
  std::optional<double> soil;       ///< mm: height of the soil plane, below which the background is brighter
};

constexpr std::uint16_t kRootScanAir = 10000;
constexpr std::uint16_t kRootScanRoot = 30000;
constexpr std::uint16_t kRootScanSoil = 12000;

/** What is known is in lattice coordinates (voxel index + 1/2) and mm, as of the phantom. */
struct RootScan
{
  std::vector<std::uint16_t>   values; ///< x fastest
  std::vector<CentreLinePoint> lines;
  std::vector<RootContact>     contacts;
  std::vector<Vector3>         holes;  ///< where they leave the root
  std::vector<Vector3>         breaks; ///< on the centre line
};

/** \throws UsageError for a value without sense; Cancelled */
RootScan
MakeRootScan(const RootScanOptions & options, const ProgressCallback & progress = {});

} // namespace voxelcore
