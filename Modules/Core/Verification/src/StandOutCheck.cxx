#include "voxelcore/Verification/StandOutCheck.h"

#include "BallBoxes.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Verification/BoundaryTree.h"
#include "voxelcore/Verification/OctantScan.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace voxelcore
{
namespace
{

using Place = std::array<double, 3>; // mm, from the grid's corner along its axes

// Into a corner of 60 degrees balls become smaller by half of the way.
constexpr double kCorner = 2;

// Voxels along a block's side to begin with; they divide the 64 of a word. In a ball of 50 voxels most such blocks are
// looked at once.
constexpr std::int32_t kBlock = 16;

double
Way(const Place & a, const Place & b)
{
  return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

std::vector<double>
Times(double factor, std::span<const double> numbers)
{
  std::vector<double> product(numbers.begin(), numbers.end());
  for (double & one : product)
  {
    one *= factor;
  }
  return product;
}

class Search
{
public:
  Search(const VoxelShape &                     shape,
         const SpacingWeights &                 weights,
         std::span<const std::array<double, 3>> positions,
         std::span<const double>                reach,
         double                                 standOut)
    : m_Shape(shape)
    , m_Boundary(ScanOctants(shape).boundary, weights)
    , m_Reaches(positions, reach, weights)
    , m_Corners(positions, Times(kCorner, reach), weights)
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      m_Scale[a] = weights.unit * static_cast<double>(weights.weight[a]);
    }
    m_Half = 0.5 * Way(m_Scale, {});
    m_Most = standOut + m_Half;
  }

  /** Blocks along x, at box-relative y and z. */
  void
  LookAlong(std::int32_t y, std::int32_t z, std::optional<BallOutside> & worst) const
  {
    State state;
    for (std::int32_t x = 0; x < m_Shape.Box().size[0]; x += kBlock)
    {
      LookAt({ x, y, z }, kBlock, state, worst);
    }
  }

  static bool
  IsWorse(const BallOutside & one, const BallOutside & other)
  {
    const auto order = [](const BallOutside & ball) {
      return std::array<std::int32_t, 3>{ ball.voxel[2], ball.voxel[1], ball.voxel[0] };
    };
    return one.beyond > other.beyond || (one.beyond == other.beyond && order(one) < order(other));
  }

private:
  struct State
  {
    std::vector<BoundaryTree::Candidate> found;
    std::size_t                          reach = 0;
    std::size_t                          corner = 0;
  };

  /** Whether no voxel of a block, box-relative, is in. */
  bool
  IsEmpty(const std::array<std::int32_t, 3> & first, std::int32_t side) const
  {
    const auto          word = static_cast<std::size_t>(first[0]) >> 6U;
    const std::uint64_t own = ((std::uint64_t{ 1 } << side) - 1) << (static_cast<unsigned>(first[0]) & 63U);
    const std::int32_t  endY = std::min(first[1] + side, m_Shape.Box().size[1]);
    const std::int32_t  endZ = std::min(first[2] + side, m_Shape.Box().size[2]);
    for (std::int32_t z = first[2]; z < endZ; ++z)
    {
      for (std::int32_t y = first[1]; y < endY; ++y)
      {
        if ((m_Shape.Row(y, z)[word] & own) != 0)
        {
          return false;
        }
      }
    }
    return true;
  }

  /** The nearest boundary vertex. */
  Place
  NearestTo(const Place & lattice, State & state) const
  {
    m_Boundary.FindNearest(lattice, 0, state.found);
    const LatticePoint & point = m_Boundary.Points()[state.found.front().point];
    return InMm({ static_cast<double>(point.x), static_cast<double>(point.y), static_cast<double>(point.z) });
  }

  Place
  InMm(const Place & lattice) const
  {
    return { m_Scale[0] * lattice[0], m_Scale[1] * lattice[1], m_Scale[2] * lattice[2] };
  }

  void
  LookAt(const std::array<std::int32_t, 3> & first,
         std::int32_t                        side,
         State &                             state,
         std::optional<BallOutside> &        worst) const
  {
    if (IsEmpty(first, side))
    {
      return;
    }
    const VoxelBox & box = m_Shape.Box();
    Place            lower{}; // middles of voxels, lattice
    Place            upper{};
    Place            middle{};
    for (std::size_t a = 0; a < 3; ++a)
    {
      lower[a] = box.lower[a] + first[a] + 0.5;
      upper[a] = box.lower[a] + std::min(first[a] + side, box.size[a]) - 0.5;
      middle[a] = 0.5 * (lower[a] + upper[a]);
    }
    const Place  vertex = NearestTo(middle, state);
    const double radius = Way(InMm(middle), vertex);
    if (side == 1)
    {
      LookAtBall(middle, radius, state, worst);
      return;
    }
    // A ball at a place is no greater than its way to this vertex, whose sum with the way to a place of the skeleton is
    // convex: the block's corners say for all of it how far its balls reach.
    const auto isWithin = [&](const verification::BallBoxes & balls, double factor, double most, std::size_t & likely) {
      if (balls.SmallestGap(middle, -std::numeric_limits<double>::infinity(), likely) + factor * radius > most)
      {
        return false;
      }
      const Place  centre = balls.Centre(likely);
      const double reach = balls.Radius(likely);
      for (unsigned corner = 0; corner < 8; ++corner)
      {
        const Place at = InMm({ (corner & 1U) != 0 ? upper[0] : lower[0],
                                (corner & 2U) != 0 ? upper[1] : lower[1],
                                (corner & 4U) != 0 ? upper[2] : lower[2] });
        if (Way(at, centre) + factor * Way(at, vertex) - reach > most)
        {
          return false;
        }
      }
      return true;
    };
    if (isWithin(m_Reaches, 1, m_Most, state.reach) || isWithin(m_Corners, kCorner, m_Half, state.corner))
    {
      return;
    }
    const std::int32_t half = side / 2;
    for (unsigned part = 0; part < 8; ++part)
    {
      const std::array<std::int32_t, 3> next{ first[0] + ((part & 1U) != 0 ? half : 0),
                                              first[1] + ((part & 2U) != 0 ? half : 0),
                                              first[2] + ((part & 4U) != 0 ? half : 0) };
      if (next[0] < box.size[0] && next[1] < box.size[1] && next[2] < box.size[2])
      {
        LookAt(next, half, state, worst);
      }
    }
  }

  void
  LookAtBall(const Place & middle, double radius, State & state, std::optional<BallOutside> & worst) const
  {
    const double gap = m_Reaches.SmallestGap(middle, m_Most - radius, state.reach);
    if (gap + radius <= m_Most ||
        m_Corners.SmallestGap(middle, m_Half - kCorner * radius, state.corner) + kCorner * radius <= m_Half)
    {
      return;
    }
    const auto        voxel = [&](std::size_t a) { return static_cast<std::int32_t>(std::floor(middle[a])); };
    const BallOutside ball{ gap + radius, { voxel(0), voxel(1), voxel(2) }, radius };
    if (!worst || IsWorse(ball, *worst))
    {
      worst = ball;
    }
  }

  const VoxelShape &      m_Shape;
  BoundaryTree            m_Boundary;
  Place                   m_Scale{}; ///< mm a lattice step
  verification::BallBoxes m_Reaches;
  verification::BallBoxes m_Corners;
  double                  m_Half = 0; ///< mm, of a voxel's diagonal
  double                  m_Most = 0; ///< mm by which a ball may reach out
};

} // namespace

std::optional<BallOutside>
BallStandingOut(const VoxelShape &                     shape,
                const SpacingWeights &                 weights,
                std::span<const std::array<double, 3>> positions,
                std::span<const double>                reach,
                double                                 standOut)
{
  const Search                            search(shape, weights, positions, reach, standOut);
  const auto                              blocks = [](std::int32_t voxels) { return (voxels + kBlock - 1) / kBlock; };
  const std::int32_t                      alongY = blocks(shape.Box().size[1]);
  const std::int64_t                      rows = std::int64_t{ alongY } * blocks(shape.Box().size[2]);
  std::vector<std::optional<BallOutside>> found(static_cast<std::size_t>(rows));
  FirstFailure                            failure;
#pragma omp parallel for schedule(dynamic, 1)
  for (std::int64_t row = 0; row < rows; ++row)
  {
    const auto own = static_cast<std::size_t>(row);
    failure.Guard(own, [&] {
      search.LookAlong(static_cast<std::int32_t>(row % alongY) * kBlock,
                       static_cast<std::int32_t>(row / alongY) * kBlock,
                       found[own]);
    });
  }
  failure.Rethrow();
  std::optional<BallOutside> worst;
  for (const auto & one : found)
  {
    if (one && (!worst || Search::IsWorse(*one, *worst)))
    {
      worst = one;
    }
  }
  return worst;
}

} // namespace voxelcore
