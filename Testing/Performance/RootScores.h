#pragma once
// The axes found in a root phantom against those it was grown along.

#include "../Uses/Roots/RootScore.h"

#include "voxelcore/Roots/RootTraits.h"

#include <map>

namespace voxelcore::testing
{

/** The truth in the form in which results come: its traits are measured as theirs are. */
struct TrueRoots
{
  SkeletonGraph graph;
  RootHierarchy roots; ///< an axis per branch of the phantom, with its number
  RootTraits    traits;
};

inline TrueRoots
TruthOf(const PhantomOptions & options)
{
  TrueRoots                truth;
  std::vector<std::size_t> within; // its branch
  const auto               lines = RootCentreLines(options);
  for (const CentreLinePoint & point : lines)
  {
    const auto number = static_cast<ElementIndex>(truth.graph.positions.size());
    truth.graph.positions.push_back(PlaceOf(options, point));
    truth.graph.radius.push_back(point.radius);
    if (static_cast<std::size_t>(point.branch) == truth.roots.axes.size())
    {
      RootAxis axis;
      axis.level = point.order;
      if (point.parent >= 0)
      {
        const auto before = static_cast<std::size_t>(point.parent);
        axis.parent = static_cast<ElementIndex>(lines[before].branch);
        axis.parentPoint = within[before];
        ++truth.roots.axes[axis.parent].children;
      }
      truth.roots.axes.push_back(axis);
    }
    RootAxis & axis = truth.roots.axes[static_cast<std::size_t>(point.branch)];
    within.push_back(axis.points.size());
    axis.points.push_back(number);
  }
  truth.traits = MeasureRoots(truth.graph, truth.roots);
  return truth;
}

struct RootScores
{
  std::size_t tips = 0; ///< true ones that can be found
  std::size_t missed = 0;
  std::size_t found = 0;
  std::size_t spurious = 0;
  double      trueLength = 0;
  double      length = 0;
  double      rightLevel = 0; ///< mm of `length`
  std::size_t undecided = 0;
  std::size_t contacts = 0; ///< in the phantom
  std::size_t angles = 0;   ///< roots whose emergence angle was compared
  double      angleError = 0;
  double      angleBias = 0; ///< sums over these, degrees
};

/** Positions of `graph` are mm from the corner of the phantom's grid. */
inline RootScores
ScoreRoots(const PhantomOptions & options, const SkeletonGraph & graph, const RootHierarchy & roots)
{
  RootScores                         score;
  const std::vector<CentreLinePoint> lines = RootCentreLines(options);
  std::vector<Spacing3>              places;
  for (const CentreLinePoint & point : lines)
  {
    places.push_back(PlaceOf(options, point));
    if (point.parent >= 0)
    {
      score.trueLength += Distance(places.back(), places[static_cast<std::size_t>(point.parent)]);
    }
  }
  const double          slice = std::max({ options.spacing[0], options.spacing[1], options.spacing[2] });
  std::vector<Spacing3> ends;
  for (const RootAxis & axis : roots.axes)
  {
    if (axis.parent == kNoRoot)
    {
      ends.push_back(graph.positions[axis.points.front()]);
    }
    if (!axis.endsAtContact)
    {
      ends.push_back(graph.positions[axis.points.back()]);
    }
    for (std::size_t i = 1; i < axis.points.size(); ++i)
    {
      const Spacing3 & a = graph.positions[axis.points[i - 1]];
      const Spacing3 & b = graph.positions[axis.points[i]];
      const Spacing3   middle{ (a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2 };
      // On the centre line of a lateral's first piece within its parent both lie near: any level there is right.
      double       nearest = std::numeric_limits<double>::infinity();
      const double step = Distance(a, b);
      for (const Spacing3 & place : places)
      {
        nearest = std::min(nearest, Distance(place, middle));
      }
      bool right = false;
      for (std::size_t k = 0; k < places.size() && !right; ++k)
      {
        right = lines[k].order == axis.level && Distance(places[k], middle) <= nearest + 0.5 * slice;
      }
      score.length += step;
      score.rightLevel += right ? step : 0;
    }
  }
  std::vector<std::uint8_t> used(ends.size(), 0);
  for (const Tip & tip : TrueTips(options))
  {
    std::size_t nearest = 0;
    for (std::size_t end = 1; end < ends.size(); ++end)
    {
      nearest = Distance(ends[end], tip.position) < Distance(ends[nearest], tip.position) ? end : nearest;
    }
    const bool isFound = !ends.empty() && Distance(ends[nearest], tip.position) <= tip.radius + 3 * slice;
    if (isFound)
    {
      used[nearest] = 1;
    }
    score.tips += tip.expected ? 1 : 0;
    score.missed += tip.expected && !isFound ? 1 : 0;
  }
  score.found = ends.size();
  score.spurious = static_cast<std::size_t>(std::count(used.begin(), used.end(), std::uint8_t{ 0 }));
  for (const RootMeeting & meeting : roots.meetings)
  {
    score.undecided += meeting.undecided ? 1 : 0;
  }
  score.contacts = RootContacts(options).size();
  return score;
}

/** Adds how far the emergence angles of laterals are from those of the branches they follow for most of their
 *  length. */
inline void
CompareAngles(const PhantomOptions & options,
              const SkeletonGraph &  graph,
              const RootHierarchy &  roots,
              const RootTraits &     traits,
              RootScores &           score)
{
  const TrueRoots                    truth = TruthOf(options);
  const std::vector<CentreLinePoint> lines = RootCentreLines(options);
  for (std::size_t axis = 0; axis < roots.axes.size(); ++axis)
  {
    std::map<std::int32_t, int> followed;
    for (const ElementIndex point : roots.axes[axis].points)
    {
      std::size_t nearest = 0;
      for (std::size_t k = 1; k < lines.size(); ++k)
      {
        nearest = Distance(truth.graph.positions[k], graph.positions[point]) <
                      Distance(truth.graph.positions[nearest], graph.positions[point])
                    ? k
                    : nearest;
      }
      ++followed[lines[nearest].branch];
    }
    const auto   most = std::max_element(followed.begin(), followed.end(), [](const auto & a, const auto & b) {
      return a.second < b.second;
    });
    const auto   branch = static_cast<std::size_t>(most->first);
    const double found = traits.roots[axis].emergenceAngle;
    const double expected = truth.traits.roots[branch].emergenceAngle;
    if (truth.roots.axes[branch].level == roots.axes[axis].level && std::isfinite(found) && std::isfinite(expected) &&
        traits.roots[axis].length > 0.5 * truth.traits.roots[branch].length)
    {
      ++score.angles;
      score.angleError += std::abs(found - expected);
      score.angleBias += found - expected;
    }
  }
}

} // namespace voxelcore::testing
