#pragma once
// Bodies with known sections, and their certified skeletons.

#include "VoxelCoreTesting/BodyVoxels.h"

#include "voxelcore/Certified/Certified.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Vessels/BranchSections.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

namespace voxelcore::testing
{

/** A body with all that its sections are measured by. */
struct MeasuredBody
{
  VoxelShape    shape;
  ImageGeometry geometry;
  SkeletonGraph graph;

  std::vector<BranchSection>
  Sections(std::optional<double> every = {}, std::optional<VoxelBox> scan = {}) const
  {
    return MeasureSections(graph, { &shape, nullptr, geometry, scan }, every);
  }
};

/** The grid whose first voxel is at the origin, up to the end of the shape's box. */
inline ImageGeometry
GridOf(const VoxelShape & shape, const Vector3 & spacing)
{
  ImageGeometry geometry;
  geometry.spacing = spacing;
  geometry.size = { shape.Box().size[0] + shape.Box().lower[0],
                    shape.Box().size[1] + shape.Box().lower[1],
                    shape.Box().size[2] + shape.Box().lower[2] };
  return geometry;
}

/** What the program makes of a body by default. */
inline MeasuredBody
MeasureBody(VoxelShape shape, const ImageGeometry & geometry)
{
  MeasuredBody body;
  body.geometry = geometry;
  CertifiedRequest request;
  request.surface = SurfaceSource();
  request.skeleton.emplace();
  request.skeleton->lambda = ParseLambda("0");
  request.lambdas = { ParseLambda("0") };
  request.skeleton->standOut = ParseLambda("3vox");
  request.skeleton->smooth = ParseLambda("6vox");
  request.skeleton->branches.pruneRadii = 1;
  body.graph = ComputeCertified(shape, geometry, request).skeleton->skeleton.graph;
  body.shape = std::move(shape);
  return body;
}

inline Vector3
Unit(const Vector3 & way)
{
  return AddScaled({}, 1 / Length(way), way);
}

/** Three unit vectors at right angles, every turn as likely. */
inline std::array<Vector3, 3>
AnyTurn(std::mt19937_64 & random)
{
  std::normal_distribution<double> normal;
  const auto                       any = [&] { return Unit({ normal(random), normal(random), normal(random) }); };
  const Vector3                    first = any();
  const Vector3                    second = Unit(Cross(first, any()));
  return { first, second, Cross(first, second) };
}

} // namespace voxelcore::testing
