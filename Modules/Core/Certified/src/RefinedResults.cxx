#include "RefinedResults.h"

#include "CertificateText.h"
#include "PruneStages.h"
#include "RefinedTolerances.h"
#include "voxelcore/Base/Hypot.h"
#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Complex/ComplexTopology.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Refinement/RadiusMargin.h"
#include "voxelcore/Verification/Enclosure.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr double kSamePlace = 1e-6; ///< voxels; more than ways to LPS mm and back lose

/** Compares what was refined with the shape, and tells how far it was moved. */
RefinedNumbers
RequireRefined(const RefinedCore & refined,
               const VoxelShape &  voxels,
               const std::string & name,
               const std::string & what)
{
  RefinedNumbers moved;
  moved.hairsRemoved = refined.hairsTaken;
  for (const Vector3 & d : refined.displacement)
  {
    const double length = Hypot(d[0], d[1], d[2]);
    moved.maxDisplacement = std::max(moved.maxDisplacement, length);
    moved.meanDisplacement += length / static_cast<double>(refined.displacement.size());
  }
  if (!LieInside(voxels, refined.core.positions) || moved.maxDisplacement > 1)
  {
    RefuseResult(name, "a vertex of " + what + " lies outside the shape or was moved by more than a voxel");
  }
  return moved;
}

/** What moved each vertex, in LPS mm: the difference of two places. */
std::vector<Vector3>
MovesInLps(const RefinedCore & refined, const ImageGeometry & geometry)
{
  std::vector<Vector3> moves(refined.displacement.size());
  for (std::size_t v = 0; v < moves.size(); ++v)
  {
    const Vector3 & place = refined.core.positions[v];
    const Vector3   from = LatticeToPhysical(geometry, Minus(place, refined.displacement[v]));
    moves[v] = Minus(LatticeToPhysical(geometry, place), from);
  }
  return moves;
}

/** Also tells how far radii may be off where the surface is `ofLabels`. */
CertifiedCore
CertifyRefined(RefinedCore            refined,
               const MedialComplex &  whole,
               const VoxelShape &     voxels,
               const CertifiedShape & shape,
               bool                   ofLabels,
               CoreNumbers            numbers)
{
  const std::string what = "its core refined at " + (numbers.tolerance ? numbers.tolerance->height : numbers.lambda);
  const TopologyNumbers topology = ComputeComplexTopology(refined.core.cells);
  RequireEqualTopology(shape.topology, topology, what, shape.name);
  numbers.refined = RequireRefined(refined, voxels, shape.name, what);
  if (numbers.tolerance)
  {
    refined.core.tolerances =
      TolerancesOfTriangles(refined.core.cells, refined.kept, refined.polygons, whole, numbers.tolerance->heightMm);
  }
  std::vector<double> margins;
  if (ofLabels)
  {
    margins = RadiusMargins(refined.core, voxels, shape.geometry.spacing);
  }
  std::vector<Vector3> moves = MovesInLps(refined, shape.geometry);
  CertifiedCore        result;
  result.core = ToPhysical(std::move(refined.core), shape.geometry, 0);
  result.core.displacement = std::move(moves);
  result.core.radiusMargin = std::move(margins);
  result.numbers = std::move(numbers);
  if (ofLabels)
  {
    result.numbers.refined->radiusMargin = DescribeMargins(result.core);
  }
  result.numbers.complex = DescribeComplex(result.core.core, topology);
  return result;
}

/** The elements of the core that are in the curves. */
LiveElements
ElementsOf(const PartElements & curves, const CellComplex & core)
{
  LiveElements elements{ std::vector<std::uint8_t>(core.vertexCount, 0),
                         std::vector<std::uint8_t>(core.edges.size(), 0),
                         std::vector<std::uint8_t>(core.FaceCount(), 0) };
  for (const auto & [indices, flags] : { std::pair(&curves.vertices, &elements.vertices),
                                         std::pair(&curves.edges, &elements.edges),
                                         std::pair(&curves.faces, &elements.faces) })
  {
    for (const ElementIndex index : *indices)
    {
      (*flags)[index] = 1;
    }
  }
  return elements;
}

/** From each end of the curves the way inwards, seen over `reach` mm: unit vectors by vertex. */
std::vector<std::pair<ElementIndex, Vector3>>
WaysInwards(const MedialComplex & curves, double reach)
{
  const CellComplex &        cells = curves.cells;
  const std::vector<Cofaces> edgesAt = CountVertexCofaces(cells);
  const auto                 otherEnd = [&](ElementIndex edge, ElementIndex vertex) {
    return cells.edges[edge][0] ^ cells.edges[edge][1] ^ vertex;
  };
  std::vector<std::pair<ElementIndex, Vector3>> ways;
  for (ElementIndex tip = 0; tip < edgesAt.size(); ++tip)
  {
    if (edgesAt[tip].count != 1)
    {
      continue;
    }
    ElementIndex edge = edgesAt[tip].exclusiveOr;
    ElementIndex at = otherEnd(edge, tip);
    while (edgesAt[at].count == 2 && Distance(curves.positions[tip], curves.positions[at]) < reach)
    {
      edge ^= edgesAt[at].exclusiveOr;
      at = otherEnd(edge, at);
    }
    const Vector3 way = Minus(curves.positions[at], curves.positions[tip]);
    ways.emplace_back(tip, AddScaled({ 0, 0, 0 }, 1 / Length(way), way));
  }
  return ways;
}

/** Puts the curves where refinement has moved them. Ends do not draw back: the surface about a tip shrinks when it is
 *  smoothed, the branch does not. A radius is that of the place where the point is put. */
void
MoveCurves(const RefinedCore & refined, const VoxelShape & voxels, const CertifiedShape & shape, BurnedCurves & burned)
{
  const std::string what = "its refined skeleton";
  RequireEqualTopology(shape.topology, ComputeComplexTopology(refined.core.cells), what, shape.name);
  RequireRefined(refined, voxels, shape.name, what);
  MedialComplex &      curves = burned.curves.complex;
  std::vector<Vector3> moves = MovesInLps(refined, shape.geometry);
  for (const auto & [tip, inwards] : WaysInwards(curves, 3 * Length(shape.geometry.spacing)))
  {
    moves[tip] = AddScaled(moves[tip], -std::max(0.0, Dot(moves[tip], inwards)), inwards);
  }
  const auto isInside = [&](const Vector3 & place) {
    return ContainsInside(voxels, PhysicalToLattice(shape.geometry, place));
  };
  for (std::size_t v = 0; v < moves.size(); ++v)
  {
    Vector3 &     position = curves.positions[v];
    Vector3 &     end = burned.curves.places[v];
    const Vector3 beyond = AddScaled(end, 1, moves[v]);
    const Vector3 place = AddScaled(position, 1, moves[v]);
    if (isInside(place))
    {
      end = end != position && isInside(beyond) ? beyond : place;
      position = place;
    }
    curves.radius[v] = refined.core.radius[v];
    const Vector3 & measured = refined.core.positions[v];
    const Vector3   given = PhysicalToLattice(shape.geometry, position);
    if (Length(Minus(given, measured)) > kSamePlace)
    {
      curves.radius[v] = burned.toSurface->RadiusAt(given, curves.radius[v], measured);
    }
  }
}

/** At which each core of the task is pruned, in mm. */
std::vector<double>
ThresholdsOf(const RefinementTask & task)
{
  std::vector<double> thresholdsMm;
  for (const CoreNumbers & one : task.asked)
  {
    thresholdsMm.push_back(one.tolerance ? one.tolerance->heightMm : one.lambdaMm);
  }
  return thresholdsMm;
}

bool
IsByTolerance(const RefinementTask & task)
{
  return !task.asked.empty() && task.asked.front().tolerance.has_value();
}

/** Of a core by tolerance it will be asked which heights its cells have. */
void
FreeWhatIsRefined(RefinementParts & parts, bool byTolerance)
{
  parts.edgePoints = EdgePoints();
  MedialComplex asked;
  if (byTolerance)
  {
    asked.cells = std::move(parts.core.cells);
    asked.tolerances = std::move(parts.core.tolerances);
  }
  parts.core = std::move(asked);
}

} // namespace

// Each threshold goes on from where the last one stopped.
void
KeepAsked(const Vector3 &          spacing,
          const MedialComplex &    whole,
          const RefinementTask &   task,
          RefinementParts &        parts,
          const ProgressCallback & progress)
{
  parts.left = LeftToRefine(whole, AscendingBeyond(-HUGE_VAL, ThresholdsOf(task)), IsByTolerance(task), progress);
  if (task.curves)
  {
    parts.curves.push_back(ElementsOf(task.curves->curves.inSurface, whole.cells));
  }
  parts.points = parts.boundary;
  parts.core = KeepToRefine(spacing, whole, parts.edgePoints, parts.points, parts.left, parts.curves);
}

std::vector<CertifiedCore>
RefineAndCertify(const VoxelShape &       voxels,
                 const CertifiedShape &   shape,
                 RefinementParts          parts,
                 const SurfaceSource &    source,
                 RefinementTask           task,
                 const ProgressCallback & progress)
{
  const std::vector<double> thresholdsMm = ThresholdsOf(task);
  const std::vector<double> ascending = AscendingBeyond(-HUGE_VAL, thresholdsMm);
  std::vector<RefinedCore>  refined;
  bool                      ofLabels = false;

  std::shared_ptr<const SurfaceDistance> toSurface;
  {
    const auto      surface = source(voxels, {}, PartOfProgress(progress, "surface", 0.05, 0.35));
    RefinementInput input{ &voxels,
                           &parts.points,
                           &parts.core,
                           &parts.edgePoints,
                           surface.get(),
                           shape.geometry.spacing,
                           IsByTolerance(task),
                           std::move(parts.curves),
                           std::move(parts.left),
                           &parts.boundary,
                           [&] { FreeWhatIsRefined(parts, IsByTolerance(task)); } };
    ofLabels = surface->IsOfLabels();
    refined = RefineCore(input, ascending, PartOfProgress(progress, "refine", 0.35, 1));
    if (task.curves)
    {
      toSurface = std::make_shared<const SurfaceDistance>(surface, parts.boundary, shape.geometry.spacing);
    }
  }
  std::vector<CertifiedCore> results;
  for (std::size_t i = 0; i < task.asked.size(); ++i)
  {
    const auto    at = std::lower_bound(ascending.begin(), ascending.end(), thresholdsMm[i]) - ascending.begin();
    RefinedCore & core = refined[static_cast<std::size_t>(at)];
    const bool    again =
      std::find(thresholdsMm.begin() + static_cast<std::ptrdiff_t>(i) + 1, thresholdsMm.end(), thresholdsMm[i]) !=
      thresholdsMm.end();
    results.push_back(CertifyRefined(again ? RefinedCore(core) : std::move(core),
                                     parts.core,
                                     voxels,
                                     shape,
                                     ofLabels,
                                     std::move(task.asked[i])));
  }
  if (task.curves)
  {
    task.curves->toSurface = toSurface;
    MoveCurves(refined.back(), voxels, shape, *task.curves);
  }
  return results;
}

} // namespace voxelcore
