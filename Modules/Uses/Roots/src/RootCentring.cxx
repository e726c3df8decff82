#include "voxelcore/Roots/RootCentring.h"

#include "voxelcore/Base/Hypot.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Skeleton/UnitVector.h"

#include "voxelcore/Skeleton/CrossSections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

// In slices, the greatest spacing.
constexpr double kThin = 3;
constexpr double kAlong = 0.75;
constexpr double kBeyond = 0.6;
constexpr double kFarthestMove = 0.5;
constexpr double kAverage = 1; // deviation of the weights along the root
constexpr double kTangent = 1.5;

constexpr double kBackground = 0.15; ///< brightness below which there is no root
constexpr double kLeastWeight = 0.3; ///< of neighbours that know a move
constexpr int    kRounds = 2;

/** A ball of a root. */
struct RootBall
{
  Vector3      place;
  double       radius;
  ElementIndex owner;
};

/** Balls by the cubes of a grid they lie in. */
class BallCells
{
public:
  explicit BallCells(double side)
    : m_Side(side)
  {}

  void
  Add(const RootBall & ball)
  {
    m_Cells[CellOf(ball.place)].push_back(ball);
  }

  /** Calls `visit` with all balls up to `reach` away, and others. */
  template <typename Visit>
  void
  VisitNear(const Vector3 & place, double reach, const Visit & visit) const
  {
    const auto far = static_cast<std::int64_t>(std::ceil(reach / m_Side));
    const Cell centre = CellOf(place);
    for (std::int64_t z = centre[2] - far; z <= centre[2] + far; ++z)
    {
      for (std::int64_t y = centre[1] - far; y <= centre[1] + far; ++y)
      {
        for (std::int64_t x = centre[0] - far; x <= centre[0] + far; ++x)
        {
          const auto found = m_Cells.find({ x, y, z });
          if (found != m_Cells.end())
          {
            ranges::for_each(found->second, visit);
          }
        }
      }
    }
  }

private:
  using Cell = std::array<std::int64_t, 3>;
  struct CellHash
  {
    std::size_t
    operator()(const Cell & cell) const
    {
      return static_cast<std::size_t>((cell[0] * 73856093) ^ (cell[1] * 19349663) ^ (cell[2] * 83492791));
    }
  };

  Cell
  CellOf(const Vector3 & place) const
  {
    Cell cell;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      cell[axis] = static_cast<std::int64_t>(std::floor(place[axis] / m_Side));
    }
    return cell;
  }

  double                                                    m_Side;
  std::unordered_map<Cell, std::vector<RootBall>, CellHash> m_Cells;
};

/** Places in mm along the axes of the grid, from its corner. */
class RootCentring
{
public:
  RootCentring(SkeletonGraph &        graph,
               const RootHierarchy &  roots,
               const ImageGeometry &  geometry,
               const RootBrightness & brightness)
    : m_Graph(graph)
    , m_Roots(roots)
    , m_Geometry(geometry)
    , m_Brightness(brightness)
    , m_Slice(std::max({ geometry.spacing[0], geometry.spacing[1], geometry.spacing[2] }))
    , m_Radii(SectionRadii(graph))
    , m_Owner(graph.positions.size(), kNoRoot)
    , m_Widest(*std::max_element(m_Radii.begin(), m_Radii.end()))
    , m_Thin(8 * m_Slice)
    , m_Thick(m_Widest + 4 * m_Slice)
  {
    for (const Vector3 & position : graph.positions)
    {
      m_First.push_back(Times(PhysicalToLattice(geometry, position), geometry.spacing));
    }
    m_Places = m_First;
    for (ElementIndex axis = 0; axis < roots.axes.size(); ++axis)
    {
      for (const ElementIndex point : roots.axes[axis].points)
      {
        m_Owner[point] = m_Owner[point] == kNoRoot ? axis : m_Owner[point]; // shared: the parent's
      }
    }
    for (ElementIndex point = 0; point < m_Owner.size(); ++point)
    {
      if (m_Owner[point] != kNoRoot)
      {
        (IsThin(point) ? m_Thin : m_Thick).Add({ m_First[point], m_Radii[point], m_Owner[point] });
      }
    }
  }

  void
  Centre()
  {
    for (ElementIndex axis = 0; axis < m_Roots.axes.size(); ++axis)
    {
      for (int round = 0; round < kRounds; ++round)
      {
        Move(axis);
      }
    }
    for (ElementIndex point = 0; point < m_Owner.size(); ++point)
    {
      if (m_Owner[point] != kNoRoot && m_Places[point] != m_First[point])
      {
        m_Graph.positions[point] = LatticeToPhysical(m_Geometry, Over(m_Places[point], m_Geometry.spacing));
      }
    }
  }

private:
  /** Balls of other roots that may reach into a ball. */
  std::vector<RootBall>
  OthersNear(ElementIndex axis, const Vector3 & place, double radius) const
  {
    std::vector<RootBall> others;
    const auto            visit = [&](const RootBall & ball) {
      const Vector3 away = Minus(ball.place, place);
      const double  reach = 2 * radius + ball.radius + m_Slice;
      if (ball.owner != axis && Dot(away, away) < reach * reach)
      {
        others.push_back(ball);
      }
    };
    m_Thin.VisitNear(place, 2 * radius + (kThin + 1) * m_Slice, visit);
    m_Thick.VisitNear(place, 2 * radius + m_Widest + m_Slice, visit);
    return others;
  }

  bool
  IsThin(ElementIndex point) const
  {
    return m_Radii[point] <= kThin * m_Slice;
  }

  /** Never 0. */
  double
  Least(double radius) const
  {
    return std::max(radius, 0.4 * m_Slice);
  }

  /** From a point to the mean place of what is bright around it, across `along`; none where other roots are near. */
  std::optional<Vector3>
  Offset(ElementIndex axis, ElementIndex point, const Vector3 & along) const
  {
    const Vector3 &             place = m_Places[point];
    const double                radius = Least(m_Radii[point]);
    const double                reach = radius + kBeyond * m_Slice;
    const double                ball = Hypot(reach, kAlong * m_Slice);
    const auto                  others = OthersNear(axis, place, reach);
    std::array<std::int32_t, 3> low{};
    std::array<std::int32_t, 3> high{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      low[k] = static_cast<std::int32_t>(std::floor((place[k] - ball) / m_Geometry.spacing[k]));
      high[k] = static_cast<std::int32_t>(std::floor((place[k] + ball) / m_Geometry.spacing[k]));
    }
    Vector3 sum{ 0, 0, 0 };
    double  weights = 0;
    for (std::int32_t z = low[2]; z <= high[2]; ++z)
    {
      for (std::int32_t y = low[1]; y <= high[1]; ++y)
      {
        for (std::int32_t x = low[0]; x <= high[0]; ++x)
        {
          const Vector3 centre = Times({ x + 0.5, y + 0.5, z + 0.5 }, m_Geometry.spacing);
          const Vector3 away = Minus(centre, place);
          const double  forward = Dot(away, along);
          const Vector3 across = AddScaled(away, -forward, along);
          if (std::abs(forward) > kAlong * m_Slice || Dot(across, across) > reach * reach)
          {
            continue;
          }
          const double own = Length(away) / radius;
          for (const RootBall & other : others)
          {
            if (Distance(centre, other.place) < own * Least(other.radius))
            {
              return std::nullopt;
            }
          }
          const double weight = std::clamp(m_Brightness(x, y, z) - kBackground, 0.0, 1.0);
          sum = AddScaled(sum, weight, across);
          weights += weight;
        }
      }
    }
    return weights > 0 ? std::optional(AddScaled({ 0, 0, 0 }, 1 / weights, sum)) : std::nullopt;
  }

  void
  Move(ElementIndex axis)
  {
    const auto &        points = m_Roots.axes[axis].points;
    std::vector<double> way(points.size(), 0);
    for (std::size_t i = 1; i < points.size(); ++i)
    {
      way[i] = way[i - 1] + Distance(m_Places[points[i - 1]], m_Places[points[i]]);
    }
    std::vector<std::optional<Vector3>> offsets(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      if (m_Owner[points[i]] != axis || !IsThin(points[i]))
      {
        continue;
      }
      const double reach = std::max(kTangent * m_Slice, 2 * m_Radii[points[i]]);
      std::size_t  before = i;
      std::size_t  after = i;
      while (before > 0 && way[i] - way[before] < reach)
      {
        --before;
      }
      while (after + 1 < points.size() && way[after] - way[i] < reach)
      {
        ++after;
      }
      const Vector3 along = Minus(m_Places[points[after]], m_Places[points[before]]);
      if (Length(along) > 0)
      {
        offsets[i] = Offset(axis, points[i], Unit(along));
      }
    }
    const double                                  deviation = kAverage * m_Slice;
    std::vector<std::pair<ElementIndex, Vector3>> moved;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      if (m_Owner[points[i]] != axis || !IsThin(points[i]))
      {
        continue;
      }
      Vector3    sum{ 0, 0, 0 };
      double     weights = 0;
      const auto add = [&](std::size_t k) {
        const double apart = (way[k] - way[i]) / deviation;
        const double weight = std::exp(-0.5 * apart * apart);
        if (offsets[k])
        {
          sum = AddScaled(sum, weight, *offsets[k]);
          weights += weight;
        }
      };
      for (std::size_t k = i; k < points.size() && way[k] - way[i] < 3 * deviation; ++k)
      {
        add(k);
      }
      for (std::size_t k = i; k-- > 0 && way[i] - way[k] < 3 * deviation;)
      {
        add(k);
      }
      if (weights >= kLeastWeight)
      {
        const Vector3 to = AddScaled(m_Places[points[i]], 1 / weights, sum);
        const Vector3 step = Minus(to, m_First[points[i]]);
        const double  most = kFarthestMove * m_Slice;
        moved.emplace_back(points[i],
                           AddScaled(m_First[points[i]], Length(step) > most ? most / Length(step) : 1.0, step));
      }
    }
    for (const auto & [point, place] : moved)
    {
      m_Places[point] = place;
    }
  }

  SkeletonGraph &             m_Graph;
  const RootHierarchy &       m_Roots;
  const ImageGeometry &       m_Geometry;
  const RootBrightness &      m_Brightness;
  double                      m_Slice;
  const std::vector<double> & m_Radii;
  std::vector<ElementIndex>   m_Owner;  ///< per point its root
  double                      m_Widest; ///< radius of any
  BallCells                   m_Thin;
  BallCells                   m_Thick;
  std::vector<Vector3>        m_First; ///< per point where it was
  std::vector<Vector3>        m_Places;
};

} // namespace

void
CentreRoots(SkeletonGraph &        graph,
            const RootHierarchy &  roots,
            const ImageGeometry &  geometry,
            const RootBrightness & brightness)
{
  if (!graph.positions.empty())
  {
    RootCentring(graph, roots, geometry, brightness).Centre();
  }
}

} // namespace voxelcore
