#pragma once
// Cross-sections of bodies, and the lesions of vessels, as files.

#include "voxelcore/Base/SpatialUnit.h"
#include "voxelcore/Models/SkeletonModel.h"
#include "voxelcore/Models/TableHead.h"
#include "voxelcore/Vessels/BranchSections.h"
#include "voxelcore/Vessels/VesselLesions.h"

#include <filesystem>
#include <string>
#include <vector>

namespace voxelcore
{

/** Of a label, or of a network: the label of a branch is then its own. */
struct SectionsOfPart
{
  std::vector<BranchSection> sections;
  std::vector<VesselLesion>  lesions;
  std::vector<std::int64_t>  labels; ///< of the branches, by number
  std::vector<std::string>   names;  ///< the same
  std::int64_t               component = 0;
};

/** With what the tables say of its branches. */
SectionsOfPart
NameSections(const SkeletonPart & part, std::vector<BranchSection> sections, std::vector<VesselLesion> lesions);

/** Comma-separated values, a row per section. \throws OutputError */
void
WriteSectionCsv(const std::filesystem::path & path, const std::vector<SectionsOfPart> & parts, HeadUnits units = {});

/** Contours as closed poly lines in XML polydata, a line per contour, with cell arrays named after the columns.
 *  \throws OutputError */
void
WriteSectionVtp(const std::filesystem::path & path, const std::vector<SectionsOfPart> & parts, SpatialUnit unit);

/** "stenosis", "bulge" or "dome". */
const char *
LesionText(LesionKind kind);

/** Comma-separated values, a row per lesion. \throws OutputError */
void
WriteLesionCsv(const std::filesystem::path & path, const std::vector<SectionsOfPart> & parts, HeadUnits units = {});

/** What the columns of both tables mean, as JSON. */
std::string
SectionColumnsJson(SpatialUnit unit);

} // namespace voxelcore
