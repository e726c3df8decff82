#include "RefinedResults.h"

#include "CertificateText.h"
#include "PruneStages.h"
#include "voxelcore/ComplexTopology.h"
#include "voxelcore/ParallelTasks.h"
#include "voxelcore/StagePlan.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace voxelcore
{

namespace
{

CertifiedCore
CertifyRefined(RefinedCore refined, const VoxelShape & voxels, const CertifiedShape & shape, CoreNumbers numbers)
{
  const std::string what = "its core refined at " + (numbers.tolerance ? numbers.tolerance->height : numbers.lambda);
  const TopologyNumbers topology = ComputeComplexTopology(refined.core.cells);
  RequireEqualTopology(shape.topology, topology, what, shape.name);
  RefinedNumbers moved;
  for (const Vector3 & d : refined.displacement)
  {
    const double length = std::hypot(d[0], d[1], d[2]);
    moved.maxDisplacement = std::max(moved.maxDisplacement, length);
    moved.meanDisplacement += length / static_cast<double>(refined.displacement.size());
  }
  if (!IsEnclosed(refined.core, voxels) || moved.maxDisplacement > 1)
  {
    RefuseResult(shape.name, "a vertex of " + what + " lies outside the shape or was moved by more than a voxel");
  }
  // A displacement in LPS mm is the difference of two places.
  std::vector<Vector3> moves(refined.displacement.size());
  for (std::size_t v = 0; v < moves.size(); ++v)
  {
    const Vector3 & place = refined.core.positions[v];
    const Vector3 & d = refined.displacement[v];
    const Vector3   from = LatticeToPhysical(shape.geometry, { place[0] - d[0], place[1] - d[1], place[2] - d[2] });
    const Vector3   to = LatticeToPhysical(shape.geometry, place);
    moves[v] = { to[0] - from[0], to[1] - from[1], to[2] - from[2] };
  }
  CertifiedCore result;
  result.core = ToPhysical(std::move(refined.core), shape.geometry, 0);
  result.core.displacement = std::move(moves);
  result.numbers = std::move(numbers);
  result.numbers.complex = DescribeComplex(result.core.core, topology);
  result.numbers.refined = moved;
  return result;
}

} // namespace

std::vector<CertifiedCore>
RefineAndCertify(const VoxelShape &       voxels,
                 const CertifiedShape &   shape,
                 RefinementParts          parts,
                 const SurfaceSource &    source,
                 std::vector<CoreNumbers> asked,
                 const ProgressCallback & progress)
{
  const auto            surface = source(voxels, PartOfProgress(progress, "surface", 0, 0.3));
  const RefinementInput input{ &voxels,
                               &parts.points,
                               &parts.core,
                               &parts.edgePoints,
                               surface.get(),
                               shape.geometry.spacing,
                               asked.front().tolerance.has_value() };
  std::vector<double>   thresholdsMm;
  for (const CoreNumbers & one : asked)
  {
    thresholdsMm.push_back(one.tolerance ? one.tolerance->heightMm : one.lambdaMm);
  }
  // Each threshold goes on from where the last one stopped.
  const std::vector<double>  ascending = AscendingBeyond(-HUGE_VAL, thresholdsMm);
  const auto                 refined = RefineCore(input, ascending, PartOfProgress(progress, "refine", 0.3, 1));
  std::vector<CertifiedCore> results;
  for (std::size_t i = 0; i < asked.size(); ++i)
  {
    const auto at = std::lower_bound(ascending.begin(), ascending.end(), thresholdsMm[i]) - ascending.begin();
    results.push_back(CertifyRefined(refined[static_cast<std::size_t>(at)], voxels, shape, std::move(asked[i])));
  }
  return results;
}

bool
IsEnclosed(const MedialComplex & core, const VoxelShape & voxels)
{
  std::atomic<bool> enclosed = true;
  RunInParts(core.positions.size() > 10000, core.positions.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t vertex = first; vertex < last && enclosed; ++vertex)
    {
      if (!ContainsInside(voxels, core.positions[vertex]))
      {
        enclosed = false;
      }
    }
  });
  return enclosed;
}

} // namespace voxelcore
