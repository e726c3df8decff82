#include "voxelcore/CertifiedThickness.h"

#include "CertificateText.h"
#include "voxelcore/SpacingWeights.h"

#include <algorithm>
#include <utility>

namespace voxelcore
{

namespace
{

// Takes half off the bias of walls; more changes little.
constexpr int kEvenings = 3;

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
  result.balls = core.numbers.refined ? EvenedBallsOfCore(core.core.core, kEvenings) : BallsOfCore(core.core.core);
  for (Vector3 & centre : result.balls.centres)
  {
    centre = PhysicalToLattice(shape.geometry, centre);
  }
  result.owners = OwnersAmong(result.balls, result.shape, weights, progress);
  result.map =
    core.numbers.refined ? ThicknessOfOwners(result.shape, weights, result.balls, result.owners) : result.bracket.lower;
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
