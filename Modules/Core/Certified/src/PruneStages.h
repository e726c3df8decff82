#pragma once
// Steps of pruning that a whole core and a finished one share.

#include "voxelcore/Certified/CertifiedCore.h"

#include <vector>

namespace voxelcore
{

/** The different thresholds beyond doneMm, ascending. */
std::vector<double>
AscendingBeyond(double doneMm, std::vector<double> thresholdsMm);

/** `whole`, which is pruned to `doneMm` already, pruned to each different threshold beyond that, ascending. */
std::vector<MedialComplex>
PruneAscending(const MedialComplex &       whole,
               double                      doneMm,
               const std::vector<double> & thresholdsMm,
               const ProgressCallback &    progress);

/** What a refined core has per vertex. */
struct RefinedVertices
{
  std::vector<Vector3> displacement;
  std::vector<double>  radiusMargin;
};

/** Checks and describes what PruneAscending() made of `whole`: a core for each lambda. `moves`, where `whole` is
 *  refined: what each complex has of it.
 *  \throws CertificateError when the topology is no longer the shape's. */
std::vector<CertifiedCore>
CertifyPruned(CertifiedCore                whole,
              std::vector<MedialComplex>   complexes,
              std::vector<RefinedVertices> moves,
              const CertifiedShape &       shape,
              const std::vector<Lambda> &  lambdas,
              const std::vector<double> &  thresholdsMm,
              const ProgressCallback &     progress);

/** Of a core of triangles with its margins: their mean over the area of faces, and the greatest. */
MarginNumbers
DescribeMargins(const PlacedCore & placed);

/** How a core pruned to a height is described; no height is greater than the diagonal of the body's box. */
ToleranceNumbers
DescribeTolerance(const Tolerance & height, const CertifiedShape & shape);

/** The diagonal of a body's box in mm: no bump is higher. */
double
BodyDiagonal(const CertifiedShape & shape);

} // namespace voxelcore
