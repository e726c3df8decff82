#pragma once
// What a comparison found, as tables: each is written as .csv, stands in the report, and is what Python gets.

#include "voxelcore/Base/SpatialUnit.h"
#include "voxelcore/Compare/CentrelineOverlap.h"
#include "voxelcore/Compare/CoreComparison.h"
#include "voxelcore/Compare/MaskComparison.h"
#include "voxelcore/Compare/TreeComparison.h"
#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Models/TableHead.h"
#include "voxelcore/Skeleton/BranchTable.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace voxelcore
{

/** Nothing where there is nothing to measure. */
using CompareCell = std::variant<std::monostate, std::int64_t, double, std::string>;

struct CompareTable
{
  std::string                           name;    ///< "labels", "differences", "branches", "levels"
  std::vector<TextColumn>               columns; ///< in the unit of what is compared
  std::vector<std::vector<CompareCell>> rows;    ///< a cell a column
};

/** What is compared: a label of both. */
struct ComparedLabel
{
  std::int64_t label = 0;
  std::string  name;
};

struct ComparedMasks : ComparedLabel
{
  MaskOverlap                                   overlap;
  SurfaceDistances                              surface;
  TopologyComparison                            open;   ///< 6-connected
  TopologyComparison                            closed; ///< 26-connected
  std::optional<std::vector<CentrelineOverlap>> lines;  ///< of A's skeleton in B, of B's in A
  std::vector<DifferingPart>                    parts;
};

struct ComparedTrees : ComparedLabel
{
  TreeComparison           found;
  std::vector<LevelRecord> levelsA;
  std::vector<LevelRecord> levelsB;
};

struct ComparedCores : ComparedLabel
{
  CoreComparison found;
};

/** "labels" and "differences". */
std::vector<CompareTable>
TablesOf(const std::vector<ComparedMasks> & labels, const ImageGeometry & geometry);
/** "labels", "differences" (tips and bifurcations), "branches" and "levels". */
std::vector<CompareTable>
TablesOf(const std::vector<ComparedTrees> & labels, SpatialUnit unit);
/** "labels". */
std::vector<CompareTable>
TablesOf(const std::vector<ComparedCores> & labels, SpatialUnit unit);

/** \throws OutputError */
void
WriteCompareCsv(const std::filesystem::path & path, const CompareTable & table, HeadUnits units = {});

/** What the columns of all tables mean, as JSON. */
std::string
CompareColumnsJson(const std::vector<CompareTable> & tables);

/** The main numbers, a row a label, and what differs. */
std::string
CompareTablesText(const std::vector<CompareTable> & tables);

} // namespace voxelcore
