#include "voxelcore/Follow/RigidMotion.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Lattice/GreatestAxis.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Refinement/TriangleTree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

constexpr double kKept = 0.8; ///< share of the places that pull while a start is tried: a fifth may be lost

// Of each start few places are tried, the best starts then with many: a turn that is off by a radius at the far end
// shows in a hundred places, and the mean of some thousand is off by a hundredth of their noise.
constexpr double      kFewPlaces = 400;
constexpr double      kManyPlaces = 4000;
constexpr int         kFewSteps = 15;
constexpr int         kManySteps = 60;
constexpr std::size_t kBestStarts = 4;

constexpr std::size_t kNodesFrom = 40; ///< nodes that triangles are made of, the thickest, which stay longest
constexpr std::size_t kNodesTo = 120;  ///< and among which they are looked for: more, as there are new ones
constexpr std::size_t kThickest = 8;
constexpr std::size_t kStarts = 24;
constexpr double      kDamping = 1e-6; ///< of the mean curvature: where lines slide along themselves nothing moves

struct Place
{
  Vector3 at{};
  double  tolerance = 0;
};

/** Places along all branches, `count` or a few more, at equal distances. */
std::vector<Place>
PlacesOf(const SkeletonGraph & graph, double count, double least)
{
  const auto & radii = SectionRadii(graph);
  double       whole = 0;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    whole += graph.BranchLength(branch);
  }
  const double       step = whole / count;
  double             rest = step / 2; // to the next place
  std::vector<Place> places;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto points = graph.Branch(branch);
    for (std::size_t i = 1; i < points.size(); ++i)
    {
      const Vector3 & one = graph.positions[points[i - 1]];
      const Vector3   way = Minus(graph.positions[points[i]], one);
      const double    length = Length(way);
      double          at = rest;
      for (; at < length && step > 0; at += step)
      {
        const double share = at / length;
        const double radius = radii[points[i - 1]] + share * (radii[points[i]] - radii[points[i - 1]]);
        places.push_back({ AddScaled(one, share, way), std::max(radius, least) });
      }
      rest = at - length;
    }
  }
  return places;
}

/** The pieces of all branches. */
class Lines
{
public:
  explicit Lines(const SkeletonGraph & graph)
    : m_Graph(graph)
    , m_Tree(graph.positions, PiecesOf(graph, m_Pieces))
  {}

  struct Foot
  {
    Vector3 away{};  ///< from the place to its foot
    Vector3 along{}; ///< the line's direction there
  };
  Foot
  Nearest(const Vector3 & place) const
  {
    const auto found = m_Tree.FindNearest(place, std::numeric_limits<double>::infinity());
    const auto & [one, two] = m_Pieces[found.triangle];
    const Vector3 way = Minus(m_Graph.positions[two], m_Graph.positions[one]);
    const double  length = Length(way);
    return { Minus(found.point, place), AddScaled({}, length > 0 ? 1 / length : 0, way) };
  }

private:
  static std::vector<std::array<std::uint32_t, 3>>
  PiecesOf(const SkeletonGraph & graph, std::vector<std::array<std::uint32_t, 2>> & pieces)
  {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
    {
      const auto points = graph.Branch(branch);
      for (std::size_t i = 1; i < points.size(); ++i)
      {
        pieces.push_back({ points[i - 1], points[i] });
        triangles.push_back({ points[i - 1], points[i], points[i] });
      }
    }
    return triangles;
  }

  const SkeletonGraph &                     m_Graph;
  std::vector<std::array<std::uint32_t, 2>> m_Pieces;
  TriangleTree                              m_Tree;
};

RigidMotion
After(const RigidMotion & second, const RigidMotion & first)
{
  RigidMotion both;
  for (std::size_t row = 0; row < 3; ++row)
  {
    for (std::size_t column = 0; column < 3; ++column)
    {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k)
      {
        sum += second.rotation[3 * row + k] * first.rotation[3 * k + column];
      }
      both.rotation[3 * row + column] = sum;
    }
  }
  both.shift = second(first.shift);
  return both;
}

/** The turn about `centre` by the quaternion (1, turn / 2), made a unit, and then the shift. */
RigidMotion
SmallMotion(const Vector3 & turn, const Vector3 & shift, const Vector3 & centre)
{
  const double length = std::sqrt(1 + Dot(turn, turn) / 4);
  const double w = 1 / length;
  const double x = turn[0] / 2 / length;
  const double y = turn[1] / 2 / length;
  const double z = turn[2] / 2 / length;
  RigidMotion  motion;
  motion.rotation = { 1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
                      2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                      2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y) };
  motion.shift = AddScaled(Minus(centre, motion(centre)), 1, shift);
  return motion;
}

/** The rotation that brings one frame of unit vectors onto another, and its point onto the other's. */
RigidMotion
Between(const std::array<Vector3, 3> & from,
        const Vector3 &                at,
        const std::array<Vector3, 3> & to,
        const Vector3 &                goal)
{
  RigidMotion motion;
  for (std::size_t row = 0; row < 3; ++row)
  {
    for (std::size_t column = 0; column < 3; ++column)
    {
      motion.rotation[3 * row + column] =
        to[0][row] * from[0][column] + to[1][row] * from[1][column] + to[2][row] * from[2][column];
    }
  }
  motion.shift = Minus(goal, motion(at));
  return motion;
}

using Six = std::array<double, 6>;

/** Sums of squared distances across lines, as a quadratic form of a small turn about `centre` and a shift. Turns count
 *  by the way they move places at `size` from the centre. */
class Pull
{
public:
  Pull(const Vector3 & centre, double size)
    : m_Centre(centre)
    , m_Size(size)
  {}

  void
  Add(const Vector3 & place, const Lines::Foot & foot)
  {
    const auto rows = RowsOf(place);
    for (std::size_t i = 0; i < 6; ++i)
    {
      const Vector3 across = AddScaled(rows[i], -Dot(rows[i], foot.along), foot.along);
      m_Aim[i] += Dot(across, foot.away);
      for (std::size_t j = 0; j <= i; ++j)
      {
        m_Form[i][j] += Dot(across, rows[j]);
      }
    }
  }

  /** Factors the form, damped. */
  void
  Factor()
  {
    double mean = 0;
    for (std::size_t i = 0; i < 6; ++i)
    {
      mean += m_Form[i][i] / 6;
    }
    for (std::size_t i = 0; i < 6; ++i)
    {
      m_Form[i][i] += kDamping * mean + std::numeric_limits<double>::min();
      for (std::size_t j = 0; j <= i; ++j)
      {
        double sum = m_Form[i][j];
        for (std::size_t k = 0; k < j; ++k)
        {
          sum -= m_Form[i][k] * m_Form[j][k];
        }
        m_Form[i][j] = i == j ? std::sqrt(std::max(sum, std::numeric_limits<double>::min())) : sum / m_Form[j][j];
      }
    }
  }

  /** The motion that brings the places nearest. */
  RigidMotion
  Best() const
  {
    Six best = Halfway(m_Aim);
    for (std::size_t i = 6; i-- > 0;)
    {
      for (std::size_t k = i + 1; k < 6; ++k)
      {
        best[i] -= m_Form[k][i] * best[k];
      }
      best[i] /= m_Form[i][i];
    }
    const double perSize = 1 / m_Size;
    return SmallMotion({ perSize * best[0], perSize * best[1], perSize * best[2] },
                       { best[3], best[4], best[5] },
                       m_Centre);
  }

  /** The sum of the variances of a place's coordinates where each distance has variance 1. */
  double
  Variance(const Vector3 & place) const
  {
    const auto rows = RowsOf(place);
    double     sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      Six aim{};
      for (std::size_t i = 0; i < 6; ++i)
      {
        aim[i] = rows[i][k];
      }
      const Six half = Halfway(aim);
      sum += std::inner_product(half.begin(), half.end(), half.begin(), 0.0);
    }
    return sum;
  }

private:
  /** How the place moves by each of the six. */
  std::array<Vector3, 6>
  RowsOf(const Vector3 & place) const
  {
    const Vector3 arm = AddScaled({}, 1 / m_Size, Minus(place, m_Centre));
    return { Vector3{ 0, -arm[2], arm[1] },
             Vector3{ arm[2], 0, -arm[0] },
             Vector3{ -arm[1], arm[0], 0 },
             Vector3{ 1, 0, 0 },
             Vector3{ 0, 1, 0 },
             Vector3{ 0, 0, 1 } };
  }

  /** Through the lower factor. */
  Six
  Halfway(Six aim) const
  {
    for (std::size_t i = 0; i < 6; ++i)
    {
      for (std::size_t k = 0; k < i; ++k)
      {
        aim[i] -= m_Form[i][k] * aim[k];
      }
      aim[i] /= m_Form[i][i];
    }
    return aim;
  }

  Vector3            m_Centre;
  double             m_Size;
  std::array<Six, 6> m_Form{};
  Six                m_Aim{};
};

struct Cloud
{
  Vector3                centre{};
  std::array<Vector3, 3> axes{}; ///< by falling extent, right-handed
  double                 size = 0;
};

Cloud
CloudOf(const std::vector<Place> & places)
{
  Cloud        cloud;
  const double each = 1 / static_cast<double>(places.size());
  for (const Place & place : places)
  {
    cloud.centre = AddScaled(cloud.centre, each, place.at);
  }
  std::array<Vector3, 3> moments{};
  for (const Place & place : places)
  {
    const Vector3 arm = Minus(place.at, cloud.centre);
    for (std::size_t k = 0; k < 3; ++k)
    {
      moments[k] = AddScaled(moments[k], each * arm[k], arm);
    }
  }
  cloud.size = std::sqrt(moments[0][0] + moments[1][1] + moments[2][2]);
  double greatest = 0;
  cloud.axes[0] = GreatestAxis(moments, greatest);
  for (std::size_t k = 0; k < 3; ++k)
  {
    moments[k] = AddScaled(moments[k], -greatest * cloud.axes[0][k], cloud.axes[0]);
  }
  const Vector3 second = GreatestAxis(moments, greatest);
  const Vector3 across = AddScaled(second, -Dot(second, cloud.axes[0]), cloud.axes[0]);
  // Of one straight line all that is left is rounding.
  const Vector3 any = std::abs(cloud.axes[0][0]) < 0.6 ? Vector3{ 1, 0, 0 } : Vector3{ 0, 1, 0 };
  const Vector3 third = Cross(cloud.axes[0], Length(across) > 0.5 ? across : any);
  cloud.axes[2] = AddScaled({}, 1 / Length(third), third);
  cloud.axes[1] = Cross(cloud.axes[2], cloud.axes[0]);
  return cloud;
}

class Search
{
public:
  Search(const SkeletonGraph & from, const SkeletonGraph & to, double least)
    : m_From(from)
    , m_To(to)
    , m_Least(least)
    , m_Lines(to)
    , m_Few(PlacesOf(from, kFewPlaces, least))
    , m_Many(PlacesOf(from, kManyPlaces, least))
    , m_Cloud(CloudOf(m_Many))
  {}

  RigidMotion
  Find() const
  {
    std::vector<RigidMotion> starts{ {} };
    AddAxes(starts);
    AddTriangles(starts);
    using Scored = std::pair<double, RigidMotion>;
    std::vector<Scored> tried;
    for (const RigidMotion & start : starts)
    {
      const RigidMotion moved = Iterate(start, m_Few, kFewSteps, true);
      tried.emplace_back(Cost(moved, m_Few), moved);
    }
    ranges::stable_sort(tried, {}, &Scored::first);
    tried.resize(std::min(tried.size(), kBestStarts));
    for (auto & [cost, motion] : tried)
    {
      motion = Iterate(motion, m_Many, kManySteps, false);
      cost = Cost(motion, m_Many);
    }
    return ranges::min_element(tried, {}, &Scored::first)->second;
  }

  FoundMotion
  Measure(const RigidMotion & motion) const
  {
    FoundMotion result{ motion };
    double      squares = 0;
    double      count = 0;
    double      apart = 0;
    Pull        pull(motion(m_Cloud.centre), m_Cloud.size);
    for (const Place & place : m_Many)
    {
      const Vector3     at = motion(place.at);
      const Lines::Foot foot = m_Lines.Nearest(at);
      const double      squared = Dot(foot.away, foot.away);
      if (squared <= place.tolerance * place.tolerance)
      {
        pull.Add(at, foot);
        squares += squared;
        apart += 2 * place.tolerance;
        ++count;
      }
    }
    result.found = count / static_cast<double>(m_Many.size());
    result.rms = count > 0 ? std::sqrt(squares / count) : std::numeric_limits<double>::quiet_NaN();
    result.spread = std::numeric_limits<double>::infinity();
    if (count > 0)
    {
      pull.Factor();
      double     greatest = 0;
      const auto largest = [&](const Place & place) { greatest = std::max(greatest, pull.Variance(motion(place.at))); };
      ranges::for_each(m_Few, largest);
      double whole = 0;
      for (std::size_t branch = 0; branch < m_From.BranchCount(); ++branch)
      {
        whole += m_From.BranchLength(branch);
      }
      const double repeated = std::max(1.0, apart / (whole * result.found)); // places that count as one
      result.spread = std::sqrt(greatest * repeated / 2);                    // across a line are two directions
    }
    return result;
  }

private:
  /** Mean over the places of their squared distances, by their tolerances, at most 1 each. */
  double
  Cost(const RigidMotion & motion, const std::vector<Place> & places) const
  {
    double sum = 0;
    for (const Place & place : places)
    {
      const Lines::Foot foot = m_Lines.Nearest(motion(place.at));
      sum += std::min(1.0, Dot(foot.away, foot.away) / (place.tolerance * place.tolerance));
    }
    return sum / static_cast<double>(places.size());
  }

  /** Those within their tolerance pull, and, with `far`, the nearest kKept of all. */
  RigidMotion
  Iterate(RigidMotion motion, const std::vector<Place> & places, int steps, bool far) const
  {
    std::vector<Vector3>     at(places.size());
    std::vector<Lines::Foot> feet(places.size());
    std::vector<double>      squares(places.size());
    for (int step = 0; step < steps; ++step)
    {
      for (std::size_t i = 0; i < places.size(); ++i)
      {
        at[i] = motion(places[i].at);
        feet[i] = m_Lines.Nearest(at[i]);
        squares[i] = Dot(feet[i].away, feet[i].away);
      }
      double limit = 0;
      if (far)
      {
        std::vector<double> order = squares;
        const auto last = order.begin() + static_cast<std::ptrdiff_t>(kKept * static_cast<double>(order.size()));
        std::nth_element(order.begin(), last, order.end());
        limit = *last;
      }
      Pull pull(motion(m_Cloud.centre), m_Cloud.size);
      for (std::size_t i = 0; i < places.size(); ++i)
      {
        if (squares[i] <= std::max(limit, places[i].tolerance * places[i].tolerance))
        {
          pull.Add(at[i], feet[i]);
        }
      }
      pull.Factor();
      const RigidMotion more = pull.Best();
      motion = After(more, motion);
      const Vector3 far1 = motion(AddScaled(m_Cloud.centre, 2 * m_Cloud.size, m_Cloud.axes[0]));
      const Vector3 far2 = motion(AddScaled(m_Cloud.centre, 2 * m_Cloud.size, m_Cloud.axes[1]));
      if (Distance(more(far1), far1) + Distance(more(far2), far2) < 1e-9 * m_Cloud.size)
      {
        break;
      }
    }
    return motion;
  }

  void
  AddAxes(std::vector<RigidMotion> & starts) const
  {
    const Cloud goal = CloudOf(PlacesOf(m_To, kManyPlaces, m_Least));
    for (const double first : { 1.0, -1.0 })
    {
      for (const double second : { 1.0, -1.0 })
      {
        const auto & axes = goal.axes;
        starts.push_back(Between(
          m_Cloud.axes,
          m_Cloud.centre,
          { AddScaled({}, first, axes[0]), AddScaled({}, second, axes[1]), AddScaled({}, first * second, axes[2]) },
          goal.centre));
      }
    }
  }

  /** Junctions and, where there is place, tips; the thickest first. */
  static std::vector<Place>
  NodesOf(const SkeletonGraph & graph, std::size_t most, double least)
  {
    std::vector<Place> nodes;
    const auto         byRadius = [](const Place & a, const Place & b) { return a.tolerance > b.tolerance; };
    for (const bool tips : { false, true })
    {
      const auto begin = static_cast<std::ptrdiff_t>(nodes.size());
      for (std::size_t node = 0; node < graph.nodePoints.size(); ++node)
      {
        if ((graph.nodeKinds[node] == NodeKind::Junction) != tips)
        {
          const ElementIndex point = graph.nodePoints[node];
          nodes.push_back({ graph.positions[point], std::max(SectionRadii(graph)[point], least) });
        }
      }
      std::stable_sort(nodes.begin() + begin, nodes.end(), byRadius);
    }
    nodes.resize(std::min(nodes.size(), most));
    ranges::stable_sort(nodes, byRadius);
    return nodes;
  }

  static std::array<Vector3, 3>
  FrameOf(const Vector3 & a, const Vector3 & b, const Vector3 & c)
  {
    const Vector3 along = Minus(b, a);
    const Vector3 across = Cross(along, Minus(c, a));
    const Vector3 first = AddScaled({}, 1 / Length(along), along);
    const Vector3 third = AddScaled({}, 1 / Length(across), across);
    return { first, Cross(third, first), third };
  }

  /** Triangles of nodes that tell a rotation: of the thickest ones, which stay where they are, all, and of further ones
   *  the longest and widest. */
  static std::vector<std::array<std::size_t, 3>>
  TrianglesOf(const std::vector<Place> & nodes)
  {
    std::vector<std::array<std::size_t, 3>> triangles;
    for (std::size_t a = 0; a < std::min(nodes.size(), kThickest); ++a)
    {
      for (std::size_t b = 0; b < a; ++b)
      {
        for (std::size_t c = 0; c < b; ++c)
        {
          triangles.push_back({ a, b, c });
        }
      }
    }
    for (std::size_t a = 0; a < std::min(nodes.size(), kStarts); ++a)
    {
      const auto from = [&](const Place & node) { return Distance(node.at, nodes[a].at); };
      const auto b = static_cast<std::size_t>(ranges::max_element(nodes, {}, from) - nodes.begin());
      const auto beside = [&](const Place & node) { return Area(nodes[a], nodes[b], node); };
      triangles.push_back({ a, b, static_cast<std::size_t>(ranges::max_element(nodes, {}, beside) - nodes.begin()) });
    }
    // Too flat ones do not tell a turn about their longest side.
    std::erase_if(triangles, [&](const auto & t) {
      const auto & [a, b, c] = t;
      const double longest = std::max(
        { Distance(nodes[a].at, nodes[b].at), Distance(nodes[a].at, nodes[c].at), Distance(nodes[b].at, nodes[c].at) });
      return !(Area(nodes[a], nodes[b], nodes[c]) > 2 * ToleranceOf(nodes, t) * longest);
    });
    return triangles;
  }

  /** Twice that. */
  static double
  Area(const Place & a, const Place & b, const Place & c)
  {
    return Length(Cross(Minus(b.at, a.at), Minus(c.at, a.at)));
  }

  static double
  ToleranceOf(const std::vector<Place> & nodes, const std::array<std::size_t, 3> & triangle)
  {
    const auto & [a, b, c] = triangle;
    return std::max({ nodes[a].tolerance, nodes[b].tolerance, nodes[c].tolerance });
  }

  /** Starts from the triangles of nodes that occur in both; those that bring most nodes onto others. */
  void
  AddTriangles(std::vector<RigidMotion> & starts) const
  {
    const std::vector<Place> nodes = NodesOf(m_From, kNodesFrom, m_Least);
    const std::vector<Place> goals = NodesOf(m_To, kNodesTo, m_Least);
    using Scored = std::pair<std::int64_t, RigidMotion>;
    std::vector<Scored> found;
    for (const auto & triangle : TrianglesOf(nodes))
    {
      const auto & [a, b, c] = triangle;
      const double tolerance = ToleranceOf(nodes, triangle);
      const double sides[]{ Distance(nodes[a].at, nodes[b].at),
                            Distance(nodes[a].at, nodes[c].at),
                            Distance(nodes[b].at, nodes[c].at) };
      const auto   frame = FrameOf(nodes[a].at, nodes[b].at, nodes[c].at);
      const auto   isNear = [&](double one, double other) { return std::abs(one - other) <= 2 * tolerance; };
      for (std::size_t i = 0; i < goals.size(); ++i)
      {
        for (std::size_t j = 0; j < goals.size(); ++j)
        {
          if (!isNear(Distance(goals[i].at, goals[j].at), sides[0]))
          {
            continue;
          }
          for (const Place & third : goals)
          {
            if (isNear(Distance(goals[i].at, third.at), sides[1]) && isNear(Distance(goals[j].at, third.at), sides[2]))
            {
              const RigidMotion motion =
                Between(frame, nodes[a].at, FrameOf(goals[i].at, goals[j].at, third.at), goals[i].at);
              if (const std::int64_t hits = Hits(motion, nodes, goals); hits >= 3) // none where these three are in line
              {
                found.emplace_back(-hits, motion);
              }
            }
          }
        }
      }
    }
    ranges::stable_sort(found, {}, &Scored::first);
    for (std::size_t i = 0; i < std::min(found.size(), kStarts); ++i)
    {
      starts.push_back(found[i].second);
    }
  }

  static std::int64_t
  Hits(const RigidMotion & motion, const std::vector<Place> & nodes, const std::vector<Place> & goals)
  {
    return ranges::count_if(nodes, [&](const Place & node) {
      const Vector3 at = motion(node.at);
      return ranges::any_of(goals, [&](const Place & goal) { return Distance(goal.at, at) <= 2 * node.tolerance; });
    });
  }

  const SkeletonGraph & m_From;
  const SkeletonGraph & m_To;
  double                m_Least;
  Lines                 m_Lines;
  std::vector<Place>    m_Few;
  std::vector<Place>    m_Many;
  Cloud                 m_Cloud;
};

} // namespace

Vector3
RigidMotion::operator()(const Vector3 & place) const
{
  Vector3 moved = shift;
  for (std::size_t k = 0; k < 3; ++k)
  {
    moved[k] += Dot({ rotation[3 * k], rotation[3 * k + 1], rotation[3 * k + 2] }, place);
  }
  return moved;
}

RigidMotion
RigidMotion::Inverse() const
{
  RigidMotion back;
  for (std::size_t k = 0; k < 9; ++k)
  {
    back.rotation[k] = rotation[3 * (k % 3) + k / 3];
  }
  back.shift = Minus({}, back(shift));
  return back;
}

double
RigidMotion::Turn() const
{
  const auto &  r = rotation;
  const Vector3 twice{ r[7] - r[5], r[2] - r[6], r[3] - r[1] };
  return std::atan2(Length(twice), r[0] + r[4] + r[8] - 1) * (180 / 3.14159265358979323846);
}

FoundMotion
FindMotion(const SkeletonGraph & from, const SkeletonGraph & to, double least)
{
  const Search search(from, to, least);
  return search.Measure(search.Find());
}

FoundMotion
MeasureMotion(const SkeletonGraph & from, const SkeletonGraph & to, const RigidMotion & motion, double least)
{
  return Search(from, to, least).Measure(motion);
}

} // namespace voxelcore
