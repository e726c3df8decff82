#include "PlaneContours.h"

#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace voxelcore
{

namespace
{

/** Corners of squares of a plane, those of one connected part marked. */
class PlaneGrid
{
public:
  explicit PlaneGrid(PlaneSides & sides)
    : m_Sides(&sides)
    , m_IsFilled(Places(), 0)
  {}

  /** Marks what hangs together with the corner nearest to the origin that is in, up to `astray` squares from it. False
   *  where none is. */
  bool
  Fill(std::int32_t astray)
  {
    const auto start = Start(astray);
    if (!start)
    {
      return false;
    }
    m_Filled.push_back(*start);
    m_IsFilled[Place(*start)] = 1;
    for (std::size_t next = 0; next < m_Filled.size(); ++next)
    {
      for (const Node & beside : Beside(m_Filled[next]))
      {
        if (std::abs(beside[0]) >= m_Half || std::abs(beside[1]) >= m_Half)
        {
          Grow();
        }
        if (!IsFilled(beside) && m_Sides->At(beside) > 0)
        {
          m_IsFilled[Place(beside)] = 1;
          m_Filled.push_back(beside);
        }
      }
    }
    return true;
  }

  /** Lines around what is marked. Between two of its corners across a square they do not pass. */
  std::vector<std::vector<Vector2>>
  Lines()
  {
    std::vector<Vector2>      points;
    std::vector<std::int64_t> pointOf(2 * Places(), -1); // by the corner at an edge's lower end, then its axis
    const auto                edge = [&](const Node & from, const Node & to) {
      const std::size_t axis = from[0] != to[0] ? 0 : 1;
      const Node &      lower = from[axis] < to[axis] ? from : to;
      return 2 * Place(lower) + axis;
    };
    // Around each corner anticlockwise: the line passes from the edge to an outer corner to the next such edge.
    std::vector<std::int64_t> next;
    const auto                pointOn = [&](const Node & in, const Node & out) {
      std::int64_t & point = pointOf[edge(in, out)];
      if (point < 0)
      {
        point = static_cast<std::int64_t>(points.size());
        points.push_back(Crossing(in, out));
        next.push_back(-1);
      }
      return static_cast<std::size_t>(point);
    };
    for (const Node & in : m_Filled)
    {
      for (const Node & way : kWays)
      {
        const Node out{ in[0] + way[0], in[1] + way[1] };
        if (IsFilled(out))
        {
          continue;
        }
        // The square to the left of the way out of the body is behind the line, as the body lies on its left.
        const Node  left{ -way[1], way[0] };
        const Node  inLeft{ in[0] + left[0], in[1] + left[1] };
        const Node  outLeft{ out[0] + left[0], out[1] + left[1] };
        const auto  here = pointOn(in, out);
        std::size_t there = 0;
        if (!IsFilled(inLeft))
        {
          there = pointOn(in, inLeft); // around the corner that is in
        }
        else if (!IsFilled(outLeft))
        {
          there = pointOn(inLeft, outLeft);
        }
        else
        {
          there = pointOn(outLeft, out);
        }
        next[here] = static_cast<std::int64_t>(there);
      }
    }
    std::vector<std::vector<Vector2>> lines;
    for (std::size_t first = 0; first < points.size(); ++first)
    {
      if (next[first] < 0)
      {
        continue;
      }
      lines.emplace_back();
      for (std::size_t at = first; next[at] >= 0;)
      {
        lines.back().push_back(points[at]);
        const auto to = static_cast<std::size_t>(next[at]);
        next[at] = -1;
        at = to;
      }
    }
    return lines;
  }

private:
  using Node = PlaneNode;
  static constexpr std::array<Node, 4> kWays{ Node{ 1, 0 }, Node{ 0, 1 }, Node{ -1, 0 }, Node{ 0, -1 } };

  std::size_t
  Places() const
  {
    const auto side = static_cast<std::size_t>(2 * m_Half + 1);
    return side * side;
  }

  std::size_t
  Place(const Node & node) const
  {
    const auto side = static_cast<std::size_t>(2 * m_Half + 1);
    return static_cast<std::size_t>(node[1] + m_Half) * side + static_cast<std::size_t>(node[0] + m_Half);
  }

  bool
  IsFilled(const Node & node) const
  {
    return m_IsFilled[Place(node)] != 0;
  }

  static std::array<Node, 4>
  Beside(const Node & node)
  {
    std::array<Node, 4> beside{};
    for (std::size_t k = 0; k < 4; ++k)
    {
      beside[k] = { node[0] + kWays[k][0], node[1] + kWays[k][1] };
    }
    return beside;
  }

  void
  Grow()
  {
    const std::vector<std::uint8_t> before = std::move(m_IsFilled);
    const std::int32_t              half = m_Half;
    const std::size_t               side = 2 * static_cast<std::size_t>(half) + 1;
    m_Half *= 2;
    m_IsFilled.assign(Places(), 0);
    for (std::int32_t y = -half; y <= half; ++y)
    {
      std::copy_n(before.begin() + static_cast<std::ptrdiff_t>(side) * (y + half),
                  side,
                  m_IsFilled.begin() + static_cast<std::ptrdiff_t>(Place({ -half, y })));
    }
  }

  std::optional<Node>
  Start(std::int32_t astray)
  {
    std::optional<Node> best;
    std::int32_t        bestSquare = astray * astray + 1;
    astray = std::min(astray, m_Half - 1);
    for (std::int32_t y = -astray; y <= astray; ++y)
    {
      for (std::int32_t x = -astray; x <= astray; ++x)
      {
        if (x * x + y * y < bestSquare && m_Sides->At({ x, y }) > 0)
        {
          best = { x, y };
          bestSquare = x * x + y * y;
        }
      }
    }
    return best;
  }

  /** Where the surface passes between two corners. */
  Vector2
  Crossing(const Node & in, const Node & out)
  {
    const double at = m_Sides->Crossing(in, out);
    return { in[0] + at * (out[0] - in[0]), in[1] + at * (out[1] - in[1]) };
  }

  PlaneSides *              m_Sides;
  std::int32_t              m_Half = 32;
  std::vector<std::uint8_t> m_IsFilled;
  std::vector<Node>         m_Filled;
};

double
Cross2(const Vector2 & a, const Vector2 & b)
{
  return a[0] * b[1] - a[1] * b[0];
}

Vector2
Minus2(const Vector2 & a, const Vector2 & b)
{
  return { a[0] - b[0], a[1] - b[1] };
}

double
Length2(const Vector2 & a)
{
  return std::sqrt(a[0] * a[0] + a[1] * a[1]);
}

/** Corners of the convex hull, anticlockwise (Andrew's monotone chain). */
std::vector<Vector2>
HullOf(std::vector<Vector2> points)
{
  ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3)
  {
    return points;
  }
  std::vector<Vector2> hull;
  const auto           add = [&](const Vector2 & point, std::size_t fixed) {
    while (hull.size() >= fixed + 2 &&
           Cross2(Minus2(hull.back(), hull[hull.size() - 2]), Minus2(point, hull.back())) <= 0)
    {
      hull.pop_back();
    }
    hull.push_back(point);
  };
  for (const Vector2 & point : points)
  {
    add(point, 0);
  }
  const std::size_t lower = hull.size() - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;)
  {
    add(points[i], lower);
  }
  hull.pop_back();
  return hull;
}

} // namespace

std::vector<std::vector<Vector2>>
PlaneContours(PlaneSides & sides, std::int32_t astray)
{
  PlaneGrid grid(sides);
  return grid.Fill(astray) ? grid.Lines() : std::vector<std::vector<Vector2>>();
}

OutlineNumbers
MeasureOutline(const std::vector<std::vector<Vector2>> & lines)
{
  OutlineNumbers       numbers;
  std::vector<Vector2> points;
  Vector2              moment{};
  for (const auto & line : lines)
  {
    for (std::size_t i = 0; i < line.size(); ++i)
    {
      const Vector2 & a = line[i];
      const Vector2 & b = line[i + 1 < line.size() ? i + 1 : 0];
      const double    twice = Cross2(a, b);
      numbers.area += 0.5 * twice;
      numbers.perimeter += Length2(Minus2(b, a));
      moment = { moment[0] + twice * (a[0] + b[0]) / 6, moment[1] + twice * (a[1] + b[1]) / 6 };
    }
    points.insert(points.end(), line.begin(), line.end());
  }
  if (numbers.area > 0)
  {
    numbers.centre = { moment[0] / numbers.area, moment[1] / numbers.area };
  }
  const std::vector<Vector2> hull = HullOf(std::move(points));
  numbers.leastWidth = HUGE_VAL;
  for (std::size_t i = 0; i < hull.size(); ++i)
  {
    const Vector2 side = Minus2(hull[i + 1 < hull.size() ? i + 1 : 0], hull[i]);
    const double  length = Length2(side);
    double        width = 0;
    for (const Vector2 & point : hull)
    {
      const Vector2 chord = Minus2(point, hull[i]);
      width = std::max(width, Cross2(side, chord) / length);
      if (Length2(chord) > numbers.greatestWidth)
      {
        numbers.greatestWidth = Length2(chord);
        numbers.greatestWay = { chord[0] / numbers.greatestWidth, chord[1] / numbers.greatestWidth };
      }
    }
    if (width < numbers.leastWidth)
    {
      numbers.leastWidth = width;
      numbers.leastWay = { -side[1] / length, side[0] / length };
    }
  }
  return numbers;
}

} // namespace voxelcore
