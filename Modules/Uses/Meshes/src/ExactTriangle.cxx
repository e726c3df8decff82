#include "ExactTriangle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore
{
namespace
{

int
SignOf(const BigInteger & value)
{
  return value.sign();
}

int
SignOf(double value)
{
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

/** Exponent of the last bit of a number that is not 0. */
int
LastBit(double value)
{
  int          exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  const auto   bits = static_cast<std::uint64_t>(std::abs(std::ldexp(fraction, 53)));
  return exponent - 53 + std::countr_zero(bits);
}

} // namespace

IntegerScale::IntegerScale(const TriangleMesh & mesh, const VoxelGrid & grid)
  : m_Exponent(std::numeric_limits<int>::max())
{
  const auto add = [&](double value) {
    if (value != 0)
    {
      m_Exponent = std::min(m_Exponent, LastBit(value));
    }
  };
  for (const auto & triangle : mesh.triangles)
  {
    for (const std::uint32_t corner : triangle)
    {
      std::for_each(mesh.points[corner].begin(), mesh.points[corner].end(), add);
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    add(grid.origin[axis]);
    add(grid.spacing[axis]);
  }
  --m_Exponent; // for halves
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    m_Origin[axis] = (*this)(grid.origin[axis]);
    m_HalfSpacing[axis] = (*this)(grid.spacing[axis]) >> 1;
  }
}

BigInteger
IntegerScale::operator()(double value) const
{
  const int  last = value == 0 ? m_Exponent : LastBit(value);
  BigInteger result = static_cast<std::int64_t>(std::ldexp(value, -last));
  result <<= last - m_Exponent;
  return result;
}

IndexMesh::IndexMesh(const TriangleMesh & given, const VoxelGrid & grid)
  : mesh(given)
  , scale(given, grid)
  , points(given.points.size())
{
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      points[i][axis] = (given.points[i][axis] - grid.origin[axis]) / grid.spacing[axis] - 0.5;
    }
  }
  double farthest = 0; // not of points that belong to no triangle, which may lie anywhere
  for (const auto & triangle : given.triangles)
  {
    for (const std::uint32_t corner : triangle)
    {
      for (const double coordinate : points[corner])
      {
        farthest = std::max(farthest, std::abs(coordinate));
      }
    }
  }
  // A difference, a quotient and a difference again, each rounded once.
  error = 4 * 0x1p-53 * (farthest + 1);
}

// Error bounds. Let d be the error of a coordinate and L the greatest difference of two: differences are off by less
// than 2.5 d, products of two by less than 7 L d, the difference of two products by less than 15 L d. The bounds used
// are about twice what follows from that; u L <= d, so rounding is in it.
ExactTriangle::ExactTriangle(const IndexMesh & mesh, const std::array<std::uint32_t, 3> & corners, std::size_t axis)
  : m_Mesh(mesh)
  , m_Corners(corners)
  , m_Axes{ axis == 0 ? 1U : 0U, axis == 2 ? 1U : 2U, axis }
{
  for (std::size_t c = 0; c < 3; ++c)
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      m_Point[c][a] = mesh.points[corners[c]][m_Axes[a]];
    }
  }
  std::array<double, 3> one{};
  std::array<double, 3> two{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    one[a] = m_Point[1][a] - m_Point[0][a];
    two[a] = m_Point[2][a] - m_Point[0][a];
    m_Extent = std::max({ m_Extent, std::abs(one[a]), std::abs(two[a]), std::abs(m_Point[2][a] - m_Point[1][a]) });
  }
  m_Extent += 2; // rays up to one voxel beside it are asked
  m_AreaError = 32 * m_Extent * mesh.error;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const std::size_t b = (a + 1) % 3;
    const std::size_t c = (a + 2) % 3;
    m_Normal[a] = one[b] * two[c] - one[c] * two[b];
  }
  m_Facing = std::abs(m_Normal[2]) > m_AreaError ? SignOf(m_Normal[2]) : SignOf(Integers().normal[2]);
}

const ExactTriangle::Exact &
ExactTriangle::Integers() const
{
  if (!m_Exact)
  {
    m_Exact = std::make_unique<Exact>();
    Exact & exact = *m_Exact;
    for (std::size_t c = 0; c < 3; ++c)
    {
      for (std::size_t a = 0; a < 3; ++a)
      {
        exact.corner[c][a] = m_Mesh.scale(m_Mesh.mesh.points[m_Corners[c]][m_Axes[a]]);
      }
    }
    for (std::size_t a = 0; a < 3; ++a)
    {
      const std::size_t b = (a + 1) % 3;
      const std::size_t c = (a + 2) % 3;
      const auto &      p = exact.corner;
      exact.normal[a] = (p[1][b] - p[0][b]) * (p[2][c] - p[0][c]) - (p[1][c] - p[0][c]) * (p[2][b] - p[0][b]);
    }
  }
  return *m_Exact;
}

std::array<std::int64_t, 2>
ExactTriangle::OuterRange() const
{
  const auto [low, high] = std::minmax({ m_Point[0][1], m_Point[1][1], m_Point[2][1] });
  return { static_cast<std::int64_t>(std::ceil(low - m_Mesh.error)),
           static_cast<std::int64_t>(std::floor(high + m_Mesh.error)) };
}

std::array<std::int64_t, 2>
ExactTriangle::InnerRange(std::int64_t outer) const
{
  const auto   at = static_cast<double>(outer);
  const double error = m_Mesh.error;
  double       low = std::numeric_limits<double>::infinity();
  double       high = -low;
  const auto   add = [&](double from, double to) {
    low = std::min(low, from);
    high = std::max(high, to);
  };
  for (std::size_t edge = 0; edge < 3; ++edge)
  {
    const auto & p = m_Point[edge];
    const auto & q = m_Point[(edge + 1) % 3];
    if (at < std::min(p[1], q[1]) - error || at > std::max(p[1], q[1]) + error)
    {
      continue;
    }
    const double rise = q[1] - p[1];
    const double run = q[0] - p[0];
    if (std::abs(rise) < 1e-3)
    {
      add(std::min(p[0], q[0]) - error, std::max(p[0], q[0]) + error);
      continue;
    }
    const double crossing = p[0] + (at - p[1]) * (run / rise);
    const double margin = 32 * error * (1 + std::abs(run / rise));
    add(crossing - margin, crossing + margin);
  }
  if (low > high)
  {
    return { 0, -1 };
  }
  return { static_cast<std::int64_t>(std::ceil(low)), static_cast<std::int64_t>(std::floor(high)) };
}

int
ExactTriangle::SideOfEdge(std::size_t edge, std::int64_t inner, std::int64_t outer) const
{
  const auto & p = m_Point[edge];
  const auto & q = m_Point[(edge + 1) % 3];
  const double side =
    (q[0] - p[0]) * (static_cast<double>(outer) - p[1]) - (q[1] - p[1]) * (static_cast<double>(inner) - p[0]);
  if (std::abs(side) > m_AreaError)
  {
    return SignOf(side);
  }
  const auto &     from = Integers().corner[edge];
  const auto &     to = Integers().corner[(edge + 1) % 3];
  const BigInteger run = to[0] - from[0];
  const BigInteger rise = to[1] - from[1];
  const int        exact = SignOf(BigInteger(run * (m_Mesh.scale.Centre(m_Axes[1], outer) - from[1]) -
                                      rise * (m_Mesh.scale.Centre(m_Axes[0], inner) - from[0])));
  // On the edge the shift decides; it is greater along the inner axis.
  return exact != 0 ? exact : !rise.is_zero() ? -SignOf(rise) : SignOf(run);
}

bool
ExactTriangle::IsCrossedBy(std::int64_t inner, std::int64_t outer) const
{
  return SideOfEdge(0, inner, outer) == m_Facing && SideOfEdge(1, inner, outer) == m_Facing &&
         SideOfEdge(2, inner, outer) == m_Facing;
}

bool
ExactTriangle::IsBeyond(std::int64_t inner, std::int64_t outer, std::int64_t along) const
{
  const Exact &                     exact = Integers();
  const std::array<std::int64_t, 3> index{ inner, outer, along };
  BigInteger                        height = 0;
  for (std::size_t a = 0; a < 3; ++a)
  {
    height += exact.normal[a] * (m_Mesh.scale.Centre(m_Axes[a], index[a]) - exact.corner[0][a]);
  }
  int sign = SignOf(height);
  for (std::size_t axis = 0; sign == 0; ++axis) // the shift is greatest along x, least along z
  {
    const auto a = static_cast<std::size_t>(std::find(m_Axes.begin(), m_Axes.end(), axis) - m_Axes.begin());
    sign = SignOf(exact.normal[a]);
  }
  return sign == m_Facing;
}

std::int64_t
ExactTriangle::FirstBeyond(std::int64_t inner, std::int64_t outer) const
{
  const auto [lowest, highest] = std::minmax({ m_Point[0][2], m_Point[1][2], m_Point[2][2] });
  const double error = m_Mesh.error;
  double       low = lowest - error;
  double       high = highest + error;
  const double area = std::abs(m_Normal[2]);
  if (area > 2 * m_AreaError)
  {
    const double height = m_Normal[0] * (static_cast<double>(inner) - m_Point[0][0]) +
                          m_Normal[1] * (static_cast<double>(outer) - m_Point[0][1]);
    const double at = m_Point[0][2] - height / m_Normal[2];
    const double margin = 128 * m_Extent * m_Extent * error / (area - m_AreaError) + 8 * error;
    low = std::max(low, at - margin);
    high = std::min(high, at + margin);
  }
  auto first = static_cast<std::int64_t>(std::ceil(low));
  auto last = static_cast<std::int64_t>(std::ceil(high));
  // The crossing lies from low to high: centres before `first` are not beyond. One at `last` may lie on it when it
  // equals high, which it does not where floating point decides.
  if (first == last && high < static_cast<double>(last))
  {
    return first;
  }
  ++last;
  while (first < last)
  {
    const std::int64_t middle = first + (last - first) / 2;
    if (IsBeyond(inner, outer, middle))
    {
      last = middle;
    }
    else
    {
      first = middle + 1;
    }
  }
  return first;
}

} // namespace voxelcore
