#include "voxelcore/Certified/CertifiedSkeleton.h"

#include "CertificateText.h"
#include "CheckedLattice.h"
#include "Frames.h"
#include "RequestStages.h"
#include "SkeletonSteps.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Complex/ComplexTopology.h"
#include "voxelcore/Complex/SimplePairCollapse.h"
#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Skeleton/BorderCut.h"
#include "voxelcore/Skeleton/BranchJoints.h"
#include "voxelcore/Skeleton/BranchTips.h"
#include "voxelcore/Skeleton/CrossSections.h"
#include "voxelcore/Skeleton/DomeBranches.h"
#include "voxelcore/Skeleton/OpenShape.h"
#include "voxelcore/Verification/Enclosure.h"
#include "voxelcore/Verification/StandOutCheck.h"
#include "voxelcore/VoxelCore/BallUnion.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

double
Diagonal(const Vector3 & spacing)
{
  return std::sqrt(spacing[0] * spacing[0] + spacing[1] * spacing[1] + spacing[2] * spacing[2]);
}

/** Of the cube with the same diagonal. */
double
VoxelSide(const Vector3 & spacing)
{
  return Diagonal(spacing) / std::sqrt(3.0);
}

VoxelReach
HalfAVoxel(const ImageGeometry & geometry)
{
  VoxelReach reach{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      reach[axis][k] = geometry.direction[3 * k + axis] / (0.5 * geometry.spacing[axis]);
    }
  }
  return reach;
}

double
LengthOn(const CertifiedShape & shape, const Lambda & length)
{
  const Vector3 & spacing = shape.geometry.spacing;
  return LambdaInMillimetres(length, ComputeSpacingWeights(spacing), spacing, shape.box);
}

double
StandOutOn(const CertifiedShape & shape, const SkeletonRequest & request)
{
  const Vector3 & spacing = shape.geometry.spacing;
  return InMeanVoxels(request.standOut, ComputeSpacingWeights(spacing), spacing, shape.box);
}

/** How far the places of ends lie, at most, from the vertices they are of, where radii are measured. */
double
FarthestEnd(const CurveSkeleton & curves)
{
  double farthest = 0;
  for (std::size_t v = 0; v < curves.places.size(); ++v)
  {
    farthest = std::max(farthest, Distance(curves.places[v], curves.complex.positions[v]));
  }
  return farthest;
}

/** A loop of two branches without points between their ends is cut in the middle of one, which may lie outside: points
 *  from `first` on go back towards their neighbours. */
void
TakeInside(SkeletonGraph & graph, std::size_t first, const OpenShape & inside)
{
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto points = graph.Branch(branch);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      Vector3 & place = graph.positions[points[i]];
      if (points[i] >= first && !inside.Holds(place))
      {
        place = inside.Towards(graph.positions[points[i > 0 ? i - 1 : i + 1]], place);
      }
    }
  }
}

/** The same for balls that touch the smooth surface. Where a tip was measured is not known: its ball is the one that
 *  the surface tells. Of other points what is known beyond that, how thick walls truly are, goes on with them. */
void
MeasureBallsAnew(SkeletonGraph &              graph,
                 const std::vector<Vector3> & before,
                 const ImageGeometry &        geometry,
                 const SurfaceDistance &      toSurface)
{
  const std::vector<std::uint8_t> isTip = TipFlags(graph);
  RunEach(graph.positions.size(), [&](std::size_t point) {
    double &      radius = graph.radius[point];
    const Vector3 place = PhysicalToLattice(geometry, graph.positions[point]);
    if (isTip[point] != 0)
    {
      radius = toSurface.From(place);
    }
    else if (graph.positions[point] != before[point])
    {
      radius = toSurface.RadiusAt(place, radius, PhysicalToLattice(geometry, before[point]));
    }
  });
}

/** The voxels in the balls of a core. */
VoxelShape
BodyOf(const MedialComplex & core, const CertifiedShape & shape)
{
  std::vector<Vector3> centres = core.positions;
  for (Vector3 & centre : centres)
  {
    centre = PhysicalToLattice(shape.geometry, centre);
  }
  return UnionOfBalls(shape.box, shape.geometry.spacing, centres, core.radius);
}

void
RequireTopologyOf(const SkeletonGraph & graph, const TopologyNumbers & topology, const std::string & name)
{
  const SkeletonNumbers numbers = MeasureBranches(graph).numbers;
  if (graph.FaceCount() == 0 && (numbers.components != topology.betti[0] || numbers.cycles != topology.betti[1]))
  {
    RefuseResult(name, "the branches do not have the shape's topology");
  }
}

} // namespace

double
InMeanVoxels(const Lambda & length, const SpacingWeights & weights, const Vector3 & spacing, const VoxelBox & shapeBox)
{
  return length.unit == Lambda::Unit::Voxel ? length.value * VoxelSide(spacing)
                                            : LambdaInMillimetres(length, weights, spacing, shapeBox);
}

namespace
{

void
Cut(CertifiedSkeleton & skeleton, const BranchRequest & request, double standOut)
{
  SkeletonGraph & graph = skeleton.skeleton.graph;
  if (request.cutLoops)
  {
    skeleton.cuts = CutLoops(graph, request.realLoops);
    PruneCutEnds(graph, skeleton.cuts, standOut);
  }
  if (request.splitAtJunctions)
  {
    SplitAtJunctions(graph);
  }
}

} // namespace

void
CutAndMeasure(CertifiedSkeleton & skeleton, const BranchRequest & request, double standOut)
{
  Cut(skeleton, request, standOut);
  skeleton.skeleton.table = MeasureBranches(skeleton.skeleton.graph, { request.root });
}

void
RequireLengthsIn(SpatialUnit unit, const BranchRequest & request)
{
  if (request.pruneLength)
  {
    RequireLengthIn(unit, *request.pruneLength);
  }
}

void
RequireLengthsIn(SpatialUnit unit, const SkeletonRequest & request)
{
  RequireLengthIn(unit, request.lambda);
  if (request.tolerance)
  {
    RequireLengthIn(unit, *request.tolerance);
  }
  RequireLengthIn(unit, request.standOut);
  if (request.plates)
  {
    RequireLengthIn(unit, *request.plates);
  }
  RequireLengthIn(unit, request.smooth);
  RequireLengthsIn(unit, request.branches);
}

ExtendedShape
UpToBorder(const VoxelShape &      shape,
           const ImageGeometry &   geometry,
           const VoxelBox &        scan,
           const SkeletonRequest & request)
{
  const Vector3 & spacing = geometry.spacing;
  // So long that the branches of the thinnest bodies stand out.
  const double clear =
    InMeanVoxels(request.standOut, ComputeSpacingWeights(spacing), spacing, shape.Box()) + Length(spacing);
  return ExtendBeyondBorder(shape, scan, spacing, { request.border, clear });
}

LiveElements
PartToBurn(const MedialComplex & whole, const CertifiedShape & shape, const SkeletonRequest & request)
{
  if (request.tolerance)
  {
    if (!whole.HasTolerances())
    {
      throw UsageError(shape.name + ": a skeleton is asked for of a core that is not: tolerance " +
                       request.tolerance->text);
    }
    return LeftByTolerance(whole, ToleranceInMillimetres(*request.tolerance, shape.geometry.spacing));
  }
  SimplePairCollapse collapse(whole.cells, whole.vertexLambda, whole.edgeLambda, whole.faceLambda);
  collapse.CollapseBelow(LengthOn(shape, request.lambda));
  return std::move(collapse).TakeLive();
}

namespace
{

CurveOptions
CurveOptionsOf(const CertifiedShape & shape, const SkeletonRequest & request)
{
  RequireLengthsIn(shape.geometry.unit, request);
  const Vector3 & spacing = shape.geometry.spacing;
  CurveOptions    curves;
  curves.branchThreshold = StandOutOn(shape, request);
  if (request.plates)
  {
    curves.plateThreshold = LengthOn(shape, *request.plates);
  }
  curves.sampling = 1.5 * *std::min_element(spacing.begin(), spacing.end());
  curves.geometry = shape.geometry;
  curves.voxel = VoxelSide(spacing);
  return curves;
}

BurnedCurves
Counted(CurveSkeleton curves, const CertifiedShape & shape)
{
  BurnedCurves burned;
  burned.topology = ComputeComplexTopology(curves.complex.cells);
  burned.curves = std::move(curves);
  RequireEqualTopology(shape.topology, burned.topology, "its skeleton", shape.name);
  return burned;
}

} // namespace

BurnedCurves
BurnToCurves(const MedialComplex &    core,
             const LiveElements *     part,
             const CertifiedShape &   shape,
             const SkeletonRequest &  request,
             const ProgressCallback & progress)
{
  return Counted(ComputeCurveSkeleton(core, part, CurveOptionsOf(shape, request), progress), shape);
}

BurnedCurves
BurnToCurves(MedialComplex &          core,
             const CertifiedShape &   shape,
             const SkeletonRequest &  request,
             const ProgressCallback & progress)
{
  return Counted(ComputeCurveSkeleton(core, CurveOptionsOf(shape, request), progress), shape);
}

CertifiedSkeleton
MeasureCurves(const BurnedCurves &    burned,
              const VoxelShape &      voxels,
              const CertifiedShape &  shape,
              const SkeletonRequest & request,
              const BeyondBorder *    goesOn)
{
  const Vector3 &   spacing = shape.geometry.spacing;
  CertifiedSkeleton result;
  result.topology = burned.topology;
  result.standOut = burned.standOut;
  SkeletonGraph & graph = result.skeleton.graph;
  graph = BuildSkeletonGraph(burned.curves);
  const double     window = InMeanVoxels(request.smooth, ComputeSpacingWeights(spacing), spacing, shape.box);
  const VoxelReach reach = HalfAVoxel(shape.geometry);
  const OpenShape  inside(voxels, shape.geometry);
  const auto       fit = [&] {
    const std::size_t domes = BranchIntoDomes(graph, inside, StandOutOn(shape, request));
    if (domes > 0 && window > 0)
    {
      StraightenPastDomes(graph, inside); // first, as smoothing draws their feet into them
    }
    FitBranches(graph, window, reach, inside);
    return domes;
  };
  const BranchRequest & branches = request.branches;
  const BranchLimit     limit{ branches.pruneLength ? LengthOn(shape, *branches.pruneLength) : 0, branches.pruneRadii };
  fit();
  // Past a twig that goes, a line may run into a dome and back. A dome that is pruned then is not looked for again.
  if (PruneBranches(graph, limit) > 0 && fit() > 0 && PruneBranches(graph, limit) > 0)
  {
    FitBranches(graph, window, reach, inside);
  }
  if (window > 0 && StraightenPastDomes(graph, inside) > 0)
  {
    FitBranches(graph, window, reach, inside);
  }
  RequireTopologyOf(graph, result.topology, shape.name);
  const std::vector<Vector3> measured = graph.medial; // where the radii are those of balls
  if (window > 0 && PlaceTips(graph, voxels, shape.geometry) > 0)
  {
    FitBranches(graph, window, reach, inside);
  }
  if (window > 0 && PlaceJoints(graph, voxels, shape.geometry) > 0)
  {
    FitBranches(graph, window, reach, inside);
  }
  graph.sectionRadius = CrossSectionRadii(graph, voxels, shape.geometry);
  if (burned.toSurface)
  {
    MeasureBallsAnew(graph, measured, shape.geometry, *burned.toSurface);
  }
  else if (!request.refined) // else balls are those of a smooth surface that is not known here
  {
    MeasureBallsAnew(graph, measured, FarthestEnd(burned.curves), inside);
  }
  if (goesOn != nullptr)
  {
    const std::size_t ends = CutAtBorder(graph, voxels, goesOn->scan, shape.geometry, goesOn->ends, goesOn->sections);
    RequireTopologyOf(graph, result.topology, shape.name);
    result.border = { goesOn->sections, ends };
  }
  // A place where a branch crosses the border lies between two within the body, but may be in none.
  const std::size_t points = goesOn != nullptr ? 0 : graph.positions.size();
  Cut(result, request.branches, StandOutOn(shape, request));
  TakeInside(graph, points, inside);
  return result;
}

void
RequireNothingStandsOut(BurnedCurves &          burned,
                        const VoxelShape &      voxels,
                        const CertifiedShape &  shape,
                        const SkeletonRequest & request)
{
  if (!(request.standOut.value > 0))
  {
    return;
  }
  const CurveSkeleton & curves = burned.curves;
  std::vector<Vector3>  places = curves.complex.positions;
  std::vector<double>   reach = curves.complex.radius;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    places[i] = PhysicalToLattice(shape.geometry, places[i]);
    // Of closed surfaces, which never burn, all faces stay.
    reach[i] += std::isfinite(curves.erosionThickness[i]) ? curves.erosionThickness[i] : 0;
  }
  const auto outside =
    BallStandingOut(voxels, ComputeSpacingWeights(shape.geometry.spacing), places, reach, StandOutOn(shape, request));
  if (outside)
  {
    RefuseResult(shape.name,
                 "what stands out of its skeleton by " + std::to_string(outside->beyond) +
                   InUnit(" mm", shape.geometry.unit) + " has no branch, at voxel " +
                   std::to_string(outside->voxel[0]) + "," + std::to_string(outside->voxel[1]) + "," +
                   std::to_string(outside->voxel[2]) + " of its box");
  }
  burned.standOut = true;
}

void
RequireEnclosed(const SkeletonGraph & graph, const VoxelShape & voxels, const CertifiedShape & shape)
{
  std::vector<Vector3> places = graph.positions;
  for (Vector3 & place : places)
  {
    place = PhysicalToLattice(shape.geometry, place);
  }
  if (!LieInside(voxels, places))
  {
    RefuseResult(shape.name, "a point of its skeleton lies outside it");
  }
}

CertifiedSkeleton
SkeletonOf(const PlacedCore &       core,
           const CertifiedShape &   shape,
           const SkeletonRequest &  request,
           const ProgressCallback & progress,
           const VoxelShape *       body)
{
  StagePlan            plan(progress, { 0.98, 0.02 });
  const BodyFrame      frame(shape.geometry, shape.box);
  const CertifiedShape there = InFrame(shape, frame);
  RequireTrueLattice(ComputeLatticeWeights(shape.geometry), shape.geometry, shape.box, shape.name);
  MedialComplex surface = core.core;
  frame.Enter(surface.positions);
  BurnedCurves burned = BurnToCurves(surface, nullptr, there, request, plan.Next());
  ReportProgress(plan.Next("branches"), "", 0);
  const VoxelShape voxels = body != nullptr ? MovedTo(frame.Enter(body->Box()).lower, *body) : BodyOf(surface, there);
  if (body != nullptr && BurnsWhole(request) && !request.refined)
  {
    RequireNothingStandsOut(burned, voxels, there, request);
  }
  SkeletonRequest inFrame = request;
  frame.Enter(inFrame.branches.realLoops);
  CertifiedSkeleton result = MeasureCurves(burned, voxels, there, inFrame);
  LeaveFrame(frame, request.branches.root, result);
  result.skeleton.label = core.label;
  result.skeleton.component = core.component;
  return result;
}

} // namespace voxelcore
