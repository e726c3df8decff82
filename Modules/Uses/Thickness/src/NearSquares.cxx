#include "NearSquares.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

constexpr double kRounding = 1e-9; ///< of squared lengths, and of lattice coordinates

std::int32_t
Floor(double value)
{
  return static_cast<std::int32_t>(std::floor(value));
}

/** How far a coordinate is from the nearest of the lattice, in voxels. */
double
FromLattice(double coordinate)
{
  const double beyond = coordinate - std::floor(coordinate);
  return std::min(beyond, 1 - beyond);
}

double
RootOf(double squared)
{
  return squared > 0 ? std::sqrt(squared) : 0.0;
}

/** visit(n) for the whole numbers n whose distance from `middle` is from `least` to `most`, with room for rounding. */
template <typename TVisit>
void
ForRing(double middle, double least, double most, const TVisit & visit)
{
  const auto from = static_cast<std::int32_t>(std::ceil(middle + least - kRounding));
  const auto last = static_cast<std::int32_t>(std::floor(middle + most + kRounding));
  for (std::int32_t n = from; n <= last; ++n)
  {
    visit(n);
  }
  const auto first = static_cast<std::int32_t>(std::ceil(middle - most - kRounding));
  for (std::int32_t n = std::min(Floor(middle - least + kRounding), from - 1); n >= first; --n)
  {
    visit(n);
  }
}

} // namespace

NearSquares::NearSquares(const VoxelShape & shape, const SpacingWeights & weights)
  : m_Shape(shape)
  , m_Weights(WeightsOf(weights))
{}

void
NearSquares::Find(const Vector3 & place, double within, std::vector<BoundarySquare> & squares) const
{
  const std::size_t before = squares.size();
  const double      squared = within * within;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    FindAcross(axis, place, squared, squares);
    FindByEdges(axis, place, squared, squares);
  }
  std::size_t kept = before;
  for (std::size_t i = before; i < squares.size(); ++i)
  {
    const auto first = squares.begin() + static_cast<std::ptrdiff_t>(before);
    const auto end = squares.begin() + static_cast<std::ptrdiff_t>(kept);
    if (SquaredDistance(squares[i], place, m_Weights) < squared && std::find(first, end, squares[i]) == end)
    {
      squares[kept++] = squares[i];
    }
  }
  squares.resize(kept);
}

double
NearSquares::DistanceTo(std::span<const BoundarySquare> squares, const Vector3 & place, double within) const
{
  double least = within * within;
  for (const BoundarySquare & square : squares)
  {
    least = std::min(least, SquaredDistance(square, place, m_Weights));
  }
  return std::min(std::sqrt(least), within);
}

/** Squares on the line through the place along an axis. */
void
NearSquares::FindAcross(std::size_t                   axis,
                        const Vector3 &               place,
                        double                        squared,
                        std::vector<BoundarySquare> & squares) const
{
  Voxel  voxel{};
  double aside = 0; // squared, of the nearest corner
  for (std::size_t a = 0; a < 3; ++a)
  {
    voxel[a] = Floor(place[a]);
    const double d = a == axis ? 0.0 : FromLattice(place[a]) * m_Weights[a];
    aside += d * d;
  }
  const double least = RootOf(squared * (1 - kRounding) - aside) / m_Weights[axis];
  const double most = std::sqrt(squared) / m_Weights[axis];
  ForRing(place[axis], least, most, [&](std::int32_t plane) {
    voxel[axis] = plane;
    const bool isIn = Contains(voxel);
    voxel[axis] = plane - 1;
    if (isIn != Contains(voxel))
    {
      BoundarySquare square{ 2 * voxel[0] + 1, 2 * voxel[1] + 1, 2 * voxel[2] + 1 };
      square[axis] = 2 * plane;
      squares.push_back(square);
    }
  });
}

/** Squares at edges along an axis beside the place. */
void
NearSquares::FindByEdges(std::size_t                   axis,
                         const Vector3 &               place,
                         double                        squared,
                         std::vector<BoundarySquare> & squares) const
{
  const double toEnd = FromLattice(place[axis]) * m_Weights[axis];
  if (toEnd == 0)
  {
    return; // the nearest places of edges are their ends
  }
  // Row by row along the axis whose voxels are shorter.
  std::size_t along = (axis + 1) % 3;
  std::size_t across = (axis + 2) % 3;
  if (m_Weights[across] < m_Weights[along])
  {
    std::swap(along, across);
  }
  const double inner = squared * (1 - kRounding) - toEnd * toEnd;
  const double reach = std::sqrt(squared) / m_Weights[across];
  Voxel        corner{};
  corner[axis] = Floor(place[axis]);
  const auto last = static_cast<std::int32_t>(std::floor(place[across] + reach));
  for (corner[across] = static_cast<std::int32_t>(std::ceil(place[across] - reach)); corner[across] <= last;
       ++corner[across])
  {
    const double aside = (corner[across] - place[across]) * m_Weights[across];
    const double rest = squared - aside * aside;
    if (rest > 0)
    {
      ForRing(place[along],
              RootOf(inner - aside * aside) / m_Weights[along],
              std::sqrt(rest) / m_Weights[along],
              [&](std::int32_t n) {
                corner[along] = n;
                AddAtEdge(axis, corner, squares);
              });
    }
  }
}

/** The boundary squares that have the edge along an axis from a lattice corner on. */
void
NearSquares::AddAtEdge(std::size_t axis, Voxel voxel, std::vector<BoundarySquare> & squares) const
{
  const std::size_t b = (axis + 1) % 3;
  const std::size_t c = (axis + 2) % 3;
  // The four voxels around the edge, in their order around it.
  constexpr std::array<std::array<std::int32_t, 2>, 4> around{ { { 0, 0 }, { -1, 0 }, { -1, -1 }, { 0, -1 } } };
  std::array<bool, 4>                                  isIn{};
  for (std::size_t i = 0; i < 4; ++i)
  {
    Voxel one = voxel;
    one[b] += around[i][0];
    one[c] += around[i][1];
    isIn[i] = Contains(one);
  }
  for (std::size_t i = 0; i < 4; ++i)
  {
    if (isIn[i] != isIn[(i + 1) % 4])
    {
      // The middle between two voxels that follow each other.
      const auto &   next = around[(i + 1) % 4];
      BoundarySquare square{};
      square[axis] = 2 * voxel[axis] + 1;
      square[b] = 2 * voxel[b] + around[i][0] + next[0] + 1;
      square[c] = 2 * voxel[c] + around[i][1] + next[1] + 1;
      squares.push_back(square);
    }
  }
}

} // namespace voxelcore
