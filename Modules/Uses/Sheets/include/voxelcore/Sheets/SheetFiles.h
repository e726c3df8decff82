#pragma once
// Sheets, seams and junctions of medial surfaces as files: polydata, tables, and a graph.

#include "voxelcore/Models/MedialModel.h"
#include "voxelcore/Models/TableHead.h"
#include "voxelcore/Sheets/MedialSheets.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace voxelcore
{

/** Of one label, or one component of it. */
struct SheetPart
{
  ModelPart                  core; ///< says label and component
  std::string                name;
  MedialSheets               sheets;
  std::vector<float>         thickness;       ///< local thickness per vertex of the core, mm; empty: twice the radius
  std::vector<std::uint64_t> voxels;          ///< per sheet, then per curve; empty where they are not known
  double                     voxelVolume = 0; ///< mm^3
};

struct SheetModel
{
  std::vector<SheetPart> parts;
  std::string            provenance;
  SpatialUnit            unit = SpatialUnit::Millimetres;
};

/** Numbers over all parts of a model: sheets from 1, the rods behind them; curves (seams, rods) from 1, junctions from
 *  1. Found once for each part, so that each number is a sum. */
class SheetNumbers
{
public:
  explicit SheetNumbers(const SheetModel & model);

  /** The number of a part's sheet (from 0) or, behind its sheets, of its curve, if that is a rod. */
  std::int64_t
  SheetId(std::size_t part, std::uint32_t piece) const
  {
    const Part & own = m_Parts[part];
    return 1 + (piece < own.sheets ? own.firstSheet : own.firstRod - own.rodsFrom) + piece;
  }

  std::int64_t
  SeamId(std::size_t part, std::uint32_t curve) const
  {
    return 1 + m_Parts[part].firstCurve + curve;
  }

  std::int64_t
  JunctionId(std::size_t part, std::uint32_t junction) const
  {
    return 1 + m_Parts[part].firstJunction + junction;
  }

private:
  /** How many there are before a part's own, over all parts. */
  struct Part
  {
    std::int64_t sheets = 0; ///< its own
    std::int64_t firstSheet = 0;
    std::int64_t firstRod = 0; ///< all sheets counted
    std::int64_t rodsFrom = 0; ///< the piece of its own that is its first rod: sheets and seams stand before
    std::int64_t firstCurve = 0;
    std::int64_t firstJunction = 0;
  };

  std::vector<Part> m_Parts;
};

/** .vtp: faces and, edge by edge, seams and rods; junctions and points that stand alone as vertices. Cell arrays
 *  `SheetId` (of faces and rods; else 0), `SeamId` (of seams and rods; else 0), `JunctionId`, `Label`, `Component`;
 *  point arrays `Radius`, `Thickness`. \throws OutputError */
void
WriteSheetsVtp(const std::filesystem::path & path, const SheetModel & model);

/** A row per sheet and rod. \throws OutputError */
void
WriteSheetCsv(const std::filesystem::path & path, const SheetModel & model, HeadUnits units = {});

/** A row per seam and rod. \throws OutputError */
void
WriteSeamCsv(const std::filesystem::path & path, const SheetModel & model, HeadUnits units = {});

/** Sheets, curves and junctions as nodes; edges lead from a curve to the sheets that meet in it and the junctions at
 *  its ends. \throws OutputError */
void
WriteSheetGraphMl(const std::filesystem::path & path, const SheetModel & model);

/** The data dictionary of both tables as JSON. */
std::string
SheetColumnsJson(SpatialUnit unit);

/** What a label comes to. */
struct SheetTotals
{
  std::size_t   sheets = 0;
  std::size_t   seams = 0;
  std::size_t   rods = 0;
  std::size_t   junctions = 0;
  double        area = 0;
  double        seamLength = 0;
  double        rodLength = 0;
  std::uint64_t sheetVoxels = 0; ///< whose ball is a sheet's
  std::uint64_t rodVoxels = 0;
};

SheetTotals
TotalsOf(const SheetPart & part);

} // namespace voxelcore
