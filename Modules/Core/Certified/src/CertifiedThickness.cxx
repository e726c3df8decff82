#include "voxelcore/Certified/CertifiedThickness.h"

#include "CertificateText.h"
#include "InscribedThickness.h"
#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Shape/BodyFrame.h"
#include "voxelcore/Shape/BoundaryCounts.h"
#include "voxelcore/Shape/BoundaryVertices.h"
#include "voxelcore/Thickness/FineBracket.h"
#include "voxelcore/Thickness/SmoothBalls.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace voxelcore
{

namespace
{

/** \throws CertificateError where a voxel has no thickness, or a bound contradicts another */
void
RequireThickness(const CertifiedThickness & found, const std::string & name)
{
  const auto & values = found.map.values;
  if (values.size() != found.owners.values.size() ||
      std::any_of(values.begin(), values.end(), [](float value) { return !(value > 0); }))
  {
    RefuseResult(name, "a voxel has no thickness");
  }
  for (std::size_t i = 0; i < found.bracket.upper.values.size(); ++i)
  {
    if (!(found.bracket.lower.values[i] <= found.bracket.upper.values[i]))
    {
      RefuseResult(name, "a ball that lies in it is greater than its thickness may be");
    }
  }
}

/** Each square of the boundary is a facet of the cells, and no other has nothing behind it. */
void
RequireSquares(const VoxelShape & shape, const DelaunayCells & cells, const std::string & name)
{
  const auto outer =
    std::count_if(cells.facetCells.begin(), cells.facetCells.end(), [](const auto & of) { return of[1] == kOutside; });
  if (static_cast<std::uint64_t>(outer) != CountBoundarySquares(shape))
  {
    RefuseResult(name, "its Delaunay cells do not end at its boundary");
  }
}

VoxelsOutside
OutsideBounds(const VoxelValues & map, const ThicknessBracket & bracket)
{
  VoxelsOutside outside;
  for (std::size_t i = 0; i < map.values.size(); ++i)
  {
    const double value = map.values[i];
    const double beyond = std::max(bracket.lower.values[i] - value, value - bracket.upper.values[i]);
    outside.voxels += beyond > 0 ? 1 : 0;
    outside.farthest = std::max(outside.farthest, beyond);
  }
  return outside;
}

void
Tighten(CertifiedThickness & found, const SpacingWeights & weights, const ProgressCallback & progress)
{
  found.parts = PartsForBounds(found.shape, weights);
  if (found.parts != decltype(found.parts){ 1, 1, 1 })
  {
    TightenBracket(found.shape, weights, found.parts, found.bracket, progress);
  }
}

/** The map is that of the bracket's balls. */
void
TakeInscribed(CertifiedThickness & found)
{
  found.balls = std::move(found.bracket.balls);
  found.owners = std::move(found.bracket.owners);
  found.map = found.bracket.lower;
}

} // namespace

MedialSheets
SheetsOf(const PlacedCore & core, const CertifiedShape & shape, double sliver)
{
  MedialComplex there = core.core;
  BodyFrame(shape.geometry, shape.box).Enter(there.positions);
  return CutIntoSheets(there, sliver);
}

VoxelOwners
OwnersInCore(const PlacedCore & core, const CertifiedShape & shape, const VoxelShape & voxels)
{
  const BodyFrame frame(shape.geometry, shape.box);
  PaintingBalls   balls = BallsOfCore(core.core);
  frame.Enter(balls.centres);
  for (Vector3 & centre : balls.centres)
  {
    centre = PhysicalToLattice(frame.Geometry(), centre);
  }
  VoxelOwners owners =
    OwnersAmong(balls, MovedTo(frame.Enter(voxels.Box()).lower, voxels), ComputeLatticeWeights(shape.geometry));
  owners.box = voxels.Box();
  return owners;
}

CertifiedThickness
InscribedThickness(const VoxelShape &       voxels,
                   const VoxelShape *       part,
                   const ImageGeometry &    geometry,
                   const CertifiedRequest & request,
                   const ProgressCallback & progress)
{
  const SpacingWeights weights = ComputeLatticeWeights(geometry);
  const bool           bounds = request.thickness->bounds && part == nullptr;
  StagePlan            plan(progress, { 0.3, 0.7, bounds ? 4.0 : 0.0 });
  CertifiedThickness   found;
  {
    const std::vector<LatticePoint> points = BoundaryVertices(voxels);
    const DelaunayCells cells = ComputeDelaunayCells(voxels, points, weights, request.engine, plan.Next("delaunay"));
    RequireSquares(voxels, cells, request.name);
    found.bracket = BracketThickness(voxels, points, cells, weights, bounds, plan.Next("thickness"), part);
  }
  found.shape = part == nullptr ? voxels : *part;
  TakeInscribed(found);
  if (const ProgressCallback tightening = plan.Next("thickness"); bounds)
  {
    Tighten(found, weights, tightening);
  }
  RequireThickness(found, request.name);
  return found;
}

SurfaceSource::Estimate
SurfaceForThickness(const CertifiedRequest & request, const VoxelShape & voxels, const ProgressCallback & progress)
{
  return request.surface->IsOfShape() ? nullptr : (*request.surface)(voxels, {}, progress);
}

CertifiedThickness
SmoothThickness(VoxelShape               voxels,
                const SpacingWeights &   weights,
                const SurfaceEstimate *  surface,
                bool                     bounds,
                const std::string &      name,
                const ProgressCallback & progress)
{
  StagePlan          plan(progress, { 0.7, 0.3, bounds ? 4.0 : 0.0 });
  CertifiedThickness found;
  found.shape = std::move(voxels);
  found.balls = SmoothBalls(found.shape, weights, surface, plan.Next("thickness"));
  found.owners = OwnersAmong(found.balls, found.shape, weights, plan.Next("thickness"));
  KeepOwners(found.balls, found.owners);
  if (!LieInVoxels(found.balls, found.shape, weights))
  {
    RefuseResult(name, "a ball in its surface reaches too far beyond its voxels");
  }
  found.map = SmoothThicknessOf(found.shape, weights, found.balls, found.owners);
  if (const ProgressCallback bracketing = plan.Next("thickness"); bounds)
  {
    found.parts = PartsForBounds(found.shape, weights);
    found.bracket = SmoothBracket(found.shape, weights, bracketing);
    RequireThickness(found, name);
    found.outside = OutsideBounds(found.map, found.bracket);
    if (found.outside.voxels > 0 && surface == nullptr)
    {
      RefuseResult(name, "a voxel is thinner or thicker than its labels allow");
    }
  }
  RequireThickness(found, name);
  return found;
}

std::vector<float>
ThicknessAt(const CertifiedThickness & found, const std::vector<Vector3> & positions, const ImageGeometry & geometry)
{
  const VoxelRanks   ranks(found.shape);
  std::vector<float> values;
  values.reserve(positions.size());
  for (const Vector3 & position : positions)
  {
    values.push_back(ValueNear(found.shape, ranks, found.map, PhysicalToLattice(geometry, position)));
  }
  return values;
}

CertifiedThickness
ThicknessOf(const CertifiedShape &   shape,
            VoxelShape               voxels,
            ThicknessBracket         bracket,
            const ProgressCallback & progress)
{
  CertifiedThickness result;
  result.shape = std::move(voxels);
  result.bracket = std::move(bracket);
  const bool bounds = !result.bracket.upper.values.empty();
  TakeInscribed(result);
  if (bounds)
  {
    Tighten(result, ComputeLatticeWeights(shape.geometry), progress);
  }
  RequireThickness(result, shape.name);
  return result;
}

} // namespace voxelcore
