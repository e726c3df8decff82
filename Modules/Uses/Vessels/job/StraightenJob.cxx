#include "voxelcore/Vessels/StraightenJob.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Jobs/LabelVolumes.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/LengthUnit.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/ParseReal.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Imaging/GreyVolume.h"
#include "voxelcore/Imaging/ScanRows.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Models/SkeletonModel.h"
#include "voxelcore/Report/CsvText.h"
#include "voxelcore/Report/ReportTable.h"
#include "voxelcore/Vessels/StraightTables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

constexpr double kMostSquares = 32768;  // along a side of a plane
constexpr double kMostPlanes = 1 << 20; // in a volume
constexpr double kWhole = 1 << 24;      // up to which float32 holds every whole number
constexpr double kRadii = 2;            // a vessel and as much around it

void
CheckFiles(const StraightenOptions & options, OutputTransaction & transaction)
{
  transaction.Protect(options.scan);
  transaction.Protect(options.skeleton);
  RequireVolumePath(options.output);
  std::vector<fs::path> targets{ options.output };
  if (options.table)
  {
    targets.push_back(*options.table);
    targets.push_back(ColumnsBeside(*options.table));
  }
  if (options.points)
  {
    transaction.Protect(*options.points);
    targets.push_back(options.mapped.value());
    targets.push_back(ColumnsBeside(*options.mapped));
  }
  CheckTargets(transaction, targets);
}

/** The skeleton's part that branches are counted in. */
const SkeletonPart &
ChosenPart(const SkeletonModel & model, const StraightenOptions & options)
{
  std::vector<const SkeletonPart *> fitting;
  std::string                       known;
  for (const SkeletonPart & part : model.parts)
  {
    known += (known.empty() ? "" : ", ") + std::to_string(part.label) +
             (part.component > 0 ? "#" + std::to_string(part.component) : "");
    if ((!options.label || part.label == *options.label) &&
        (options.component == 0 || part.component == options.component))
    {
      fitting.push_back(&part);
    }
  }
  if (fitting.empty())
  {
    throw InputError(options.skeleton.string() + ": has no such label; --label can be one of " + known);
  }
  if (fitting.size() > 1)
  {
    throw UsageError(options.skeleton.string() + ": has several skeletons; choose one by --label: " + known);
  }
  return *fitting[0];
}

SkeletonWay
ChosenWay(const SkeletonGraph & graph, const StraightenOptions & options)
{
  try
  {
    if (options.ends)
    {
      return WayBetween(graph, options.ends->first, options.ends->second);
    }
    std::vector<ElementIndex> branches;
    for (const std::int64_t branch : options.branches)
    {
      branches.push_back(static_cast<ElementIndex>(std::min<std::int64_t>(branch, kNoBranch)));
    }
    return WayAlong(graph, branches);
  }
  catch (const UsageError & error)
  {
    throw UsageError(std::string(options.ends ? "--from, --to: " : "--branch: ") + error.what());
  }
}

PlaneGrid
GridAround(const SkeletonWay & way, const Vector3 & spacing, const StraightenOptions & options, const Vector3 & ofScan)
{
  const double least = *ranges::min_element(ofScan);
  double       width = kRadii * *ranges::max_element(way.radius);
  if (options.width)
  {
    width = options.width->value * (options.width->unit == Lambda::Unit::Voxel ? least : 1);
  }
  PlaneGrid grid;
  for (std::size_t k = 0; k < 2; ++k)
  {
    const double half = std::ceil(width / spacing[k] - 1e-9);
    if (!(2 * half + 1 < kMostSquares))
    {
      throw UsageError("a plane would have more than 32768 voxels to a side; give a coarser --spacing or less --width");
    }
    grid.half[k] = static_cast<std::int32_t>(half);
    grid.spacing[k] = spacing[k];
  }
  return grid;
}

/** Labels, and no grey values: of the whole scan, as `info` tells. What is damaged is told when values are read. */
bool
HoldsLabels(const fs::path & scan, ReadOptions reading)
{
  reading.refuseGrey = true;
  try
  {
    ReadLabelVolume(scan, reading);
    return true;
  }
  catch (const InputError &)
  {
    return false;
  }
}

bool
AreWhole(std::span<const float> values)
{
  return ranges::all_of(values, [](float value) { return value >= 0 && value == std::floor(value); });
}

/** Planes of the volume, some at a time side by side. */
class PlaneValues
{
public:
  PlaneValues(std::span<const AxisPlane> planes,
              const PlaneGrid &          grid,
              const ScanPart &           scan,
              bool                       isLinear,
              float                      outside)
    : m_Planes(planes)
    , m_Grid(grid)
    , m_Scan(scan)
    , m_IsLinear(isLinear)
    , m_Outside(outside)
    , m_Squares(static_cast<std::size_t>(grid.Size()[0]) * static_cast<std::size_t>(grid.Size()[1]))
  {}

  std::span<const float>
  Of(std::size_t plane)
  {
    constexpr std::size_t kAtOnce = 64;
    if (m_Values.empty() || plane < m_First || plane >= m_First + kAtOnce)
    {
      m_First = plane / kAtOnce * kAtOnce;
      const std::size_t count = std::min(kAtOnce, m_Planes.size() - m_First);
      m_Values.resize(count * m_Squares);
      RunEach(count, [&](std::size_t i) {
        SamplePlane(m_Planes[m_First + i],
                    m_Grid,
                    m_Scan,
                    m_IsLinear,
                    m_Outside,
                    std::span(m_Values).subspan(i * m_Squares, m_Squares));
      });
    }
    return std::span(m_Values).subspan((plane - m_First) * m_Squares, m_Squares);
  }

private:
  std::span<const AxisPlane> m_Planes;
  const PlaneGrid &          m_Grid;
  const ScanPart &           m_Scan;
  bool                       m_IsLinear;
  float                      m_Outside;
  std::size_t                m_Squares;
  std::size_t                m_First = 0;
  std::vector<float>         m_Values;
};

ImageGeometry
StraightGeometry(const PlaneGrid & grid, const StraightAxis & axis, double step, SpatialUnit unit)
{
  ImageGeometry geometry;
  geometry.size = { grid.Size()[0], grid.Size()[1], std::ssize(axis.planes) };
  geometry.spacing = { grid.spacing[0], grid.spacing[1], step };
  geometry.origin = { -grid.half[0] * grid.spacing[0], -grid.half[1] * grid.spacing[1], 0 };
  geometry.unit = unit;
  return geometry;
}

/** Reads points of the scan or of the straight volume, and finds the others. */
std::vector<MappedPoint>
MapPoints(const fs::path & path, std::span<const AxisPlane> planes, const ImageGeometry & volume)
{
  std::ifstream     file(path, std::ios::binary);
  const std::string text{ std::istreambuf_iterator<char>(file), {} };
  if (!file)
  {
    throw InputError(path.string() + ": cannot read this file; check its name and permissions");
  }
  const auto                            rows = ParseCsv(text, path.string(), FindSeparator(text));
  const auto                            columns = ColumnPlaces(rows.empty() ? CsvRow() : rows[0]);
  constexpr std::array<const char *, 3> ofScan{ "x", "y", "z" };
  constexpr std::array<const char *, 3> ofVolume{ "across", "up", "arc_length" };
  const auto                            has = [&](const auto & names) {
    return ranges::all_of(names, [&](const char * name) { return columns.contains(name); });
  };
  const bool isOfScan = has(ofScan);
  if (isOfScan == has(ofVolume))
  {
    throw InputError(path.string() +
                     ": expected a table with the columns x, y, z (points in the scan, LPS mm) or "
                     "across, up, arc_length (points in the straight volume)");
  }
  std::vector<MappedPoint> points;
  for (std::size_t row = 1; row < rows.size(); ++row)
  {
    Vector3 given{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::size_t column = columns.at(isOfScan ? ofScan[k] : ofVolume[k]);
      const auto        number = column < rows[row].fields.size() ? ParseReal(rows[row].fields[column]) : std::nullopt;
      if (!number || !std::isfinite(*number))
      {
        throw InputError(path.string() + ", line " + std::to_string(rows[row].line) + ": expected three numbers");
      }
      given[k] = *number;
    }
    MappedPoint point;
    point.place = isOfScan ? given : FromStraight(planes, given);
    point.straight = isOfScan ? ToStraight(planes, given) : given;
    point.isInVolume = point.straight.has_value();
    for (std::size_t k = 0; k < 3 && point.isInVolume; ++k)
    {
      const double index = ((*point.straight)[k] - volume.origin[k]) / volume.spacing[k];
      point.isInVolume = index >= -0.5 && index <= static_cast<double>(volume.size[k]) - 0.5;
    }
    points.push_back(point);
  }
  return points;
}

void
WriteTables(const StraightenOptions & options,
            const StraightAxis &      axis,
            StraightenResult &        result,
            OutputTransaction &       transaction,
            HeadUnits                 units)
{
  std::vector<MappedPoint> points;
  if (options.points)
  {
    points = MapPoints(*options.points, axis.planes, result.geometry);
    result.mapped = points.size();
    WriteMappedCsv(transaction.Stage(*options.mapped), points, units);
  }
  if (options.table)
  {
    WritePlaneCsv(transaction.Stage(*options.table), axis.planes, units);
  }
  for (const auto & table : { options.table, options.mapped })
  {
    if (table)
    {
      WriteTextFile(transaction.Stage(ColumnsBeside(*table)), StraightColumnsJson(result.geometry.unit));
    }
  }
}

void
TellBends(const StraightAxis & axis, const ImageGeometry & geometry, StraightenResult & result)
{
  double      most = 0;
  std::size_t crossing = 0;
  for (const AxisPlane & plane : axis.planes)
  {
    most = std::max(most, plane.bend);
    crossing += plane.bend * plane.radius > 1 ? 1 : 0;
  }
  result.tightestBend = 1 / most;
  if (crossing > 0)
  {
    const LengthUnit unit = LengthUnit::For(result.tightestBend, geometry.unit);
    result.notes.push_back("the axis bends more tightly than the vessel is wide (down to a radius of " +
                           unit.Text(result.tightestBend) + " " + unit.Name() + ") at " + std::to_string(crossing) +
                           " planes: there planes cross within the vessel, and its inner side appears twice");
  }
}

} // namespace

StraightenResult
RunStraightenJob(const StraightenOptions & options, const JobContext & given)
{
  const JobContext  context = ForwardOnly(given);
  OutputTransaction transaction(options.force, context.temporaries);
  CheckFiles(options, transaction);
  StraightenResult result;
  ReportProgress(context.progress, "reading", 0);
  const SkeletonModel model = ReadSkeletonVtp(options.skeleton);
  WarnOfRounding(options.skeleton, model.rounded, result.warnings);
  const SkeletonPart & part = ChosenPart(model, options);
  const SkeletonWay    way = ChosenWay(part.graph, options);
  const ScanRows       header(options.scan, options.reading);
  const ImageGeometry  scan = header.Geometry();
  for (const std::string & warning : header.Warnings())
  {
    result.warnings.push_back(warning);
  }
  RequireSameUnit(options.skeleton, model.unit, options.scan, scan.unit);
  if (options.width)
  {
    RequireLengthIn(scan.unit, *options.width);
  }
  const double  least = *ranges::min_element(scan.spacing);
  const Vector3 spacing = options.spacing.value_or(Vector3{ least, least, least });
  if (!(WayLength(way) / spacing[2] < kMostPlanes))
  {
    throw UsageError("the volume would have more than a million planes; give a coarser --spacing");
  }
  const PlaneGrid    grid = GridAround(way, spacing, options, scan.spacing);
  const StraightAxis axis = StraightenWay(way, Length(scan.spacing) / std::sqrt(3.0), spacing[2]);
  result.length = axis.length;
  result.geometry = StraightGeometry(grid, axis, spacing[2], scan.unit);
  RequireVolumeFits(options.output, result.geometry.size);
  TellBends(axis, scan, result);

  const VoxelBox box = VoxelsAt(axis.planes, grid, scan);
  if (box.size[0] == 0)
  {
    throw InputError(options.scan.string() + ": the way lies outside this scan; give the scan that " +
                     options.skeleton.string() + " was made of, or one in the same place");
  }
  result.isLinear = options.samples == SampleKind::Linear ||
                    (options.samples == SampleKind::Auto && !HoldsLabels(options.scan, options.reading));
  const GreyVolume grey =
    ReadGreyVolume(options.scan, box, options.reading, PartOfProgress(context.progress, "reading", 0.1, 0.5));
  const auto outside = static_cast<float>(options.outside);
  if (!result.isLinear && ranges::any_of(grey.values, [](float value) { return std::abs(value) >= kWhole; }))
  {
    throw InputError(options.scan.string() +
                     ": has values of 16777216 or more, which would be rounded; number its "
                     "labels anew");
  }
  const bool  asNumbers = !result.isLinear && AreWhole(grey.values) && AreWhole(std::span(&outside, 1));
  ScanPart    values{ scan, box, grey.values };
  PlaneValues planes(axis.planes, grid, values, result.isLinear, outside);
  const auto  fill = [&](std::int64_t k, auto slice) {
    const auto of = planes.Of(static_cast<std::size_t>(k));
    using Value = typename decltype(slice)::value_type;
    ranges::transform(of, slice.begin(), [](float value) { return static_cast<Value>(value); });
    ReportProgress(context.progress,
                   "writing",
                   0.5 + 0.2 * static_cast<double>(k + 1) / static_cast<double>(result.geometry.size[2]));
  };
  const fs::path target = transaction.StageWithCompanions(options.output);
  if (asNumbers)
  {
    WriteNumberVolume(target, result.geometry, [&](std::int64_t k, std::span<std::uint32_t> slice) { fill(k, slice); });
  }
  else
  {
    WriteFloatVolume(target, result.geometry, [&](std::int64_t k, std::span<float> slice) { fill(k, slice); });
  }
  if (const std::string leftOut = WhatIsLeftOut(options.output, result.geometry); !leftOut.empty())
  {
    result.notes.push_back(leftOut);
  }
  WriteTables(options, axis, result, transaction, context.Heads(result.geometry.unit));
  Finish(transaction, context);
  return result;
}

std::string
StraightenText(const StraightenResult & result)
{
  const ImageGeometry & geometry = result.geometry;
  const LengthUnit      unit = LengthUnit::For(result.length, geometry.unit);
  std::string           text = "length " + unit.Text(result.length) + " " + unit.Name() + ": " +
                     std::to_string(geometry.size[2]) + " planes of " + std::to_string(geometry.size[0]) + " x " +
                     std::to_string(geometry.size[1]) + ", " + (result.isLinear ? "linear" : "nearest voxels") + "\n";
  if (result.mapped > 0)
  {
    text += std::to_string(result.mapped) + " points mapped\n";
  }
  return text;
}

} // namespace voxelcore
