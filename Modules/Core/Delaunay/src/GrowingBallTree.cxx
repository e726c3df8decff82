#include "GrowingBallTree.h"

#include "voxelcore/Base/EightLanes.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace voxelcore
{

namespace
{

constexpr float  infinite = std::numeric_limits<float>::infinity();
constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr double roundings = 1e-12; // far more than a sum of squares in double precision is off by, as a share of it
constexpr float  blur = 1e-6F;      // and of one in single precision

std::array<double, 3>
Scaled(const LatticePoint & from, const LatticePoint & to, const SpacingWeights & weights)
{
  return { static_cast<double>(weights.weight[0] * (to.x - from.x)),
           static_cast<double>(weights.weight[1] * (to.y - from.y)),
           static_cast<double>(weights.weight[2] * (to.z - from.z)) };
}

double
Dot(const std::array<double, 3> & a, const std::array<double, 3> & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

} // namespace

FacetSpheres::FacetSpheres(LatticePoint pa, LatticePoint pb, LatticePoint pc, const SpacingWeights & weights)
{
  const auto length2 = [&](const LatticePoint & from, const LatticePoint & to) {
    const std::array<double, 3> side = Scaled(from, to, weights);
    return Dot(side, side);
  };
  // From the corner opposite to the longest side the circle's centre is no small difference of long vectors.
  for (int turn = 0; turn < 2 && length2(pb, pc) < std::max(length2(pa, pb), length2(pa, pc)); ++turn)
  {
    const LatticePoint first = pa;
    pa = pb;
    pb = pc;
    pc = first;
  }
  a = pa;
  const std::array<std::int64_t, 3> toB{ pb.x - pa.x, pb.y - pa.y, pb.z - pa.z };
  const std::array<std::int64_t, 3> toC{ pc.x - pa.x, pc.y - pa.y, pc.z - pa.z };
  const std::array<double, 3>       u = Scaled(pa, pb, weights);
  const std::array<double, 3>       v = Scaled(pa, pc, weights);
  const double                      uu = Dot(u, u);
  const double                      uv = Dot(u, v);
  const double                      vv = Dot(v, v);
  double                            product = 1.0;
  double                            square = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    const auto        w = static_cast<double>(weights.weight[i]);
    normal[i] = static_cast<double>(toB[j] * toC[k] - toB[k] * toC[j]);
    along[i] = normal[i] * static_cast<double>(weights.weight[j] * weights.weight[k]);
    square += along[i] * along[i];
    squared[i] = w * w;
    product *= w;
  }
  const double root = std::sqrt(square);
  for (std::size_t i = 0; i < 3; ++i)
  {
    along[i] /= root;
    middle[i] = (vv * (uu - uv) * u[i] + uu * (vv - uv) * v[i]) / (2.0 * square);
    twice[i] = 2.0 * middle[i] * static_cast<double>(weights.weight[i]);
  }
  circle2 = Dot(middle, middle);
  scale = root / (2.0 * product);
}

double
FacetSpheres::SquaredRadius(const LatticePoint & q) const
{
  const std::array<double, 3> d{ static_cast<double>(q.x - a.x),
                                 static_cast<double>(q.y - a.y),
                                 static_cast<double>(q.z - a.z) };
  double                      value = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    value += (squared[axis] * d[axis] - twice[axis]) * d[axis];
  }
  const double at = value / Dot(normal, d) * scale;
  return circle2 + at * at;
}

// A ball that grows smaller with what is found, and what is found.
struct GrowingBallTree::Look
{
  const FacetSpheres &         spheres;
  std::array<double, 3>        weight;
  std::array<double, 3>        from; // of the facet's corner, in units of length from the tree's origin
  std::array<std::int32_t, 3>  corner;
  double                       extent;
  std::vector<std::uint32_t> & met;
  std::vector<double> &        low; // of its height's share
  double                       least = unbounded;
  std::array<float, 3>         centre{};
  std::array<float, 3>         along{};
  std::array<float, 3>         singleWeight{};
  float                        base = 0.0F; // of the facet's plane along it
  float                        radius = infinite;
  float                        radius2 = infinite;

  void
  Meet(const Leaf & leaf, std::size_t lane)
  {
    double height = 0.0;
    double value = 0.0;
    double square = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double d = leaf.place[axis][lane] - corner[axis];
      height += spheres.normal[axis] * d;
      square += spheres.squared[axis] * (d * d);
      value += spheres.twice[axis] * d;
    }
    const double off = roundings * (square + spheres.circle2);
    if (height > 0.0 && square - value - off <= least * height)
    {
      met.push_back(leaf.point[lane]);
      low.push_back((square - value - off) / height);
      least = std::min(least, (square - value + off) / height);
    }
  }

  /** Looks no further than the ball whose centre is so far from the circle's. */
  void
  Bound(double at)
  {
    double farthest = extent;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double own = from[axis] + spheres.middle[axis] + at * spheres.along[axis];
      centre[axis] = static_cast<float>(own);
      farthest = std::max(farthest, std::abs(own));
    }
    // The nearer to a plane, the larger: what single precision cannot hold is everything beyond the facet.
    const double grown = std::sqrt(spheres.circle2 + at * at) * (1.0 + 2.0 * blur) + 4.0 * blur * farthest;
    radius = grown < 1e15 ? static_cast<float>(grown) : infinite;
    radius2 = radius * radius;
    if (radius == infinite)
    {
      centre = {};
    }
  }
};

VOXELCORE_EIGHT_LANES void
GrowingBallTree::Descend(const std::array<std::uint32_t, 3> & near, Look & look) const
{
  struct Branch
  {
    std::uint32_t level;
    std::uint32_t at;
  };
  std::array<Branch, 8 * 13> stack;
  std::size_t                depth = 0;
  stack[depth++] = { static_cast<std::uint32_t>(m_Levels.size()), 0 };
  for (const std::uint32_t place : near)
  {
    stack[depth++] = { 0, place / lanes };
  }
  while (depth > 0)
  {
    const Branch branch = stack[--depth];
    if (branch.level == 0)
    {
      const Leaf & leaf = m_Leaves[branch.at];
      EightFloats  distance2{};
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        EightIntegers place;
        std::memcpy(&place, leaf.place[axis].data(), sizeof(place));
        const EightFloats away =
          __builtin_convertvector(place, EightFloats) * look.singleWeight[axis] - look.centre[axis];
        distance2 += away * away;
      }
      const double before = look.least;
      for (std::uint32_t left = LanesOf(distance2 <= look.radius2); left != 0; left &= left - 1)
      {
        look.Meet(leaf, static_cast<std::size_t>(std::countr_zero(left)));
      }
      if (look.least < before)
      {
        look.Bound(look.least * look.spheres.scale);
      }
      continue;
    }
    const Boxes & boxes = m_Levels[branch.level - 1][branch.at];
    EightFloats   distance2{};
    EightFloats   beyond = -look.base + EightFloats{};
    EightFloats   below{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const EightFloats low = EightAt(boxes.low[axis].data())->lanes;
      const EightFloats high = EightAt(boxes.high[axis].data())->lanes;
      const EightFloats under = low - look.centre[axis];
      const EightFloats over = look.centre[axis] - high;
      EightFloats       outside = under > over ? under : over;
      outside = outside > 0.0F ? outside : EightFloats{};
      distance2 += outside * outside;
      beyond += look.along[axis] * (look.along[axis] > 0.0F ? high : low);
      below += EightAt(boxes.outwards[axis].data())->lanes * look.centre[axis];
    }
    const EightFloats   layer = EightAt(boxes.begin.data())->lanes - below;
    const EightIntegers passes = (distance2 <= look.radius2) & (beyond > 0.0F) & (layer <= look.radius);
    for (std::uint32_t left = LanesOf(passes); left != 0; left &= left - 1)
    {
      stack[depth++] = { branch.level - 1, lanes * branch.at + static_cast<std::uint32_t>(std::countr_zero(left)) };
    }
  }
}

void
GrowingBallTree::Find(const FacetSpheres &                 spheres,
                      double                               radius,
                      const std::array<std::uint32_t, 3> & near,
                      std::vector<std::uint32_t> &         first)
{
  Look look{ spheres, m_Weight, {}, {}, m_Extent, m_Met, m_Low };
  look.corner = { spheres.a.x - m_Origin.x, spheres.a.y - m_Origin.y, spheres.a.z - m_Origin.z };
  double base = 0.0;
  double highest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    look.from[axis] = m_Weight[axis] * look.corner[axis];
    look.along[axis] = static_cast<float>(spheres.along[axis]);
    look.singleWeight[axis] = static_cast<float>(m_Weight[axis]);
    base += look.from[axis] * spheres.along[axis];
    highest += std::abs(spheres.normal[axis]) * m_Longest;
  }
  if (highest > 0x1p53)
  {
    throw InputError("the shape is too thick for exact arithmetic; crop it"); // a ball of 30,000 voxels
  }
  look.base = static_cast<float>(base - 4.0 * blur * m_Extent);
  // NOLINTNEXTLINE(cert-flp30-c): doubling is exact
  for (const double widest = 1e3 * m_Extent; m_Size > 0; radius *= 2.0)
  {
    m_Met.clear();
    m_Low.clear();
    const bool   isLast = radius > widest;
    const double at = isLast ? unbounded : std::sqrt(std::max(0.0, radius * radius - spheres.circle2));
    look.least = at / spheres.scale;
    look.Bound(at);
    Descend(near, look);
    // What is found at the rim of the ball may have peers beyond it.
    if (isLast || look.least < at / spheres.scale)
    {
      break;
    }
  }
  first.clear();
  for (std::size_t i = 0; i < m_Met.size(); ++i)
  {
    // Leaves are looked at twice, and the last may have the last point several times.
    if (m_Low[i] <= look.least && std::find(first.begin(), first.end(), m_Met[i]) == first.end())
    {
      first.push_back(m_Met[i]);
    }
  }
}

void
GrowingBallTree::Build(const std::vector<LatticePoint> & points,
                       std::span<const std::uint32_t>    chosen,
                       std::span<const Direction>        outwards,
                       const SpacingWeights &            weights)
{
  m_Size = chosen.size();
  m_Leaves.resize((m_Size + lanes - 1) / lanes);
  m_Levels.clear();
  if (m_Size == 0)
  {
    return;
  }
  LatticePoint low = points[chosen[0]];
  LatticePoint high = low;
  for (const std::uint32_t p : chosen)
  {
    low = { std::min(low.x, points[p].x), std::min(low.y, points[p].y), std::min(low.z, points[p].z) };
    high = { std::max(high.x, points[p].x), std::max(high.y, points[p].y), std::max(high.z, points[p].z) };
  }
  m_Origin = low;
  const std::array<double, 3> diagonal = Scaled(low, high, weights);
  m_Extent = std::max({ diagonal[0], diagonal[1], diagonal[2] });
  m_Longest = std::max({ high.x - low.x, high.y - low.y, high.z - low.z });
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    m_Weight[axis] = static_cast<double>(weights.weight[axis]);
  }
  for (std::size_t i = 0; i < lanes * m_Leaves.size(); ++i)
  {
    // The last leaf's spare places repeat the last point.
    const LatticePoint & p = points[chosen[std::min(i, m_Size - 1)]];
    Leaf &               leaf = m_Leaves[i / lanes];
    leaf.place[0][i % lanes] = p.x - low.x;
    leaf.place[1][i % lanes] = p.y - low.y;
    leaf.place[2][i % lanes] = p.z - low.z;
    leaf.point[i % lanes] = chosen[std::min(i, m_Size - 1)];
  }
  for (std::size_t width = lanes, count = m_Leaves.size();; width *= lanes, count = m_Levels.back().size())
  {
    std::vector<Boxes> level((count + lanes - 1) / lanes);
    RunInParts(m_Size > 10000, level.size() * lanes, [&](std::size_t from, std::size_t to) {
      for (std::size_t branch = from; branch < to; ++branch)
      {
        SetBox(level[branch / lanes],
               branch % lanes,
               branch * width,
               std::min(branch * width + width, m_Size),
               outwards);
      }
    });
    m_Levels.push_back(std::move(level));
    if (m_Levels.back().size() == 1)
    {
      break;
    }
  }
}

void
GrowingBallTree::SetBox(Boxes &                    boxes,
                        std::size_t                lane,
                        std::size_t                from,
                        std::size_t                to,
                        std::span<const Direction> outwards)
{
  std::array<double, 3> low{ unbounded, unbounded, unbounded };
  std::array<double, 3> high{ -unbounded, -unbounded, -unbounded };
  std::array<double, 3> sum{};
  const auto            placeOf = [&](std::size_t i) {
    const auto &          place = m_Leaves[i / lanes].place;
    std::array<double, 3> scaled;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      scaled[axis] = m_Weight[axis] * place[axis][i % lanes];
    }
    return scaled;
  };
  for (std::size_t i = from; i < to; ++i)
  {
    const std::array<double, 3> place = placeOf(i);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::min(low[axis], place[axis]);
      high[axis] = std::max(high[axis], place[axis]);
      sum[axis] += static_cast<double>(outwards[i].to[axis]);
    }
  }
  const double         length = std::sqrt(Dot(sum, sum));
  std::array<float, 3> unit{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    unit[axis] = length > 0.0 ? static_cast<float>(sum[axis] / length) : 0.0F;
    boxes.low[axis][lane] = static_cast<float>(low[axis]);
    boxes.high[axis][lane] = static_cast<float>(high[axis]);
    boxes.outwards[axis][lane] = unit[axis];
  }
  double begin = unbounded;
  for (std::size_t i = from; i < to; ++i)
  {
    const std::array<double, 3> place = placeOf(i);
    begin = std::min(begin, place[0] * unit[0] + place[1] * unit[1] + place[2] * unit[2]);
  }
  // Where there is no direction, a ball is never too far from what begins nowhere; an empty lane is everywhere too far.
  boxes.begin[lane] = from >= to ? infinite : length > 0.0 ? static_cast<float>(begin) : -infinite;
}

} // namespace voxelcore
