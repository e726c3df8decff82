#include "voxelcore/Masks/ShapeSmoothing.h"

#include "voxelcore/Shape/GrowingPieces.h"
#include "MendingWindow.h"
#include "ShapeField.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Shape/TouchingPieces.h"

#include <algorithm>
#include <iterator>
#include <tuple>
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
    double             done = 0;
    std::vector<Voxel> voxels = NotSimple();
    do
    {
      const double           next = 0.5 * (1 + done);
      const ProgressCallback pass = PartOfProgress(progress, done, next);
      done = next;
      ReportProgress(pass, "mending", 0);
      m_Flipped.clear();
      for (std::size_t i = 0; i < voxels.size(); ++i)
      {
        if ((i & 0xFFFU) == 0)
        {
          ReportProgress(pass, "mending", static_cast<double>(i) / static_cast<double>(voxels.size()));
        }
        if (m_Shape.Contains(voxels[i]))
        {
          TakeOut(voxels[i]);
        }
        else
        {
          PutIn(voxels[i]);
        }
      }
      voxels = NotSimpleNow(voxels);
    } while (!m_Flipped.empty());
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

  /** The same after flips: whether a voxel is simple changes beside them alone. */
  std::vector<Voxel>
  NotSimpleNow(const std::vector<Voxel> & before) const
  {
    const auto inScanOrder = [](const Voxel & a, const Voxel & b) {
      return std::tie(a[2], a[1], a[0]) < std::tie(b[2], b[1], b[0]);
    };
    std::vector<Voxel> beside;
    for (const Voxel & flipped : m_Flipped)
    {
      for (std::int32_t i = 0; i < 27; ++i)
      {
        beside.push_back({ flipped[0] + i % 3 - 1, flipped[1] + i / 3 % 3 - 1, flipped[2] + i / 9 - 1 });
      }
    }
    ranges::sort(beside, inScanOrder);
    beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
    std::vector<Voxel> all;
    std::set_difference(before.begin(),
                        before.end(),
                        beside.begin(),
                        beside.end(),
                        std::back_inserter(all),
                        inScanOrder);
    const auto others = static_cast<std::ptrdiff_t>(all.size());
    std::copy_if(beside.begin(), beside.end(), std::back_inserter(all), [&](const Voxel & voxel) {
      const Neighbourhood around = m_Shape.Around(voxel);
      return around != 0 && around != kAll27 && !IsSimpleVoxel(around & ~kCentre27);
    });
    std::inplace_merge(all.begin(), all.begin() + others, all.end(), inScanOrder);
    return all;
  }

  void
  PutIn(const Voxel & voxel)
  {
    const Neighbourhood around = m_Shape.Around(voxel);
    const Pieces        shape = ShapePieces(around);
    const Pieces        background = BackgroundPieces(around);
    if (shape.count == 0 || (shape.count == 1 && background.count == 1))
    {
      return;
    }
    const auto components = m_Components.Apart(voxel, shape);
    if (!components || (background.count > 1 && !HangTogether(m_Shape, voxel, background, true)))
    {
      return;
    }
    Flip(voxel);
    ++m_Result.voxelsAdded;
    m_Result.piecesJoined += shape.count - 1;
    m_Result.loopsClosed += background.count > 1 ? background.count - 1 : 0;
    m_Result.cavitiesFilled += background.count == 0 ? 1 : 0;
    m_Components.Join(voxel, *components);
  }

  void
  TakeOut(const Voxel & voxel)
  {
    const Neighbourhood around = m_Shape.Around(voxel);
    const Pieces        shape = ShapePieces(around);
    if (shape.count < 2 || BackgroundPieces(around).count != 1 || FieldAround(m_Shape, voxel) >= kFieldHalf ||
        !StandsOnSomethingThick(voxel) || !HangTogether(m_Shape, voxel, shape, false))
    {
      return;
    }
    Flip(voxel);
    ++m_Result.voxelsRemoved;
    m_Result.loopsClosed += shape.count - 1;
  }

  void
  Flip(const Voxel & voxel)
  {
    m_Shape.Flip(voxel);
    m_Flipped.push_back(voxel);
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

  PaddedShape        m_Shape;
  GrowingPieces      m_Components;
  std::vector<Voxel> m_Flipped; ///< in this pass
  MendedShape        m_Result;
};

} // namespace

MendedShape
MendShape(const VoxelShape & shape, const ProgressCallback & progress)
{
  return Mending(shape).Run(progress);
}

} // namespace voxelcore
