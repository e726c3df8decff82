#include "RootStrands.h"

#include "voxelcore/Skeleton/UnitVector.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>

namespace voxelcore
{

namespace
{

constexpr double      kApart = 0.75;    // of the sum of radii: nearer are no two roots
constexpr std::size_t kCurvePoints = 9; // within a contact

/** The square of the distance from a place to a segment, and where along it. */
std::pair<double, double>
ToSegment(const Vector3 & place, const Vector3 & a, const Vector3 & b)
{
  const Vector3 along = Minus(b, a);
  const Vector3 offset = Minus(place, a);
  const double  squared = Dot(along, along);
  const double  t = squared > 0 ? std::clamp(Dot(offset, along) / squared, 0.0, 1.0) : 0;
  const Vector3 away = AddScaled(offset, -t, along);
  return { Dot(away, away), t };
}

class StrandTracer
{
public:
  StrandTracer(const SkeletonGraph & graph, const RootHierarchy & roots)
    : m_Graph(graph)
    , m_Roots(roots)
    , m_Radii(SectionRadii(graph))
  {}

  std::vector<Strand>
  Trace(const RootMeeting & meeting) const
  {
    std::vector<Strand> strands = StrandsOf(meeting);
    MoveApart(strands);
    return strands;
  }

private:
  const Vector3 &
  Place(const RootAxis & axis, std::size_t i) const
  {
    return m_Graph.positions[axis.points[i]];
  }

  std::vector<Strand>
  StrandsOf(const RootMeeting & meeting) const
  {
    std::set<ElementIndex> axes;
    for (const ElementIndex arm : meeting.arms)
    {
      if (m_Roots.rootOf[arm] != kNoRoot)
      {
        axes.insert(m_Roots.rootOf[arm]);
      }
    }
    std::vector<Strand> strands;
    for (const ElementIndex number : axes)
    {
      const RootAxis &      axis = m_Roots.axes[number];
      std::optional<Strand> open;
      for (std::size_t i = 0; i < axis.points.size(); ++i)
      {
        const bool isIn = Distance(Place(axis, i), meeting.position) <= meeting.reach;
        if (isIn && !open)
        {
          open = Strand{ number, i, i, 0, {}, 0, 0 };
        }
        if (isIn)
        {
          open->last = i;
        }
        // One that is outside for less than the contact is wide has not left it.
        const bool isFar = open && WayBetween(axis, open->last, i) > meeting.reach;
        if (open && (isFar || i + 1 == axis.points.size()))
        {
          strands.push_back(*std::exchange(open, std::nullopt));
        }
      }
    }
    for (Strand & strand : strands)
    {
      TraceLine(meeting, strand);
    }
    return strands;
  }

  double
  WayBetween(const RootAxis & axis, std::size_t from, std::size_t to) const
  {
    double way = 0;
    for (std::size_t i = from; i < to; ++i)
    {
      way += Distance(Place(axis, i), Place(axis, i + 1));
    }
    return way;
  }

  /** The point outside the contact, some way along from its border. */
  std::size_t
  Outwards(const RootAxis & axis, std::size_t border, bool forward, double way) const
  {
    std::size_t at = border;
    double      gone = 0;
    while (gone < way && (forward ? at + 1 < axis.points.size() : at > 0))
    {
      const std::size_t next = forward ? at + 1 : at - 1;
      gone += Distance(Place(axis, at), Place(axis, next));
      at = next;
    }
    return at;
  }

  void
  TraceLine(const RootMeeting & meeting, Strand & strand) const
  {
    const RootAxis & axis = m_Roots.axes[strand.axis];
    const bool       comes = strand.first > 0;
    const bool       goes = strand.last + 1 < axis.points.size();
    // Radius and direction from the root outside.
    const double      least = std::min(m_Radii[axis.points[strand.first]], m_Radii[axis.points[strand.last]]);
    const std::size_t entry = comes ? strand.first - 1 : strand.first;
    const std::size_t exit = goes ? strand.last + 1 : strand.last;
    double            sum = 0;
    std::size_t       count = 0;
    const auto        count1 = [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i <= to; ++i, ++count)
      {
        sum += m_Radii[axis.points[i]];
      }
    };
    const std::size_t before = comes ? Outwards(axis, entry, false, 3 * least) : entry;
    const std::size_t after = goes ? Outwards(axis, exit, true, 3 * least) : exit;
    if (comes)
    {
      count1(before, entry);
    }
    if (goes)
    {
      count1(exit, after);
    }
    strand.radius = count > 0 ? sum / static_cast<double>(count) : least;
    const std::size_t start = comes ? Outwards(axis, entry, false, meeting.reach + 4 * strand.radius) : strand.first;
    const std::size_t end = goes ? Outwards(axis, exit, true, meeting.reach + 4 * strand.radius) : strand.last;
    if (comes && goes)
    {
      for (std::size_t i = start; i <= entry; ++i)
      {
        strand.line.push_back(Place(axis, i));
      }
      strand.curveFrom = strand.line.size();
      const double  chord = Distance(Place(axis, entry), Place(axis, exit));
      const Vector3 from = Direction(axis, before, entry, Minus(Place(axis, exit), Place(axis, entry)));
      const Vector3 to = Direction(axis, exit, after, Minus(Place(axis, exit), Place(axis, entry)));
      for (std::size_t k = 1; k <= kCurvePoints; ++k)
      {
        const double t = static_cast<double>(k) / (kCurvePoints + 1);
        const double s = 1 - t;
        Vector3      place{ 0, 0, 0 };
        place = AddScaled(place, s * s * (1 + 2 * t), Place(axis, entry));
        place = AddScaled(place, t * t * (1 + 2 * s), Place(axis, exit));
        place = AddScaled(place, t * s * s * chord, from);
        place = AddScaled(place, -t * t * s * chord, to);
        strand.line.push_back(place);
      }
      strand.curveTo = strand.line.size();
      for (std::size_t i = exit; i <= end; ++i)
      {
        strand.line.push_back(Place(axis, i));
      }
      return;
    }
    // One that ends in the contact is its own as far as its border; one that springs there does so from its parent on.
    const std::size_t to = !goes && comes ? entry : end;
    for (std::size_t i = start; i <= to; ++i)
    {
      strand.line.push_back(Place(axis, i));
    }
    strand.curveFrom = strand.curveTo = strand.line.size();
  }

  Vector3
  Direction(const RootAxis & axis, std::size_t from, std::size_t to, const Vector3 & otherwise) const
  {
    return Unit(from < to ? Minus(Place(axis, to), Place(axis, from)) : otherwise);
  }

  /** Two whose curves come too near to each other give way, the thinner more. */
  void
  MoveApart(std::vector<Strand> & strands) const
  {
    for (std::size_t i = 0; i < strands.size(); ++i)
    {
      for (std::size_t k = i + 1; k < strands.size(); ++k)
      {
        if (!AreKin(m_Roots, strands[i], strands[k]))
        {
          MovePairApart(strands[i], strands[k]);
        }
      }
    }
  }

  static void
  MovePairApart(Strand & a, Strand & b)
  {
    double  least = std::numeric_limits<double>::infinity();
    Vector3 away{ 0, 0, 0 };
    Vector3 alongA{ 0, 0, 0 };
    Vector3 alongB{ 0, 0, 0 };
    for (std::size_t i = a.curveFrom; i < a.curveTo; ++i)
    {
      for (std::size_t k = b.curveFrom; k < b.curveTo; ++k)
      {
        // A curve has lines before and behind it.
        const Vector3 segment = Minus(b.line[k + 1], b.line[k - 1]);
        const auto [squared, t] = ToSegment(a.line[i], b.line[k - 1], b.line[k + 1]);
        if (squared < least)
        {
          least = squared;
          away = Minus(a.line[i], AddScaled(b.line[k - 1], t, segment));
          alongA = Unit(Minus(a.line[i + 1], a.line[i - 1]));
          alongB = Unit(segment);
        }
      }
    }
    const double wanted = kApart * (a.radius + b.radius);
    const double apart = std::sqrt(least);
    if (!(apart < wanted))
    {
      return;
    }
    // Curves that cross lie over each other on the side on which their arms do.
    Vector3 direction = Unit(away);
    if (const Vector3 across = Cross(alongA, alongB); Length(across) > 0.3)
    {
      const Vector3 arms =
        Minus(AddScaled(a.line.front(), 1, a.line.back()), AddScaled(b.line.front(), 1, b.line.back()));
      direction = AddScaled({ 0, 0, 0 }, Dot(across, arms) < 0 ? -1 : 1, Unit(across));
    }
    const double lacking = wanted - Dot(away, direction);
    Bend(a, b.radius / (a.radius + b.radius) * lacking, direction);
    Bend(b, -a.radius / (a.radius + b.radius) * lacking, direction);
  }

  /** Moves the middle of a curve so far, its ends not at all. */
  static void
  Bend(Strand & strand, double by, const Vector3 & direction)
  {
    const auto count = static_cast<double>(strand.curveTo - strand.curveFrom + 1);
    for (std::size_t i = strand.curveFrom; i < strand.curveTo; ++i)
    {
      const double part = std::sin(3.14159265358979 * static_cast<double>(i - strand.curveFrom + 1) / count);
      strand.line[i] = AddScaled(strand.line[i], by * part, direction);
    }
  }

  const SkeletonGraph &       m_Graph;
  const RootHierarchy &       m_Roots;
  const std::vector<double> & m_Radii;
};

} // namespace

std::vector<Strand>
TraceStrands(const SkeletonGraph & graph, const RootHierarchy & roots, const RootMeeting & meeting)
{
  return StrandTracer(graph, roots).Trace(meeting);
}

bool
AreKin(const RootHierarchy & roots, const Strand & a, const Strand & b)
{
  const auto springs = [&roots](const Strand & child, const Strand & parent) {
    const RootAxis & axis = roots.axes[child.axis];
    return child.first == 0 && axis.parent == parent.axis && axis.parentPoint + 1 >= parent.first &&
           axis.parentPoint <= parent.last + 1;
  };
  return springs(a, b) || springs(b, a);
}

double
SquaredDistance(const Vector3 & place, std::span<const Vector3> line)
{
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
  {
    least = std::min(least, ToSegment(place, line[i], line[i + 1]).first);
  }
  return line.size() == 1 ? ToSegment(place, line[0], line[0]).first : least;
}

} // namespace voxelcore
