#pragma once
// What a user can choose about the branches of curve skeletons, as text: in options and in reports.

#include "voxelcore/Certified/CertifiedSkeleton.h"

#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

/** Three finite coordinates; nothing for any other number of parts, or where one is no number. */
std::optional<Vector3>
ParsePlace(const std::vector<std::string> & parts);

/** "x,y,z" in LPS mm, several with semicolons between; blanks may stand around numbers. \throws UsageError */
std::vector<Vector3>
ParsePlaces(const std::string & text);

/** "top", "bottom", "thickest" or "x,y,z" in LPS mm. \throws UsageError */
RootChoice
ParseRoot(const std::string & text);

/** The inverse of ParseRoot. */
std::string
RootText(const RootChoice & root);

/** "open", "closed" or "overlap". \throws UsageError */
BorderEnds
ParseBorder(const std::string & text);

/** The inverse of ParseBorder. */
std::string
BorderText(BorderEnds ends);

/** "i-", "i+", "j-", ..: the beginning or the end of a voxel axis. */
std::string
BorderSideText(const BorderSection & section);

} // namespace voxelcore
