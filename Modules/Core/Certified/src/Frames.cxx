#include "Frames.h"

#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Delaunay/CanonicalCells.h"

#include <cstddef>
#include <utility>

namespace voxelcore
{

namespace
{

/** Of cells that lie elsewhere: the points are the same ones in the frame. */
void
FindCentres(const std::vector<LatticePoint> & points, const SpacingWeights & weights, DelaunayCells & cells)
{
  RunInParts(cells.centres.size() > 10000, cells.centres.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t cell = first; cell < last; ++cell)
    {
      const auto & t = cells.tetrahedra[cell];
      cells.centres[cell] =
        CentreOfCorners({ points.at(t[0]), points.at(t[1]), points.at(t[2]), points.at(t[3]) }, weights).centre;
    }
  });
}

} // namespace

CertifiedRequest
InFrame(CertifiedRequest request, const BodyFrame & frame, const SpacingWeights & weights)
{
  const auto lower = frame.Lower();
  if (request.surface && *request.surface && !request.surface->IsOfShape())
  {
    request.surface = [source = std::move(*request.surface), lower](const VoxelShape &           shape,
                                                                    const SurfaceSource::Place & place,
                                                                    const ProgressCallback &     progress) {
      return source(shape, { place[0] + lower[0], place[1] + lower[1], place[2] + lower[2] }, progress);
    };
  }
  if (request.cells)
  {
    request.cells = [source = std::move(request.cells), lower, weights](const std::vector<LatticePoint> & points,
                                                                        const ProgressCallback &          progress) {
      std::vector<LatticePoint> inScan = points;
      for (LatticePoint & point : inScan)
      {
        point = { point.x + lower[0], point.y + lower[1], point.z + lower[2] };
      }
      DelaunayCells cells = source(inScan, progress);
      FindCentres(points, weights, cells);
      return cells;
    };
  }
  if (request.scan)
  {
    request.scan = frame.Enter(*request.scan);
  }
  if (request.skeleton)
  {
    frame.Enter(request.skeleton->branches.realLoops);
  }
  return request;
}

CertifiedShape
InFrame(const CertifiedShape & shape, const BodyFrame & frame)
{
  return { shape.name, shape.topology, frame.Enter(shape.box), frame.Geometry() };
}

void
LeaveFrame(const BodyFrame & frame, PaintingBalls & balls)
{
  for (Vector3 & centre : balls.centres)
  {
    centre = frame.LeaveLattice(centre);
  }
}

void
LeaveFrame(const BodyFrame & frame, PlacedCore & core)
{
  frame.Leave(core.core.positions);
}

void
LeaveFrame(const BodyFrame & frame, CertifiedThickness & found)
{
  const VoxelBox box = frame.Leave(found.shape.Box());
  found.shape = MovedTo(box.lower, found.shape);
  LeaveFrame(frame, found.balls);
  LeaveFrame(frame, found.bracket.balls);
  found.owners.box = box;
  found.map.box = box;
  found.bracket.owners.box = box;
  found.bracket.lower.box = box;
  found.bracket.upper.box = box;
}

void
LeaveFrame(const BodyFrame & frame, const RootChoice & root, CertifiedSkeleton & skeleton)
{
  SkeletonGraph & graph = skeleton.skeleton.graph;
  frame.Leave(graph.positions);
  frame.Leave(graph.medial);
  for (LoopCut & cut : skeleton.cuts)
  {
    cut.position = frame.Leave(cut.position);
  }
  if (skeleton.border)
  {
    for (BorderSection & section : skeleton.border->sections)
    {
      section.centre = frame.LeaveLattice(section.centre);
    }
  }
  skeleton.skeleton.table = MeasureBranches(graph, { root });
}

} // namespace voxelcore
