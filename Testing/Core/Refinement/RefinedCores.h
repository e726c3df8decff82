#pragma once
// Refined cores of small shapes.

#include "VoxelCoreTesting/Cores.h"

#include "voxelcore/Refinement/Refinement.h"

namespace voxelcore::testing
{

/** What a threshold in mm leaves of a shape's core, refined. */
inline RefinedCore
Refine(const VoxelShape &      shape,
       const Spacing3 &        spacing,
       double                  threshold,
       const SurfaceEstimate * given = nullptr) // else from labels
{
  const SpacingWeights weights = ComputeSpacingWeights(spacing);
  const auto           points = BoundaryVertices(shape);
  DelaunayCells        cells = ComputeDelaunayCells(shape, points, weights, Engine::Auto);
  const EdgePoints     edgePoints = NearestToEdges(cells);
  const MedialComplex  core = BuildVoxelCore(shape, points, std::move(cells), weights);
  const auto           labels = given == nullptr ? SurfaceFromLabels(shape, spacing) : nullptr;
  const auto *         surface = given != nullptr ? given : labels.get();
  return std::move(RefineCore({ &shape, &points, &core, &edgePoints, surface, spacing }, { threshold })[0]);
}

/** What a tolerance in mm leaves of a shape's core, refined from labels. */
inline RefinedCore
RefineByTolerance(const VoxelShape & shape, const Spacing3 & spacing, double height)
{
  const SpacingWeights weights = ComputeSpacingWeights(spacing);
  const auto           points = BoundaryVertices(shape);
  DelaunayCells        cells = ComputeDelaunayCells(shape, points, weights, Engine::Auto);
  const EdgePoints     edgePoints = NearestToEdges(cells);
  auto                 touching = LargestTouchingBalls(shape, cells, points, weights);
  MedialComplex        core = BuildVoxelCore(shape, points, std::move(cells), weights);
  core.tolerances = ComputeTolerances(core, weights, points, std::move(touching));
  const auto surface = SurfaceFromLabels(shape, spacing);
  return std::move(
    RefineCore({ &shape, &points, &core, &edgePoints, surface.get(), spacing, true }, { height }).front());
}

inline Vector3
Minus(const Vector3 & a, const Vector3 & b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

/** Twice a triangle's area along its normal, in mm^2. */
inline Vector3
Normal(const Vector3 & a, const Vector3 & b, const Vector3 & c, const Spacing3 & spacing)
{
  Vector3 ab = Minus(b, a);
  Vector3 ac = Minus(c, a);
  for (std::size_t k = 0; k < 3; ++k)
  {
    ab[k] *= spacing[k];
    ac[k] *= spacing[k];
  }
  return { ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2], ab[0] * ac[1] - ab[1] * ac[0] };
}

} // namespace voxelcore::testing
