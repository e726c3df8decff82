#include "voxelcore/CertifiedThickness.h"

#include "CertificateText.h"
#include "voxelcore/FineBracket.h"
#include "voxelcore/FittedBalls.h"
#include "voxelcore/SpacingWeights.h"
#include "voxelcore/StagePlan.h"

#include <algorithm>
#include <utility>

namespace voxelcore
{

namespace
{

// So far along a core as its noise is long; what rises as steeply as this is no noise but an edge or the way into one.
constexpr int    kEvenings = 20;
constexpr double kSlope = 0.4;

} // namespace

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
  const bool refined = core.numbers.refined.has_value();
  result.balls = refined ? EvenedBallsOfCore(core.core.core, kEvenings, kSlope) : BallsOfCore(core.core.core);
  for (Vector3 & centre : result.balls.centres)
  {
    centre = PhysicalToLattice(shape.geometry, centre);
  }
  const bool bounds = !result.bracket.upper.values.empty();
  StagePlan  plan(progress, { refined ? 0.5 : 0.0, 0.5, bounds ? 4.0 : 0.0 });
  if (const ProgressCallback fitting = plan.Next(); refined)
  {
    FitBalls(result.shape, weights, core.core.core.cells, result.balls, fitting);
  }
  result.owners = OwnersAmong(result.balls, result.shape, weights, plan.Next());
  result.map = refined ? ThicknessOfOwners(result.shape, weights, result.balls, result.owners) : result.bracket.lower;
  const VoxelRanks ranks(result.shape);
  result.atVertices.reserve(result.balls.Count());
  for (const Vector3 & centre : result.balls.centres)
  {
    result.atVertices.push_back(ValueNear(result.shape, ranks, result.map, centre));
  }
  const auto & values = result.map.values;
  if (values.size() != result.owners.values.size() ||
      std::any_of(values.begin(), values.end(), [](float value) { return !(value > 0); }))
  {
    RefuseResult(shape.name, "a voxel has no thickness");
  }
  if (bounds)
  {
    result.parts = PartsForBounds(result.shape, weights);
    if (const ProgressCallback tightening = plan.Next(); result.parts != decltype(result.parts){ 1, 1, 1 })
    {
      TightenBracket(result.shape, weights, result.parts, result.bracket, tightening);
    }
  }
  for (std::size_t i = 0; i < result.bracket.upper.values.size(); ++i)
  {
    if (!(result.bracket.lower.values[i] <= result.bracket.upper.values[i]))
    {
      RefuseResult(shape.name, "a ball that lies in it is greater than its thickness may be");
    }
  }
  return result;
}

} // namespace voxelcore
