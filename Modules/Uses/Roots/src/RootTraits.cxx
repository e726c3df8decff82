#include "voxelcore/Roots/RootTraits.h"

#include "HullSize.h"
#include "MeanOfKnown.h"
#include "RootLevels.h"
#include "RootSteps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore
{

namespace
{

constexpr double      kNotKnown = std::numeric_limits<double>::quiet_NaN();
constexpr double      kPi = 3.14159265358979323846;
constexpr std::size_t kClasses = 20;

class Measurer
{
public:
  Measurer(const SkeletonGraph & graph, const RootHierarchy & roots)
    : m_Graph(graph)
    , m_Roots(roots)
    , m_Radii(SectionRadii(graph))
    , m_Down(AddScaled({ 0, 0, 0 }, -1, roots.up))
    , m_Ways(roots.axes.size())
    , m_First(roots.axes.size(), 0)
  {
    for (std::size_t axis = 0; axis < roots.axes.size(); ++axis)
    {
      const auto & points = roots.axes[axis].points;
      m_Ways[axis].assign(points.size(), 0);
      for (std::size_t i = 1; i < points.size(); ++i)
      {
        m_Ways[axis][i] = m_Ways[axis][i - 1] + Distance(Place(points[i - 1]), Place(points[i]));
      }
      if (roots.axes[axis].parent != kNoRoot)
      {
        const RootAxis &   parent = roots.axes[roots.axes[axis].parent];
        const ElementIndex origin = parent.points[roots.axes[axis].parentPoint];
        std::size_t &      first = m_First[axis];
        while (first + 2 < points.size() && Distance(Place(points[first]), Place(origin)) < m_Radii[origin])
        {
          ++first;
        }
      }
    }
  }

  RootTraits
  Measure(std::optional<double> soilDepth)
  {
    RootTraits traits;
    for (std::size_t axis = 0; axis < m_Roots.axes.size(); ++axis)
    {
      traits.roots.push_back(MeasureRoot(axis));
    }
    traits.levels = SumLevels(m_Roots, traits.roots);
    traits.balance = Balance(traits);
    MeasureStems(traits);
    MeasureExtent(traits);
    FillClasses(traits);
    traits.contacts = static_cast<std::int64_t>(m_Roots.meetings.size());
    traits.undecidedContacts = std::count_if(m_Roots.meetings.begin(),
                                             m_Roots.meetings.end(),
                                             [](const RootMeeting & m) { return m.undecided; });
    if (soilDepth)
    {
      CountAboveSoil(traits, *soilDepth);
    }
    return traits;
  }

private:
  const Vector3 &
  Place(ElementIndex point) const
  {
    return m_Graph.positions[point];
  }

  /** Below the base of the first stem. */
  double
  DepthOf(const Vector3 & place) const
  {
    return Dot(Minus(place, Place(m_Roots.axes.front().points.front())), m_Down);
  }

  /** Which way an axis runs at one of its points, over two of its diameters to each side. */
  Vector3
  DirectionAt(std::size_t axis, std::size_t at) const
  {
    const auto & points = m_Roots.axes[axis].points;
    const auto & way = m_Ways[axis];
    const double reach = 4 * m_Radii[points[at]];
    std::size_t  before = at;
    std::size_t  after = at;
    while (before > 0 && way[at] - way[before] < reach)
    {
      --before;
    }
    while (after + 1 < points.size() && way[after] - way[at] < reach)
    {
      ++after;
    }
    return Minus(Place(points[after]), Place(points[before]));
  }

  RootRecord
  MeasureRoot(std::size_t axis) const
  {
    const RootAxis &  root = m_Roots.axes[axis];
    const auto &      points = root.points;
    const auto &      way = m_Ways[axis];
    const std::size_t first = m_First[axis];
    RootRecord        record;
    record.base = Place(points[first]);
    record.tip = Place(points.back());
    record.length = way.back() - way[first];
    record.chord = Distance(record.base, record.tip);
    record.tortuosity = record.chord > 0 ? record.length / record.chord : kNotKnown;
    record.children = root.children;
    record.baseDepth = DepthOf(record.base);
    record.tipDepth = DepthOf(record.tip);
    record.minDiameter = 2 * m_Radii[points[first]];
    record.maxDiameter = record.minDiameter;
    MeanOfKnown diameter;
    for (std::size_t i = first + 1; i < points.size(); ++i)
    {
      const double a = m_Radii[points[i - 1]];
      const double b = m_Radii[points[i]];
      const double step = way[i] - way[i - 1];
      diameter.Add(a + b, step);
      record.minDiameter = std::min(record.minDiameter, 2 * b);
      record.maxDiameter = std::max(record.maxDiameter, 2 * b);
      record.volume += kPi / 3 * (a * a + a * b + b * b) * step;
      record.surface += kPi * (a + b) * std::sqrt(step * step + (a - b) * (a - b));
    }
    record.meanDiameter = record.length > 0 ? diameter.Value() : record.maxDiameter;
    // Its own direction begins behind the bend into its parent.
    const auto awayFromBase = [&](double diameters) {
      std::size_t at = first;
      while (at + 1 < points.size() && way[at] - way[first] < diameters * record.meanDiameter)
      {
        ++at;
      }
      return at;
    };
    const std::size_t near = awayFromBase(4);
    const std::size_t bend = awayFromBase(1) < near ? awayFromBase(1) : first;
    std::size_t       middle = first;
    while (middle + 1 < points.size() && way[middle] - way[first] < 0.5 * record.length)
    {
      ++middle;
    }
    const Vector3 start = Minus(Place(points[near]), Place(points[bend]));
    const Vector3 toMiddle = Minus(Place(points[middle]), record.base);
    const Vector3 toTip = Minus(record.tip, record.base);
    record.emergenceFromDown = AngleDegrees(m_Down, start);
    record.midpointFromDown = AngleDegrees(m_Down, toMiddle);
    record.tipFromDown = AngleDegrees(m_Down, toTip);
    record.emergenceAngle = record.midpointAngle = record.tipAngle = record.alongParent = kNotKnown;
    if (root.parent != kNoRoot)
    {
      const Vector3 parent = DirectionAt(root.parent, root.parentPoint);
      record.emergenceAngle = AngleDegrees(parent, start);
      record.midpointAngle = AngleDegrees(parent, toMiddle);
      record.tipAngle = AngleDegrees(parent, toTip);
      const auto & along = m_Ways[root.parent];
      record.alongParent = std::max(0.0, along[root.parentPoint] - along[m_First[root.parent]]);
    }
    return record;
  }

  RootBalance
  Balance(const RootTraits & traits) const
  {
    RootBalance balance;
    balance.bulges = m_Roots.bulges.length;
    balance.skeleton = balance.bulges;
    for (std::size_t axis = 0; axis < m_Ways.size(); ++axis)
    {
      balance.roots += traits.roots[axis].length;
      balance.within += m_Ways[axis][m_First[axis]];
      balance.bridged += m_Ways[axis].back();
    }
    double          once = 0; // on roots and on branches
    const RootSteps steps(m_Roots);
    for (ElementIndex branch = 0; branch < m_Graph.BranchCount(); ++branch)
    {
      const auto points = m_Graph.Branch(branch);
      balance.skeleton += m_Graph.BranchLength(branch);
      const LeftOut why = branch < m_Roots.leftOut.size() ? m_Roots.leftOut[branch] : LeftOut::No;
      for (std::size_t i = 1; i < points.size(); ++i)
      {
        const double length = Distance(Place(points[i - 1]), Place(points[i]));
        const auto   count = static_cast<double>(steps.Count(points[i - 1], points[i]));
        once += count > 0 ? length : 0;
        balance.shared += count > 1 ? (count - 1) * length : 0;
        balance.bridges += count == 0 && why == LeftOut::Bridge ? length : 0;
        balance.removed += count == 0 && why == LeftOut::Removed ? length : 0;
      }
    }
    balance.bridged -= once + balance.shared;
    return balance;
  }

  void
  MeasureStems(RootTraits & traits) const
  {
    MeanOfKnown diameter;
    for (std::size_t axis = 0; axis < traits.roots.size(); ++axis)
    {
      if (m_Roots.axes[axis].level == 0 && !m_Roots.axes[axis].loose)
      {
        ++traits.stems;
        traits.stemLength += traits.roots[axis].length;
        diameter.Add(traits.roots[axis].meanDiameter, traits.roots[axis].length);
      }
    }
    traits.stemDiameter = diameter.Value();
    traits.whorls = static_cast<std::int64_t>(m_Roots.whorls.size());
    MeanOfKnown between;
    for (std::size_t i = 1; i < m_Roots.whorls.size(); ++i)
    {
      if (m_Roots.whorls[i].stem == m_Roots.whorls[i - 1].stem)
      {
        between.Add(m_Roots.whorls[i].along - m_Roots.whorls[i - 1].along);
      }
    }
    traits.meanWhorlDistance = between.Value();
  }

  void
  MeasureExtent(RootTraits & traits) const
  {
    std::vector<Vector3> places;
    double               highest = std::numeric_limits<double>::infinity();
    double               deepest = -highest;
    for (const RootAxis & axis : m_Roots.axes)
    {
      for (const ElementIndex point : axis.points)
      {
        places.push_back(Place(point));
        highest = std::min(highest, DepthOf(places.back()));
        deepest = std::max(deepest, DepthOf(places.back()));
      }
    }
    if (places.empty())
    {
      return;
    }
    const HullSize hull = ConvexHullSize(places);
    traits.hullVolume = hull.volume;
    traits.hullSurface = hull.surface;
    traits.depth = deepest - highest;
    traits.width = WidthAcross(m_Down, places);
    std::vector<std::vector<Vector3>> slices(kClasses);
    const auto                        sliceOf = [&](const Vector3 & place) {
      const double part = traits.depth > 0 ? (DepthOf(place) - highest) / traits.depth : 0;
      return std::min(kClasses - 1, static_cast<std::size_t>(std::max(0.0, part) * kClasses));
    };
    traits.depths.resize(kClasses);
    for (std::size_t axis = 0; axis < m_Roots.axes.size(); ++axis)
    {
      const auto & points = m_Roots.axes[axis].points;
      for (std::size_t i = m_First[axis]; i < points.size(); ++i)
      {
        slices[sliceOf(Place(points[i]))].push_back(Place(points[i]));
        if (i > m_First[axis])
        {
          const Vector3 middle = AddScaled(Place(points[i]), 0.5, Minus(Place(points[i - 1]), Place(points[i])));
          traits.depths[sliceOf(middle)].length += m_Ways[axis][i] - m_Ways[axis][i - 1];
        }
      }
    }
    for (std::size_t slice = 0; slice < kClasses; ++slice)
    {
      traits.depths[slice].depth = highest + (static_cast<double>(slice) + 0.5) / kClasses * traits.depth;
      traits.depths[slice].width = WidthAcross(m_Down, slices[slice]);
    }
  }

  void
  FillClasses(RootTraits & traits) const
  {
    double greatest = 0;
    for (const RootRecord & root : traits.roots)
    {
      greatest = std::max(greatest, root.maxDiameter);
    }
    traits.diameters.resize(kClasses);
    for (std::size_t i = 0; i < kClasses; ++i)
    {
      traits.diameters[i].from = greatest * static_cast<double>(i) / kClasses;
      traits.diameters[i].to = greatest * static_cast<double>(i + 1) / kClasses;
    }
    for (std::size_t axis = 0; axis < m_Roots.axes.size(); ++axis)
    {
      const auto & points = m_Roots.axes[axis].points;
      for (std::size_t i = m_First[axis] + 1; i < points.size() && greatest > 0; ++i)
      {
        const double diameter = m_Radii[points[i - 1]] + m_Radii[points[i]];
        const auto   at = std::min(kClasses - 1, static_cast<std::size_t>(diameter / greatest * kClasses));
        traits.diameters[at].length += m_Ways[axis][i] - m_Ways[axis][i - 1];
      }
    }
  }

  void
  CountAboveSoil(RootTraits & traits, double soilDepth) const
  {
    traits.soilDepth = soilDepth;
    for (std::size_t axis = 0; axis < traits.roots.size(); ++axis)
    {
      if (m_Roots.axes[axis].level > 0)
      {
        ++(traits.roots[axis].baseDepth < soilDepth ? traits.rootsAboveSoil : traits.rootsBelowSoil);
      }
    }
    for (const RootWhorl & whorl : m_Roots.whorls)
    {
      ++(DepthOf(whorl.position) < soilDepth ? traits.whorlsAboveSoil : traits.whorlsBelowSoil);
    }
  }

  const SkeletonGraph &            m_Graph;
  const RootHierarchy &            m_Roots;
  const std::vector<double> &      m_Radii;
  Vector3                          m_Down;
  std::vector<std::vector<double>> m_Ways;  ///< per axis and point: mm from its first point
  std::vector<std::size_t>         m_First; ///< per axis: its first point outside the parent
};

} // namespace

void
WidenToBalls(SkeletonGraph & graph)
{
  if (graph.sectionRadius.empty())
  {
    return;
  }
  std::vector<double> excess(graph.radius.size());
  for (std::size_t point = 0; point < excess.size(); ++point)
  {
    excess[point] = graph.radius[point] - graph.sectionRadius[point];
  }
  const auto middle = excess.begin() + static_cast<std::ptrdiff_t>(excess.size() / 2);
  std::nth_element(excess.begin(), middle, excess.end());
  const double usual = std::max(0.0, *middle);
  for (std::size_t point = 0; point < excess.size(); ++point)
  {
    graph.sectionRadius[point] = std::max(graph.sectionRadius[point], graph.radius[point] - usual);
  }
}

RootTraits
MeasureRoots(const SkeletonGraph & graph, const RootHierarchy & roots, std::optional<double> soilDepth)
{
  return Measurer(graph, roots).Measure(soilDepth);
}

} // namespace voxelcore
