#include "voxelcore/Sheets/SheetsJob.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/LengthUnit.h"
#include "voxelcore/Base/SystemCalls.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Imaging/GreyVolume.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Jobs/LabelReading.h"
#include "voxelcore/Jobs/LabelVolumes.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Report/ReportTable.h"
#include "voxelcore/Thickness/CoreThickness.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

using Json = nlohmann::ordered_json;

class Work
{
public:
  Work(const SheetsOptions & options, const JobContext & context)
    : m_Options(options)
    , m_Context(context)
    , m_Transaction(options.core.force, context.temporaries)
    , m_FromCore(IsFinishedCore(options.core.scan, options.core.reading, options.core.resolution))
  {
    CheckTargets();
  }

  SheetsResult
  Run()
  {
    Stopwatch total;
    m_FromCore ? TakeCore() : TakeScan();
    ReportProgress(m_Context.progress, "writing", 0.92);
    Stopwatch                watch;
    CoreReport &             report = m_Result.report;
    std::vector<std::size_t> all(report.labels.size());
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      all[i] = i;
      m_Result.totals.push_back(TotalsOf(m_Result.model.parts[i]));
    }
    m_Result.model.unit = report.input.geometry.unit;
    m_Result.model.provenance = ProvenanceJson(report, all, 0);
    WriteSheetsVtp(m_Transaction.Stage(m_Options.output), m_Result.model);
    if (m_Options.table)
    {
      const fs::path & table = *m_Options.table;
      const HeadUnits  units = m_Context.Heads(m_Result.model.unit);
      WriteSheetCsv(m_Transaction.Stage(table), m_Result.model, units);
      WriteSeamCsv(m_Transaction.Stage(FileOutputPath(table, "_seams")), m_Result.model, units);
      WriteTextFile(m_Transaction.Stage(ColumnsBeside(table)), SheetColumnsJson(m_Result.model.unit));
    }
    if (m_Options.graph)
    {
      WriteSheetGraphMl(m_Transaction.Stage(*m_Options.graph), m_Result.model);
    }
    if (m_Options.voxels)
    {
      WriteVoxels();
    }
    for (SheetPart & part : m_Result.model.parts)
    {
      part.core.core = MedialComplex();
    }
    report.seconds.write = watch.Lap();
    report.seconds.total = total.Lap();
    report.peakMemoryMb = PeakMemoryMb();
    if (m_Options.core.report)
    {
      WriteTextFile(m_Transaction.Stage(*m_Options.core.report),
                    ReportJson(report, ReportMember{ "sheets", SheetsJson() }));
    }
    Finish(m_Transaction, m_Context);
    return std::move(m_Result);
  }

private:
  void
  CheckTargets()
  {
    ProtectInputs(m_Transaction, m_Options.core);
    const auto require = [&](const std::optional<fs::path> & target, const char * option, const char * extension) {
      if (target && target->extension() != extension)
      {
        throw UsageError(std::string(option) + " " + target->string() + ": unknown extension; give " + extension);
      }
    };
    require(m_Options.output, "--output", ".vtp");
    require(m_Options.table, "--table", ".csv");
    require(m_Options.graph, "--graph", ".graphml");
    if (m_Options.voxels)
    {
      if (m_FromCore)
      {
        throw UsageError("--voxels needs a scan; " + m_Options.core.scan.string() + " is a medial surface");
      }
      RequireVolumePath(*m_Options.voxels);
    }
    std::vector<fs::path> targets{ m_Options.output };
    for (const auto & target : { m_Options.core.report, m_Options.table, m_Options.graph, m_Options.voxels })
    {
      if (target)
      {
        targets.push_back(*target);
      }
    }
    if (m_Options.table)
    {
      targets.insert(targets.end(), { FileOutputPath(*m_Options.table, "_seams"), ColumnsBeside(*m_Options.table) });
    }
    voxelcore::CheckTargets(m_Transaction, targets);
  }

  double
  Sliver(const LabelRecord & record) const
  {
    const CoreReport & report = m_Result.report;
    return InMeanVoxels(m_Options.sliver, report.parameters.weights, report.input.geometry.spacing, record.box);
  }


  void
  Take(LabelRecord record, ModelPart core, CertifiedThickness * found)
  {
    SheetPart part;
    part.name = record.name;
    const CertifiedShape shape = RecordedShape(m_Result.report, record);
    part.sheets = SheetsOf(core, shape, Sliver(record));
    const VoxelOwners owners = found != nullptr ? OwnersInCore(core, shape, found->shape) : VoxelOwners();
    part.core = std::move(core);
    if (found != nullptr)
    {
      const Vector3 & spacing = m_Result.report.input.geometry.spacing;
      part.voxelVolume = spacing[0] * spacing[1] * spacing[2];
      part.thickness = std::move(found->atVertices);
      VoxelOwners pieces = PiecesOfVoxels(part.sheets, owners);
      part.voxels.assign(part.sheets.sheets.size() + part.sheets.curves.size(), 0);
      for (const std::uint32_t piece : pieces.values)
      {
        if (piece == 0)
        {
          throw CertificateError(LabelText(record.label, record.name) + ": a voxel lies in no sheet's or rod's ball");
        }
        ++part.voxels[piece - 1];
      }
      if (m_Options.voxels)
      {
        m_Shapes.push_back(std::move(found->shape));
        m_Pieces.push_back(std::move(pieces));
      }
    }
    m_Result.model.parts.push_back(std::move(part));
    m_Result.report.labels.push_back(std::move(record));
  }

  void
  TakeScan()
  {
    StagePlan           plan(m_Context.progress, { 0.05, 0.02, 0.85, 0.08 });
    const CoreOptions & options = m_Options.core;
    CoreReport &        report = m_Result.report;
    ScanLabels          read = ReadScanLabels(options, plan, report);
    if (m_Options.voxels)
    {
      RequireVolumeFits(*m_Options.voxels, read.geometry.size);
    }
    m_Result.warnings = std::move(read.warnings);
    m_Result.notes = read.edited.notes;
    if (const std::string note = m_Options.voxels ? WhatIsLeftOut(*m_Options.voxels, read.geometry) : ""; !note.empty())
    {
      m_Result.notes.push_back(note);
    }
    CertifiedRequest request = RequestOf(options, read.surface);
    request.refineCores = static_cast<bool>(read.surface);
    request.thickness = ThicknessRequest{ false };
    RequireLengthsOf(options.scan, read.geometry.unit, request);
    RequireLength(read.geometry.unit);
    const ProgressCallback computing = plan.Next();
    const std::size_t      count = read.edited.labels.size();
    const auto share = [&](std::size_t done) { return static_cast<double>(done) / static_cast<double>(count); };
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::string name = read.edited.labels[i].label.name;
      LabelOutcome      outcome = ProcessLabel(std::move(read.edited.labels[i]),
                                          read.geometry,
                                          request,
                                          ProgressOfLabel(computing, name, i, count, share(i), share(i + 1)));
      AddComputing(report.seconds, outcome.seconds);
      Take(std::move(outcome.record), std::move(outcome.parts.front()), &*outcome.thickness);
    }
  }

  void
  RequireLength(SpatialUnit unit) const
  {
    CertifiedRequest request;
    request.lambdas = { m_Options.sliver };
    RequireLengthsOf(m_Options.core.scan, unit, request);
  }

  void
  TakeCore()
  {
    ReportProgress(m_Context.progress, "reading", 0);
    Stopwatch   watch;
    MedialModel model = ReadModel(m_Options.core.scan, Precision::AsSaved);
    WarnOfRounding(m_Options.core.scan, model.rounded, m_Result.warnings);
    CoreReport & report = m_Result.report;
    report = ParseProvenance(model.provenance, m_Options.core.scan.string());
    RequireFittingProvenance(report.labels.size() == model.parts.size() && report.parameters.lambda.size() == 1 &&
                               report.parameters.tolerances.size() <= 1,
                             m_Options.core.scan);
    report.command = m_Options.core.command;
    report.input.path = m_Options.core.scan.string();
    RequireLength(report.input.geometry.unit);
    report.seconds.read = watch.Lap();
    std::vector<LabelRecord> records = std::move(report.labels);
    report.labels.clear();
    for (std::size_t i = 0; i < records.size(); ++i)
    {
      ReportProgress(m_Context.progress,
                     records[i].name,
                     0.1 + 0.8 * static_cast<double>(i) / static_cast<double>(records.size()));
      Take(std::move(records[i]), std::move(model.parts[i]), nullptr);
    }
  }

  void
  WriteVoxels()
  {
    VolumeOfLabels<std::uint32_t> volume;
    const SheetNumbers            known(m_Result.model);
    for (std::size_t i = 0; i < m_Shapes.size(); ++i)
    {
      const SheetPart &          part = m_Result.model.parts[i];
      std::vector<std::uint32_t> numbers{ 0 };
      for (std::uint32_t piece = 0; piece < part.voxels.size(); ++piece)
      {
        const bool isSeam =
          piece >= part.sheets.sheets.size() && !part.sheets.curves[piece - part.sheets.sheets.size()].isRod;
        numbers.push_back(isSeam ? 0 : static_cast<std::uint32_t>(known.SheetId(i, piece)));
      }
      for (std::uint32_t & value : m_Pieces[i].values)
      {
        value = numbers[value];
      }
      volume.shapes.push_back(&m_Shapes[i]);
      volume.values.push_back(&m_Pieces[i]);
    }
    const ImageGeometry & geometry = m_Result.report.input.geometry;
    WriteNumberVolume(m_Transaction.StageWithCompanions(*m_Options.voxels),
                      geometry,
                      [&](std::int64_t k, std::span<std::uint32_t> slice) { FillSlice(volume, geometry, k, slice); });
  }

  std::string
  SheetsJson() const
  {
    Json all = Json::array();
    for (std::size_t i = 0; i < m_Result.totals.size(); ++i)
    {
      const SheetTotals & t = m_Result.totals[i];
      const SheetPart &   part = m_Result.model.parts[i];
      Json                one{
        { "label", part.core.label },    { "name", part.name },  { "sliver_mm", Sliver(m_Result.report.labels[i]) },
        { "sheets", t.sheets },          { "seams", t.seams },   { "rods", t.rods },
        { "junctions", t.junctions },    { "area_mm2", t.area }, { "seam_length_mm", t.seamLength },
        { "rod_length_mm", t.rodLength }
      };
      if (part.core.component > 0)
      {
        one["component"] = part.core.component;
      }
      if (!part.voxels.empty())
      {
        one["sheet_voxels"] = t.sheetVoxels;
        one["rod_voxels"] = t.rodVoxels;
      }
      all.push_back(std::move(one));
    }
    return all.dump(-1, ' ', false, Json::error_handler_t::replace);
  }

  const SheetsOptions &    m_Options;
  const JobContext &       m_Context;
  OutputTransaction        m_Transaction;
  bool                     m_FromCore;
  std::vector<VoxelShape>  m_Shapes; ///< per label, for --voxels
  std::vector<VoxelOwners> m_Pieces;
  SheetsResult             m_Result;
};

} // namespace

SheetsResult
RunSheetsJob(const SheetsOptions & options, const JobContext & given)
{
  const JobContext context = ForwardOnly(given);
  return Work(options, context).Run();
}

std::string
SheetsText(const SheetsResult & result)
{
  double longest = 0;
  for (const SheetTotals & totals : result.totals)
  {
    longest = std::max({ longest, totals.seamLength, totals.rodLength, std::sqrt(totals.area) });
  }
  const LengthUnit                      unit = LengthUnit::For(longest, result.model.unit);
  std::vector<std::vector<std::string>> rows{ { "label",
                                                "name",
                                                "sheets",
                                                "seams",
                                                "junctions",
                                                "rods",
                                                "area " + unit.Name(2),
                                                "seams " + unit.Name(),
                                                "rods " + unit.Name(),
                                                "plates : rods" } };
  for (std::size_t i = 0; i < result.totals.size(); ++i)
  {
    const SheetTotals & t = result.totals[i];
    const std::uint64_t all = t.sheetVoxels + t.rodVoxels;
    const auto          percent = [&](std::uint64_t part) {
      return FixedText(100 * static_cast<double>(part) / static_cast<double>(all), 1);
    };
    rows.push_back({ std::to_string(result.model.parts[i].core.label),
                     result.model.parts[i].name,
                     std::to_string(t.sheets),
                     std::to_string(t.seams),
                     std::to_string(t.junctions),
                     std::to_string(t.rods),
                     unit.Text(t.area, 2),
                     unit.Text(t.seamLength),
                     unit.Text(t.rodLength),
                     all == 0 ? "-" : percent(t.sheetVoxels) + " : " + percent(t.rodVoxels) + " %" });
  }
  return FormatTable(rows);
}

} // namespace voxelcore
