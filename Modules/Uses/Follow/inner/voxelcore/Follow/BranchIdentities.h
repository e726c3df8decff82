#pragma once
// Branches that keep their numbers from day to day, while they grow, are lost, and new ones spring from them.
//
// A branch is a way along a day's skeleton from its base, on its parent, to its tip. Of a day's first skeleton they are
// the axes of MeasureBranches(). Later a known branch is the way that goes on longest along its last known course: by
// the length of that course by which the way advances within its radius, or `least` mm where that is more. Parents come
// first, of one level the longest; behind the end of its course a branch goes on as MeasureBranches() says. It is the
// same branch where that advance is kSharedCourse of the shorter of both, not counting what lies in its parent's ball.
// What no known branch takes is new. Lost ones stay known: one that comes back keeps its number.

#include "voxelcore/Follow/RigidMotion.h"
#include "voxelcore/Skeleton/BranchTable.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace voxelcore
{

/** As ATM'22 has it of branches that are detected. */
inline constexpr double kSharedCourse = 0.8;

enum class BranchState
{
  Kept, ///< was there the day before
  New,
  Back ///< was lost
};

struct FollowedBranch
{
  std::int64_t              id = 0;     ///< from 1
  std::int64_t              parent = 0; ///< its id; 0: none
  std::int32_t              order = 0;  ///< 0 without parent, else one more than that
  BranchState               state = BranchState::New;
  std::vector<ElementIndex> points;         ///< of the day's graph, from the base on, which is a point of the parent
  double                    length = 0;     ///< mm
  double                    meanRadius = 0; ///< outside the parent's ball, weighted by length
  double                    advance = 0;    ///< along the course it was known by, mm
  std::size_t               before = 0;     ///< the day, from 0, of that course
  /** Since that day, mm: along its course from the place nearest to the earlier tip to its tip; where that is at its
   *  end, by how much the earlier course went on, negative. NaN of a new one. Lengths tell it less well, as their bases
   *  lie somewhere in their parents. */
  double growth = std::numeric_limits<double>::quiet_NaN();
  /** Since that day, mean along the course that both share outside the parent's ball, mm; NaN of a new one. */
  double radiusChange = std::numeric_limits<double>::quiet_NaN();
};

struct LostBranch
{
  std::int64_t id = 0;
  Vector3      tip{}; ///< where it was
};

struct FollowedDay
{
  SkeletonGraph               graph;    ///< in the space of the first day
  std::vector<FollowedBranch> branches; ///< by id; each branch of the graph is part of one
  std::vector<LostBranch>     lost;     ///< those of the day before that are not there
};

/** The days' skeletons in one space. `root`: where the hierarchy of the first begins; later ones begin at the nodes
 *  nearest to where earlier ones did. */
std::vector<FollowedDay>
FollowBranches(std::vector<SkeletonGraph> graphs, const RootChoice & root, double least);

/** Holds the result against its definition, by other means: motions are rigid; each piece of a skeleton is on one
 *  branch, and their lengths sum up to its; each number stands once a day, its parent does too, and its base is on
 *  that; states and losses are what the days before say; what is kept shares its course. \throws CertificateError */
void
RequireIdentities(std::span<const FollowedDay> days, std::span<const RigidMotion> motions, double least);

/** What both the rule and its check mean by a course: its points with radii. */
struct Course
{
  std::vector<Vector3> places;
  std::vector<double>  radii;
  std::vector<double>  arcs;     ///< from the base, mm
  double               base = 0; ///< radius of the parent's ball at its base, mm; 0 without parent
};

Course
CourseOf(const SkeletonGraph & graph, std::span<const ElementIndex> points, bool hasParent);

/** How far apart places of a later line are held against an earlier course: a quarter of its least tolerance. Of a day
 *  of the length `whole` there are no more than 100,000: a damaged file's one far point would ask for all time. */
inline double
StepAlong(const Course & earlier, double whole, double least)
{
  return std::max(std::max(*std::min_element(earlier.radii.begin(), earlier.radii.end()), least) / 4, whole / 1e5);
}

/** The length of a later way, of which the part in the parent's ball decides nothing, that must be shared. */
inline double
SharedNeed(const Course & course, double later)
{
  return kSharedCourse * (std::min(course.arcs.back(), later) - course.base);
}

} // namespace voxelcore
