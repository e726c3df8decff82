#pragma once
// What the checks share: the input with its nearest sets, and how offenders are found and told.

#include "NearestSets.h"
#include "Vectors.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Verification/BallCoverage.h"
#include "voxelcore/Verification/Verification.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace voxelcore::verification
{

/** The input, its nearest sets, and what several checks need. */
struct Subject
{
  const VerificationInput & input;
  const CellComplex &       cells;
  const BoundaryTree &      tree;
  double                    tolerance; ///< of a coordinate, lattice units
  NearestSets               sets;
  /** The two ends of a face's dual edge; both kNoPoint when its corners do not share exactly two. */
  std::vector<std::array<std::uint32_t, 2>> dualEdges;

  const LatticePoint &
  Point(std::uint32_t place) const
  {
    return tree.Points()[place];
  }
};

inline constexpr std::uint32_t kNoPoint = 0xFFFFFFFFU;

/** Runs `offends(i)` for i below count, in parallel, and adds a check with the number of i for which it holds and
 *  `describe(i)` of the smallest. Both must be thread-safe. */
template <typename Offends, typename Describe>
void
AddCheck(VerificationReport & report, std::string name, std::size_t count, Offends && offends, Describe && describe)
{
  std::uint64_t offenders = 0;
  std::uint64_t first = count;
  FirstFailure  failure;
#pragma omp parallel for schedule(dynamic, 1024) reduction(+ : offenders) reduction(min : first) if (count > 4096)
  for (std::size_t i = 0; i < count; ++i)
  {
    bool is = false;
    failure.Guard(i, [&] { is = offends(i); });
    if (is)
    {
      ++offenders;
      first = std::min<std::uint64_t>(first, i);
    }
  }
  failure.Rethrow();
  VerificationCheck check{ std::move(name), offenders == 0, offenders, {} };
  if (offenders != 0)
  {
    check.firstOffender = describe(static_cast<std::size_t>(first));
  }
  report.checks.push_back(std::move(check));
}

std::string
Describe(const LatticePoint & point);
std::string
Describe(const Position & position);
/** With enough digits to tell two doubles apart. */
std::string
Describe(double value);
/** "vertex 7 at (x, y, z)". */
std::string
DescribeVertex(const Subject & subject, std::size_t vertex);
/** "edge 7 (vertices 1, 2)". */
std::string
DescribeEdge(const Subject & subject, std::size_t edge);
/** "face 7 (first corner 1 at (x, y, z))". */
std::string
DescribeFace(const Subject & subject, std::size_t face);

/** Whether a stored length agrees with a recomputed one. */
bool
Agree(double stored, double recomputed);

/** Radius measure in mm of the smallest ball enclosing the points of the tree. */
double
MeasureOf(const Subject & subject, std::span<const std::uint32_t> points);
/** Of an edge: from what its ends share. */
double
EdgeMeasureOf(const Subject & subject, std::size_t edge);
/** Half the distance of two points, in mm. */
double
HalfDistance(const Subject & subject, std::uint32_t a, std::uint32_t b);

/** Whether the arrays can be worked on at all; adds the checks "arrays" and "numbers". */
bool
CheckArrays(VerificationReport & report, const VerificationInput & input);
/** "edge ends", "polygons", "polygon edges"; false when faces cannot be worked on. */
bool
CheckIncidences(VerificationReport & report, const CellComplex & cells);

void
CheckDistinct(VerificationReport & report, const Subject & subject);
void
CheckVertices(VerificationReport & report, const Subject & subject);
void
CheckTrueSpacing(VerificationReport & report, const Subject & subject);
void
CheckDuals(VerificationReport & report, const Subject & subject);
void
CheckPolygons(VerificationReport & report, const Subject & subject);
void
CheckMeasures(VerificationReport & report, const Subject & subject);
void
CheckOrder(VerificationReport & report, const Subject & subject);
void
CheckCompleteness(VerificationReport & report, const Subject & subject);
void
CheckPruning(VerificationReport & report, const Subject & subject);
void
CheckTolerances(VerificationReport & report, const Subject & subject);
void
CheckCoverage(VerificationReport &      report,
              const VerificationInput & input,
              double                    positionTolerance,
              const PromisedGap &       promised);

/** "shape Euler number", "topology"; fills shapeTopology. `recount` is the shape's Euler number by other means. */
void
CheckTopology(VerificationReport & report, const VoxelShape & shape, std::int64_t recount);
/** Each first offender starts its sentence; says whether all passed. */
void
FinishReport(VerificationReport & report);
/** \throws InputError when shape and weights exceed the exact range */
void
RequireExactRange(const VoxelBox & box, const SpacingWeights & weights);
/** By how much a position straight from a computation may be off, and so the centre it is compared with. */
double
PositionRounding(const VoxelBox & box);
/** Whether a position known up to a tolerance lies inside the open shape. */
bool
IsInside(const VoxelShape & shape, const Position & position, double tolerance);

/** Fills Subject::dualEdges. */
void
FindDualEdges(Subject & subject);

} // namespace voxelcore::verification
