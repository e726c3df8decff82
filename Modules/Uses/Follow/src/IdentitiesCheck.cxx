#include "voxelcore/Follow/BranchIdentities.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr double kRounding = 1e-6; ///< of sums of many pieces, as a share

void
Require(bool holds, std::size_t day, const std::string & what)
{
  if (!holds)
  {
    throw CertificateError("follow: day " + std::to_string(day + 1) + ": " + what +
                           "; nothing is written; please report this as a fault");
  }
}

void
RequireRigid(const RigidMotion & motion, std::size_t day)
{
  const auto & r = motion.rotation;
  double       off = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t j = 0; j < 3; ++j)
    {
      const double product = r[i] * r[j] + r[3 + i] * r[3 + j] + r[6 + i] * r[6 + j];
      off = std::max(off, std::abs(product - (i == j ? 1 : 0)));
    }
  }
  const double determinant =
    r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6]) + r[2] * (r[3] * r[7] - r[4] * r[6]);
  Require(off < 1e-9 && std::abs(determinant - 1) < 1e-9, day, "the motion is not rigid");
}

/** Each piece of the skeleton on one branch, once, and their lengths. */
void
RequirePieces(const FollowedDay & day, std::size_t number)
{
  std::map<std::pair<ElementIndex, ElementIndex>, int> pieces;
  const auto                                           count = [&](std::span<const ElementIndex> points, int by) {
    for (std::size_t i = 1; i < points.size(); ++i)
    {
      pieces[std::minmax({ points[i - 1], points[i] })] += by;
    }
  };
  double whole = 0;
  double sum = 0;
  for (std::size_t branch = 0; branch < day.graph.BranchCount(); ++branch)
  {
    count(day.graph.Branch(branch), 1);
    whole += day.graph.BranchLength(branch);
  }
  for (const FollowedBranch & branch : day.branches)
  {
    count(branch.points, -1);
    sum += branch.length;
  }
  const bool isEach = ranges::all_of(pieces, [](const auto & piece) { return piece.second == 0; });
  Require(isEach, number, "a piece of the skeleton is not on one branch alone");
  Require(std::abs(sum - whole) <= kRounding * whole, number, "the branches' lengths do not sum up to the skeleton's");
}

void
RequireParents(const FollowedDay & day, std::size_t number)
{
  std::map<std::int64_t, const FollowedBranch *> byId;
  for (const FollowedBranch & branch : day.branches)
  {
    Require(byId.emplace(branch.id, &branch).second, number, "two branches have one number");
  }
  for (const FollowedBranch & branch : day.branches)
  {
    const std::string name = "branch " + std::to_string(branch.id);
    if (branch.parent == 0)
    {
      Require(branch.order == 0, number, name + " has an order without a parent");
      continue;
    }
    const auto parent = byId.find(branch.parent);
    Require(parent != byId.end(), number, name + " has a parent that is not there");
    Require(branch.order == parent->second->order + 1, number, name + " does not follow its parent's order");
    // On surfaces that stay lines meet without a point in common.
    const bool isOn = ranges::count(parent->second->points, branch.points.front()) > 0;
    Require(isOn || day.graph.FaceCount() > 0, number, name + " does not begin on its parent");
  }
}

/** Where a place is along a course, nearest of all pieces; -1 where none is near enough. */
double
ArcAt(const Course & course, const Vector3 & place, double least)
{
  double nearest = std::numeric_limits<double>::infinity();
  double arc = -1;
  double radius = 0;
  for (std::size_t i = 1; i < course.places.size(); ++i)
  {
    const Vector3 way = Minus(course.places[i], course.places[i - 1]);
    const double  squared = Dot(way, way);
    const double  share =
      squared > 0 ? std::clamp(Dot(Minus(place, course.places[i - 1]), way) / squared, 0.0, 1.0) : 0.0;
    if (const double distance = Distance(place, AddScaled(course.places[i - 1], share, way)); distance < nearest)
    {
      nearest = distance;
      arc = course.arcs[i - 1] + share * std::sqrt(squared);
      radius = course.radii[i - 1] + share * (course.radii[i] - course.radii[i - 1]);
    }
  }
  return nearest <= std::max(radius, least) ? arc : -1;
}

/** The advance of a later line along an earlier course, in steps of its points and no more than `step`. */
double
Advance(const Course & earlier, const Course & later, double step, double least)
{
  double sum = 0;
  double before = ArcAt(earlier, later.places.front(), least);
  for (std::size_t i = 1; i < later.places.size(); ++i)
  {
    const double length = later.arcs[i] - later.arcs[i - 1];
    const double parts = std::max(1.0, std::ceil(length / step));
    for (double part = 1; part <= parts; ++part)
    {
      const Vector3 way = Minus(later.places[i], later.places[i - 1]);
      const double  here = ArcAt(earlier, AddScaled(later.places[i - 1], part / parts, way), least);
      if (before >= 0 && here >= 0)
      {
        sum += std::clamp(here - before, -length / parts, length / parts);
      }
      before = here;
    }
  }
  return sum;
}

/** A branch that was known shares the course it had. */
void
RequireCourse(const FollowedBranch & branch,
              const FollowedDay &    day,
              const FollowedDay &    before,
              std::size_t            number,
              double                 least)
{
  const auto        known = ranges::find(before.branches, branch.id, &FollowedBranch::id);
  const std::string name = "branch " + std::to_string(branch.id);
  Require(known != before.branches.end(), number, name + " was not there on the day it is known from");
  const Course earlier = CourseOf(before.graph, known->points, known->parent != 0);
  const Course later = CourseOf(day.graph, branch.points, branch.parent != 0);
  double       whole = 0;
  for (std::size_t one = 0; one < day.graph.BranchCount(); ++one)
  {
    whole += day.graph.BranchLength(one);
  }
  const double advance = Advance(earlier, later, StepAlong(earlier, whole, least), least);
  const double rounding = kRounding * (1 + later.arcs.back());
  Require(std::abs(advance - branch.advance) <= rounding, number, name + " was measured wrong");
  constexpr double anywhere = std::numeric_limits<double>::infinity();
  const double     ahead = later.arcs.back() - ArcAt(later, earlier.places.back(), anywhere);
  const double     behind = earlier.arcs.back() - ArcAt(earlier, later.places.back(), anywhere);
  const double     growth = branch.growth > 0 ? ahead : -behind;
  const bool       isSound = branch.growth > 0 || ahead <= rounding;
  Require(isSound && std::abs(growth - branch.growth) <= rounding, number, name + " has grown otherwise");
  Require(advance >= SharedNeed(earlier, later.arcs.back()) - rounding, number, name + " does not share its course");
}

} // namespace

void
RequireIdentities(std::span<const FollowedDay> days, std::span<const RigidMotion> motions, double least)
{
  std::set<std::int64_t> known;
  std::set<std::int64_t> before;
  for (std::size_t number = 0; number < days.size(); ++number)
  {
    const FollowedDay & day = days[number];
    RequireRigid(motions[number], number);
    RequirePieces(day, number);
    RequireParents(day, number);
    std::set<std::int64_t> now;
    for (const FollowedBranch & branch : day.branches)
    {
      const BranchState expected = !known.contains(branch.id)   ? BranchState::New
                                   : before.contains(branch.id) ? BranchState::Kept
                                                                : BranchState::Back;
      Require(branch.state == expected, number, "branch " + std::to_string(branch.id) + " has a wrong state");
      now.insert(branch.id);
      if (expected != BranchState::New)
      {
        Require(branch.before < number, number, "a branch is known from a day to come");
        RequireCourse(branch, day, days[branch.before], number, least);
      }
    }
    std::set<std::int64_t> lost;
    for (const LostBranch & branch : day.lost)
    {
      lost.insert(branch.id);
    }
    std::set<std::int64_t> missing;
    ranges::copy_if(before, std::inserter(missing, missing.end()), [&](std::int64_t id) { return !now.contains(id); });
    Require(lost == missing, number, "what is lost is not what is missing");
    known.insert(now.begin(), now.end());
    before = std::move(now);
  }
}

} // namespace voxelcore
