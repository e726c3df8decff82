#pragma once
// Shapes with known cores, and cores made ready for verification.

#include "voxelcore/Verification/Verification.h"
#include "voxelcore/VoxelCore/MedialComplex.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace voxelcore::testing
{

/** A box of voxels with those in for which `isIn` says so. */
VoxelShape
MakeShape(const std::array<std::int32_t, 3> &                                   size,
          const std::function<bool(std::int32_t, std::int32_t, std::int32_t)> & isIn,
          const std::array<std::int32_t, 3> &                                   lower = { 0, 0, 0 });

/** All voxels of a box in. */
VoxelShape
SolidBox(const std::array<std::int32_t, 3> & size);

/** Voxels in with the given probability (percent). */
VoxelShape
RandomShape(std::uint32_t seed, const std::array<std::int32_t, 3> & size, unsigned percent);

/** An ellipsoid with a rod one voxel thick on it: faces with many corners, and edges on no face. */
VoxelShape
EllipsoidWithRod();

/** A shape, its weights and a core of it. */
struct VerificationCase
{
  VoxelShape            shape;
  SpacingWeights        weights;
  MedialComplex         core;
  std::optional<double> threshold;
  double                positionTolerance = 0;
  bool                  polygonsReversed = false;
  std::array<double, 3> spacing{ 1, 1, 1 };
};

/** With the core as the product makes it, pruned to `threshold` mm if that is > 0. */
VerificationCase
MakeCase(VoxelShape shape, const std::array<double, 3> & spacing, double threshold = 0);

/** Refers to the case. */
VerificationInput
InputOf(const VerificationCase & subject);

VerificationReport
Verify(const VerificationCase & subject);

/** The names of the checks that did not pass. */
std::vector<std::string>
FailedChecks(const VerificationReport & report);

/** Failed checks with their offenders, for messages. */
std::string
Summary(const VerificationReport & report);

} // namespace voxelcore::testing
