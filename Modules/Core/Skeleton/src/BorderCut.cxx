#include "voxelcore/Skeleton/BorderCut.h"

#include "GraphLines.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Shape/ShapeOperations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace voxelcore
{

namespace
{

class BorderCutting
{
public:
  BorderCutting(SkeletonGraph & graph, const VoxelBox & scan, const ImageGeometry & geometry, BorderEnds ends)
    : m_Graph(graph)
    , m_Geometry(geometry)
    , m_Lines(LinesOf(graph))
    , m_Ends(graph.positions.size(), 0)
    , m_Kept(graph.positions.size(), 0)
  {
    const double inset = ends == BorderEnds::Overlap ? 0.5 : 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const bool isFlat = scan.size[axis] < 2; // has no border along the axis
      m_Low[axis] = isFlat ? -std::numeric_limits<double>::infinity() : scan.lower[axis] + inset;
      m_High[axis] = isFlat ? std::numeric_limits<double>::infinity() : scan.lower[axis] + scan.size[axis] - inset;
    }
    for (const auto & line : m_Lines)
    {
      ++m_Ends[line.front()];
      ++m_Ends[line.back()];
    }
    for (const ElementIndex point : graph.faceVertices)
    {
      m_Kept[point] = 1; // and is no tip
    }
    for (std::size_t node = 0; node < graph.nodePoints.size(); ++node)
    {
      if (graph.nodeKinds[node] == NodeKind::Isolated)
      {
        m_Kept[graph.nodePoints[node]] = 1;
      }
    }
  }

  void
  TakeOff()
  {
    bool goesOn = true;
    while (goesOn)
    {
      goesOn = false;
      for (auto & line : m_Lines)
      {
        for (const bool fromBack : { false, true })
        {
          goesOn = TakeOffFrom(line, fromBack) || goesOn;
        }
      }
    }
    std::erase_if(m_Lines, [](const auto & line) { return line.empty(); });
    for (const auto & line : m_Lines)
    {
      for (const ElementIndex point : line)
      {
        m_Kept[point] = 1;
      }
    }
    KeepPoints(m_Graph, m_Lines, m_Kept);
  }

  /** What was added may lead on obliquely: a place that is none of the body, pushed back, goes to the centre of the
   *  nearest section. */
  void
  PushBack(const std::vector<BorderSection> & sections, const VoxelShape & voxels)
  {
    for (std::vector<Vector3> * places : { &m_Graph.positions, &m_Graph.medial })
    {
      for (Vector3 & place : *places)
      {
        const Vector3 lattice = PhysicalToLattice(m_Geometry, place);
        if (Beyond(lattice) > kInPlane)
        {
          const Vector3 back = Within(lattice);
          place = LatticeToPhysical(
            m_Geometry,
            sections.empty() || ContainsInside(voxels, back) ? back : NearestCentre(back, sections, voxels));
        }
      }
    }
    SortBranches(m_Graph, m_Lines, true);
  }

  /** The tips, or else other points, in each section's layer: pairs of the nearest first. */
  void
  PutIntoCentres(const std::vector<BorderSection> & sections, const VoxelShape & voxels)
  {
    std::vector<std::uint8_t> isTip(m_Graph.positions.size(), 0);
    for (const ElementIndex point : Tips())
    {
      isTip[point] = 1;
    }
    using Pair = std::tuple<bool, double, std::size_t, ElementIndex>;
    std::vector<Pair> pairs;
    for (ElementIndex point = 0; point < m_Graph.positions.size(); ++point)
    {
      const Vector3 lattice = PhysicalToLattice(m_Geometry, m_Graph.positions[point]);
      for (std::size_t i = 0; i < sections.size(); ++i)
      {
        const BorderSection & section = sections[i];
        const double away = Distance(Times(lattice, m_Geometry.spacing), Times(section.centre, m_Geometry.spacing));
        if (std::abs(lattice[section.axis] - section.centre[section.axis]) < kInPlane && away <= section.reach)
        {
          pairs.emplace_back(isTip[point] == 0, away, i, point);
        }
      }
    }
    std::sort(pairs.begin(), pairs.end());
    std::vector<std::uint8_t> served(sections.size(), 0);
    std::vector<std::uint8_t> taken(m_Graph.positions.size(), 0);
    for (const auto & [isNoTip, away, section, point] : pairs)
    {
      if (served[section] == 0 && taken[point] == 0)
      {
        m_Graph.positions[point] = LatticeToPhysical(m_Geometry, sections[section].centre);
        served[section] = 1;
        taken[point] = 1;
      }
    }
    std::vector<VoxelShape> components;
    for (std::size_t i = 0; i < sections.size(); ++i)
    {
      if (served[i] == 0)
      {
        components = components.empty() ? SplitComponents(voxels) : std::move(components);
        LeadTo(sections[i], components);
      }
    }
    SortBranches(m_Graph, m_Lines, true);
  }

  std::size_t
  TipsInBorder() const
  {
    const std::vector<ElementIndex> tips = Tips();
    return static_cast<std::size_t>(std::count_if(tips.begin(), tips.end(), [&](ElementIndex tip) {
      const Vector3 lattice = PhysicalToLattice(m_Geometry, m_Graph.positions[tip]);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        if (lattice[axis] < m_Low[axis] + kInPlane || lattice[axis] > m_High[axis] - kInPlane)
        {
          return true;
        }
      }
      return false;
    }));
  }

private:
  /** Places that differ by less, in voxels, are in one plane: rounding is far less. */
  static constexpr double kInPlane = 1e-6;

  /** In the border's plane, of sections that are cut if there are any. Where what was added leads on so obliquely that
   *  the plane's place is none of the body, the section's own, half a voxel within. */
  Vector3
  NearestCentre(const Vector3 & lattice, const std::vector<BorderSection> & sections, const VoxelShape & voxels) const
  {
    const auto inPlane = [&](const BorderSection & section) {
      Vector3 centre = section.centre;
      centre[section.axis] = section.isUpper ? m_High[section.axis] : m_Low[section.axis];
      return centre;
    };
    const auto key = [&](const BorderSection & section) {
      const double away = Distance(Times(lattice, m_Geometry.spacing), Times(inPlane(section), m_Geometry.spacing));
      return std::pair(!section.isCut, away);
    };
    const BorderSection & nearest = *ranges::min_element(sections, {}, key);
    return ContainsInside(voxels, inPlane(nearest)) ? inPlane(nearest) : nearest.centre;
  }

  /** Adds a branch to a section's centre, from the point that is nearest to it in its component. */
  void
  LeadTo(const BorderSection & section, const std::vector<VoxelShape> & components)
  {
    const auto holds = [](const VoxelShape & component, const Vector3 & lattice) {
      // Of places on the faces of voxels any voxel beside them counts.
      for (int corner = 0; corner < 8; ++corner)
      {
        const auto at = [&](std::size_t axis) {
          return static_cast<std::int32_t>(
            std::floor(lattice[axis] + ((corner >> axis & 1) != 0 ? kInPlane : -kInPlane)));
        };
        if (component.Contains(at(0), at(1), at(2)))
        {
          return true;
        }
      }
      return false;
    };
    const auto component =
      ranges::find_if(components, [&](const VoxelShape & one) { return holds(one, section.centre); });
    const Vector3 centre = LatticeToPhysical(m_Geometry, section.centre);
    ElementIndex  nearest = 0;
    bool          isWithin = false;
    double        least = std::numeric_limits<double>::infinity();
    for (ElementIndex point = 0; point < m_Graph.positions.size(); ++point)
    {
      const Vector3 & place = m_Graph.positions[point];
      const bool      here = component != components.end() && holds(*component, PhysicalToLattice(m_Geometry, place));
      const double    away = Distance(place, centre);
      if ((here && !isWithin) || (here == isWithin && away < least))
      {
        nearest = point;
        isWithin = here;
        least = away;
      }
    }
    const ElementIndex end = CopyPoint(m_Graph, nearest);
    m_Graph.positions[end] = centre;
    m_Graph.radius[end] = section.radius;
    if (!m_Graph.medial.empty())
    {
      m_Graph.medial[end] = centre;
    }
    if (!m_Graph.sectionRadius.empty())
    {
      m_Graph.sectionRadius[end] = section.radius;
    }
    SplitAt(nearest);
    m_Lines.push_back({ nearest, end });
  }

  /** Makes a point within a branch the end of two. */
  void
  SplitAt(ElementIndex point)
  {
    for (std::size_t line = 0; line < m_Lines.size(); ++line)
    {
      auto &     points = m_Lines[line];
      const auto at = std::find(points.begin() + 1, points.end() - 1, point);
      if (at != points.end() - 1)
      {
        std::vector<ElementIndex> rest(at, points.end());
        points.erase(at + 1, points.end());
        m_Lines.push_back(std::move(rest));
        return;
      }
    }
  }

  std::vector<ElementIndex>
  Tips() const
  {
    std::vector<ElementIndex> tips;
    for (std::size_t node = 0; node < m_Graph.nodePoints.size(); ++node)
    {
      if (m_Graph.nodeKinds[node] == NodeKind::Tip)
      {
        tips.push_back(m_Graph.nodePoints[node]);
      }
    }
    return tips;
  }

  Vector3
  Within(Vector3 lattice) const
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      lattice[axis] = std::clamp(lattice[axis], m_Low[axis], m_High[axis]);
    }
    return lattice;
  }

  /** How far a place lies outside, in voxels along the axis where it is farthest; not above 0 within. */
  double
  Beyond(const Vector3 & lattice) const
  {
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      most = std::max({ most, m_Low[axis] - lattice[axis], lattice[axis] - m_High[axis] });
    }
    return most;
  }

  double
  Beyond(ElementIndex point) const
  {
    return Beyond(PhysicalToLattice(m_Geometry, m_Graph.positions[point]));
  }

  /** Takes off what lies outside from a tip on. Whether another branch may have got a tip by that. */
  bool
  TakeOffFrom(std::vector<ElementIndex> & line, bool fromBack)
  {
    const auto isTip = [this](ElementIndex point) { return m_Ends[point] == 1 && m_Kept[point] == 0; };
    if (line.empty() || !isTip(fromBack ? line.back() : line.front()))
    {
      return false;
    }
    if (fromBack)
    {
      std::reverse(line.begin(), line.end());
    }
    const auto isInside = [this](ElementIndex point) { return Beyond(point) <= 0; };
    const auto first = std::find_if(line.begin(), line.end(), isInside);
    bool       another = false;
    if (first == line.end())
    {
      TakeAway(line);
      another = true;
    }
    else if (first != line.begin())
    {
      // The place where it crosses the border is the end.
      const ElementIndex inside = *first;
      const ElementIndex outside = *(first - 1);
      --m_Ends[line.front()];
      line.erase(line.begin(), first - 1);
      ++m_Ends[outside];
      MoveTowards(outside, inside);
    }
    if (fromBack)
    {
      std::reverse(line.begin(), line.end());
    }
    return another;
  }

  /** A branch that is outside, but for what hangs on its other end. Of a component that is all outside one point
   *  stays. */
  void
  TakeAway(std::vector<ElementIndex> & line)
  {
    const ElementIndex base = line.back();
    --m_Ends[line.front()];
    --m_Ends[base];
    if (m_Ends[base] == 0 && m_Kept[base] == 0)
    {
      const auto nearest = std::min_element(line.begin(), line.end(), [&](ElementIndex a, ElementIndex b) {
        return Beyond(a) < Beyond(b);
      });
      m_Kept[*nearest] = 1;
    }
    line.clear();
  }

  /** Puts a point outside into the border, on the way to one inside. */
  void
  MoveTowards(ElementIndex outside, ElementIndex inside)
  {
    const Vector3 from = PhysicalToLattice(m_Geometry, m_Graph.positions[outside]);
    const Vector3 to = PhysicalToLattice(m_Geometry, m_Graph.positions[inside]);
    double        part = 0; // of the way to the point inside
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double plane = from[axis] < m_Low[axis] ? m_Low[axis] : m_High[axis];
      if (from[axis] < m_Low[axis] || from[axis] > m_High[axis])
      {
        part = std::max(part, (plane - from[axis]) / (to[axis] - from[axis]));
      }
    }
    const auto move = [&](auto & values) {
      if (!values.empty())
      {
        values[outside] += part * (values[inside] - values[outside]);
      }
    };
    move(m_Graph.radius);
    move(m_Graph.sectionRadius);
    if (std::isfinite(m_Graph.erosionThickness[inside]) && std::isfinite(m_Graph.erosionThickness[outside]))
    {
      move(m_Graph.erosionThickness);
    }
    if (!m_Graph.medial.empty())
    {
      m_Graph.medial[outside] =
        AddScaled(m_Graph.medial[outside], part, Minus(m_Graph.medial[inside], m_Graph.medial[outside]));
    }
    m_Graph.positions[outside] = LatticeToPhysical(m_Geometry, Within(AddScaled(from, part, Minus(to, from))));
  }

  SkeletonGraph &            m_Graph;
  const ImageGeometry &      m_Geometry;
  Vector3                    m_Low{}; ///< of the scan, lattice coordinates
  Vector3                    m_High{};
  GraphLines                 m_Lines;
  std::vector<std::uint32_t> m_Ends; ///< of branches, per point
  std::vector<std::uint8_t>  m_Kept; ///< points on faces, and by themselves
};

} // namespace

std::size_t
CutAtBorder(SkeletonGraph &                    graph,
            const VoxelShape &                 voxels,
            const VoxelBox &                   scan,
            const ImageGeometry &              geometry,
            BorderEnds                         ends,
            const std::vector<BorderSection> & sections)
{
  BorderCutting cutting(graph, scan, geometry, ends);
  cutting.TakeOff();
  cutting.PushBack(sections, voxels);
  if (ends == BorderEnds::Overlap)
  {
    cutting.PutIntoCentres(sections, voxels);
  }
  return cutting.TipsInBorder();
}

} // namespace voxelcore
