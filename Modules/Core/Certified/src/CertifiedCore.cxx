#include "voxelcore/Certified/CertifiedCore.h"

#include "CertificateText.h"
#include "CheckedLattice.h"
#include "PruneStages.h"
#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Complex/ComplexTopology.h"
#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Shape/BodyFrame.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace voxelcore
{

namespace
{

/** What some vertices of a refined core have. */
RefinedVertices
MovesOf(const PlacedCore & refined, const std::vector<ElementIndex> & vertices)
{
  RefinedVertices moves;
  const auto      take = [&](const auto & from, auto & to) {
    to.reserve(from.empty() ? 0 : vertices.size());
    for (std::size_t i = 0; i < vertices.size() && !from.empty(); ++i)
    {
      to.push_back(from[vertices[i]]);
    }
  };
  take(refined.displacement, moves.displacement);
  take(refined.radiusMargin, moves.radiusMargin);
  return moves;
}

void
SetMoves(RefinedVertices moves, PlacedCore & core)
{
  core.displacement = std::move(moves.displacement);
  core.radiusMargin = std::move(moves.radiusMargin);
}

/** As where it was made, so that what is pruned later gets the same figures to the last bit. */
ComplexRecord
DescribeInFrame(MedialComplex & core, const TopologyNumbers & topology, const CertifiedShape & shape)
{
  std::vector<Vector3> placed = core.positions;
  BodyFrame(shape.geometry, shape.box).Enter(core.positions);
  const ComplexRecord record = DescribeComplex(core, topology);
  core.positions.swap(placed);
  return record;
}

void
DescribeMarginsLeft(CertifiedCore & pruned)
{
  if (pruned.numbers.refined && !pruned.core.radiusMargin.empty())
  {
    pruned.numbers.refined->radiusMargin = DescribeMargins(pruned.core);
  }
}

} // namespace

MarginNumbers
DescribeMargins(const PlacedCore & placed)
{
  const MedialComplex & core = placed.core;
  MarginNumbers         numbers;
  double                whole = 0;
  for (std::size_t face = 0; face < core.cells.FaceCount(); ++face)
  {
    const auto      corners = core.cells.FaceVertices(face);
    const Vector3 & a = core.positions[corners[0]];
    const double    area = Length(Cross(Minus(core.positions[corners[1]], a), Minus(core.positions[corners[2]], a)));
    for (const ElementIndex corner : corners)
    {
      numbers.mean += area * placed.radiusMargin[corner] / 3;
    }
    whole += area;
  }
  numbers.mean = whole > 0 ? numbers.mean / whole : 0;
  for (const double margin : placed.radiusMargin)
  {
    numbers.max = std::max(numbers.max, margin);
  }
  return numbers;
}

std::vector<double>
AscendingBeyond(double doneMm, std::vector<double> thresholdsMm)
{
  std::sort(thresholdsMm.begin(), thresholdsMm.end());
  thresholdsMm.erase(std::unique(thresholdsMm.begin(), thresholdsMm.end()), thresholdsMm.end());
  std::erase_if(thresholdsMm, [doneMm](double threshold) { return threshold <= doneMm; });
  return thresholdsMm;
}

std::vector<MedialComplex>
PruneAscending(const MedialComplex &       whole,
               double                      doneMm,
               const std::vector<double> & thresholdsMm,
               const ProgressCallback &    progress)
{
  const std::vector<double> ascending = AscendingBeyond(doneMm, thresholdsMm);
  return ascending.empty() ? std::vector<MedialComplex>() : PruneByLambda(whole, ascending, progress);
}

std::vector<CertifiedCore>
CertifyPruned(CertifiedCore                whole,
              std::vector<MedialComplex>   complexes,
              std::vector<RefinedVertices> moves,
              const CertifiedShape &       shape,
              const std::vector<Lambda> &  lambdas,
              const std::vector<double> &  thresholdsMm,
              const ProgressCallback &     progress)
{
  const double               doneMm = whole.numbers.lambdaMm;
  const std::vector<double>  ascending = AscendingBeyond(doneMm, thresholdsMm);
  std::vector<CertifiedCore> results(lambdas.size());
  for (std::size_t i = 0; i < lambdas.size(); ++i)
  {
    ReportProgress(progress, "certificate", static_cast<double>(i) / static_cast<double>(lambdas.size()));
    const double threshold = thresholdsMm[i];
    const auto   place = std::lower_bound(ascending.begin(), ascending.end(), threshold) - ascending.begin();
    const bool   unchanged = threshold <= doneMm;
    auto &       source = unchanged ? whole.core.core : complexes[static_cast<std::size_t>(place)];
    // Two lambdas may come to the same threshold; the last one takes the complex, the others a copy.
    const bool neededAgain =
      std::any_of(thresholdsMm.begin() + static_cast<std::ptrdiff_t>(i) + 1, thresholdsMm.end(), [&](double later) {
        return later == threshold || (unchanged && later <= doneMm);
      });
    CertifiedCore & result = results[i];
    result.core = { whole.core.label, neededAgain ? source : std::move(source), whole.core.component };
    if (!whole.core.displacement.empty())
    {
      SetMoves(unchanged ? RefinedVertices{ whole.core.displacement, whole.core.radiusMargin }
                         : moves[static_cast<std::size_t>(place)],
               result.core);
    }
    const TopologyNumbers topology =
      unchanged ? whole.numbers.complex.topology : ComputeComplexTopology(result.core.core.cells);
    RequireEqualTopology(shape.topology, topology, "its core pruned at " + lambdas[i].text, shape.name);
    result.numbers.lambda = lambdas[i].text;
    result.numbers.lambdaMm = threshold;
    result.numbers.refined = whole.numbers.refined;
    DescribeMarginsLeft(result);
    result.numbers.complex = unchanged ? whole.numbers.complex : DescribeInFrame(result.core.core, topology, shape);
  }
  return results;
}

void
RequireTopologyOf(const CertifiedShape & shape, const CertifiedCore & core)
{
  RequireEqualTopology(shape.topology,
                       core.numbers.complex.topology,
                       "its core pruned at " + core.numbers.lambda,
                       shape.name);
}

std::vector<CertifiedCore>
PruneCertified(CertifiedCore               core,
               const CertifiedShape &      shape,
               const std::vector<Lambda> & lambdas,
               const ProgressCallback &    progress)
{
  const CoreNumbers & done = core.numbers;
  if (done.tolerance && done.tolerance->heightMm > 0)
  {
    throw UsageError(shape.name + ": its core is pruned by tolerance already and cannot be pruned by lambda");
  }
  const SpacingWeights weights = ComputeSpacingWeights(shape.geometry.spacing);
  RequireTrueLattice(weights, shape.geometry, shape.box, shape.name);
  std::vector<double> thresholds;
  for (const Lambda & lambda : lambdas)
  {
    RequireLengthIn(shape.geometry.unit, lambda);
    thresholds.push_back(LambdaInMillimetres(lambda, weights, shape.geometry.spacing, shape.box));
    if (thresholds.back() < done.lambdaMm)
    {
      throw UsageError(shape.name + ": its core is pruned at " + done.lambda + " already, beyond " + lambda.text);
    }
  }
  StagePlan plan(progress, { 0.8, 0.2 });
  core.core.core.tolerances = {};
  const ProgressCallback       prune = plan.Next("prune");
  std::vector<MedialComplex>   complexes;
  std::vector<RefinedVertices> moves;
  if (core.core.displacement.empty())
  {
    complexes = PruneAscending(core.core.core, done.lambdaMm, thresholds, prune);
  }
  else if (const std::vector<double> ascending = AscendingBeyond(done.lambdaMm, thresholds); !ascending.empty())
  {
    std::vector<std::vector<ElementIndex>> vertices;
    complexes = PruneByLambda(core.core.core, ascending, vertices, prune);
    for (const std::vector<ElementIndex> & left : vertices)
    {
      moves.push_back(MovesOf(core.core, left));
    }
  }
  return CertifyPruned(std::move(core),
                       std::move(complexes),
                       std::move(moves),
                       shape,
                       lambdas,
                       thresholds,
                       plan.Next("certificate"));
}

double
BodyDiagonal(const CertifiedShape & shape)
{
  double squared = 0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double side = static_cast<double>(shape.box.size[k]) * shape.geometry.spacing[k];
    squared += side * side;
  }
  return std::sqrt(squared);
}

ToleranceNumbers
DescribeTolerance(const Tolerance & height, const CertifiedShape & shape)
{
  return { height.text, std::min(ToleranceInMillimetres(height, shape.geometry.spacing), BodyDiagonal(shape)), {} };
}

std::vector<CertifiedCore>
PruneCertified(const CertifiedCore & core, const CertifiedShape & shape, const std::vector<Tolerance> & heights)
{
  std::vector<CertifiedCore> results(heights.size());
  for (std::size_t i = 0; i < heights.size(); ++i)
  {
    RequireLengthIn(shape.geometry.unit, heights[i]);
    ToleranceNumbers tolerance = DescribeTolerance(heights[i], shape);
    const double     height = tolerance.heightMm;
    if (!core.core.core.HasTolerances() && core.core.core.cells.vertexCount > 0)
    {
      throw UsageError(shape.name + ": its core does not hold tolerances");
    }
    if (core.numbers.tolerance && height < core.numbers.tolerance->heightMm)
    {
      throw UsageError(shape.name + ": its core is pruned at tolerance " + core.numbers.tolerance->height +
                       " already, beyond " + heights[i].text);
    }
    CertifiedCore &           result = results[i];
    std::vector<ElementIndex> left;
    result.core = { core.core.label, PruneByTolerance(core.core.core, height, left), core.core.component };
    if (!core.core.displacement.empty())
    {
      SetMoves(MovesOf(core.core, left), result.core);
    }
    const TopologyNumbers topology = ComputeComplexTopology(result.core.core.cells);
    RequireEqualTopology(shape.topology, topology, "its core pruned at tolerance " + heights[i].text, shape.name);
    result.numbers = core.numbers;
    result.numbers.tolerance = std::move(tolerance);
    DescribeMarginsLeft(result);
    result.numbers.complex = DescribeInFrame(result.core.core, topology, shape);
  }
  return results;
}

} // namespace voxelcore
