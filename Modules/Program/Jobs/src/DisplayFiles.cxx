#include "voxelcore/Jobs/DisplayFiles.h"

#include "DisplayLoading.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Display/HtmlPage.h"
#include "voxelcore/Display/LabelSurface.h"
#include "voxelcore/Display/SlicerScene.h"
#include "voxelcore/Jobs/DisplayTargets.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Models/DisplayColors.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

/** So many curves a person can find their way in, and Slicer too. */
constexpr std::size_t kMostCurves = 200;

constexpr const char * kDataFolder = "Data";

/** Whether the file says how its axes lie in the patient: slices and meshes never do, and readers note it where a scan
 *  does not. */
bool
HasPatientAxes(const InputRecord & input)
{
  const bool can =
    input.format.starts_with("NRRD") || input.format.starts_with("NIfTI") || input.format.starts_with("MetaImage");
  return can && std::none_of(input.notes.begin(), input.notes.end(), [](const std::string & note) {
           return note.find("taken as LPS") != std::string::npos;
         });
}

} // namespace

void
RequirePages()
{
  if (!HasHtml())
  {
    throw UsageError("--html is off in this build: install three.js (Debian: libjs-three) and configure it anew");
  }
}

LabelSurfaceMesh
SurfaceToShow(const VoxelShape & shape, const ImageGeometry & geometry)
{
  return LabelSurface(shape, geometry);
}

struct DisplayFiles::State
{
  DisplayTargets            targets;
  fs::path                  input;
  OutputTransaction &       transaction;
  ImageGeometry             geometry;
  std::vector<LabelShape>   scan;       ///< the edited labels; of components each
  std::vector<std::int64_t> components; ///< of `scan`
  std::vector<ModelPart>    surfaces;
  std::vector<SkeletonPart> skeletons; ///< each with its label
  std::vector<std::size_t>  records;   ///< of both, in the report
  fs::path                  archive;   ///< where the archive comes to be; empty for a .mrml
  bool                      byLabel = false;

  bool
  IsArchive() const
  {
    return targets.scene->extension() == ".mrb";
  }

  fs::path
  DataFolder() const
  {
    return targets.scene->parent_path() / (targets.scene->stem().string() + "_" + kDataFolder);
  }

  /** Where to write one of the scene's data files. */
  fs::path
  StageData(const std::string & name)
  {
    return IsArchive() ? archive.parent_path() / name : transaction.Stage(DataFolder() / name);
  }

  std::string
  PartName(std::int64_t label, std::int64_t component) const
  {
    return ScanName(input) + "_label-" + std::to_string(label) +
           (component > 0 ? "_component-" + std::to_string(component) : std::string());
  }

  Color
  ColorOf(std::int64_t label, std::int64_t component) const
  {
    for (std::size_t i = 0; i < scan.size(); ++i)
    {
      if (scan[i].value == label && components[i] == component && scan[i].color)
      {
        return *scan[i].color;
      }
    }
    return ComponentColor(label, component);
  }

  void
  WriteScene(const CoreReport & report, std::vector<std::string> & notes);
  void
  AddSkeletons(const CoreReport &                                   report,
               SceneDescription &                                   scene,
               const std::function<fs::path(const std::string &)> & stage,
               std::vector<std::string> &                           notes);
  ColorRange
  RangeOf(PictureColoring coloring) const;
  DisplayContent
  Content(const CoreReport & report, const ProgressCallback & progress) const;
};

DisplayFiles::DisplayFiles(const DisplayTargets & targets, const fs::path & input, OutputTransaction & transaction)
  : m_State(new State{ targets, input, transaction, {}, {}, {}, {}, {}, {}, {} })
{
  if (targets.scene)
  {
    const std::string extension = targets.scene->extension().string();
    if (extension != ".mrml" && extension != ".mrb")
    {
      throw UsageError("--scene " + targets.scene->string() + ": unknown extension; give .mrml or .mrb");
    }
    transaction.CheckTarget(*targets.scene);
    if (!m_State->IsArchive())
    {
      transaction.MakeDirectory(m_State->DataFolder());
    }
  }
  if (targets.html)
  {
    RequirePages();
    if (targets.html->extension() != ".html")
    {
      throw UsageError("--html " + targets.html->string() + ": unknown extension; give .html");
    }
    transaction.CheckTarget(*targets.html);
  }
}

DisplayFiles::~DisplayFiles() = default;

bool
DisplayFiles::AreAsked() const
{
  return m_State->targets.scene || m_State->targets.html;
}

void
DisplayFiles::OpenByLabel()
{
  m_State->byLabel = true;
}

void
DisplayFiles::AddScan(const std::vector<EditedLabel> & labels, const ImageGeometry & geometry)
{
  if (!AreAsked())
  {
    return;
  }
  m_State->geometry = geometry;
  for (const EditedLabel & one : labels)
  {
    m_State->scan.push_back(one.label);
    m_State->components.push_back(one.component);
    LabelShape & added = m_State->scan.back();
    added.color = added.color.value_or(ComponentColor(added.value, one.component));
  }
}

void
DisplayFiles::AddNetwork(const std::vector<LabelShape> & labels, const ImageGeometry & geometry)
{
  std::vector<EditedLabel> apart;
  for (std::size_t i = 0; AreAsked() && i < labels.size(); ++i)
  {
    apart.push_back({ labels[i], 0, std::nullopt });
  }
  AddScan(apart, geometry);
}

void
DisplayFiles::AddLabel(const LabelRecord & record, const ModelPart & surface, const SkeletonPart * skeleton)
{
  if (!AreAsked())
  {
    return;
  }
  const std::size_t number = m_State->records.empty() ? 0 : m_State->records.back() + 1;
  if (skeleton != nullptr && skeleton->network)
  {
    for (SkeletonPart & part : PartsByLabel(*skeleton))
    {
      m_State->surfaces.emplace_back();
      m_State->skeletons.push_back(std::move(part));
      m_State->records.push_back(number);
    }
    return;
  }
  m_State->surfaces.push_back(surface);
  m_State->skeletons.push_back(skeleton != nullptr ? *skeleton : SkeletonPart());
  m_State->records.push_back(number);
  SkeletonPart & part = m_State->skeletons.back();
  part.label = record.label;
  part.component = record.component;
  part.name = record.name;
}

void
DisplayFiles::State::AddSkeletons(const CoreReport &                                   report,
                                  SceneDescription &                                   scene,
                                  const std::function<fs::path(const std::string &)> & stage,
                                  std::vector<std::string> &                           notes)
{
  std::size_t branches = 0;
  for (const SkeletonPart & part : skeletons)
  {
    branches += part.graph.BranchCount();
  }
  if (branches > kMostCurves)
  {
    notes.push_back(targets.scene->string() + ": " + std::to_string(branches) +
                    " branches are too many for curves one by one; each label's are a model");
  }
  for (std::size_t i = 0; i < skeletons.size(); ++i)
  {
    const SkeletonPart & part = skeletons[i];
    const Color          color = ColorOf(part.label, part.component);
    const std::string    name = PartName(part.label, part.component);
    if (part.graph.positions.empty())
    {
      continue;
    }
    if (branches > kMostCurves || part.graph.BranchCount() == 0)
    {
      SkeletonModel model;
      model.parts = { part };
      model.unit = report.input.geometry.unit;
      model.provenance = SkeletonProvenanceJson(report, { records[i] });
      scene.models.push_back({ part.name + " skeleton", name + "_skeleton.vtp", color });
      WriteSkeletonVtp(stage(scene.models.back().file), model);
      continue;
    }
    for (std::size_t branch = 0; branch < part.graph.BranchCount(); ++branch)
    {
      const auto    points = part.graph.Branch(branch);
      SkeletonModel one;
      one.unit = report.input.geometry.unit;
      one.parts.emplace_back();
      one.parts[0].label = part.label;
      one.parts[0].component = part.component;
      SkeletonGraph &           graph = one.parts[0].graph;
      std::vector<ElementIndex> line;
      for (const ElementIndex point : points)
      {
        line.push_back(static_cast<ElementIndex>(graph.positions.size()));
        graph.positions.push_back(part.graph.positions[point]);
        graph.radius.push_back(SectionRadii(part.graph)[point]);
      }
      SortBranches(graph, { line }, false);
      const std::string number = std::to_string(branch);
      scene.curves.push_back({ Text(part.name, " branch ", number),
                               Text(name, "_branch-", number, ".mrk.json"),
                               part.lives.empty() ? color : LengthColor(part.lives[branch].highest) });
      WriteMarkups(stage(scene.curves.back().file), one);
    }
  }
}

void
DisplayFiles::State::WriteScene(const CoreReport & report, std::vector<std::string> & notes)
{
  SceneDescription                              scene;
  std::vector<std::pair<std::string, fs::path>> files; // of an archive
  const std::string                             root = targets.scene->stem().string();
  if (IsArchive())
  {
    archive = transaction.StageWithCompanions(*targets.scene);
  }
  const std::string folder = IsArchive() ? std::string(kDataFolder) : DataFolder().filename().string();
  const auto        stage = [&](const std::string & name) {
    fs::path path = StageData(name);
    files.emplace_back(root + "/" + folder + "/" + name, path);
    return path;
  };
  if (!scan.empty())
  {
    scene.segmentations.push_back({ ScanName(input), ScanName(input) + ".seg.nrrd", {} });
    WriteSegmentation(stage(scene.segmentations.back().file), geometry, scan);
  }
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    const ModelPart &   part = surfaces[i];
    const LabelRecord & record = report.labels.at(records[i]);
    if (part.core.cells.vertexCount == 0)
    {
      continue;
    }
    MedialModel model;
    model.parts = { part };
    model.unit = report.input.geometry.unit;
    model.refined = part.displacement.empty() ? std::string() : report.parameters.refine.surface;
    model.provenance = ProvenanceJson(report, { records[i] }, 0);
    scene.models.push_back({ record.name + " medial surface",
                             PartName(record.label, record.component) + "_medial.vtp",
                             ColorOf(record.label, record.component) });
    WriteModel(stage(scene.models.back().file), "x.vtp", model, {});
  }
  const bool areMeasured =
    !surfaces.empty() &&
    std::all_of(surfaces.begin(), surfaces.end(), [](const ModelPart & part) { return !part.thickness.empty(); });
  scene.coloring = areMeasured ? "Thickness" : "Radius";
  scene.radius = RangeOf(areMeasured ? PictureColoring::Thickness : PictureColoring::Radius);
  AddSkeletons(report, scene, stage, notes);
  for (auto * items : { &scene.segmentations, &scene.models, &scene.curves })
  {
    for (SceneItem & item : *items)
    {
      item.file.insert(0, folder + "/");
    }
  }
  if (!IsArchive())
  {
    WriteTextFile(transaction.Stage(*targets.scene), SceneXml(scene));
    return;
  }
  const fs::path description = archive.parent_path() / (root + ".mrml");
  WriteTextFile(description, SceneXml(scene));
  files.emplace(files.begin(), root + "/" + root + ".mrml", description);
  WriteZip(archive, files);
  for (const auto & [name, path] : files)
  {
    fs::remove(path); // what is left beside the archive would be taken for its companion
  }
}

/** As in pictures and pages, of all labels together. */
ColorRange
DisplayFiles::State::RangeOf(PictureColoring coloring) const
{
  std::vector<WeightedValue> values;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    DisplayLabel label;
    label.medial = surfaces[i];
    label.curves = skeletons[i].graph;
    const auto more = ShownValues(label, coloring);
    values.insert(values.end(), more.begin(), more.end());
  }
  return RangeOfShares(std::move(values));
}

DisplayContent
DisplayFiles::State::Content(const CoreReport & report, const ProgressCallback & progress) const
{
  DisplayContent content;
  content.unit = report.input.geometry.unit;
  content.labels.resize(surfaces.size());
  RunEach(
    surfaces.size(),
    [&](std::size_t i) {
      const SkeletonPart & part = skeletons[i];
      DisplayLabel &       label = content.labels[i];
      label.label = part.label;
      label.component = part.component;
      label.name = part.name;
      label.color = ColorOf(part.label, part.component);
      label.medial = surfaces[i];
      label.curves = part.graph;
      label.confidence = PointConfidence(part);
      if (label.medial.core.cells.vertexCount > 0)
      {
        label.erosionThickness = VertexErosionThickness(label.medial.core, report.input.geometry.spacing, {});
      }
      for (std::size_t k = 0; k < scan.size(); ++k)
      {
        if (scan[k].value == part.label && components[k] == part.component)
        {
          label.surface = LabelSurface(scan[k].shape, geometry);
        }
      }
    },
    [&](std::size_t done) {
      ReportProgress(progress, "page", static_cast<double>(done) / static_cast<double>(surfaces.size()));
    });
  return content;
}

void
DisplayFiles::Finish(const CoreReport & report, std::vector<std::string> & notes, const ProgressCallback & progress)
{
  if (m_State->targets.scene)
  {
    m_State->WriteScene(report, notes);
  }
  if (m_State->targets.html)
  {
    HtmlOptions options;
    options.byLabel = m_State->byLabel;
    options.title = ScanName(m_State->input);
    options.triangles = m_State->targets.htmlTriangles;
    options.anatomical = HasPatientAxes(report.input);
    const Vector3 & spacing = report.input.geometry.spacing;
    options.voxel = *std::min_element(spacing.begin(), spacing.end());
    WriteHtml(m_State->transaction.Stage(*m_State->targets.html),
              m_State->Content(report, progress),
              options,
              progress);
  }
}

} // namespace voxelcore
