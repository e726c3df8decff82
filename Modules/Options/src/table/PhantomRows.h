#pragma once
// Options of `phantom` alone.

#include "CommandBits.h"

#include <array>

namespace voxelcore::table
{

inline constexpr auto kPhantomRows = std::to_array<Parameter>({
  { "size", "--size", Text, "N|X,Y,Z", "64", false, kPhantom, "Size in voxels" },
  { "spacing", "--spacing", Text, "X,Y,Z", "1,1,1", false, kPhantom, "Voxel size in mm" },
  { "seed", "--seed", Integer, "N", "1", false, kPhantom, "Seed of the random kinds: porous, noise, root, cells" },
  { "radius", "--radius", Real, "MM", "", false, kPhantom, "Radius; the default depends on the kind" },
  { "thickness", "--thickness", Real, "MM", "", false, kPhantom, "Thickness; the default depends on the kind" },
  { "period",
    "--period",
    Real,
    "MM",
    "",
    false,
    kPhantom,
    "Period of the gyroid, or distance between the grains of porous" },
  { "density", "--density", Real, "0..1", "", false, kPhantom, "Volume fraction of porous and noise" },
  { "detail", "--detail", Real, "MM", "", false, kPhantom, "Smallest radius of a root" },
  { "laterals", "--laterals", Integer, "N", "", false, kPhantom, "Number of laterals on the stem of a root" },
  { "sub-laterals", "--sub-laterals", Integer, "N", "", false, kPhantom, "Number of laterals on each lateral" },
  { "cells", "--cells", Integer, "N", "", false, kPhantom, "Number of bodies of the kind cells" },
});

} // namespace voxelcore::table
