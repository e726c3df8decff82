#pragma once
// Root systems as files: tables, and RSML (Lobet et al., Plant Physiology 2015), which archiDART, SmartRoot and others
// read.

#include "voxelcore/Base/SpatialUnit.h"
#include "voxelcore/Models/TableHead.h"
#include "voxelcore/Roots/RootTraits.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

/** A root system with its numbers; positions in LPS mm, or in voxels. */
struct RootModel
{
  std::string   name; ///< of the scan
  SkeletonGraph graph;
  RootHierarchy roots;
  RootTraits    traits;
  SpatialUnit   unit = SpatialUnit::Millimetres;
};

/** Of files whose roots have the same ids: a plant over time. */
struct RsmlSequence
{
  std::string               label; ///< the same in all of them
  std::int64_t              index = 0;
  std::vector<std::int64_t> ids; ///< of the axes
};

/** What a file says of itself. */
struct RsmlOptions
{
  std::string lastModified; ///< yyyy-mm-ddThh:mm:ss: of the scan, so that equal scans give equal files
  std::string software;     ///< with its version
  std::string sha256;       ///< of the scan; may be empty

  std::optional<RsmlSequence> sequence{};
};

/** RSML 1: a plant per stem, roots nested as they spring from each other, each a polyline from its base on, the first
 *  point on its parent's axis, with the diameter at each point. `unit` is mm with a resolution of 1, or pixel. Roots
 *  have the properties level, length, mean-diameter, emergence-angle, parent-node (the point of the parent's polyline
 *  it springs from, counted from 0) and parent-position (mm along the parent to there). \throws OutputError */
void
WriteRsml(const std::filesystem::path & path, const RootModel & model, const RsmlOptions & options);

/** The roots as a forest of points, each root by itself from its base on: where roots touch, a point is there for each
 *  of them. A lateral's first point has its parent's point, the nearest to it, as parent. Micrometres, or voxels; the
 *  type is 5 and the level, radii are those of round cross-sections. Comments name each root with its level and
 *  parent. \throws OutputError */
void
WriteRootSwc(const std::filesystem::path & path, const RootModel & model);

/** The same as a directed graph, from bases to tips: a node at each base of a stem, each place where a lateral
 *  springs, and each tip; an edge between those that follow each other along a root, and one from a lateral's parent
 *  to its first node, with the root, its level, parent and name, and length and mean radius of the stretch. \throws
 *  OutputError */
void
WriteRootGraphMl(const std::filesystem::path & path, const RootModel & model);

/** A row per root. \throws OutputError */
void
WriteRootCsv(const std::filesystem::path & path, const RootModel & model, HeadUnits units = {});

/** A row per level, one for all laterals, one for all roots. \throws OutputError */
void
WriteRootLevelCsv(const std::filesystem::path & path, const RootModel & model, HeadUnits units = {});

/** One row: the plant as a whole. `volume` is that of the voxels. \throws OutputError */
void
WritePlantCsv(const std::filesystem::path & path, const RootModel & model, double volume, HeadUnits units = {});

/** The same row as a JSON object in one line, its units in its names: total_length_mm, volume_mm3; without what is not
 *  known. */
std::string
PlantJson(const RootModel & model, double volume);

/** Length by depth and by diameter, and width by depth. \throws OutputError */
void
WriteRootProfileCsv(const std::filesystem::path & path, const RootModel & model, HeadUnits units = {});

/** The data dictionary of these tables as JSON: meaning and unit of each column. */
std::string
RootColumnsJson(SpatialUnit unit);

} // namespace voxelcore
