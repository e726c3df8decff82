#include "voxelcore/CertifiedThickness.h"

#include "CertificateText.h"
#include "InscribedThickness.h"
#include "voxelcore/BoundaryCounts.h"
#include "voxelcore/BoundaryVertices.h"
#include "voxelcore/FineBracket.h"
#include "voxelcore/FittedBalls.h"
#include "voxelcore/SpacingWeights.h"
#include "voxelcore/StagePlan.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace voxelcore
{

namespace
{

// So far along a core as its noise is long; what rises as steeply as this is no noise but an edge or the way into one.
constexpr std::int64_t kEvenings = 20; // of cubic voxels
constexpr double       kSlope = 0.4;

/** More in thick slices, whose terraces are longer; up to three times as many, as each takes its time. */
int
EveningsOf(const SpacingWeights & weights)
{
  const auto [shortest, longest] = std::minmax_element(weights.weight.begin(), weights.weight.end());
  return static_cast<int>(std::min(3 * kEvenings, (kEvenings * *longest + *shortest - 1) / *shortest));
}

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

CertifiedThickness
ThicknessOf(const CertifiedCore &    core,
            const CertifiedShape &   shape,
            VoxelShape               voxels,
            ThicknessBracket         bracket,
            const ProgressCallback & progress)
{
  const SpacingWeights weights = ComputeLatticeWeights(shape.geometry);
  CertifiedThickness   result;
  result.shape = std::move(voxels);
  result.bracket = std::move(bracket);
  const bool           refined = core.numbers.refined.has_value();
  const bool           bounds = !result.bracket.upper.values.empty();
  std::vector<Vector3> places = core.core.core.positions;
  for (Vector3 & place : places)
  {
    place = PhysicalToLattice(shape.geometry, place);
  }
  StagePlan plan(progress, { refined ? 0.5 : 0.0, refined ? 0.5 : 0.0, bounds ? 4.0 : 0.0 });
  if (const ProgressCallback fitting = plan.Next("thickness"), painting = plan.Next("thickness"); refined)
  {
    result.balls = EvenedBallsOfCore(core.core.core, EveningsOf(weights), kSlope);
    result.balls.centres = places;
    FitBalls(result.shape, weights, core.core.core.cells, result.balls, fitting);
    result.owners = OwnersAmong(result.balls, result.shape, weights, painting);
    result.map = ThicknessOfOwners(result.shape, weights, result.balls, result.owners);
  }
  else
  {
    TakeInscribed(result);
  }
  const VoxelRanks ranks(result.shape);
  result.atVertices.reserve(places.size());
  for (const Vector3 & place : places)
  {
    result.atVertices.push_back(ValueNear(result.shape, ranks, result.map, place));
  }
  if (const ProgressCallback tightening = plan.Next("thickness"); bounds)
  {
    Tighten(result, weights, tightening);
  }
  RequireThickness(result, shape.name);
  return result;
}

} // namespace voxelcore
