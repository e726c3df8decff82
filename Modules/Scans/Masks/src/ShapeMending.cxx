#include "voxelcore/Masks/ShapeSmoothing.h"

#include "voxelcore/Shape/GrowingPieces.h"
#include "MendingWindow.h"
#include "ShapeField.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Shape/TouchingPieces.h"

#include <algorithm>
#include <vector>

namespace voxelcore
{

namespace
{

class Mending
{
public:
  explicit Mending(const VoxelShape & shape)
    : m_Shape(shape)
    , m_Components(shape)
  {}

  MendedShape
  Run(const ProgressCallback & progress)
  {
    // What is mended may let a neighbour be mended. Every change lowers a topology number, so this ends.
    // Each pass takes half of the progress left: how many there will be nobody knows, and the first is most work.
    double done = 0;
    for (bool changes = true; changes;)
    {
      changes = false;
      const double           next = 0.5 * (1 + done);
      const ProgressCallback pass = PartOfProgress(progress, done, next);
      done = next;
      ReportProgress(pass, "mending", 0);
      const std::vector<Voxel> voxels = NotSimple();
      for (std::size_t i = 0; i < voxels.size(); ++i)
      {
        if ((i & 0xFFFU) == 0)
        {
          ReportProgress(pass, "mending", static_cast<double>(i) / static_cast<double>(voxels.size()));
        }
        changes = (m_Shape.Contains(voxels[i]) ? TakeOut(voxels[i]) : PutIn(voxels[i])) || changes;
      }
    }
    // Two that meet at a corner alone take two voxels.
    JoinedPieces joined = JoinTouchingPieces(std::move(m_Shape).Release());
    m_Result.voxelsAdded += joined.VoxelsAdded();
    m_Result.piecesJoined += joined.PiecesJoined();
    m_Result.shape = std::move(joined.shape);
    return std::move(m_Result);
  }

private:
  /** Voxels at the boundary whose flip changes the topology, in scan order. */
  std::vector<Voxel>
  NotSimple() const
  {
    const Voxel &                   size = m_Shape.Size();
    std::vector<std::vector<Voxel>> found(static_cast<std::size_t>(size[2]));
    FirstFailure                    failure;
#pragma omp parallel
    {
      SimpleVoxels simple;
#pragma omp for schedule(dynamic, 4)
      for (std::int32_t z = 1; z < size[2] - 1; ++z)
      {
        const auto slice = static_cast<std::size_t>(z);
        failure.Guard(slice, [&] {
          for (std::int32_t y = 1; y + 1 < size[1]; ++y)
          {
            m_Shape.VisitBoundary(y, z, [&](const Voxel & voxel) {
              if (!simple.IsSimple(m_Shape.Around(voxel)))
              {
                found[slice].push_back(voxel);
              }
            });
          }
        });
      }
    }
    failure.Rethrow();
    std::vector<Voxel> all;
    for (const auto & part : found)
    {
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }

  bool
  PutIn(const Voxel & voxel)
  {
    const Neighbourhood around = m_Shape.Around(voxel);
    const Pieces        shape = ShapePieces(around);
    const Pieces        background = BackgroundPieces(around);
    if (shape.count == 0 || (shape.count == 1 && background.count == 1))
    {
      return false;
    }
    const auto components = m_Components.Apart(voxel, shape);
    if (!components || (background.count > 1 && !HangTogether(m_Shape, voxel, background, true)))
    {
      return false;
    }
    m_Shape.Flip(voxel);
    ++m_Result.voxelsAdded;
    m_Result.piecesJoined += shape.count - 1;
    m_Result.loopsClosed += background.count > 1 ? background.count - 1 : 0;
    m_Result.cavitiesFilled += background.count == 0 ? 1 : 0;
    m_Components.Join(voxel, *components);
    return true;
  }

  bool
  TakeOut(const Voxel & voxel)
  {
    const Neighbourhood around = m_Shape.Around(voxel);
    const Pieces        shape = ShapePieces(around);
    if (shape.count < 2 || BackgroundPieces(around).count != 1 || FieldAround(m_Shape, voxel) >= kFieldHalf ||
        !StandsOnSomethingThick(voxel) || !HangTogether(m_Shape, voxel, shape, false))
    {
      return false;
    }
    m_Shape.Flip(voxel);
    ++m_Result.voxelsRemoved;
    m_Result.loopsClosed += shape.count - 1;
    return true;
  }

  /** Loops of rods as thin as a voxel are not noise. */
  bool
  StandsOnSomethingThick(const Voxel & voxel) const
  {
    const auto faces = FaceNeighbours(voxel);
    return std::any_of(faces.begin(), faces.end(), [&](const Voxel & next) {
      return m_Shape.Contains(next) && FieldAround(m_Shape, next) >= kFieldWhole / 2;
    });
  }

  PaddedShape   m_Shape;
  GrowingPieces m_Components;
  MendedShape   m_Result;
};

} // namespace

MendedShape
MendShape(const VoxelShape & shape, const ProgressCallback & progress)
{
  return Mending(shape).Run(progress);
}

} // namespace voxelcore
