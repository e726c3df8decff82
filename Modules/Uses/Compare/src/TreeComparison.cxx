#include "voxelcore/Compare/TreeComparison.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/Compare/CentrelineOverlap.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Refinement/TriangleTree.h"
#include "voxelcore/VoxelCore/BallTree.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kSteps = 4;        ///< places a radius
constexpr double kFarthest = 1e15;  ///< mm; squares of more than 1e150 overflow
constexpr double kMostPlaces = 1e6; ///< of a skeleton. Of a vessel tree of 30 m there are 0.3 million; a damaged file's
                                    ///< one far point would ask for all memory
constexpr double kLeave = 2;        ///< radii from a bifurcation on: outside the ball there, where branches are apart
constexpr int    kHalvings = 40;    ///< of a step: to its rounding

struct Place
{
  Vector3 at{};
  double  radius = 0;
  double  arc = 0; ///< from the branch's begin, mm
};

/** A skeleton's lines, cut into places no more than a step apart; all points of lines are among them. */
struct Lines
{
  std::vector<Place>       places;
  std::vector<std::size_t> offsets{ 0 }; ///< of branches
  TriangleTree             tree{ {}, {} };
  std::vector<std::size_t> firstOf; ///< per piece its first place
  std::vector<ElementIndex>
    pointOf; ///< per place the graph's point, or a number of its own: pieces with one in common hang together
};

Vector3
NearestOnPiece(const Lines & lines, std::size_t piece, const Vector3 & to, double & share)
{
  const Vector3 & p = lines.places[lines.firstOf[piece]].at;
  const Vector3   d = Minus(lines.places[lines.firstOf[piece] + 1].at, p);
  const double    squared = Dot(d, d);
  share = squared > 0 ? std::clamp(Dot(Minus(to, p), d) / squared, 0.0, 1.0) : 0;
  return AddScaled(p, share, d);
}

double
RadiusOnPiece(const Lines & lines, std::size_t piece, double share)
{
  const Place & one = lines.places[lines.firstOf[piece]];
  const Place & two = lines.places[lines.firstOf[piece] + 1];
  return one.radius + share * (two.radius - one.radius);
}

Lines
CutLines(const SkeletonGraph & graph, double step)
{
  const auto & radii = SectionRadii(graph);
  Lines        lines;
  auto         further = static_cast<ElementIndex>(graph.positions.size());
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto points = graph.Branch(branch);
    double     arc = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const Vector3 & at = graph.positions[points[i]];
      lines.places.push_back({ at, radii[points[i]], arc });
      lines.pointOf.push_back(points[i]);
      if (i + 1 == points.size())
      {
        break;
      }
      const Vector3 d = Minus(graph.positions[points[i + 1]], at);
      const double  length = Length(d);
      const double  count = std::max(1.0, std::ceil(length / step));
      for (double k = 1; k < count; ++k)
      {
        const double share = k / count;
        lines.places.push_back({ AddScaled(at, share, d),
                                 radii[points[i]] + share * (radii[points[i + 1]] - radii[points[i]]),
                                 arc + share * length });
        lines.pointOf.push_back(further++);
      }
      arc += length;
    }
    lines.offsets.push_back(lines.places.size());
  }
  std::vector<Vector3>                      vertices;
  std::vector<std::array<std::uint32_t, 3>> pieces;
  for (const Place & place : lines.places)
  {
    vertices.push_back(place.at);
  }
  for (std::size_t branch = 0; branch + 1 < lines.offsets.size(); ++branch)
  {
    for (std::size_t i = lines.offsets[branch]; i + 1 < lines.offsets[branch + 1]; ++i)
    {
      const auto first = static_cast<std::uint32_t>(i);
      lines.firstOf.push_back(i);
      pieces.push_back({ first, first + 1, first + 1 });
    }
  }
  lines.tree = TriangleTree(vertices, pieces);
  return lines;
}

/** Where the other's lines are nearest. */
struct Nearest
{
  double distance = std::numeric_limits<double>::infinity();
  double radius = 0; ///< there
};

Nearest
NearestOf(const Lines & lines, const Vector3 & place)
{
  if (lines.firstOf.empty())
  {
    return {};
  }
  const auto    found = lines.tree.FindNearest(place, std::numeric_limits<double>::infinity());
  double        share = 0;
  const Vector3 foot = NearestOnPiece(lines, found.triangle, place, share);
  return { Distance(foot, place), RadiusOnPiece(lines, found.triangle, share) };
}

class Comparison
{
public:
  Comparison(const SkeletonGraph & a, const SkeletonGraph & b, double least, double step)
    : m_Least(least)
    , m_A(CutLines(a, step))
    , m_B(CutLines(b, step))
    , m_NearA(NearestOfAll(m_A, m_B))
    , m_NearB(NearestOfAll(m_B, m_A))
  {}

  double
  Tolerance(double radius) const
  {
    return std::max(radius, m_Least) * (1 + kLengthRounding);
  }

  std::vector<BranchMatch>
  Branches(bool ofA) const
  {
    const Lines &            own = ofA ? m_A : m_B;
    std::vector<BranchMatch> branches(own.offsets.size() - 1);
    const BallTree           balls = BallsOf(ofA ? m_B : m_A, !ofA);
    RunEach(branches.size(), [&](std::size_t branch) {
      branches[branch].length = own.places[own.offsets[branch + 1] - 1].arc;
      branches[branch].found = FoundLength(ofA, branch);
      branches[branch].share = FollowedShare(ofA, branch, balls);
    });
    return branches;
  }

  void
  AddDistances(TreeComparison & compared) const
  {
    std::vector<double> found;
    std::vector<double> all;
    for (const bool ofA : { true, false })
    {
      const Lines & own = ofA ? m_A : m_B;
      const auto &  near = ofA ? m_NearA : m_NearB;
      for (std::size_t i = 0; i < own.places.size(); ++i)
      {
        all.push_back(near[i].distance);
        if (IsFound(ofA, own.places[i].radius, near[i]))
        {
          found.push_back(near[i].distance);
        }
      }
    }
    compared.axis = DistancesOf(std::move(found));
    compared.all = DistancesOf(std::move(all));
  }

  void
  AddRadii(TreeComparison & compared) const
  {
    double length = 0;
    double bias = 0;
    double error = 0;
    for (std::size_t branch = 0; branch + 1 < m_A.offsets.size(); ++branch)
    {
      for (std::size_t i = m_A.offsets[branch]; i < m_A.offsets[branch + 1]; ++i)
      {
        if (IsFound(true, m_A.places[i].radius, m_NearA[i]))
        {
          const double weight = Weight(m_A, branch, i);
          length += weight;
          bias += weight * (m_NearA[i].radius - m_A.places[i].radius);
          error += weight * std::abs(m_NearA[i].radius - m_A.places[i].radius);
        }
      }
    }
    compared.radiusBias = length > 0 ? bias / length : kUnknown;
    compared.radiusError = length > 0 ? error / length : kUnknown;
  }

private:
  static std::vector<Nearest>
  NearestOfAll(const Lines & own, const Lines & other)
  {
    std::vector<Nearest> near(own.places.size());
    RunInParts(near.size() > 1000, near.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
      {
        near[i] = NearestOf(other, own.places[i].at);
      }
    });
    return near;
  }

  static AxisDistances
  DistancesOf(std::vector<double> distances)
  {
    if (distances.empty())
    {
      return { kUnknown, kUnknown, kUnknown };
    }
    ranges::sort(distances); // so that the sum does not depend on the order of A and B
    AxisDistances result;
    for (const double distance : distances)
    {
      result.mean += distance;
    }
    result.mean /= static_cast<double>(distances.size());
    result.max = distances.back();
    result.percentile95 = QuantileOf(std::move(distances), 0.95);
    return result;
  }

  bool
  IsFound(bool ofA, double radius, const Nearest & nearest) const
  {
    return nearest.distance <= Tolerance(ofA ? radius : nearest.radius);
  }

  /** Half of what lies to either side. */
  static double
  Weight(const Lines & lines, std::size_t branch, std::size_t i)
  {
    const std::size_t before = std::max(i, lines.offsets[branch] + 1) - 1;
    const std::size_t behind = std::min(i + 1, lines.offsets[branch + 1] - 1);
    return (lines.places[behind].arc - lines.places[before].arc) / 2;
  }

  double
  FoundLength(bool ofA, std::size_t branch) const
  {
    const Lines & own = ofA ? m_A : m_B;
    const auto &  near = ofA ? m_NearA : m_NearB;
    double        length = 0;
    for (std::size_t i = own.offsets[branch]; i + 1 < own.offsets[branch + 1]; ++i)
    {
      const Place & one = own.places[i];
      const Place & two = own.places[i + 1];
      const bool    begins = IsFound(ofA, one.radius, near[i]);
      const bool    ends = IsFound(ofA, two.radius, near[i + 1]);
      double        share = begins ? 1 : 0;
      if (begins != ends)
      {
        double low = 0;
        double high = 1;
        for (int k = 0; k < kHalvings; ++k)
        {
          const double  middle = (low + high) / 2;
          const Nearest there = NearestOf(ofA ? m_B : m_A, AddScaled(one.at, middle, Minus(two.at, one.at)));
          (IsFound(ofA, one.radius + middle * (two.radius - one.radius), there) == begins ? low : high) = middle;
        }
        share = begins ? low : 1 - low;
      }
      length += share * (two.arc - one.arc);
    }
    return length;
  }

  /** Balls around pieces; of A's pieces, with the tolerance around them. */
  BallTree
  BallsOf(const Lines & lines, bool withTolerance) const
  {
    std::vector<Vector3> centres;
    std::vector<double>  radii;
    for (const std::size_t first : lines.firstOf)
    {
      const Place & one = lines.places[first];
      const Place & two = lines.places[first + 1];
      centres.push_back(AddScaled(one.at, 0.5, Minus(two.at, one.at)));
      radii.push_back(Distance(one.at, two.at) / 2 + (withTolerance ? Tolerance(std::max(one.radius, two.radius)) : 0));
    }
    return { centres, radii, SpacingWeights() };
  }

  /** BranchMatch::share. */
  double
  FollowedShare(bool ofA, std::size_t branch, const BallTree & balls) const
  {
    const Lines &                                      own = ofA ? m_A : m_B;
    const Lines &                                      other = ofA ? m_B : m_A;
    const std::size_t                                  begin = own.offsets[branch];
    const std::size_t                                  count = own.offsets[branch + 1] - begin;
    const double                                       whole = own.places[begin + count - 1].arc;
    std::vector<std::pair<std::size_t, std::uint32_t>> near; // place of the branch, number of the piece there
    std::map<std::uint32_t, std::uint32_t>             numbers;
    std::vector<std::uint32_t>                         found;
    for (std::size_t i = begin; i < begin + count; ++i)
    {
      const Place & place = own.places[i];
      balls.FindWithin(place.at, ofA ? Tolerance(place.radius) : 0, found);
      for (const std::uint32_t piece : found)
      {
        double        share = 0;
        const Vector3 foot = NearestOnPiece(other, piece, place.at, share);
        if (Distance(foot, place.at) <= Tolerance(ofA ? place.radius : RadiusOnPiece(other, piece, share)))
        {
          near.emplace_back(i, numbers.emplace(piece, static_cast<std::uint32_t>(numbers.size())).first->second);
        }
      }
    }
    if (near.empty() || !(whole > 0))
    {
      return 0;
    }
    UnionFind                             runs(numbers.size());
    std::map<ElementIndex, std::uint32_t> pieceAt;
    for (const auto & [piece, number] : numbers)
    {
      for (std::size_t end = 0; end < 2; ++end)
      {
        const auto at = pieceAt.emplace(other.pointOf[other.firstOf[piece] + end], number);
        runs.Unite(at.first->second, number);
      }
    }
    std::map<std::uint32_t, std::pair<double, std::size_t>> followed; // by run: length, and the last place counted
    double                                                  most = 0;
    for (const auto & [i, number] : near)
    {
      auto & [length, last] = followed.emplace(runs.Find(number), std::pair(0.0, begin + count)).first->second;
      if (last != i)
      {
        last = i;
        length += Weight(own, branch, i);
        most = std::max(most, length);
      }
    }
    return most / whole;
  }

  double               m_Least;
  Lines                m_A;
  Lines                m_B;
  std::vector<Nearest> m_NearA; ///< from each of A's places to B
  std::vector<Nearest> m_NearB;
};

/** The median of what radii are above 0; 0 where none is. */
double
MedianRadius(const SkeletonGraph & graph)
{
  std::vector<double> radii;
  ranges::copy_if(SectionRadii(graph), std::back_inserter(radii), [](double radius) { return radius > 0; });
  return radii.empty() ? 0 : QuantileOf(std::move(radii), 0.5);
}

std::vector<ElementIndex>
PointsOf(const SkeletonGraph & graph, bool tips)
{
  std::vector<ElementIndex> points;
  std::vector<int>          ends(graph.nodePoints.size(), 0);
  for (const auto & nodes : graph.branchNodes)
  {
    ++ends[nodes[0]];
    ++ends[nodes[1]];
  }
  for (std::size_t node = 0; node < graph.nodePoints.size(); ++node)
  {
    const NodeKind kind = graph.nodeKinds[node];
    if (tips ? kind == NodeKind::Tip || kind == NodeKind::Isolated : ends[node] > 2)
    {
      points.push_back(graph.nodePoints[node]);
    }
  }
  return points;
}

/** From a bifurcation to where its branches are `far` along, or to their other ends. */
std::vector<Vector3>
DirectionsFrom(const SkeletonGraph & graph, ElementIndex point, double far)
{
  std::vector<Vector3> directions;
  const auto           add = [&](const auto & points) {
    double along = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
    {
      const Vector3 & one = graph.positions[points[i - 1]];
      const Vector3   d = Minus(graph.positions[points[i]], one);
      const double    length = Length(d);
      if (along + length >= far || i + 1 == points.size())
      {
        const double  share = along + length > far ? (far - along) / length : 1;
        const Vector3 way = Minus(AddScaled(one, share, d), graph.positions[point]);
        if (Length(way) > 0)
        {
          directions.push_back(way);
        }
        return;
      }
      along += length;
    }
  };
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto points = graph.Branch(branch);
    if (points.front() == point)
    {
      add(points);
    }
    if (points.back() == point)
    {
      add(std::vector<ElementIndex>(points.rbegin(), points.rend()));
    }
  }
  return directions;
}

/** PlaceMatch::angleError of directions of A and of B. */
double
AngleError(const std::vector<Vector3> & a, const std::vector<Vector3> & b)
{
  std::vector<std::array<double, 3>> pairs; // angle between the two, their numbers
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    for (std::size_t j = 0; j < b.size(); ++j)
    {
      pairs.push_back({ AngleDegrees(a[i], b[j]), static_cast<double>(i), static_cast<double>(j) });
    }
  }
  ranges::sort(pairs);
  std::vector<std::size_t> ofA;
  std::vector<std::size_t> ofB;
  for (const auto & pair : pairs)
  {
    const auto i = static_cast<std::size_t>(pair[1]);
    const auto j = static_cast<std::size_t>(pair[2]);
    if (ranges::count(ofA, i) + ranges::count(ofB, j) == 0)
    {
      ofA.push_back(i);
      ofB.push_back(j);
    }
  }
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < ofA.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      sum += std::abs(AngleDegrees(a[ofA[i]], a[ofA[j]]) - AngleDegrees(b[ofB[i]], b[ofB[j]]));
      ++count;
    }
  }
  return count > 0 ? sum / count : kUnknown;
}

std::vector<PlaceMatch>
MatchPlaces(const SkeletonGraph & a, const SkeletonGraph & b, bool tips, const Comparison & comparison)
{
  const auto pointsA = PointsOf(a, tips);
  const auto pointsB = PointsOf(b, tips);
  struct Pair
  {
    double      distance;
    std::size_t a;
    std::size_t b;
    auto
    operator<=>(const Pair &) const = default;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < pointsA.size(); ++i)
  {
    const double reach = comparison.Tolerance(SectionRadii(a)[pointsA[i]]);
    for (std::size_t j = 0; j < pointsB.size(); ++j)
    {
      if (const double distance = Distance(a.positions[pointsA[i]], b.positions[pointsB[j]]); distance <= reach)
      {
        pairs.push_back({ distance, i, j });
      }
    }
  }
  ranges::sort(pairs);
  std::vector<double>       partnerOf(pointsA.size(), kUnknown);
  std::vector<double>       angles(pointsA.size(), kUnknown);
  std::vector<std::uint8_t> isTaken(pointsB.size(), 0);
  for (const Pair & pair : pairs)
  {
    if (std::isnan(partnerOf[pair.a]) && isTaken[pair.b] == 0)
    {
      partnerOf[pair.a] = pair.distance;
      isTaken[pair.b] = 1;
      const double far = kLeave * comparison.Tolerance(SectionRadii(a)[pointsA[pair.a]]);
      angles[pair.a] =
        tips ? kUnknown : AngleError(DirectionsFrom(a, pointsA[pair.a], far), DirectionsFrom(b, pointsB[pair.b], far));
    }
  }
  std::vector<PlaceMatch> places;
  for (std::size_t i = 0; i < pointsA.size(); ++i)
  {
    places.push_back({ a.positions[pointsA[i]],
                       SectionRadii(a)[pointsA[i]],
                       partnerOf[i],
                       angles[i],
                       true,
                       !std::isnan(partnerOf[i]) });
  }
  for (std::size_t j = 0; j < pointsB.size(); ++j)
  {
    if (isTaken[j] == 0)
    {
      places.push_back({ b.positions[pointsB[j]], SectionRadii(b)[pointsB[j]], kUnknown, kUnknown, false, true });
    }
  }
  return places;
}

} // namespace

bool
BranchMatch::IsFound() const
{
  return share >= kDetectedShare * (1 - kLengthRounding);
}

BranchTotals
TotalsOf(const std::vector<BranchMatch> & branches)
{
  BranchTotals totals;
  for (const BranchMatch & branch : branches)
  {
    ++totals.branches;
    totals.found += branch.IsFound() ? 1 : 0;
    totals.length += branch.length;
    totals.foundLength += branch.found;
  }
  return totals;
}

TreeComparison
CompareTrees(const SkeletonGraph & a, const SkeletonGraph & b, const TreeTolerance & tolerance)
{
  const double radiusA = MedianRadius(a);
  const double radiusB = MedianRadius(b);
  if (!a.positions.empty() && !(radiusA > 0) && !(tolerance.least > 0))
  {
    throw InputError("the reference has no radii, so nothing says how near is near; give --near, such as 1mm");
  }
  double step = std::numeric_limits<double>::infinity(); // where neither has a line, nothing is cut
  for (const double length : { radiusA, radiusB, radiusA > 0 ? 0 : tolerance.least })
  {
    step = length > 0 ? std::min(step, length) : step;
  }
  double longest = 0;
  for (const SkeletonGraph * graph : { &a, &b })
  {
    const auto isFar = [](const Vector3 & place) { return !(Length(place) <= kFarthest); };
    if (ranges::any_of(graph->positions, isFar))
    {
      throw InputError("a point is more than 1e15 mm from the origin; correct its coordinates");
    }
    double length = 0;
    for (std::size_t branch = 0; branch < graph->BranchCount(); ++branch)
    {
      length += graph->BranchLength(branch);
    }
    longest = std::max(longest, length);
  }
  const Comparison comparison(a, b, tolerance.least, std::max(step / kSteps, longest / kMostPlaces));
  TreeComparison   compared;
  compared.a = comparison.Branches(true);
  compared.b = comparison.Branches(false);
  compared.tips = MatchPlaces(a, b, true, comparison);
  compared.bifurcations = MatchPlaces(a, b, false, comparison);
  comparison.AddDistances(compared);
  comparison.AddRadii(compared);
  return compared;
}

} // namespace voxelcore
