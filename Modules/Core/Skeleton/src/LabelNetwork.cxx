#include "voxelcore/Skeleton/LabelNetwork.h"

#include "GraphLines.h"
#include "LabelChoices.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Skeleton/OpenShape.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr std::size_t kNoContact = std::numeric_limits<std::size_t>::max();

/** A graph in lines, with a label for each point; at points with a mark labels meet. */
struct LabelledLines
{
  std::vector<Vector3>       positions;
  std::vector<double>        radius;
  std::vector<std::uint32_t> labels;
  std::vector<std::uint8_t>  marks;
  GraphLines                 lines;
};

/** Where labels meet. */
struct NetworkPlaces
{
  std::vector<std::vector<Vector3>> ofContacts;
  std::vector<NetworkGap>           gaps; ///< between labels that do not touch
};

/** A line seen from one of its ends. */
struct LineEnd
{
  std::size_t line;
  bool        isLast;
};

class NetworkCutter
{
public:
  NetworkCutter(SkeletonGraph &                   graph,
                const std::vector<LabelShape> &   labels,
                const std::vector<LabelContact> & contacts,
                const VoxelShape &                shape,
                const ImageGeometry &             geometry)
    : m_Graph(graph)
    , m_Labels(labels)
    , m_Contacts(contacts)
    , m_Geometry(geometry)
    , m_Inside(shape, geometry)
    , m_Diagonal(Length(geometry.spacing))
    , m_Shares(FindLabelShares(graph, labels, geometry))
  {
    LabelPairs touching;
    for (std::size_t contact = 0; contact < contacts.size(); ++contact)
    {
      const auto & two = contacts[contact].labels;
      touching.insert({ static_cast<std::uint32_t>(two[0]), static_cast<std::uint32_t>(two[1]) });
    }
    m_Now.positions = graph.positions;
    m_Now.radius = graph.radius;
    m_Now.labels = ChooseLabels(graph, m_Shares, touching, labels.size());
    m_Now.marks.assign(graph.positions.size(), 0);
    m_Now.lines = LinesOf(graph);
  }

  /** Brings contacts to junctions where that leaves fewer of them without a place of their own. */
  void
  BringToJunctions()
  {
    std::size_t faults = Faults(m_Now);
    const auto  take = [&](std::optional<LabelledLines> other) {
      const std::size_t left = other ? Faults(*other) : faults;
      if (left >= faults)
      {
        return false;
      }
      m_Now = std::move(*other);
      faults = left;
      return true;
    };
    for (bool changes = true; changes && faults > 0;)
    {
      changes = false;
      auto ends = EndsOf(m_Now);
      for (ElementIndex point = 0; point < ends.size(); ++point)
      {
        changes = (ends[point].size() >= 3 && take(Brought(m_Now, point, ends[point]))) || changes;
      }
      for (std::size_t line = 0; line < m_Now.lines.size(); ++line)
      {
        if (IsWithinBalls(line, ends))
        {
          const ElementIndex at = m_Now.lines[line].front();
          LabelledLines      drawn = DrawnTogether(m_Now, line);
          const auto         all = EndsOf(drawn)[at];
          if (take(Brought(drawn, at, all)))
          {
            ends = EndsOf(m_Now);
            changes = true;
          }
        }
      }
    }
  }

  NetworkPlaces
  Finish()
  {
    InsertContacts();
    DropIdleMarks();
    NetworkPlaces places = PlacesOf(m_Now);
    Write();
    return places;
  }

private:
  std::vector<std::vector<LineEnd>>
  EndsOf(const LabelledLines & lines) const
  {
    std::vector<std::vector<LineEnd>> ends(lines.positions.size());
    for (std::size_t line = 0; line < lines.lines.size(); ++line)
    {
      if (!lines.lines[line].empty())
      {
        ends[lines.lines[line].front()].push_back({ line, false });
        ends[lines.lines[line].back()].push_back({ line, true });
      }
    }
    return ends;
  }

  static ElementIndex
  PointFrom(const LabelledLines & lines, const LineEnd & end, std::size_t i)
  {
    const auto & line = lines.lines[end.line];
    return end.isLast ? line[line.size() - 1 - i] : line[i];
  }

  /** The contact of two labels nearest to a place, or none within `reach`. */
  std::size_t
  ContactAt(std::uint32_t a, std::uint32_t b, const Vector3 & place, double reach) const
  {
    std::size_t best = kNoContact;
    double      least = reach;
    for (std::size_t contact = 0; contact < m_Contacts.size(); ++contact)
    {
      if (m_Contacts[contact].labels[0] != std::min(a, b) || m_Contacts[contact].labels[1] != std::max(a, b))
      {
        continue;
      }
      const Vector3 at = PhysicalToLattice(m_Geometry, place);
      for (const auto & voxel : m_Contacts[contact].voxels)
      {
        const double away =
          Length(Times(Minus({ voxel[0] + 0.5, voxel[1] + 0.5, voxel[2] + 0.5 }, at), m_Geometry.spacing));
        if (away < least)
        {
          least = away;
          best = contact;
        }
      }
    }
    return best;
  }

  static std::size_t
  Count(const NetworkPlaces & places)
  {
    std::size_t count = places.gaps.size();
    for (const auto & one : places.ofContacts)
    {
      count += one.size();
    }
    return count;
  }

  /** Marks go where all that meets is of one label. */
  void
  DropIdleMarks()
  {
    const auto ends = EndsOf(m_Now);
    for (std::size_t point = 0; point < ends.size(); ++point)
    {
      std::set<std::uint32_t> labels;
      for (const LineEnd & end : ends[point])
      {
        const ElementIndex next = PointFrom(m_Now, end, 1);
        labels.insert(m_Now.labels[m_Now.marks[next] == 0 ? next : static_cast<ElementIndex>(point)]);
      }
      if (m_Now.marks[point] != 0 && labels.size() == 1)
      {
        m_Now.marks[point] = 0;
        m_Now.labels[point] = *labels.begin();
      }
    }
  }

  NetworkPlaces
  PlacesOf(const LabelledLines & lines) const
  {
    constexpr double everywhere = std::numeric_limits<double>::infinity();
    NetworkPlaces    places;
    places.ofContacts.resize(m_Contacts.size());
    const auto add = [&](std::uint32_t a, std::uint32_t b, const Vector3 & place, double reach) {
      const std::size_t contact = ContactAt(a, b, place, reach);
      if (contact != kNoContact)
      {
        places.ofContacts[contact].push_back(place);
      }
      else if (reach == everywhere)
      {
        places.gaps.push_back({ { m_Labels[std::min(a, b)].value, m_Labels[std::max(a, b)].value }, place });
      }
    };
    std::vector<std::set<std::uint32_t>> meeting(lines.positions.size());
    for (const auto & line : lines.lines)
    {
      for (std::size_t i = 1; i < line.size(); ++i)
      {
        const ElementIndex a = line[i - 1];
        const ElementIndex b = line[i];
        if (lines.marks[a] == 0 && lines.marks[b] == 0)
        {
          if (lines.labels[a] != lines.labels[b])
          {
            add(lines.labels[a],
                lines.labels[b],
                AddScaled(lines.positions[a], 0.5, Minus(lines.positions[b], lines.positions[a])),
                everywhere);
          }
          continue;
        }
        const std::uint32_t own = lines.labels[lines.marks[a] == 0 ? a : b];
        for (const ElementIndex point : { a, b })
        {
          if (lines.marks[point] != 0)
          {
            meeting[point].insert(own);
          }
        }
      }
    }
    for (std::size_t point = 0; point < meeting.size(); ++point)
    {
      const auto before = Count(places);
      for (const std::uint32_t a : meeting[point])
      {
        for (const std::uint32_t b : meeting[point])
        {
          if (a < b)
          {
            add(a,
                b,
                lines.positions[point],
                meeting[point].size() == 2 ? everywhere : lines.radius[point] + 2 * m_Diagonal);
          }
        }
      }
      if (meeting[point].size() > 2 && Count(places) == before) // no two of them touch near here
      {
        add(*meeting[point].begin(), *std::next(meeting[point].begin()), lines.positions[point], everywhere);
      }
    }
    return places;
  }

  /** Contacts without a place, further places of one contact, and labels without a line. */
  std::size_t
  Faults(const LabelledLines & lines) const
  {
    std::size_t faults = 0;
    for (const auto & places : PlacesOf(lines).ofContacts)
    {
      faults += places.empty() ? 1 : places.size() - 1;
    }
    std::vector<std::uint8_t> isThere(m_Labels.size(), 0);
    for (const auto & line : lines.lines)
    {
      for (const ElementIndex point : line)
      {
        isThere[lines.labels[point]] = isThere[lines.labels[point]] != 0 || lines.marks[point] == 0;
      }
    }
    // A label without a line is worse than any contact.
    faults += 1000 * static_cast<std::size_t>(std::count(isThere.begin(), isThere.end(), 0));
    return faults;
  }

  /** The last point of a line, from the ball of the junction at its end on, before which the label changes in there;
   *  0 where none does. */
  static std::size_t
  LastChange(const LabelledLines & lines, ElementIndex junction, const LineEnd & end)
  {
    std::size_t last = 0;
    for (std::size_t i = 1; i < lines.lines[end.line].size(); ++i)
    {
      const ElementIndex before = PointFrom(lines, end, i - 1);
      const ElementIndex point = PointFrom(lines, end, i);
      if (Distance(lines.positions[before], lines.positions[junction]) > lines.radius[junction] ||
          lines.marks[point] != 0)
      {
        break;
      }
      last = lines.labels[point] != lines.labels[before] ? i : last;
    }
    return last;
  }

  /** With all changes of label within the ball of a junction in the junction itself. None where there is none. */
  static std::optional<LabelledLines>
  Brought(const LabelledLines & from, ElementIndex junction, const std::vector<LineEnd> & ends)
  {
    if (ranges::none_of(ends, [&](const LineEnd & end) { return LastChange(from, junction, end) > 0; }))
    {
      return std::nullopt;
    }
    LabelledLines lines = from;
    for (const LineEnd & end : ends)
    {
      const std::size_t last = LastChange(lines, junction, end);
      for (std::size_t i = 1; i < last; ++i)
      {
        lines.labels[PointFrom(lines, end, i)] = lines.labels[PointFrom(lines, end, last)];
      }
    }
    lines.marks[junction] = 1;
    return lines;
  }

  /** Whether a line between two junctions lies in their balls. */
  bool
  IsWithinBalls(std::size_t line, const std::vector<std::vector<LineEnd>> & ends) const
  {
    const auto & points = m_Now.lines[line];
    if (points.empty() || points.front() == points.back() || ends[points.front()].size() < 3 ||
        ends[points.back()].size() < 3)
    {
      return false;
    }
    const auto isIn = [&](ElementIndex point, ElementIndex end) {
      return Distance(m_Now.positions[point], m_Now.positions[end]) <= m_Now.radius[end];
    };
    return std::all_of(points.begin(), points.end(), [&](ElementIndex point) {
      return isIn(point, points.front()) || isIn(point, points.back());
    });
  }

  Vector3
  PlaceBetween(const Vector3 & a, const Vector3 & b, double part) const
  {
    return m_Inside.Towards(a, AddScaled(a, part, Minus(b, a)));
  }

  /** With a line between two junctions drawn together into the first, which goes to its middle. */
  LabelledLines
  DrawnTogether(const LabelledLines & from, std::size_t line) const
  {
    const auto & points = from.lines[line];
    double       length = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
    {
      length += Distance(from.positions[points[i]], from.positions[points[i - 1]]);
    }
    LabelledLines      lines = from;
    const ElementIndex to = points.front();
    double             way = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
    {
      const double step = Distance(from.positions[points[i]], from.positions[points[i - 1]]);
      if (way + step >= 0.5 * length)
      {
        const double part = step > 0 ? (0.5 * length - way) / step : 0;
        lines.positions[to] = PlaceBetween(from.positions[points[i - 1]], from.positions[points[i]], part);
        break;
      }
      way += step;
    }
    lines.radius[to] = std::max(from.radius[points.front()], from.radius[points.back()]);
    lines.lines[line].clear();
    for (auto & other : lines.lines)
    {
      for (std::size_t i = 0; i < other.size(); ++i)
      {
        if (other[i] == points.back() && (i == 0 || i + 1 == other.size()))
        {
          other[i] = to;
        }
      }
    }
    return lines;
  }

  /** A point between two others of the graph; `part` of the way. */
  ElementIndex
  Insert(ElementIndex a, ElementIndex b, double part)
  {
    const auto point = static_cast<ElementIndex>(m_Now.positions.size());
    const auto add = [&](std::vector<double> & values) {
      if (!values.empty())
      {
        values.push_back(values[a] + part * (values[b] - values[a]));
      }
    };
    m_Now.positions.push_back(PlaceBetween(m_Now.positions[a], m_Now.positions[b], part));
    add(m_Now.radius);
    add(m_Graph.radius);
    add(m_Graph.sectionRadius);
    // Both may be infinite.
    m_Graph.erosionThickness.push_back(std::max(m_Graph.erosionThickness[a], m_Graph.erosionThickness[b]));
    if (!m_Graph.medial.empty())
    {
      m_Graph.medial.push_back(AddScaled(m_Graph.medial[a], part, Minus(m_Graph.medial[b], m_Graph.medial[a])));
    }
    m_Now.labels.push_back(m_Now.labels[part < 0.5 ? a : b]);
    m_Now.marks.push_back(0);
    return point;
  }

  /** How far from a to b the shares of their labels are equal. */
  double
  BorderBetween(ElementIndex a, ElementIndex b) const
  {
    constexpr double end = 0.1; // the contact is a point apart from both
    const auto       lead = [&](ElementIndex point) {
      return ShareOf(m_Shares[point], m_Now.labels[a]) - ShareOf(m_Shares[point], m_Now.labels[b]);
    };
    const double before = lead(a);
    const double behind = lead(b);
    return before > behind ? std::clamp(before / (before - behind), end, 1 - end) : 0.5;
  }

  /** A point at each change of label, and one in the middle of lines all of whose points are contacts. */
  void
  InsertContacts()
  {
    for (auto & line : m_Now.lines)
    {
      std::vector<ElementIndex> points;
      for (std::size_t i = 0; i < line.size(); ++i)
      {
        if (i > 0)
        {
          const ElementIndex a = line[i - 1];
          const ElementIndex b = line[i];
          const bool         isMarkedA = m_Now.marks[a] != 0;
          const bool         isMarkedB = m_Now.marks[b] != 0;
          if (isMarkedA && isMarkedB && line.size() == 2)
          {
            points.push_back(Insert(a, b, 0.5));
          }
          else if (!isMarkedA && !isMarkedB && m_Now.labels[a] != m_Now.labels[b])
          {
            points.push_back(Insert(a, b, BorderBetween(a, b)));
            m_Now.marks[points.back()] = 1;
          }
        }
        points.push_back(line[i]);
      }
      line = std::move(points);
    }
  }

  /** Into the graph: points that are left, and lines cut where labels meet. */
  void
  Write()
  {
    GraphLines cut;
    for (const auto & line : m_Now.lines)
    {
      for (std::size_t i = 0; i < line.size(); ++i)
      {
        if (i == 0 || (m_Now.marks[line[i]] != 0 && i + 1 < line.size()))
        {
          if (i > 0)
          {
            cut.back().push_back(line[i]);
          }
          cut.emplace_back();
        }
        cut.back().push_back(line[i]);
      }
    }
    m_Graph.positions = m_Now.positions;
    m_Graph.radius = m_Now.radius;
    m_Graph.contact = m_Now.marks;
    m_Graph.labels.clear();
    for (const std::uint32_t label : m_Now.labels)
    {
      m_Graph.labels.push_back(m_Labels[label].value);
    }
    KeepPointsOf(cut);
    SortBranches(m_Graph, cut, false);
  }

  /** Drops points of lines that were drawn together. */
  void
  KeepPointsOf(GraphLines & lines)
  {
    std::vector<std::uint8_t> keep(m_Graph.positions.size(), 1);
    for (const ElementIndex point : m_Graph.branchPoints)
    {
      keep[point] = 0;
    }
    for (const auto & line : lines)
    {
      for (const ElementIndex point : line)
      {
        keep[point] = 1;
      }
    }
    for (const ElementIndex point : m_Graph.faceVertices)
    {
      keep[point] = 1;
    }
    KeepPoints(m_Graph, lines, keep);
  }

  SkeletonGraph &                   m_Graph;
  const std::vector<LabelShape> &   m_Labels;
  const std::vector<LabelContact> & m_Contacts;
  const ImageGeometry &             m_Geometry;
  OpenShape                         m_Inside;
  double                            m_Diagonal;
  LabelShares                       m_Shares; ///< of the graph's own points
  LabelledLines                     m_Now;
};

} // namespace

SkeletonNetwork
CutAtLabels(SkeletonGraph &                 graph,
            const std::vector<LabelShape> & labels,
            const VoxelShape &              shape,
            const ImageGeometry &           geometry)
{
  const std::vector<LabelContact> contacts = FindLabelContacts(labels, geometry);
  NetworkCutter                   cutter(graph, labels, contacts, shape, geometry);
  cutter.BringToJunctions();
  NetworkPlaces   places = cutter.Finish();
  SkeletonNetwork network;
  const double    voxelMm3 = geometry.spacing[0] * geometry.spacing[1] * geometry.spacing[2];
  for (const LabelShape & label : labels)
  {
    network.labels.push_back({ label.value, label.name, label.voxels, static_cast<double>(label.voxels) * voxelMm3 });
  }
  for (std::size_t i = 0; i < contacts.size(); ++i)
  {
    const LabelContact & contact = contacts[i];
    network.contacts.push_back({ { labels[contact.labels[0]].value, labels[contact.labels[1]].value },
                                 contact.voxels.size(),
                                 contact.faces,
                                 contact.areaMm2,
                                 contact.centre,
                                 std::move(places.ofContacts[i]) });
  }
  network.gaps = std::move(places.gaps);
  return network;
}

} // namespace voxelcore
