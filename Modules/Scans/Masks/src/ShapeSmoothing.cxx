#include "voxelcore/Masks/ShapeSmoothing.h"

#include "ShapeField.h"

#include "voxelcore/Base/CountBits.h"
#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>
#include <vector>

namespace voxelcore
{

namespace
{

// How much more than half must speak against a voxel. With kFieldOwn / 2 = 404 it would take part in the vote itself.
// At 300 one of 200 boundary vertices of clean balls and rods sees a flip, and two thirds of 5 % noise on them go.
constexpr std::int32_t kAgainst = 300;

// What a voxel stands on must be more than half in, without that voxel, else it is thin, and a rod would lose its tip.
constexpr std::int32_t kFirmGround = kFieldWhole / 2;

class Smoothing
{
public:
  explicit Smoothing(const VoxelShape & shape)
    : m_Original(shape)
    , m_Shape(shape)
  {}

  SmoothedShape
  Run(const ProgressCallback & progress)
  {
    ReportProgress(progress, "smoothing", 0);
    FindFirst();
    SmoothedShape     result;
    const std::size_t first = m_Queue.size();
    for (std::size_t count = 0; !m_Queue.empty(); ++count)
    {
      if ((count & 0xFFFFU) == 0)
      {
        // As many again come into the queue, more or less.
        ReportProgress(progress, "smoothing", 0.3 + 0.7 * static_cast<double>(count) / static_cast<double>(2 * first));
      }
      const Candidate candidate = m_Queue.top();
      m_Queue.pop();
      // One that has changed since waits a second time.
      if (Gain(candidate.voxel) == candidate.gain && MayFlip(candidate.voxel))
      {
        Flip(candidate.voxel, result);
      }
    }
    result.largestShift = std::sqrt(static_cast<double>(LargestSquaredShift()));
    result.shape = std::move(m_Shape).Release();
    return result;
  }

private:
  struct Candidate
  {
    std::int32_t gain;
    std::int32_t wide; ///< what a wider view says for it, in voxels
    Voxel        voxel;

    /** Greater gains first, then wider views, which turn with the shape, then in scan order. */
    friend bool
    operator<(const Candidate & a, const Candidate & b)
    {
      const auto order = [](const Voxel & v) { return Voxel{ v[2], v[1], v[0] }; };
      return std::tuple(a.gain, a.wide, order(b.voxel)) < std::tuple(b.gain, b.wide, order(a.voxel));
    }
  };

  void
  FindFirst()
  {
    const Voxel &                       size = m_Shape.Size();
    std::vector<std::vector<Candidate>> found(static_cast<std::size_t>(size[2]));
    RunEach(found.size() < 2 ? 0 : found.size() - 2, [&](std::size_t i) {
      const auto z = static_cast<std::int32_t>(i + 1);
      for (std::int32_t y = 1; y + 1 < size[1]; ++y)
      {
        m_Shape.VisitBoundary(y, z, [&](const Voxel & voxel) {
          if (const std::int32_t gain = Gain(voxel); gain > 0)
          {
            found[i + 1].push_back({ gain, WideView(voxel), voxel });
          }
        });
      }
    });
    std::vector<Candidate> all;
    for (const auto & part : found)
    {
      all.insert(all.end(), part.begin(), part.end());
    }
    m_Queue = std::priority_queue<Candidate>({}, std::move(all));
  }

  /** By how much what is around a voxel wants it on the other side; a voxel pulls towards where it was. */
  std::int32_t
  Gain(const Voxel & voxel) const
  {
    const std::int32_t pull = m_Original.Contains(voxel) ? kAgainst : -kAgainst;
    const std::int32_t forIn = FieldAround(m_Shape, voxel) - kFieldHalf + pull;
    return m_Shape.Contains(voxel) ? -forIn : forIn;
  }

  /** Of the 7 x 7 x 7 voxels around, how many are on the other side. */
  std::int32_t
  WideView(const Voxel & voxel) const
  {
    std::int32_t in = 0;
    for (std::int32_t k = 0; k < 49; ++k)
    {
      in += CountBits(m_Shape.Bits(voxel[0] - 3, voxel[1] - 3 + k % 7, voxel[2] - 3 + k / 7, 7));
    }
    return m_Shape.Contains(voxel) ? -in : in;
  }

  bool
  MayFlip(const Voxel & voxel)
  {
    if (!IsSimpleVoxel(m_Shape.Around(voxel)))
    {
      return false;
    }
    const bool isReturn = m_Shape.Contains(voxel) != m_Original.Contains(voxel);
    if (!isReturn && !StandsFirm(voxel))
    {
      return false;
    }
    m_Shape.Flip(voxel);
    bool isNear = HasKept(voxel);
    for (const Voxel & next : FaceNeighbours(voxel))
    {
      isNear = isNear && HasKept(next);
    }
    m_Shape.Flip(voxel);
    return isNear;
  }

  bool
  StandsFirm(const Voxel & voxel) const
  {
    const bool isIn = m_Shape.Contains(voxel);
    for (const Voxel & next : FaceNeighbours(voxel))
    {
      if (m_Shape.Contains(next) == isIn)
      {
        const std::int32_t field = FieldAround(m_Shape, next);
        if ((isIn ? field : kFieldWhole - kFieldOwn - field) >= kFirmGround)
        {
          return true;
        }
      }
    }
    return false;
  }

  /** Whether a voxel is as it was or has a face neighbour of the kind it was. */
  bool
  HasKept(const Voxel & voxel) const
  {
    const bool was = m_Original.Contains(voxel);
    bool       has = m_Shape.Contains(voxel) == was;
    if (!has)
    {
      for (const Voxel & next : FaceNeighbours(voxel))
      {
        has = has || m_Shape.Contains(next) == was;
      }
    }
    return has;
  }

  void
  Flip(const Voxel & voxel, SmoothedShape & result)
  {
    m_Shape.Flip(voxel);
    const bool      isIn = m_Shape.Contains(voxel);
    const bool      isReturn = isIn == m_Original.Contains(voxel);
    std::uint64_t & count = isIn != isReturn ? result.voxelsAdded : result.voxelsRemoved;
    count += isReturn ? ~std::uint64_t{ 0 } : 1;
    const Voxel & size = m_Shape.Size();
    for (std::int32_t z = std::max(1, voxel[2] - 2); z <= std::min(size[2] - 2, voxel[2] + 2); ++z)
    {
      for (std::int32_t y = std::max(1, voxel[1] - 2); y <= std::min(size[1] - 2, voxel[1] + 2); ++y)
      {
        for (std::int32_t x = std::max(1, voxel[0] - 2); x <= std::min(size[0] - 2, voxel[0] + 2); ++x)
        {
          const Voxel         near{ x, y, z };
          const Neighbourhood around = m_Original.Around(near);
          if (around != 0 && around != kAll27)
          {
            if (const std::int32_t gain = Gain(near); gain > 0)
            {
              m_Queue.push({ gain, WideView(near), near });
            }
          }
        }
      }
    }
  }

  /** Whether the lattice point at the lower corner of a voxel is a boundary vertex. */
  static bool
  IsBoundaryVertex(const PaddedShape & shape, const Voxel & corner)
  {
    std::uint32_t voxels = 0;
    for (std::int32_t k = 0; k < 4; ++k)
    {
      voxels = voxels << 2 | shape.Bits(corner[0] - 1, corner[1] - k % 2, corner[2] - k / 2, 2);
    }
    return voxels != 0 && voxels != 0xFF;
  }

  /** From a vertex that is on one boundary and not on the other to the latter; 0 for others. */
  static std::int32_t
  SquaredShift(const Voxel & corner, const PaddedShape & from, const PaddedShape & to)
  {
    if (!IsBoundaryVertex(from, corner) || IsBoundaryVertex(to, corner))
    {
      return 0;
    }
    std::int32_t nearest = 3;
    for (std::int32_t k = 0; k < 27; ++k)
    {
      const Voxel step{ k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1 };
      if (IsBoundaryVertex(to, { corner[0] + step[0], corner[1] + step[1], corner[2] + step[2] }))
      {
        nearest = std::min(nearest, step[0] * step[0] + step[1] * step[1] + step[2] * step[2]);
      }
    }
    return nearest;
  }

  /** Only vertices of voxels that changed can lie off the other boundary, and they lie within a voxel's diagonal: it
   *  was at the boundary, and has a face neighbour of the kind it was. */
  std::int32_t
  LargestSquaredShift() const
  {
    const Voxel & size = m_Shape.Size();
    std::int32_t  largest = 0;
#pragma omp parallel for schedule(dynamic, 4) reduction(max : largest)
    for (std::int32_t z = 2; z < size[2] - 1; ++z)
    {
      std::int32_t here = 0;
      for (std::int32_t y = 2; y + 1 < size[1]; ++y)
      {
        m_Original.VisitBoundary(y, z, [&](const Voxel & voxel) {
          if (m_Shape.Contains(voxel) != m_Original.Contains(voxel))
          {
            for (std::int32_t k = 0; k < 8; ++k)
            {
              const Voxel corner{ voxel[0] + k % 2, voxel[1] + k / 2 % 2, voxel[2] + k / 4 };
              here = std::max(
                { here, SquaredShift(corner, m_Original, m_Shape), SquaredShift(corner, m_Shape, m_Original) });
            }
          }
        });
      }
      largest = std::max(largest, here);
    }
    return largest;
  }

  PaddedShape                    m_Original;
  PaddedShape                    m_Shape;
  std::priority_queue<Candidate> m_Queue;
};

} // namespace

SmoothedShape
SmoothShape(const VoxelShape & shape, const ProgressCallback & progress)
{
  return Smoothing(shape).Run(progress);
}

} // namespace voxelcore
