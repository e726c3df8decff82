#include "voxelcore/Models/AppendedVtp.h"
#include "voxelcore/Models/TableColumns.h"

#include "voxelcore/Models/SkeletonModel.h"
#include "voxelcore/Sheets/SheetFiles.h"

#include <array>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr auto kSheetColumns = std::to_array<Column>({
  kLabelColumn,
  kNameColumn,
  kPartColumn,
  { "sheet_id", "", "number of the sheet or rod: SheetId, and the value in --voxels" },
  { "kind", "", "sheet or rod" },
  { "area", "mm^2", "of a sheet, without small fins" },
  { "length", "mm", "of a rod" },
  { "thickness", "mm", "mean of twice the radius" },
  { "thickness_sd", "mm", "standard deviation over a sheet" },
  { "normal_x", "1", "of the plane nearest to a sheet, LPS" },
  { "normal_y", "1", "" },
  { "normal_z", "1", "" },
  { "flatness", "1", "1 in a plane, 1/3 where normals go everywhere" },
  { "neighbours", "", "sheets that share a seam with it, by number" },
  { "free_border", "mm", "length of its border that is no seam" },
  { "seam_border", "mm", "length of its seams" },
  { "voxels", "", "voxels that belong to it; they add up to the label's" },
  { "volume", "mm^3", "of these voxels" },
});

constexpr auto kSeamColumns = std::to_array<Column>({
  kLabelColumn,
  kNameColumn,
  kPartColumn,
  { "seam_id", "", "number of the seam or rod: SeamId" },
  { "kind", "", "seam or rod" },
  { "length", "mm", "along it" },
  { "thickness", "mm", "mean of twice the radius along it" },
  { "sheets", "", "numbers of the sheets that meet in it" },
  { "junction_src", "", "junction at its first point; empty: a free end, or closed" },
  { "junction_dst", "", "junction at its last point" },
  { "closed", "", "1: it comes back to its first point" },
});

void
WriteNames(TextFile & file, const SheetPart & part)
{
  file << part.core.label << "," << CsvField(part.name) << "," << part.core.component << ",";
}

std::size_t
CountRods(const SheetPart & part)
{
  std::size_t rods = 0;
  for (const CurveRecord & curve : part.sheets.curves)
  {
    rods += curve.isRod ? 1 : 0;
  }
  return rods;
}

void
WriteVoxels(TextFile & file, const SheetPart & part, std::size_t piece)
{
  if (part.voxels.empty())
  {
    file << ",\n";
    return;
  }
  file << part.voxels[piece] << "," << static_cast<double>(part.voxels[piece]) * part.voxelVolume << "\n";
}

} // namespace

SheetNumbers::SheetNumbers(const SheetModel & model)
{
  Part next;
  for (const SheetPart & part : model.parts)
  {
    const auto curves = static_cast<std::int64_t>(part.sheets.curves.size());
    const auto rods = static_cast<std::int64_t>(CountRods(part));
    next.sheets = static_cast<std::int64_t>(part.sheets.sheets.size());
    next.rodsFrom = next.sheets + curves - rods;
    m_Parts.push_back(next);
    next.firstSheet += next.sheets;
    next.firstRod += rods;
    next.firstCurve += curves;
    next.firstJunction += static_cast<std::int64_t>(part.sheets.junctions.size());
  }
  for (Part & part : m_Parts)
  {
    part.firstRod += next.firstSheet;
  }
}

void
WriteSheetsVtp(const std::filesystem::path & path, const SheetModel & model)
{
  const SheetNumbers numbers(model);
  struct Names
  {
    std::vector<std::int64_t> sheet, seam, junction, label, component;
  };
  VtpContent          content;
  Names               names[3];
  std::vector<double> radius;
  std::vector<double> thickness;
  std::int64_t        first = 0;
  for (std::size_t p = 0; p < model.parts.size(); ++p)
  {
    const SheetPart &     part = model.parts[p];
    const MedialComplex & core = part.core.core;
    const MedialSheets &  cut = part.sheets;
    const auto add = [&](int kind, auto && points, std::int64_t sheet, std::int64_t seam, std::int64_t junction) {
      for (const ElementIndex point : points)
      {
        content.cells[kind].points.push_back(first + point);
      }
      content.cells[kind].offsets.push_back(static_cast<std::int64_t>(content.cells[kind].points.size()));
      names[kind].sheet.push_back(sheet);
      names[kind].seam.push_back(seam);
      names[kind].junction.push_back(junction);
      names[kind].label.push_back(part.core.label);
      names[kind].component.push_back(part.core.component);
    };
    for (std::size_t vertex = 0; vertex < core.positions.size(); ++vertex)
    {
      content.positions.insert(content.positions.end(), core.positions[vertex].begin(), core.positions[vertex].end());
      thickness.push_back(part.thickness.empty() ? 2 * core.radius[vertex] : part.thickness[vertex]);
    }
    radius.insert(radius.end(), core.radius.begin(), core.radius.end());
    const auto sheets = static_cast<std::uint32_t>(cut.sheets.size());
    for (std::uint32_t junction = 0; junction < cut.junctions.size(); ++junction)
    {
      add(0, std::array{ cut.junctions[junction] }, 0, 0, numbers.JunctionId(p, junction));
    }
    for (std::uint32_t curve = 0; curve < cut.curves.size(); ++curve)
    {
      const CurveRecord & one = cut.curves[curve];
      if (one.vertices.size() == 1)
      {
        add(0, one.vertices, numbers.SheetId(p, sheets + curve), numbers.SeamId(p, curve), 0);
      }
    }
    for (std::size_t edge = 0; edge < cut.curveOfEdge.size(); ++edge)
    {
      if (const std::uint32_t curve = cut.curveOfEdge[edge]; curve != kNoPiece)
      {
        const bool isRod = cut.curves[curve].isRod;
        add(1, core.cells.edges[edge], isRod ? numbers.SheetId(p, sheets + curve) : 0, numbers.SeamId(p, curve), 0);
      }
    }
    const std::int64_t firstSheet = sheets > 0 ? numbers.SheetId(p, 0) : 0;
    for (std::size_t face = 0; face < cut.sheetOfFace.size(); ++face)
    {
      const std::uint32_t piece = cut.sheetOfFace[face];
      add(2, core.cells.FaceVertices(face), piece < sheets ? firstSheet + piece : numbers.SheetId(p, piece), 0, 0);
    }
    first += static_cast<std::int64_t>(core.positions.size());
  }
  content.texts = { { "SPACE", "LPS" }, { "Units", UnitName(model.unit) }, { "Provenance", model.provenance } };
  content.pointArrays = { { "Radius", std::move(radius) }, { "Thickness", std::move(thickness) } };
  const auto addCells = [&](const char * name, auto member) {
    auto all = names[0].*member;
    for (const int kind : { 1, 2 })
    {
      all.insert(all.end(), (names[kind].*member).begin(), (names[kind].*member).end());
    }
    content.cellArrays.emplace_back(name, std::move(all));
  };
  addCells("SheetId", &Names::sheet);
  addCells("SeamId", &Names::seam);
  addCells("JunctionId", &Names::junction);
  addCells("Label", &Names::label);
  addCells("Component", &Names::component);
  WriteVtp(path, std::move(content));
}

void
WriteSheetCsv(const std::filesystem::path & path, const SheetModel & model, HeadUnits units)
{
  const SheetNumbers numbers(model);
  TextFile           file(path, tableDigits);
  file << HeadLine(kSheetColumns, units);
  for (std::size_t p = 0; p < model.parts.size(); ++p)
  {
    const SheetPart & part = model.parts[p];
    const auto        sheets = static_cast<std::uint32_t>(part.sheets.sheets.size());
    for (std::uint32_t i = 0; i < sheets; ++i)
    {
      const SheetRecord & sheet = part.sheets.sheets[i];
      WriteNames(file, part);
      file << numbers.SheetId(p, i) << ",sheet," << sheet.area << ",," << sheet.thickness << ","
           << sheet.thicknessDeviation << "," << sheet.normal[0] << "," << sheet.normal[1] << "," << sheet.normal[2]
           << "," << sheet.flatness << ",";
      for (std::size_t n = 0; n < sheet.neighbours.size(); ++n)
      {
        file << (n > 0 ? " " : "") << numbers.SheetId(p, sheet.neighbours[n]);
      }
      file << "," << sheet.freeBorder << "," << sheet.seamBorder << ",";
      WriteVoxels(file, part, i);
    }
    for (std::uint32_t i = 0; i < part.sheets.curves.size(); ++i)
    {
      const CurveRecord & rod = part.sheets.curves[i];
      if (rod.isRod)
      {
        WriteNames(file, part);
        file << numbers.SheetId(p, sheets + i) << ",rod,," << rod.length << "," << rod.thickness << ",,,,,,,,,";
        WriteVoxels(file, part, sheets + i);
      }
    }
  }
  file.Finish();
}

void
WriteSeamCsv(const std::filesystem::path & path, const SheetModel & model, HeadUnits units)
{
  const SheetNumbers numbers(model);
  TextFile           file(path, tableDigits);
  file << HeadLine(kSeamColumns, units);
  for (std::size_t p = 0; p < model.parts.size(); ++p)
  {
    const SheetPart & part = model.parts[p];
    for (std::uint32_t i = 0; i < part.sheets.curves.size(); ++i)
    {
      const CurveRecord & curve = part.sheets.curves[i];
      WriteNames(file, part);
      file << numbers.SeamId(p, i) << (curve.isRod ? ",rod," : ",seam,") << curve.length << "," << curve.thickness
           << ",";
      for (std::size_t n = 0; n < curve.sheets.size(); ++n)
      {
        file << (n > 0 ? " " : "") << numbers.SheetId(p, curve.sheets[n]);
      }
      for (const std::uint32_t junction : curve.junctions)
      {
        file << ",";
        if (junction != kNoPiece)
        {
          file << numbers.JunctionId(p, junction);
        }
      }
      file << "," << (curve.isClosed ? 1 : 0) << "\n";
    }
  }
  file.Finish();
}

void
WriteSheetGraphMl(const std::filesystem::path & path, const SheetModel & model)
{
  const SheetNumbers numbers(model);
  TextFile           file(path, 9);
  file << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n";
  const auto key = [&](const char * id, const char * of, const char * type) {
    file << "  <key id=\"" << id << "\" for=\"" << of << "\" attr.name=\"" << id << "\" attr.type=\"" << type
         << "\"/>\n";
  };
  key("kind", "node", "string");
  key("label", "node", "long");
  for (const char * name : { "area", "length", "thickness", "x", "y", "z" })
  {
    key(name, "node", "double");
  }
  key("voxels", "node", "long");
  file << "  <graph id=\"sheets\" edgedefault=\"undirected\">\n";
  const auto data = [&](const char * name, auto value) {
    file << "<data key=\"" << name << "\">" << value << "</data>";
  };
  for (std::size_t p = 0; p < model.parts.size(); ++p)
  {
    const SheetPart & part = model.parts[p];
    const auto        sheets = static_cast<std::uint32_t>(part.sheets.sheets.size());
    const auto        node = [&](const char * letter, std::int64_t id, std::string_view kind) {
      file << "    <node id=\"" << letter << id << "\">";
      data("kind", kind);
      data("label", part.core.label);
    };
    for (std::uint32_t i = 0; i < sheets; ++i)
    {
      node("s", numbers.SheetId(p, i), "sheet");
      data("area", part.sheets.sheets[i].area);
      data("thickness", part.sheets.sheets[i].thickness);
      if (!part.voxels.empty())
      {
        data("voxels", part.voxels[i]);
      }
      file << "</node>\n";
    }
    for (std::uint32_t i = 0; i < part.sheets.curves.size(); ++i)
    {
      const CurveRecord & curve = part.sheets.curves[i];
      node("c", numbers.SeamId(p, i), curve.isRod ? "rod" : "seam");
      data("length", curve.length);
      data("thickness", curve.thickness);
      if (curve.isRod && !part.voxels.empty())
      {
        data("voxels", part.voxels[sheets + i]);
      }
      file << "</node>\n";
    }
    for (std::uint32_t i = 0; i < part.sheets.junctions.size(); ++i)
    {
      const Vector3 & place = part.core.core.positions[part.sheets.junctions[i]];
      node("j", numbers.JunctionId(p, i), "junction");
      data("x", place[0]);
      data("y", place[1]);
      data("z", place[2]);
      file << "</node>\n";
    }
    for (std::uint32_t i = 0; i < part.sheets.curves.size(); ++i)
    {
      const auto edge = [&](const char * letter, std::int64_t id) {
        file << "    <edge source=\"c" << numbers.SeamId(p, i) << "\" target=\"" << letter << id << "\"/>\n";
      };
      for (const std::uint32_t sheet : part.sheets.curves[i].sheets)
      {
        edge("s", numbers.SheetId(p, sheet));
      }
      for (const std::uint32_t junction : part.sheets.curves[i].junctions)
      {
        if (junction != kNoPiece)
        {
          edge("j", numbers.JunctionId(p, junction));
        }
      }
    }
  }
  file << "  </graph>\n</graphml>\n";
  file.Finish();
}

std::string
SheetColumnsJson(SpatialUnit unit)
{
  return TablesJson({ { "sheets", ColumnsJson(kSheetColumns, unit) }, { "seams", ColumnsJson(kSeamColumns, unit) } });
}

SheetTotals
TotalsOf(const SheetPart & part)
{
  SheetTotals totals;
  totals.sheets = part.sheets.sheets.size();
  totals.rods = CountRods(part);
  totals.seams = part.sheets.curves.size() - totals.rods;
  totals.junctions = part.sheets.junctions.size();
  for (const SheetRecord & sheet : part.sheets.sheets)
  {
    totals.area += sheet.area;
  }
  for (const CurveRecord & curve : part.sheets.curves)
  {
    (curve.isRod ? totals.rodLength : totals.seamLength) += curve.length;
  }
  for (std::size_t piece = 0; piece < part.voxels.size(); ++piece)
  {
    (piece < totals.sheets ? totals.sheetVoxels : totals.rodVoxels) += part.voxels[piece];
  }
  return totals;
}

} // namespace voxelcore
