#include "DisplayLoading.h"

#include "voxelcore/Base/DidYouMean.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Display/LabelSurface.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Masks/ShapeEdits.h"
#include "voxelcore/Models/DisplayColors.h"
#include "voxelcore/Models/MedialModel.h"
#include "voxelcore/Models/PlainSurface.h"
#include "voxelcore/Models/ReadMesh.h"
#include "voxelcore/Models/SkeletonModel.h"
#include "voxelcore/Report/CoreReport.h"
#include "voxelcore/Skeleton/ErosionThickness.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace voxelcore
{

std::vector<double>
VertexErosionThickness(const MedialComplex & surface, const Vector3 & spacing, const ProgressCallback & progress)
{
  const double        voxel = *std::min_element(spacing.begin(), spacing.end());
  std::vector<double> thickness = ComputeBurnTimes(surface, 1.5 * voxel, progress).vertices;
  for (std::size_t vertex = 0; vertex < thickness.size(); ++vertex)
  {
    thickness[vertex] = std::max(0.0, thickness[vertex] - surface.radius[vertex]);
  }
  return thickness;
}

namespace
{

using LabelKey = std::pair<std::int64_t, std::int64_t>; ///< label, component

/** Which labels a user asked for. */
class LabelSelection
{
public:
  explicit LabelSelection(const std::string & text)
  {
    for (std::size_t from = 0; text != "all" && from <= text.size();)
    {
      const std::size_t comma = std::min(text.find(',', from), text.size());
      m_Open.insert(text.substr(from, comma - from));
      from = comma + 1;
    }
    m_Selection = m_Open;
  }

  bool
  Take(std::int64_t label, const std::string & name)
  {
    bool taken = m_Selection.empty();
    for (const std::string & word : { std::to_string(label), name, name.substr(0, name.rfind('#')) })
    {
      const auto meant = [&](const std::string & wish) { return EqualIgnoringCase(wish, word); };
      taken = taken || std::any_of(m_Selection.begin(), m_Selection.end(), meant);
      std::erase_if(m_Open, meant);
      m_Names.insert(word);
    }
    return taken;
  }

  void
  RequireAllTaken() const
  {
    if (!m_Open.empty())
    {
      const std::vector<std::string_view> names(m_Names.begin(), m_Names.end());
      throw InputError("there is no label '" + *m_Open.begin() + "' in the files given" +
                       DidYouMean(*m_Open.begin(), names));
    }
  }

private:
  std::set<std::string> m_Selection;
  std::set<std::string> m_Open;
  std::set<std::string> m_Names; ///< of all labels seen
};

bool
IsSkeleton(const CoreReport & report)
{
  return report.skeleton.has_value();
}

class Loader
{
public:
  Loader(const DisplaySources & sources, const ProgressCallback & progress)
    : m_Sources(sources)
    , m_Progress(progress)
    , m_Selection(sources.labels)
  {}

  DisplayContent
  Load(std::vector<std::string> & notes, std::vector<std::string> & warnings)
  {
    for (std::size_t i = 0; i < m_Sources.files.size(); ++i)
    {
      const double count = static_cast<double>(m_Sources.files.size() + 1);
      LoadFile(m_Sources.files[i],
               PartOfProgress(m_Progress, static_cast<double>(i) / count, static_cast<double>(i + 1) / count),
               notes);
    }
    m_Selection.RequireAllTaken();
    if (m_Sources.scan)
    {
      LoadScan(notes, warnings);
    }
    DisplayContent content;
    content.areSheets = m_AreSheets;
    content.unit = m_Report ? m_Report->input.geometry.unit : SpatialUnit::Millimetres;
    for (auto & [key, label] : m_Labels)
    {
      content.labels.push_back(std::move(label));
    }
    return content;
  }

private:
  DisplayLabel &
  LabelOf(std::int64_t label, std::int64_t component, const std::string & name)
  {
    auto [place, isNew] = m_Labels.try_emplace({ label, component });
    if (isNew)
    {
      place->second.label = label;
      place->second.component = component;
      place->second.name = name;
      place->second.color = ComponentColor(label, component);
    }
    return place->second;
  }

  /** A file's own record tells which of the two kinds it is. */
  void
  LoadFile(const std::filesystem::path & path, const ProgressCallback & progress, std::vector<std::string> & notes)
  {
    ReportProgress(progress, "reading", 0);
    if (!IsMeshPath(path))
    {
      throw UsageError(path.string() + ": give .vtp files that 'voxelcore core' or 'voxelcore skeleton' wrote, or a " +
                       "mesh (.vtk .ply .stl .obj .off)");
    }
    if (auto plain = ReadPlainSurface(path))
    {
      AddPlain(path, std::move(*plain), notes);
      return;
    }
    if (auto sheets = ReadSheetSurfaces(path))
    {
      AddSheets(path, std::move(*sheets));
      return;
    }
    if (auto measured = ReadMeasuredSurfaces(path))
    {
      AddMeasured(path, std::move(*measured));
      return;
    }
    std::string   provenance;
    MedialModel   surfaces;
    SkeletonModel skeletons;
    if (auto found = ReadSkeletonIfAny(path))
    {
      skeletons = std::move(*found);
      provenance = skeletons.provenance;
    }
    else
    {
      surfaces = ReadModel(path, Precision::AsSaved); // says what is wrong when it is neither
      provenance = surfaces.provenance;
    }
    for (const std::string & rounded : { skeletons.rounded, surfaces.rounded })
    {
      if (!rounded.empty())
      {
        notes.push_back(path.string() + ": " + rounded + ", as another program saved it");
      }
    }
    const CoreReport  report = ParseProvenance(provenance, path.string());
    const std::size_t parts = IsSkeleton(report) ? skeletons.parts.size() : surfaces.parts.size();
    RequireFittingProvenance(report.labels.size() == parts, path);
    if (!m_Report)
    {
      m_Report = report;
    }
    RequireSameUnit(path, report.input.geometry.unit, m_Sources.files.front(), m_Report->input.geometry.unit);
    for (std::size_t i = 0; i < parts; ++i)
    {
      const LabelRecord & record = report.labels[i];
      if (!m_Selection.Take(record.label, record.name))
      {
        continue;
      }
      DisplayLabel & label = LabelOf(record.label, record.component, record.name);
      if (IsSkeleton(report))
      {
        RefuseSecond(label.curves.positions.empty(), path, record, "curve skeleton");
        label.confidence = PointConfidence(skeletons.parts[i]);
        label.curves = std::move(skeletons.parts[i].graph);
        continue;
      }
      RefuseSecond(label.medial.core.cells.vertexCount == 0, path, record, "medial surface");
      label.medial = std::move(surfaces.parts[i]);
      if (m_Sources.erosionThickness)
      {
        const double count = static_cast<double>(parts);
        label.erosionThickness = VertexErosionThickness(label.medial.core,
                                                        report.input.geometry.spacing,
                                                        NamedPartOfProgress(progress,
                                                                            record.name,
                                                                            static_cast<double>(i) / count,
                                                                            static_cast<double>(i + 1) / count));
      }
    }
  }

  /** A file without a record is a label of its own, with a number that no other file's label has. */
  void
  AddPlain(const std::filesystem::path & path, PlainSurface && plain, std::vector<std::string> & notes)
  {
    notes.push_back(path.string() + ": has no field Provenance, so it is drawn as it is, as one label" +
                    (plain.hasRadius ? "" : "; it has no array Radius, so it is coloured by label"));
    std::int64_t value = 1;
    while (m_Labels.contains({ value, 0 }))
    {
      ++value;
    }
    const std::string name = path.stem().string();
    if (m_Selection.Take(value, name))
    {
      DisplayLabel & label = LabelOf(value, 0, name);
      label.medial.label = value;
      label.medial.core = std::move(plain.surface);
      label.hasRadius = plain.hasRadius;
    }
  }

  /** Each sheet and rod is shown as a label of its own. */
  void
  AddSheets(const std::filesystem::path & path, SheetSurfaces && read)
  {
    if (m_Sources.files.size() > 1 || m_Sources.scan)
    {
      throw UsageError(path.string() + ": sheets are drawn alone; give no other file and no --scan");
    }
    m_Report = ParseProvenance(read.provenance, path.string());
    m_AreSheets = true;
    for (SheetSurface & sheet : read.sheets)
    {
      const bool        isRod = sheet.plain.surface.cells.FaceCount() == 0;
      const std::string name = (isRod ? "rod " : "sheet ") + std::to_string(sheet.id);
      if (m_Selection.Take(sheet.id, name))
      {
        DisplayLabel & label = LabelOf(sheet.id, 0, name);
        label.medial.label = sheet.id;
        label.medial.core = std::move(sheet.plain.surface);
        label.medial.thickness = std::move(sheet.thickness);
      }
    }
  }

  /** Surfaces of labels, which have a thickness and no radius. */
  void
  AddMeasured(const std::filesystem::path & path, MeasuredSurfaces && read)
  {
    if (m_Sources.files.size() > 1 || m_Sources.scan)
    {
      throw UsageError(path.string() + ": surfaces of labels are drawn alone; give no other file and no --scan");
    }
    m_Report = ParseProvenance(read.provenance, path.string());
    for (MeasuredSurface & one : read.surfaces)
    {
      const auto & records = m_Report->labels;
      const auto   record = std::find_if(records.begin(), records.end(), [&](const LabelRecord & candidate) {
        return candidate.label == one.label && candidate.component == one.component;
      });
      RequireFittingProvenance(record != records.end(), path);
      if (m_Selection.Take(one.label, record->name))
      {
        DisplayLabel & label = LabelOf(one.label, one.component, record->name);
        label.medial.label = one.label;
        label.medial.core = std::move(one.plain.surface);
        label.medial.thickness = std::move(one.thickness);
        label.hasRadius = false;
      }
    }
  }

  static void
  RefuseSecond(bool isFirst, const std::filesystem::path & path, const LabelRecord & record, const std::string & what)
  {
    if (!isFirst)
    {
      throw UsageError(path.string() + ": another file has a " + what + " of " + LabelText(record.label, record.name) +
                       " already; give one");
    }
  }

  void
  LoadScan(std::vector<std::string> & notes, std::vector<std::string> & warnings)
  {
    if (!m_Report)
    {
      throw UsageError("--scan: " + m_Sources.files.front().string() +
                       " has no field Provenance, which says how the scan was read; give a file that has");
    }
    // The scan is the last of the files.
    const double files = static_cast<double>(m_Sources.files.size());
    StagePlan    plan(PartOfProgress(m_Progress, files / (files + 1), 1), { 1, 1, 1 });
    LabelMap     volume = ReadScanAgain(*m_Sources.scan, m_Report->parameters, notes, plan.Next("reading"));
    warnings = volume.warnings;
    RequireSameUnit(m_Sources.files.front(), m_Report->input.geometry.unit, *m_Sources.scan, volume.geometry.unit);
    EditedLabels           edited = EditLabels(std::move(volume.labels),
                                     volume.geometry,
                                     m_Report->parameters.edits,
                                     false,
                                     m_Sources.scan->string(),
                                     plan.Next("editing"));
    const ProgressCallback surfaces = plan.Next("surface");
    for (std::size_t i = 0; i < edited.labels.size(); ++i)
    {
      EditedLabel & one = edited.labels[i];
      ReportProgress(surfaces, "", static_cast<double>(i) / static_cast<double>(edited.labels.size()));
      const auto place = m_Labels.find({ one.label.value, one.component });
      if (place == m_Labels.end())
      {
        continue;
      }
      place->second.surface = LabelSurface(one.label.shape, volume.geometry);
      place->second.color = one.label.color.value_or(place->second.color);
    }
    for (const auto & [key, label] : m_Labels)
    {
      if (label.surface.triangles.empty())
      {
        notes.push_back(m_Sources.scan->string() + ": has no " + LabelText(label.label, label.name) +
                        ", so no surface is drawn of it");
      }
    }
  }

  const DisplaySources &           m_Sources;
  const ProgressCallback &         m_Progress;
  LabelSelection                   m_Selection;
  std::optional<CoreReport>        m_Report; ///< of the first file
  std::map<LabelKey, DisplayLabel> m_Labels;
  bool                             m_AreSheets = false;
};

} // namespace

DisplayContent
LoadDisplayContent(const DisplaySources &     sources,
                   std::vector<std::string> & notes,
                   std::vector<std::string> & warnings,
                   const ProgressCallback &   progress)
{
  return Loader(sources, progress).Load(notes, warnings);
}

} // namespace voxelcore
