#include "RootGrowth.h"
#include "SplitMix64.h"

#include "voxelcore/Base/Error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>

namespace voxelcore
{
namespace
{

/** How one branch grows. */
struct Growth
{
  Vector3 start{};
  Vector3 direction{};
  double  length = 0;
  double  baseRadius = 0;
  double  tipRadius = 0;
  double  wander = 0;  ///< how much each step may turn
  double  gravity = 0; ///< how much each step turns down
};

/** Grows the branches one after another, each keeping clear of what is there, so that the system stays a tree. */
class RootGrower
{
public:
  explicit RootGrower(const PhantomOptions & options)
    : m_Seed(options.seed)
    , m_Sides(Sides(options))
    , m_Shortest(ShortestSide(options))
    , m_Detail(options.detail.value_or(0.501 * std::sqrt(Dot(options.spacing, options.spacing))))
    , m_Step(m_Shortest / 200)
    , m_StemRadius(std::max(options.radius.value_or(0.045 * m_Shortest), m_Detail))
    , m_CellSide(2 * (m_StemRadius + 4 * m_Detail + m_Step))
  {
    // As many as there is room for between them at this detail.
    const double room = m_Sides[2] / m_Detail;
    m_Laterals = options.laterals.value_or(static_cast<int>(std::clamp(room / 16, 3.0, 50.0)));
    m_SubLaterals = options.subLaterals.value_or(static_cast<int>(std::clamp(m_Shortest / m_Detail / 60, 1.0, 8.0)));
    m_Whorls = options.whorls.value_or(0);
    m_Wanted = options.contacts.value_or(0);
  }

  GrownRoot
  Grow()
  {
    const std::size_t stem = GrowStem();
    if (m_Points.empty())
    {
      return {};
    }
    const std::vector<std::size_t> laterals = GrowOn(stem, m_Laterals, 1);
    for (const std::size_t lateral : laterals)
    {
      GrowOn(lateral, m_SubLaterals, 2);
    }
    for (int i = 0; i < m_Wanted; ++i)
    {
      GrowContact(stem, static_cast<std::uint64_t>(i));
    }
    return { std::move(m_Points), std::move(m_Contacts) };
  }

private:
  /** Points of a branch lie together: [first, last). */
  struct Branch
  {
    std::size_t first = 0;
    std::size_t last = 0;
  };

  std::size_t
  GrowStem()
  {
    const double margin = m_StemRadius + 2 * m_Detail;
    Growth       growth;
    growth.start = { m_Sides[0] / 2, m_Sides[1] / 2, m_Sides[2] - margin };
    growth.direction = { 0, 0, -1 };
    growth.length = std::max(0.0, m_Sides[2] - 2 * margin);
    growth.baseRadius = m_StemRadius;
    growth.tipRadius = m_StemRadius / 4;
    growth.wander = 0.05;
    growth.gravity = 0.02;
    SplitMix64 random(m_Seed, 0);
    return Accept(Trace(growth, random), -1, 0);
  }

  /** Lets laterals spring from a branch; gives those that grew. */
  std::vector<std::size_t>
  GrowOn(std::size_t parentBranch, int count, std::int32_t order)
  {
    std::vector<std::size_t> grown;
    const Branch             parent = m_Branches[parentBranch];
    const double             points = static_cast<double>(parent.last - parent.first);
    for (int i = 0; i < count; ++i)
    {
      std::vector<GrownPoint> best;
      std::size_t             bestOrigin = 0;
      double                  bestPart = 0;
      for (std::uint64_t attempt = 0; attempt < 12 && bestPart < 1; ++attempt)
      {
        // A stream for each attempt: whether one is needed must not change the branches that come after.
        SplitMix64 random(m_Seed, (((parentBranch + 1) << 20) + static_cast<std::uint64_t>(i)) * 64 + attempt + 1);
        double     along =
          order == 1 ? 0.04 + 0.9 * (i + random.Uniform()) / count : 0.2 + 0.7 * (i + random.Uniform()) / count;
        if (order == 1 && m_Whorls > 0)
        {
          const int whorl = i * m_Whorls / count;
          along = 0.08 + 0.7 * (whorl + 0.5) / m_Whorls;
        }
        const std::size_t origin = std::min(parent.last - 1, parent.first + static_cast<std::size_t>(along * points));
        const Growth      growth = GrowthAt(origin, along, order, random);
        if (growth.length <= 0)
        {
          continue;
        }
        std::vector<GrownPoint> points_ = Trace(growth, random);
        const std::size_t       wanted = points_.size();
        points_.resize(FreeLength(points_, origin, parentBranch));
        const double part = static_cast<double>(points_.size()) / static_cast<double>(wanted);
        if (part > bestPart && points_.size() > 3)
        {
          best = std::move(points_);
          bestOrigin = origin;
          bestPart = part;
        }
      }
      if (bestPart > 0.2)
      {
        grown.push_back(Accept(std::move(best), static_cast<std::int64_t>(bestOrigin), order));
      }
    }
    return grown;
  }

  Growth
  GrowthAt(std::size_t origin, double along, std::int32_t order, SplitMix64 & random) const
  {
    const GrownPoint & from = m_Points[origin];
    const Vector3      tangent = Direction(
      Minus(from.position, m_Points[static_cast<std::size_t>(std::max<std::int64_t>(from.parent, 0))].position));
    Vector3 sideways = RandomInBall(random);
    sideways = Direction(AddScaled(sideways, -Dot(sideways, tangent), tangent));
    Growth growth;
    growth.start = from.position;
    growth.direction = Direction(AddScaled(sideways, order == 1 ? 0.35 : 0.7, tangent));
    growth.length = order == 1 ? (0.6 - 0.3 * along) * m_Shortest * random.Uniform(0.7, 1.2)
                               : (0.24 - 0.1 * along) * m_Shortest * random.Uniform(0.5, 1.2);
    growth.baseRadius = (order == 1 ? 0.45 : 0.6) * from.radius * random.Uniform(0.8, 1.0);
    growth.tipRadius = 0.35 * growth.baseRadius;
    growth.wander = order == 1 ? 0.12 : 0.18;
    growth.gravity = order == 1 ? 0.012 : 0.006;
    return growth;
  }

  /** The points of a branch, from its start on: straight on, a little astray, a little down. It ends at the margin. */
  std::vector<GrownPoint>
  Trace(const Growth & growth, SplitMix64 & random, const std::optional<Vector3> & target = {}) const
  {
    bool                    reached = !target;
    std::vector<GrownPoint> points;
    const int               steps = std::max(1, static_cast<int>(growth.length / m_Step));
    Vector3                 position = growth.start;
    Vector3                 direction = growth.direction;
    Vector3                 turn{ 0, 0, 0 };
    for (int i = 0; i <= steps; ++i)
    {
      const double t = static_cast<double>(i) / steps;
      GrownPoint   point;
      point.position = position;
      point.radius = std::max(m_Detail, growth.baseRadius + t * (growth.tipRadius - growth.baseRadius));
      const double margin = point.radius + m_Detail;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        if (position[axis] < margin || position[axis] > m_Sides[axis] - margin)
        {
          return points;
        }
      }
      points.push_back(point);
      // The turning itself changes slowly: the line is smooth.
      turn = AddScaled({ 0.8 * turn[0], 0.8 * turn[1], 0.8 * turn[2] }, 0.3 * growth.wander, RandomInBall(random));
      direction = Direction(AddScaled(AddScaled(direction, 1, turn), growth.gravity, { 0, 0, -1 }));
      if (!reached)
      {
        const double away = Distance(position, *target);
        direction = Direction(AddScaled(direction, m_Step / away, Minus(*target, position)));
        reached = away < 3 * m_Step;
      }
      position = AddScaled(position, m_Step, direction);
    }
    return points;
  }

  /** How many points a branch has before it comes too near to another, or back to the one it springs from. */
  std::size_t
  FreeLength(const std::vector<GrownPoint> & points,
             std::size_t                     origin,
             std::size_t                     parentBranch,
             const ConeEnd &                 touched = {},
             std::int32_t                    touchedBranch = -1) const
  {
    const GrownPoint & from = m_Points[origin];
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const GrownPoint & point = points[i];
      const double       away = Distance(point.position, from.position);
      if (away < from.radius + point.radius)
      {
        continue; // still within the parent
      }
      const bool  leftParent = away > 2.5 * (from.radius + point.radius) + 4 * m_Detail;
      std::size_t blocked = 0;
      ForNeighbours(point.position, [&](std::size_t index) {
        const GrownPoint & other = m_Points[index];
        if (static_cast<std::size_t>(other.branch) == parentBranch && !leftParent)
        {
          return;
        }
        if (other.branch == touchedBranch && Distance(point.position, touched.position) < touched.radius)
        {
          return;
        }
        if (Distance(point.position, other.position) < point.radius + other.radius + 3 * m_Detail + m_Step / 2)
        {
          ++blocked;
        }
      });
      if (blocked > 0)
      {
        return i;
      }
    }
    return points.size();
  }

  /** Lets a lateral grow that touches another branch on its way, in one place, and goes on beyond. */
  void
  GrowContact(std::size_t stem, std::uint64_t number)
  {
    for (std::uint64_t attempt = 0; attempt < 2000; ++attempt)
    {
      SplitMix64 random(m_Seed, (std::uint64_t{ 1 } << 50) + (number << 12) + attempt);
      const auto pick = [&random](std::size_t count) {
        return static_cast<std::size_t>(random.Uniform() * static_cast<double>(count));
      };
      const Branch      other = m_Branches[1 + pick(m_Branches.size() - 1)];
      const std::size_t length = other.last - other.first;
      if (m_Branches.size() < 2 || length < 30)
      {
        continue;
      }
      const std::size_t at = other.first + length / 3 + pick(length / 2);
      const GrownPoint  there = m_Points[at];
      const Vector3     tangent = Direction(Minus(m_Points[at + 1].position, m_Points[at - 1].position));
      Vector3           sideways = RandomInBall(random);
      sideways = Direction(AddScaled(sideways, -Dot(sideways, tangent), tangent));
      const Branch &    trunk = m_Branches[stem];
      const double      along = 0.04 + 0.7 * random.Uniform();
      const std::size_t origin =
        trunk.first + static_cast<std::size_t>(along * static_cast<double>(trunk.last - trunk.first));
      Growth growth = GrowthAt(origin, along, 1, random);
      growth.baseRadius = std::max(growth.baseRadius, m_Detail);
      const double  thickness = std::max(m_Detail, 0.7 * growth.baseRadius);
      const Vector3 target = AddScaled(there.position, 0.85 * (there.radius + thickness), sideways);
      growth.direction = Direction(Minus(target, growth.start));
      growth.length = Distance(target, growth.start) * random.Uniform(1.4, 1.8);
      growth.wander *= 0.5;
      if (std::abs(Dot(growth.direction, tangent)) > 0.8)
      {
        continue; // along the other rather than across it
      }
      std::vector<GrownPoint> points = Trace(growth, random, target);
      const ConeEnd           window{ there.position, 4 * (there.radius + thickness) + 4 * m_Detail };
      points.resize(FreeLength(points, origin, stem, window, there.branch));
      std::size_t nearest = 0;
      double      gap = std::numeric_limits<double>::infinity();
      Vector3     between{};
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        for (std::size_t k = other.first; k < other.last; ++k)
        {
          const double away = Distance(points[i].position, m_Points[k].position);
          const double apart = away / (points[i].radius + m_Points[k].radius);
          if (apart < gap)
          {
            gap = apart;
            nearest = i;
            between = AddScaled(points[i].position, 0.5, Minus(m_Points[k].position, points[i].position));
          }
        }
      }
      const double beyond = static_cast<double>(points.size() - std::min(points.size(), nearest)) * m_Step;
      if (gap > 0.95 || beyond < window.radius)
      {
        continue;
      }
      const std::size_t branch = Accept(std::move(points), static_cast<std::int64_t>(origin), 1);
      m_Contacts.push_back({ between, { there.branch, static_cast<std::int32_t>(branch) } });
      return;
    }
  }

  /** Adds a branch whose first point follows the point `parent`. */
  std::size_t
  Accept(std::vector<GrownPoint> points, std::int64_t parent, std::int32_t order)
  {
    const std::size_t branch = m_Branches.size();
    m_Branches.push_back({ m_Points.size(), m_Points.size() + points.size() });
    for (GrownPoint & point : points)
    {
      point.parent = parent;
      point.branch = static_cast<std::int32_t>(branch);
      point.order = order;
      parent = static_cast<std::int64_t>(m_Points.size());
      m_Cells[CellOf(point.position, { 0, 0, 0 })].push_back(m_Points.size());
      m_Points.push_back(point);
    }
    return branch;
  }

  std::uint64_t
  CellOf(const Vector3 & position, const std::array<int, 3> & shift) const
  {
    std::uint64_t key = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto cell = static_cast<std::int64_t>(position[axis] / m_CellSide) + shift[axis] + 1;
      key = (key << 21) | (static_cast<std::uint64_t>(cell) & 0x1FFFFF);
    }
    return key;
  }

  template <typename Visit>
  void
  ForNeighbours(const Vector3 & position, Visit && visit) const
  {
    for (int dz = -1; dz <= 1; ++dz)
    {
      for (int dy = -1; dy <= 1; ++dy)
      {
        for (int dx = -1; dx <= 1; ++dx)
        {
          const auto cell = m_Cells.find(CellOf(position, { dx, dy, dz }));
          if (cell != m_Cells.end())
          {
            std::for_each(cell->second.begin(), cell->second.end(), visit);
          }
        }
      }
    }
  }

  std::uint64_t                                               m_Seed;
  Vector3                                                     m_Sides;
  double                                                      m_Shortest;
  double                                                      m_Detail; ///< smallest radius
  double                                                      m_Step;   ///< between points
  double                                                      m_StemRadius;
  double                                                      m_CellSide;
  int                                                         m_Laterals = 0;
  int                                                         m_SubLaterals = 0;
  int                                                         m_Whorls = 0; ///< 0: laterals spring from anywhere
  int                                                         m_Wanted = 0; ///< contacts
  std::vector<GrownContact>                                   m_Contacts;
  std::vector<GrownPoint>                                     m_Points;
  std::vector<Branch>                                         m_Branches;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> m_Cells; ///< points by coarse cells
};

} // namespace

GrownRoot
GrowRoot(const PhantomOptions & options)
{
  GrownRoot root = RootGrower(options).Grow();
  if (root.points.empty())
  {
    throw UsageError("a root does not fit into a grid this small; enlarge its size or give a smaller detail");
  }
  return root;
}

} // namespace voxelcore
