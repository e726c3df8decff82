#include "voxelcore/DomeBranches.h"

#include "GraphLines.h"
#include "voxelcore/Vectors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace voxelcore
{

namespace
{

/** Of a line of points: its greatest ball, and where the ways there meet. */
struct Dome
{
  std::size_t before = 0;
  std::size_t greatest = 0;
  std::size_t behind = 0;
  Vector3     foot{};
  double      footRadius = 0; ///< mm
};

class DomeSearch
{
public:
  DomeSearch(const SkeletonGraph & graph, const OpenShape & inside, double standOut)
    : m_Graph(graph)
    , m_Inside(inside)
    , m_StandOut(standOut)
  {}

  /** Those of a line that have no point in common, the greatest first, then in the line's order. */
  std::vector<Dome>
  Of(const std::vector<ElementIndex> & line) const
  {
    std::vector<double> way(line.size(), 0);
    for (std::size_t i = 1; i < line.size(); ++i)
    {
      way[i] = way[i - 1] + Distance(Place(line, i), Place(line, i - 1));
    }
    std::vector<Dome> domes;
    for (std::size_t i = 1; i + 1 < line.size(); ++i)
    {
      if (IsGreatest(line, way, i))
      {
        if (const auto dome = At(line, way, i))
        {
          domes.push_back(*dome);
        }
      }
    }
    std::ranges::stable_sort(domes, std::ranges::greater(), [&](const Dome & dome) {
      return Radius(line, dome.greatest);
    });
    std::vector<Dome> apart;
    for (const Dome & dome : domes)
    {
      if (std::ranges::none_of(apart, [&](const Dome & other) {
            return dome.before <= other.behind && other.before <= dome.behind;
          }))
      {
        apart.push_back(dome);
      }
    }
    std::ranges::sort(apart, {}, &Dome::before);
    return apart;
  }

private:
  const Vector3 &
  Place(const std::vector<ElementIndex> & line, std::size_t at) const
  {
    return m_Graph.positions[line[at]];
  }

  double
  Radius(const std::vector<ElementIndex> & line, std::size_t at) const
  {
    return m_Graph.radius[line[at]];
  }

  /** Of the balls whose centres lie in it; the first of equals. */
  bool
  IsGreatest(const std::vector<ElementIndex> & line, const std::vector<double> & way, std::size_t at) const
  {
    const double radius = Radius(line, at);
    for (std::size_t i = at; i-- > 0 && way[at] - way[i] <= radius;)
    {
      if (Radius(line, i) >= radius)
      {
        return false;
      }
    }
    for (std::size_t i = at + 1; i < line.size() && way[i] - way[at] <= radius; ++i)
    {
      if (Radius(line, i) > radius)
      {
        return false;
      }
    }
    return true;
  }

  std::optional<Dome>
  At(const std::vector<ElementIndex> & line, const std::vector<double> & way, std::size_t greatest) const
  {
    Dome dome{ greatest, greatest, greatest };
    // Step by step as far from it on both sides.
    while (dome.before > 0 && dome.behind + 1 < line.size())
    {
      Dome next = dome;
      way[greatest] - way[dome.before - 1] < way[dome.behind + 1] - way[greatest] ? --next.before : ++next.behind;
      if (Distance(Place(line, next.before), Place(line, next.behind)) >
          std::min(Radius(line, next.before), Radius(line, next.behind)))
      {
        break;
      }
      dome = next;
    }
    if (dome.before == greatest || dome.behind == greatest)
    {
      return std::nullopt;
    }
    const Vector3 & before = Place(line, dome.before);
    const Vector3 & behind = Place(line, dome.behind);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      dome.foot[axis] = 0.5 * (before[axis] + behind[axis]);
    }
    const double radius = Radius(line, greatest);
    const double wayIn = Distance(dome.foot, Place(line, greatest));
    const double least = std::max(m_StandOut, kDomeOfRadius * radius);
    if (wayIn + radius < least || !m_Inside.Holds(dome.foot) || !m_Inside.HoldsSegment(dome.foot, before) ||
        !m_Inside.HoldsSegment(dome.foot, behind) || !m_Inside.HoldsSegment(dome.foot, Place(line, dome.before + 1)))
    {
      return std::nullopt;
    }
    // By so much balls of a refined surface differ from those of voxels.
    const double most = radius + wayIn;
    const double differs =
      Radius(line, dome.before) - m_Inside.DistanceToBoundary(before, 0, Radius(line, dome.before) + most);
    dome.footRadius = std::max(0.0, m_Inside.DistanceToBoundary(dome.foot, 0, most) + differs);
    if (radius <= dome.footRadius || wayIn + radius - dome.footRadius < least)
    {
      return std::nullopt;
    }
    return dome;
  }

  const SkeletonGraph & m_Graph;
  const OpenShape &     m_Inside;
  const double          m_StandOut; ///< mm
};

} // namespace

std::size_t
BranchIntoDomes(SkeletonGraph & graph, const OpenShape & inside, double standOut)
{
  std::size_t               count = 0;
  GraphLines                lines;
  std::vector<std::uint8_t> keep(graph.positions.size(), 1);
  const GraphLines          all = LinesOf(graph);
  for (const std::vector<ElementIndex> & line : all)
  {
    const std::vector<Dome>   domes = DomeSearch(graph, inside, standOut).Of(line);
    std::size_t               from = 0;
    std::vector<ElementIndex> begun;
    for (const Dome & dome : domes)
    {
      const ElementIndex foot = CopyPoint(graph, line[dome.before]);
      keep.push_back(1);
      graph.positions[foot] = dome.foot;
      graph.radius[foot] = dome.footRadius;
      if (!graph.medial.empty())
      {
        graph.medial[foot] = dome.foot;
      }
      begun.insert(begun.end(),
                   line.begin() + static_cast<std::ptrdiff_t>(from),
                   line.begin() + static_cast<std::ptrdiff_t>(dome.before + 1));
      begun.push_back(foot);
      lines.push_back(std::move(begun));
      std::vector<ElementIndex> into{ foot };
      into.insert(into.end(),
                  line.begin() + static_cast<std::ptrdiff_t>(dome.before + 1),
                  line.begin() + static_cast<std::ptrdiff_t>(dome.greatest + 1));
      lines.push_back(std::move(into));
      for (std::size_t i = dome.greatest + 1; i < dome.behind; ++i)
      {
        keep[line[i]] = 0;
      }
      begun = { foot };
      from = dome.behind;
      ++count;
    }
    begun.insert(begun.end(), line.begin() + static_cast<std::ptrdiff_t>(from), line.end());
    lines.push_back(std::move(begun));
  }
  if (count > 0)
  {
    KeepPoints(graph, lines, keep);
    SortBranches(graph, lines, false);
  }
  return count;
}

} // namespace voxelcore
