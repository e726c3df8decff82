#include "ThinPlates.h"

#include "GreatestAxis.h"

#include "voxelcore/Vectors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxelcore
{

namespace
{

// Of the longest side of a voxel.
constexpr double kThickest = 1.25; ///< plates that may be without sheets
constexpr double kLayer = 1;       ///< half the thickness of what is looked at
constexpr double kBent = 0.5;      ///< root mean square of distances from a plane
constexpr double kNarrow = 0.75;   ///< and along it from their middle, where it is narrowest

constexpr int    kCells = 5;            ///< squares a row, each as wide as a voxel's longest and shortest side
constexpr int    kMiddle = kCells / 2;  ///< the square in the middle
constexpr double kReach = kCells / 2.0; ///< squares that a plane is laid through
constexpr double kLeast = 0.5;          ///< of the mean around, in each square of a plate

/** A plane with two directions in it. */
struct Plane
{
  Vector3 middle{ 0, 0, 0 };
  Vector3 normal{ 0, 0, 0 };
  Vector3 u{ 0, 0, 0 };
  Vector3 v{ 0, 0, 0 };
  double  deviation = 0; ///< root mean square of distances from it
  double  width = 0;     ///< and along it from the middle, where that is least
};

Plane
PlaneThrough(const std::vector<Vector3> & points)
{
  Plane found;
  for (const Vector3 & p : points)
  {
    found.middle = AddScaled(found.middle, 1.0 / static_cast<double>(points.size()), p);
  }
  std::array<Vector3, 3> m{};
  for (const Vector3 & p : points)
  {
    const Vector3 d = Minus(p, found.middle);
    for (std::size_t i = 0; i < 3; ++i)
    {
      m[i] = AddScaled(m[i], -d[i], d);
    }
  }
  const double trace = -(m[0][0] + m[1][1] + m[2][2]); // less the matrix: its greatest axis is the least one
  for (std::size_t i = 0; i < 3; ++i)
  {
    m[i][i] += trace;
  }
  double greatest = 0;
  found.normal = GreatestAxis(m, greatest);
  found.deviation = std::sqrt(std::max(0.0, trace - greatest) / static_cast<double>(points.size()));
  std::size_t least = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
  {
    least = std::abs(found.normal[axis]) < std::abs(found.normal[least]) ? axis : least;
  }
  Vector3 along{ 0, 0, 0 };
  along[least] = 1;
  found.u = Cross(found.normal, along);
  found.u = AddScaled({ 0, 0, 0 }, 1 / Length(found.u), found.u);
  found.v = Cross(found.normal, found.u);
  double uu = 0;
  double uv = 0;
  double vv = 0;
  for (const Vector3 & p : points)
  {
    const double du = Dot(Minus(p, found.middle), found.u);
    const double dv = Dot(Minus(p, found.middle), found.v);
    uu += du * du;
    uv += du * dv;
    vv += dv * dv;
  }
  const double least2 = (uu + vv) / 2 - std::hypot((uu - vv) / 2, uv);
  found.width = std::sqrt(std::max(0.0, least2) / static_cast<double>(points.size()));
  return found;
}

/** Volume by area on squares of a plane, each voxel's shared by the four squares whose middles are around it. */
class Raster
{
public:
  /** In sides of a square, from the middle one's middle. */
  void
  Add(double u, double v, double volume)
  {
    const double i = std::floor(u + kMiddle + 1);
    const double j = std::floor(v + kMiddle + 1);
    if (i >= 0 && j >= 0 && i <= kCells && j <= kCells)
    {
      const double restU = u + kMiddle + 1 - i;
      const double restV = v + kMiddle + 1 - j;
      const auto   column = static_cast<std::size_t>(i);
      const auto   row = static_cast<std::size_t>(j);
      m_Volumes[row][column] += (1 - restU) * (1 - restV) * volume;
      m_Volumes[row][column + 1] += restU * (1 - restV) * volume;
      m_Volumes[row + 1][column] += (1 - restU) * restV * volume;
      m_Volumes[row + 1][column + 1] += restU * restV * volume;
    }
  }

  /** The mean over squares with which, and around which, there is nowhere too little or more than `most`; 0 where there
   *  is none. */
  double
  MeanOfInner(double most) const
  {
    double sum = 0;
    int    count = 0;
    for (std::size_t j = 2; j < kCells; ++j)
    {
      for (std::size_t i = 2; i < kCells; ++i)
      {
        double about = 0;
        double least = HUGE_VAL;
        double greatest = 0;
        for (std::size_t k = 0; k < 9; ++k)
        {
          const double one = m_Volumes[j - 1 + k / 3][i - 1 + k % 3];
          about += one;
          least = std::min(least, one);
          greatest = std::max(greatest, one);
        }
        if (9 * least > kLeast * about && greatest < most)
        {
          sum += m_Volumes[j][i];
          ++count;
        }
      }
    }
    return count > 0 ? sum / count : 0;
  }

private:
  std::array<std::array<double, kCells + 2>, kCells + 2> m_Volumes{}; ///< with a border that is not looked at
};

} // namespace

ThinPlates::ThinPlates(const VoxelShape & shape, const SpacingWeights & weights)
  : m_Shape(shape)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    m_Sides[axis] = static_cast<double>(weights.weight[axis]) * weights.unit;
  }
  m_Longest = *std::max_element(m_Sides.begin(), m_Sides.end());
  m_Square = m_Longest + *std::min_element(m_Sides.begin(), m_Sides.end());
}

template <typename TVisit>
void
ThinPlates::VisitVoxels(const Vector3 & place, double reach, TVisit visit) const
{
  const VoxelBox &            box = m_Shape.Box();
  std::array<std::int32_t, 3> first{};
  std::array<std::int32_t, 3> last{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double middle = place[axis] - box.lower[axis] - 0.5;
    const double half = reach / m_Sides[axis];
    first[axis] = std::max(0, static_cast<std::int32_t>(std::ceil(middle - half)));
    last[axis] = std::min(box.size[axis] - 1, static_cast<std::int32_t>(std::floor(middle + half)));
  }
  for (std::int32_t z = first[2]; z <= last[2]; ++z)
  {
    for (std::int32_t y = first[1]; y <= last[1]; ++y)
    {
      const auto row = m_Shape.Row(y, z);
      for (std::int32_t x = first[0]; x <= last[0]; ++x)
      {
        if ((row[static_cast<std::size_t>(x) >> 6U] >> (static_cast<std::uint32_t>(x) & 63U) & 1U) != 0)
        {
          const Vector3 voxel{ box.lower[0] + x + 0.5, box.lower[1] + y + 0.5, box.lower[2] + z + 0.5 };
          visit(Times(Minus(voxel, place), m_Sides));
        }
      }
    }
  }
}

double
ThinPlates::ThicknessAt(const Vector3 & place, double radius) const
{
  if (radius > kThickest * m_Longest)
  {
    return 0;
  }
  std::vector<Vector3> near; // from the place, mm
  VisitVoxels(place, kReach * m_Square, [&](const Vector3 & voxel) {
    if (Length(voxel) < kReach * m_Square)
    {
      near.push_back(voxel);
    }
  });
  if (near.empty())
  {
    return 0;
  }
  const Plane plane = PlaneThrough(near);
  if (plane.deviation > kBent * m_Longest || plane.width < kNarrow * m_Longest ||
      std::abs(Dot(plane.middle, plane.normal)) > kLayer * m_Longest)
  {
    return 0;
  }
  Raster       raster;
  const double volume = m_Sides[0] * m_Sides[1] * m_Sides[2] / (m_Square * m_Square);
  VisitVoxels(place, std::sqrt(2.0) * (kReach + 0.5) * m_Square, [&](const Vector3 & voxel) {
    if (std::abs(Dot(Minus(voxel, plane.middle), plane.normal)) < kLayer * m_Longest)
    {
      raster.Add(Dot(voxel, plane.u) / m_Square, Dot(voxel, plane.v) / m_Square, volume);
    }
  });
  return raster.MeanOfInner(kThickest * m_Longest);
}

} // namespace voxelcore
