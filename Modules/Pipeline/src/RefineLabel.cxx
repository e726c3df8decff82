#include "RefineLabel.h"

#include "voxelcore/ComplexTopology.h"
#include "voxelcore/CoreJob.h"
#include "voxelcore/Error.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

PrunedCore
CertifyRefined(RefinedCore           refined,
               const VoxelShape &    shape,
               const ImageGeometry & geometry,
               const Lambda &        lambda,
               double                thresholdMm,
               const LabelRecord &   record,
               const std::string &   labelText)
{
  const TopologyNumbers topology = ComputeComplexTopology(refined.core.cells);
  RequireEqualTopology(record.shape, topology, "its core refined at " + lambda.text, labelText);
  RefinedRecord moved;
  for (const Vector3 & d : refined.displacement)
  {
    const double length = std::hypot(d[0], d[1], d[2]);
    moved.maxDisplacement = std::max(moved.maxDisplacement, length);
    moved.meanDisplacement += length / static_cast<double>(refined.displacement.size());
  }
  if (!IsEnclosed(refined.core, shape) || moved.maxDisplacement > 1)
  {
    throw CertificateError(
      labelText + ": certificate failed: a vertex of its core refined at " + lambda.text +
      " lies outside the shape or was moved by more than a voxel; nothing was written; this is a " +
      "fault of VoxelCore, please report it with the scan");
  }
  // A displacement in LPS mm is the difference of two places.
  std::vector<Vector3> moves(refined.displacement.size());
  for (std::size_t v = 0; v < moves.size(); ++v)
  {
    const Vector3 & place = refined.core.positions[v];
    const Vector3 & d = refined.displacement[v];
    const Vector3   from = LatticeToPhysical(geometry, { place[0] - d[0], place[1] - d[1], place[2] - d[2] });
    const Vector3   to = LatticeToPhysical(geometry, place);
    moves[v] = { to[0] - from[0], to[1] - from[1], to[2] - from[2] };
  }
  PrunedCore result;
  result.part = ToPhysical(std::move(refined.core), geometry, record.label);
  result.part.displacement = std::move(moves);
  result.record.lambda = lambda.text;
  result.record.lambdaMm = thresholdMm;
  result.record.complex = DescribeComplex(result.part.core, topology);
  result.record.refined = moved;
  return result;
}

} // namespace

std::vector<PrunedCore>
RefineAndCertify(const VoxelShape &          shape,
                 RefinementParts             parts,
                 const SurfaceSource &       source,
                 const ImageGeometry &       geometry,
                 const std::vector<Lambda> & lambdas,
                 const std::vector<double> & thresholdsMm,
                 const LabelRecord &         record,
                 const std::string &         labelText,
                 const ProgressCallback &    progress)
{
  const auto            surface = source(shape, PartOfProgress(progress, "surface", 0, 0.3));
  const RefinementInput input{ &shape, &parts.points, &parts.core, &parts.edgePoints, surface.get(), geometry.spacing };
  // Each threshold goes on from where the last one stopped.
  const std::vector<double> ascending = AscendingBeyond(-HUGE_VAL, thresholdsMm);
  const auto                refined = RefineCore(input, ascending, PartOfProgress(progress, "refine", 0.3, 1));
  std::vector<PrunedCore>   results;
  for (std::size_t i = 0; i < lambdas.size(); ++i)
  {
    const auto at = std::lower_bound(ascending.begin(), ascending.end(), thresholdsMm[i]) - ascending.begin();
    results.push_back(CertifyRefined(refined[static_cast<std::size_t>(at)],
                                     shape,
                                     geometry,
                                     lambdas[i],
                                     thresholdsMm[i],
                                     record,
                                     labelText));
  }
  return results;
}

} // namespace voxelcore
