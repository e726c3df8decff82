#include "voxelcore/Thickness/ThicknessJob.h"
#include "voxelcore/Jobs/ReadInput.h"

#include "BackgroundRegion.h"
#include "voxelcore/Jobs/DisplayFiles.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Jobs/LabelReading.h"
#include "ThicknessPlan.h"
#include "voxelcore/Jobs/LabelVolumes.h"
#include "ThicknessSteps.h"
#include "ThicknessTargets.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/SystemCalls.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Imaging/GreyVolume.h"
#include "voxelcore/Jobs/CostModel.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Labels/CropRange.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <omp.h>
#include <utility>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

class ThicknessWork
{
public:
  ThicknessWork(const ThicknessOptions & options, const JobContext & context)
    : m_Options(options)
    , m_Context(context)
    , m_Transaction(options.core.force, context.temporaries)
    , m_ToFolder(MakesFolder(m_Transaction, options.output))
    , m_Shown(options.core.display, options.core.scan, m_Transaction)
  {
    CheckTargets();
  }

  ThicknessResult
  Run()
  {
    StagePlan    plan(m_Context.progress, { 0.05, 0.02, 0.85, 0.08 });
    Stopwatch    total;
    CoreReport & report = m_Result.report;
    Read(plan);
    const ProgressCallback  computing = plan.Next();
    const std::size_t       count = m_Edited.labels.size();
    const bool              separates = m_Options.separation != SeparationRegion::None;
    std::vector<VoxelShape> shapes;
    for (std::size_t i = 0; separates && i < count; ++i)
    {
      shapes.push_back(m_Edited.labels[i].label.shape);
    }
    const auto share = [&](std::size_t i) {
      return static_cast<double>(i) / static_cast<double>(count + (separates ? 1 : 0));
    };
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::string name = m_Edited.labels[i].label.name;
      const auto        part = ProgressOfLabel(computing, name, i, count, share(i), share(i + 1));
      const BallTest    atBorder = [&](const PaintingBalls & balls) {
        return BallsAtSides(balls, m_Geometry, PartRead());
      };
      report.labels.push_back(Measure(std::move(m_Edited.labels[i]), atBorder, false, part));
      if (m_ToFolder)
      {
        WriteVolumes(i);
      }
    }
    if (separates)
    {
      Separate(shapes, NamedPartOfProgress(computing, "separation", share(count), 1));
    }
    const ProgressCallback writing = plan.Next("writing");
    ReportProgress(writing, "", 0);
    Stopwatch watch;
    if (!m_ToFolder)
    {
      WriteVolumes(0);
    }
    WriteSeparation();
    WriteTables();
    WriteModels();
    m_Shown.Finish(report, m_Result.notes, {});
    report.seconds.write = watch.Lap();
    report.seconds.total = total.Lap();
    report.peakMemoryMb = PeakMemoryMb();
    if (m_Options.core.report)
    {
      WriteTextFile(m_Transaction.Stage(*m_Options.core.report),
                    ReportJson(report, ReportMember{ "thickness", ThicknessJson(m_Result, m_Options) }));
    }
    Finish(m_Transaction, m_Context);
    return std::move(m_Result);
  }

private:
  /** Before any other file is looked for, as it may be in this folder, too. */
  static bool
  MakesFolder(OutputTransaction & transaction, const fs::path & output)
  {
    if (!IsFolderOutput(output))
    {
      return false;
    }
    transaction.MakeDirectory(output);
    return true;
  }

  void
  CheckTargets()
  {
    ProtectInputs(m_Transaction, m_Options.core);
    if (NamesFile(m_Options.within))
    {
      m_Transaction.Protect(m_Options.within);
    }
    CheckThicknessTargets(m_Options, m_Transaction);
  }

  void
  Read(StagePlan & plan)
  {
    ScanLabels read = ReadScanLabels(m_Options.core, plan, m_Result.report);
    m_Geometry = read.geometry;
    m_Surface = std::move(read.surface);
    m_Edited = std::move(read.edited);
    CheckThicknessVolumes(m_Options, m_Geometry, m_Edited.labels, m_Transaction);
    if (m_Context.admit)
    {
      const CostPrediction core = PredictJob(CountBoundaries(m_Edited.labels), m_Options.core, omp_get_max_threads());
      m_Context.admit(1e-6 * static_cast<double>(core.memoryBytes) + MapMb());
    }
    m_Shown.AddScan(m_Edited.labels, m_Geometry);
    m_Result.warnings = std::move(read.warnings);
    m_Result.notes = m_Edited.notes;
    NoteWhatIsLeftOut(m_ToFolder ? std::string() : WhatIsLeftOut(m_Options.output, m_Geometry));
  }

  void
  NoteWhatIsLeftOut(const std::string & note)
  {
    if (!note.empty())
    {
      m_Result.notes.push_back(note);
    }
  }

  /** Values at the voxels of all labels, which stay until they are written together. */
  double
  MapMb() const
  {
    std::uint64_t voxels = 0;
    for (const EditedLabel & one : m_Edited.labels)
    {
      voxels += one.label.voxels;
    }
    return 1e-6 * static_cast<double>(sizeof(float) * voxels);
  }

  /** Whether something is asked for besides the map and its numbers that needs the core of a whole label. */
  bool
  ShowsCores() const
  {
    const DisplayTargets & shown = m_Options.core.display;
    return m_Options.surface || m_Options.medial || shown.html || shown.scene;
  }

  /** What may be taken while a label is measured. */
  double
  BytesToUse() const
  {
    const std::optional<double> available = m_Context.admit ? std::nullopt : AvailableMemoryMb();
    double                      kept = 0;
    for (const CertifiedThickness & found : m_Found)
    {
      kept += static_cast<double>(sizeof(float) * found.map.values.size());
    }
    return m_Options.core.memory ? static_cast<double>(*m_Options.core.memory) - kept
           : available           ? 1e6 * *available
                                 : HUGE_VAL;
  }

  /** One label, as a whole or in blocks. */
  LabelRecord
  Measure(EditedLabel edited, const BallTest & atBorder, bool isSeparation, const ProgressCallback & progress)
  {
    CertifiedRequest request = RequestOf(m_Options.core, m_Surface);
    request.refineCores = static_cast<bool>(m_Surface);
    request.thickness = ThicknessRequest{ m_Options.bounds, !ShowsCores() && !m_Options.core.report };
    RequireLengthsOf(m_Options.core.scan, m_Geometry.unit, request);
    const std::vector<VoxelBox> blocks =
      PlanThickness(edited.label.shape, m_Geometry, request, m_Options, BytesToUse());
    if (blocks.size() > 1 && !ShowsCores() && !m_Options.bounds)
    {
      return MeasureInBlocks(std::move(edited), std::move(request), blocks, atBorder, isSeparation, progress);
    }
    if (blocks.size() > 1)
    {
      m_Result.notes.push_back(LabelText(edited.label.value, edited.label.name) +
                               ": measured as a whole, which may need more memory than is allowed; --bounds, "
                               "--surface, --medial, --html and --scene do not work in blocks");
    }
    LabelOutcome outcome = ProcessLabel(std::move(edited), m_Geometry, std::move(request), progress);
    outcome.record.hasCore = !outcome.parts.empty();
    if (!isSeparation && outcome.record.hasCore)
    {
      Keep(outcome);
    }
    Take(outcome, atBorder(outcome.thickness->balls), isSeparation);
    return std::move(outcome.record);
  }

  LabelRecord
  MeasureInBlocks(EditedLabel                   edited,
                  CertifiedRequest              request,
                  const std::vector<VoxelBox> & blocks,
                  const BallTest &              atBorder,
                  bool                          isSeparation,
                  const ProgressCallback &      progress)
  {
    LabelRecord record = DescribeLabel(edited, m_Geometry);
    record.hasCore = false;
    request.name = LabelText(record.label, record.name);
    Stopwatch        watch;
    BlockedThickness blocked = ThicknessInBlocks(edited.label.shape, m_Geometry, request, blocks, atBorder, progress);
    record.seconds = watch.Lap();
    record.shape = ComputeShapeTopology(edited.label.shape);
    m_Result.blocks += blocked.computed;
    m_Result.notes.push_back(
      request.name + ": measured in " + std::to_string(blocks.size()) + " blocks, as memory does not hold the whole" +
      (m_Surface && !m_Surface.IsOfShape() ? "; near their sides values may differ from those of the whole" : ""));
    ThicknessRecord numbers = RecordOf(record, isSeparation);
    SummarizeMap(blocked.map, m_Geometry, blocked.atBorder, m_Options.border, numbers);
    m_Result.thickness.push_back(std::move(numbers));
    CertifiedThickness found;
    found.shape = std::move(edited.label.shape);
    found.map = std::move(blocked.map);
    m_Found.push_back(std::move(found));
    return record;
  }

  /** What is shown of a label, and surfaces that are files. */
  void
  Keep(LabelOutcome & outcome)
  {
    ModelPart &                part = outcome.parts.front();
    const CertifiedThickness & found = *outcome.thickness;
    part.thickness.assign(found.atVertices.begin(), found.atVertices.end());
    m_Shown.AddLabel(outcome.record, part, nullptr);
    if (m_Options.surface)
    {
      ThicknessSurface one{ outcome.record.label, outcome.record.component, {}, {} };
      one.surface = SurfaceToShow(found.shape, m_Geometry);
      const VoxelRanks ranks(found.shape);
      for (const auto & point : one.surface.points)
      {
        const Vector3 place = PhysicalToLattice(m_Geometry, { point[0], point[1], point[2] });
        one.thickness.push_back(ValueNear(found.shape, ranks, found.map, place));
      }
      m_Surfaces.push_back(std::move(one));
    }
    if (m_Options.medial)
    {
      m_Parts.push_back(std::move(part));
    }
  }

  void
  WriteModels()
  {
    const CoreReport &       report = m_Result.report;
    std::vector<std::size_t> all(report.labels.size());
    std::iota(all.begin(), all.end(), std::size_t{ 0 });
    if (m_Options.surface)
    {
      WriteThicknessVtp(m_Transaction.Stage(*m_Options.surface),
                        m_Surfaces,
                        m_Geometry.unit,
                        ProvenanceJson(report, all, 0));
    }
    if (m_Options.medial)
    {
      MedialModel model;
      model.parts = std::move(m_Parts);
      model.unit = m_Geometry.unit;
      model.refined = m_Options.core.refine.surface;
      model.provenance = ProvenanceJson(report, all, 0);
      WriteModel(m_Transaction.Stage(*m_Options.medial), *m_Options.medial, model, {});
    }
  }

  void
  Take(LabelOutcome & outcome, const std::vector<char> & touches, bool isSeparation)
  {
    AddComputing(m_Result.report.seconds, outcome.seconds);
    CertifiedThickness & found = *outcome.thickness;
    ThicknessRecord      record = RecordOf(outcome.record, isSeparation);
    Summarize(found, m_Geometry, touches, m_Options.border, record);
    m_Result.thickness.push_back(std::move(record));
    found.owners = VoxelOwners();
    found.balls = PaintingBalls();
    m_Found.push_back(std::move(found));
  }

  static ThicknessRecord
  RecordOf(const LabelRecord & label, bool isSeparation)
  {
    ThicknessRecord record;
    record.label = isSeparation ? 0 : label.label;
    record.component = label.component;
    record.name = label.name;
    record.isSeparation = isSeparation;
    return record;
  }

  /** What is read of the scan: a crop cuts bodies off as the scan's sides do. */
  VoxelBox
  PartRead() const
  {
    const CropRange part = ResolveCrop(m_Options.core.reading.crop, m_Geometry.size, m_Options.core.scan);
    VoxelBox        box;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      box.lower[axis] = part.first[axis];
      box.size[axis] = part.end[axis] - part.first[axis];
    }
    return box;
  }

  void
  Separate(const std::vector<VoxelShape> & shapes, const ProgressCallback & progress)
  {
    StagePlan        plan(progress, { 0.05, 0.95 });
    const VoxelShape region = RegionOfBackground(m_Options, m_Geometry, shapes, plan.Next());
    EditedLabel      between;
    between.label.shape = CropToVoxels(BackgroundIn(region, shapes));
    between.label.voxels = between.label.shape.CountVoxels();
    if (between.label.voxels == 0)
    {
      throw InputError(m_Options.core.scan.string() +
                       (m_Options.separation == SeparationRegion::Within
                          ? ": --within " + m_Options.within +
                              ": all of it is in the labels that are measured; give --labels without those that "
                              "count as background"
                          : ": --separation: there is no background where it is to be measured"));
    }
    between.label.name = "separation";
    const BallTest atBorder = [&](const PaintingBalls & balls) {
      return m_Options.separation == SeparationRegion::Box ? BallsAtSides(balls, m_Geometry, region.Box())
                                                           : BallsAtRegion(balls, m_Geometry, region, shapes);
    };
    Measure(std::move(between), atBorder, true, plan.Next());
  }

  /** Of a folder those of one label, which then go; else those of all. */
  void
  WriteVolumes(std::size_t first)
  {
    const std::size_t last = m_ToFolder ? first + 1 : m_Result.report.labels.size();
    const auto        write = [&](const std::string & what, auto && valuesOf) {
      VolumeOfLabels<float> volume;
      for (std::size_t i = first; i < last; ++i)
      {
        volume.shapes.push_back(&m_Found[i].shape);
        volume.values.push_back(&valuesOf(m_Found[i]));
      }
      WriteOne(ThicknessPath(m_Options, m_Result.report.labels[first], what), volume);
    };
    write("", [](const CertifiedThickness & found) -> const VoxelValues & { return found.map; });
    if (m_Options.bounds)
    {
      write("_lower", [](const CertifiedThickness & found) -> const VoxelValues & { return found.bracket.lower; });
      write("_upper", [](const CertifiedThickness & found) -> const VoxelValues & { return found.bracket.upper; });
    }
    if (m_ToFolder)
    {
      m_Found[first] = CertifiedThickness();
    }
  }

  void
  WriteSeparation()
  {
    if (m_Options.separation == SeparationRegion::None)
    {
      return;
    }
    const VolumeOfLabels<float> volume{ { &m_Found.back().shape }, { &m_Found.back().map } };
    WriteOne(SeparationPath(m_Options), volume);
  }

  void
  WriteOne(const fs::path & target, const VolumeOfLabels<float> & volume)
  {
    WriteFloatVolume(m_Transaction.StageWithCompanions(target),
                     m_Geometry,
                     [&](std::int64_t k, std::span<float> slice) { FillSlice(volume, m_Geometry, k, slice); });
  }

  void
  WriteTables()
  {
    if (!m_Options.table)
    {
      return;
    }
    const fs::path & table = *m_Options.table;
    const HeadUnits  units = m_Context.Heads(m_Geometry.unit);
    WriteThicknessCsv(m_Transaction.Stage(table), m_Result.thickness, units);
    WriteThicknessHistogramCsv(m_Transaction.Stage(FileOutputPath(table, "_histogram")), m_Result.thickness, units);
    WriteTextFile(m_Transaction.Stage(ColumnsBeside(table)), ThicknessColumnsJson(m_Geometry.unit));
  }

  const ThicknessOptions &        m_Options;
  const JobContext &              m_Context;
  OutputTransaction               m_Transaction;
  bool                            m_ToFolder;
  DisplayFiles                    m_Shown;
  std::vector<ThicknessSurface>   m_Surfaces;
  std::vector<ModelPart>          m_Parts;
  ImageGeometry                   m_Geometry;
  EditedLabels                    m_Edited;
  SurfaceSource                   m_Surface;
  std::vector<CertifiedThickness> m_Found; ///< per label, then the separation
  ThicknessResult                 m_Result;
};

} // namespace

ThicknessResult
RunThicknessJob(const ThicknessOptions & options, const JobContext & given)
{
  const JobContext context = ForwardOnly(given);
  return ThicknessWork(options, context).Run();
}

} // namespace voxelcore
