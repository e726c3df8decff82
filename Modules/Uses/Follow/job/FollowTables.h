#pragma once
// What was followed, as files.

#include "voxelcore/Follow/FollowJob.h"
#include "voxelcore/Models/TableHead.h"

namespace voxelcore
{

/** A row a branch and day, and one where a branch was lost. \throws OutputError */
void
WriteFollowedBranches(const std::filesystem::path & path, const FollowResult & result, HeadUnits units);

/** A row a day. \throws OutputError */
void
WriteFollowedDays(const std::filesystem::path & path, const FollowResult & result, HeadUnits units);

/** What the columns mean. */
std::string
FollowColumnsJson(SpatialUnit unit);

/** All days' branches as poly lines in the space of the first: point array Radius, cell arrays Id, Day, ParentId,
 *  Order, Length. \throws OutputError */
void
WriteIdentitiesVtp(const std::filesystem::path & path, const FollowResult & result);

/** A day as RSML, in the space of the first, its roots called by their numbers. \throws OutputError */
void
WriteDayRsml(const std::filesystem::path & path,
             const FollowResult &          result,
             std::size_t                   day,
             const std::filesystem::path & scan);

} // namespace voxelcore
