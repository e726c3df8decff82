#include "WholeCore.h"

#include "CertificateText.h"
#include "CrossCheck.h"
#include "PruneStages.h"
#include "RequestStages.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/Stopwatch.h"
#include "voxelcore/Shape/BoundaryVertices.h"
#include "voxelcore/Shape/ShapeTopology.h"
#include "voxelcore/Verification/Enclosure.h"
#include "voxelcore/VoxelCore/VoxelCore.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

/** As ended in files: what never goes, and what would go beyond the diagonal of the body's box, has a height greater
 *  by a hundredth than all others: a slider can tell it from them, and a range of colours stays as it is. */
void
EndTolerances(ToleranceValues & values, const CertifiedShape & shape)
{
  const double diagonal = BodyDiagonal(shape);
  double       greatest = 0;
  for (const double value : values.vertices)
  {
    greatest = value < diagonal ? std::max(greatest, value) : greatest;
  }
  const double end = greatest > 0 ? std::min(1.01 * greatest, diagonal) : diagonal;
  for (auto * one : { &values.vertices, &values.edges, &values.faces })
  {
    RunInParts(one->size() > 10000, one->size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
      {
        (*one)[i] = std::min((*one)[i], end);
      }
    });
  }
}

void
RequireEnclosed(const MedialComplex & core, const VoxelShape & voxels, const std::string & name)
{
  if (!LieInside(voxels, core.positions))
  {
    RefuseResult(name, "a vertex of the core lies outside the shape");
  }
}

/** Where nothing but its positions will change, these are enough to take it back to the lattice. */
void
KeepPlaces(const MedialComplex & core, const ImageGeometry & geometry, RefinementParts & kept)
{
  if (IsLeftHanded(geometry)) // polygons are turned round, too
  {
    kept.core = core;
  }
  else
  {
    kept.core.positions = core.positions;
  }
}

DelaunayCells
CellsOf(const VoxelShape &                voxels,
        const std::vector<LatticePoint> & points,
        const CertifiedRequest &          request,
        const SpacingWeights &            weights,
        const ProgressCallback &          progress)
{
  if (request.cells)
  {
    return request.cells(points, progress);
  }
  if (request.crossCheck)
  {
    return CrossCheckedCells(voxels, points, weights, request.engine, request.name, progress);
  }
  // A core is made of the facets between its cells.
  const bool boundaryToo = !request.tolerances.empty() || NeedsBracket(request);
  return ComputeDelaunayCells(voxels,
                              points,
                              weights,
                              request.engine,
                              progress,
                              boundaryToo ? Facets::All : Facets::Inside);
}

} // namespace

WholeCore
MakeWholeCore(const VoxelShape &       voxels,
              const CertifiedRequest & request,
              const SpacingWeights &   weights,
              double                   lambdaMm,
              CoreUse                  use,
              StagePlan &              plan,
              CertifiedResult &        result)
{
  Stopwatch          watch;
  CertifiedSeconds & seconds = result.seconds;
  const bool         byTolerance = !request.tolerances.empty();
  WholeCore          whole;
  MedialComplex      core;
  {
    ReportProgress(plan.Next("shape"), "", 0);
    result.shape.topology = ComputeShapeTopology(voxels);
    std::vector<LatticePoint> points = BoundaryVertices(voxels);
    result.boundaryVertices = points.size();
    seconds.shape += watch.Lap();

    DelaunayCells cells = CellsOf(voxels, points, request, weights, plan.Next("delaunay"));
    seconds.delaunay += watch.Lap();
    if (NeedsBracket(request))
    {
      whole.bracket =
        BracketThickness(voxels, points, cells, weights, request.thickness->bounds, plan.Next("thickness"));
      seconds.thickness += watch.Lap();
    }

    const ProgressCallback building = plan.Next("core");
    ReportProgress(building, "", 0);
    TouchingBalls touching = byTolerance ? LargestTouchingBalls(voxels, cells, points, weights) : TouchingBalls();
    if (Refines(request))
    {
      whole.kept.edgePoints = NearestToEdges(cells);
    }
    ReportProgress(building, "", 0.1);
    const bool needsPoints = byTolerance || Refines(request);
    core = BuildVoxelCore(voxels, needsPoints ? points : std::move(points), std::move(cells), weights, use);
    RequireEnclosed(core, voxels, request.name);
    seconds.core += watch.Lap();
    if (byTolerance)
    {
      // NOLINTNEXTLINE(bugprone-use-after-move): moved only where tolerance does not need them
      core.tolerances = ComputeTolerances(core, weights, points, std::move(touching), lambdaMm, plan.Next("prune"));
      EndTolerances(core.tolerances, result.shape);
      seconds.prune += watch.Lap();
    }
    if (Refines(request))
    {
      whole.kept.boundary = std::move(points);
    }
  }
  if (Refines(request))
  {
    KeepPlaces(core, result.shape.geometry, whole.kept);
  }
  whole.core.core = ToPhysical(std::move(core), result.shape.geometry, 0);
  whole.core.numbers.lambda = "0";
  seconds.core += watch.Lap();
  return whole;
}

} // namespace voxelcore
