#include "voxelcore/Jobs/SkeletonFiles.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/LengthUnit.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Jobs/LabelVolumes.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Models/TableColumns.h"
#include "voxelcore/Vessels/FlowFiles.h"
#include "voxelcore/Vessels/SectionTables.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

/** Plain text in the form "x y z r" a line, after their count: what the program of Yan et al. (2016) takes with a
 *  .ma. */
std::string
RadiiText(const MedialModel & surfaces)
{
  std::size_t count = 0;
  for (const ModelPart & part : surfaces.parts)
  {
    count += part.core.positions.size();
  }
  std::string text = std::to_string(count) + "\n";
  char        line[160];
  for (const ModelPart & part : surfaces.parts)
  {
    for (std::size_t v = 0; v < part.core.positions.size(); ++v)
    {
      const auto & p = part.core.positions[v];
      (void)std::snprintf(line, sizeof(line), "%.17g %.17g %.17g %.17g\n", p[0], p[1], p[2], part.core.radius[v]);
      text += line;
    }
  }
  return text;
}

std::string
CutText(const LoopCut & cut, SpatialUnit lengths)
{
  const LengthUnit unit = LengthUnit::For(cut.radius, lengths);
  const auto       at = [&](std::size_t axis) { return unit.Text(cut.position[axis]); };
  return ": a cycle was cut at " + at(0) + ", " + at(1) + ", " + at(2) + " (LPS " + unit.Name() + "), radius " +
         unit.Text(cut.radius) + " " + unit.Name();
}

} // namespace

SkeletonFiles::SkeletonFiles(fs::path output, fs::path input, SkeletonTargets wanted, OutputTransaction & transaction)
  : m_Output(std::move(output))
  , m_Input(std::move(input))
  , m_ToFolder(IsFolderOutput(m_Output))
  , m_Targets(std::move(wanted))
  , m_Transaction(transaction)
{
  const std::string extension = m_Output.extension().string();
  if (!m_ToFolder && extension != ".vtp" && extension != ".csv")
  {
    throw UsageError(
      m_Output.string() +
      ": unknown extension; a skeleton is written as .vtp, as .csv (tables alone), or into a folder ending in "
      "/; other forms by --also");
  }
  if (!m_ToFolder && extension == ".csv" && !Wants("csv"))
  {
    m_Targets.also.insert(m_Targets.also.begin(), "csv");
  }
  if (m_ToFolder && m_Targets.network)
  {
    throw UsageError(m_Output.string() + ": a network is one file; give .vtp, or .csv for tables alone");
  }
  if (const std::string option(m_Targets.NeedsOneFile()); m_ToFolder && !option.empty())
  {
    throw UsageError(option + ": all labels go into one file; give -o OUT.vtp or OUT.csv instead of a folder");
  }
  if (m_ToFolder && m_Targets.soma && m_Targets.soma->place)
  {
    throw UsageError(
      "--soma X,Y,Z: is in one label, and a folder gets a file per label; give -o OUT.vtp, or --soma auto");
  }
  if (m_Targets.centerlines && m_Targets.centerlines->extension() != ".vtp")
  {
    throw UsageError("--centerlines " + m_Targets.centerlines->string() + ": give a .vtp file");
  }
  if (m_Targets.flow && !IsFlowJson() && !IsFlowYaml() && m_Targets.flow->extension() != ".csv")
  {
    throw UsageError("--flow " + m_Targets.flow->string() +
                     ": give a .csv file, a .json file for svZeroDSolver, or a .yaml file for openBF");
  }
  m_Transaction.Protect(m_Input);
  for (const fs::path & target : FlowTargets())
  {
    m_Transaction.CheckTarget(target);
  }
  if (m_Targets.table)
  {
    m_Transaction.CheckTarget(*m_Targets.table);
  }
  for (const auto & [file, text] : m_ToFolder ? std::map<fs::path, std::string>() : Columns(SpatialUnit::Millimetres))
  {
    m_Transaction.CheckTarget(file);
  }
  if (m_ToFolder)
  {
    m_Transaction.MakeDirectory(m_Output);
  }
  if (Wants("precomputed"))
  {
    const fs::path folder = PrecomputedFolder();
    m_Transaction.MakeDirectory(folder / "names");
    m_Transaction.CheckTarget(folder / "info");
  }
  if (m_ToFolder)
  {
    return;
  }
  if (extension == ".vtp")
  {
    m_Transaction.CheckTarget(m_Output);
  }
  for (const std::string & ending : m_Targets.also)
  {
    const std::vector<fs::path> targets = ending == "precomputed" ? std::vector<fs::path>() : Beside(m_Output, ending);
    for (std::size_t i = ending == "csv" && m_Targets.table ? 1 : 0; i < targets.size(); ++i)
    {
      m_Transaction.CheckTarget(targets[i]);
    }
  }
}

bool
SkeletonFiles::IsFlowJson() const
{
  return m_Targets.flow->extension() == ".json";
}

bool
SkeletonFiles::IsFlowYaml() const
{
  return m_Targets.flow->extension() == ".yaml" || m_Targets.flow->extension() == ".yml";
}

fs::path
SkeletonFiles::BesideFlow(const char * ending) const
{
  return (m_Targets.flow->parent_path() / m_Targets.flow->stem()).string() + ending;
}

std::vector<fs::path>
SkeletonFiles::FlowTargets() const
{
  std::vector<fs::path> targets;
  if (m_Targets.centerlines)
  {
    targets.push_back(*m_Targets.centerlines);
  }
  if (m_Targets.flow)
  {
    targets.push_back(*m_Targets.flow);
    if (IsFlowYaml())
    {
      targets.push_back(BesideFlow("_inlet.dat"));
    }
    else if (!IsFlowJson())
    {
      targets.push_back(BesideFlow("_nodes.csv"));
    }
  }
  return targets;
}

void
SkeletonFiles::RequireUnit(SpatialUnit unit) const
{
  if (unit != SpatialUnit::Millimetres && m_Targets.flow && (IsFlowJson() || IsFlowYaml()))
  {
    throw InputError(m_Input.string() + ": gives no voxel size, and --flow " + m_Targets.flow->string() + " is in " +
                     (IsFlowJson() ? "centimetres" : "metres") + "; give --spacing, or a .csv file");
  }
  if (unit != SpatialUnit::Millimetres && Wants("precomputed"))
  {
    throw InputError(m_Input.string() + ": gives no voxel size, and --also precomputed is in nm; give --spacing");
  }
}

fs::path
SkeletonFiles::PrecomputedFolder() const
{
  const fs::path beside = m_ToFolder ? SkeletonTablesPath(m_Output, m_Input) : m_Output;
  return beside.parent_path() / (beside.stem().string() + "_precomputed");
}

void
SkeletonFiles::WritePrecomputed(const SkeletonModel & model)
{
  WritePrecomputedSkeletons([&](const std::string & name) { return m_Transaction.Stage(PrecomputedFolder() / name); },
                            model);
}

std::map<fs::path, std::string>
SkeletonFiles::Columns(SpatialUnit unit) const
{
  std::map<fs::path, std::string> files;
  const auto                      add = [&](const fs::path & table, const std::string & text) {
    std::string & file = files[ColumnsBeside(table)];
    file = file.empty() ? text : JoinedTables(file, text);
  };
  const fs::path    tables = m_ToFolder ? SkeletonTablesPath(m_Output, m_Input) : m_Output;
  const std::string ofSkeletons = SkeletonColumnsJson(unit, m_Targets.network, m_HasLives, m_HasNames);
  if (Wants("csv"))
  {
    add(tables, ofSkeletons);
  }
  if (m_Targets.table && !files.contains(ColumnsBeside(*m_Targets.table)))
  {
    add(*m_Targets.table, ofSkeletons);
  }
  if (m_Targets.sections)
  {
    add(tables, SectionColumnsJson(unit));
  }
  if (m_Targets.flow && !IsFlowJson() && !IsFlowYaml())
  {
    add(*m_Targets.flow, FlowColumnsJson(unit));
  }
  return files;
}

void
SkeletonFiles::WriteFlow(const CoreReport & report)
{
  if (!m_Targets.centerlines && !m_Targets.flow)
  {
    return;
  }
  InletChoice choice{ m_Targets.inlets, report.input.geometry };
  if (report.skeleton && report.skeleton->border != BorderEnds::Closed)
  {
    choice.border = PartRead(report.parameters.reading.crop, report.input.geometry);
  }
  const auto inlets = FindInlets(m_Model.parts, choice);
  if (m_Targets.centerlines)
  {
    WriteCenterlineVtp(m_Transaction.Stage(*m_Targets.centerlines),
                       SplitCenterlines(m_Model.parts, inlets),
                       m_Model.unit);
  }
  if (m_Targets.flow)
  {
    const FlowNetwork network = MakeFlowNetwork(m_Model.parts, inlets);
    const fs::path    target = m_Transaction.Stage(*m_Targets.flow);
    if (IsFlowJson())
    {
      WriteFlowJson(target, network, m_Model.parts);
    }
    else if (IsFlowYaml())
    {
      const std::string name = m_Targets.flow->stem().string();
      try
      {
        WriteFlowYaml(target, m_Transaction.Stage(BesideFlow("_inlet.dat")), name, network, m_Model.parts);
      }
      catch (const InputError & error)
      {
        throw InputError("--flow " + m_Targets.flow->string() + ": " + error.what());
      }
    }
    else
    {
      WriteFlowCsv(target,
                   m_Transaction.Stage(BesideFlow("_nodes.csv")),
                   network,
                   m_Model.parts,
                   Heads(report.input.geometry.unit));
    }
  }
}

bool
SkeletonFiles::Wants(const std::string & ending) const
{
  return std::find(m_Targets.also.begin(), m_Targets.also.end(), ending) != m_Targets.also.end();
}

std::vector<fs::path>
SkeletonFiles::Beside(const fs::path & output, const std::string & ending) const
{
  const std::string stem = (output.parent_path() / output.stem()).string();
  if (ending == "csv")
  {
    std::vector<fs::path> tables{ stem + "_branches.csv", stem + "_summary.csv" };
    if (m_Targets.network)
    {
      tables.emplace_back(stem + "_contacts.csv");
    }
    return tables;
  }
  if (ending == "ma")
  {
    return { stem + ".ma", stem + ".r" };
  }
  return { stem + "." + ending };
}

void
SkeletonFiles::Add(CoreReport &               report,
                   std::size_t                label,
                   SkeletonPart               part,
                   ModelPart                  surface,
                   std::vector<std::string> & notes)
{
  LabelRecord &     record = report.labels.at(label);
  SkeletonRecord &  skeleton = record.skeleton.value();
  const std::string text = LabelText(record.label, record.name);
  const fs::path    output = m_ToFolder ? FolderTarget(record.label, record.component) : m_Output;
  skeleton.output = output.string();
  m_HasLives = m_HasLives || !part.lives.empty();
  m_HasNames = m_HasNames || !part.names.empty();
  for (const LoopCut & cut : skeleton.cuts)
  {
    notes.push_back(text + CutText(cut, report.input.geometry.unit));
  }
  if (skeleton.numbers.closedFaces > 0)
  {
    notes.push_back(text + ": " + std::to_string(skeleton.numbers.closedFaces) +
                    " faces of closed surfaces stay: around a cavity nothing can become a curve; give --fill-cavities "
                    "for curves alone, as of a cell without its nucleus");
  }
  if (m_ToFolder && (Wants("csv") || Wants("precomputed") || m_Targets.table))
  {
    m_AllLabels.parts.push_back(part);
  }
  m_Model.parts.push_back(std::move(part));
  m_Labels.push_back(label);
  if (NeedsSurface())
  {
    m_Surfaces.parts.push_back(std::move(surface));
  }
  if (m_ToFolder)
  {
    WriteGroup(report, output, { label }, notes);
  }
}

fs::path
SkeletonFiles::FolderTarget(std::int64_t label, std::int64_t component) const
{
  return SkeletonFolderPath(m_Output, m_Input, label, component);
}

std::vector<fs::path>
SkeletonFiles::FolderTables() const
{
  auto tables = Wants("csv") ? Beside(SkeletonTablesPath(m_Output, m_Input), "csv") : std::vector<fs::path>();
  for (const auto & [file, text] : Columns(SpatialUnit::Millimetres))
  {
    tables.push_back(file);
  }
  return tables;
}

void
SkeletonFiles::AddFinished(CoreReport & report, std::size_t label)
{
  LabelRecord &    record = report.labels.at(label);
  SkeletonRecord & skeleton = record.skeleton.value();
  const fs::path   output = FolderTarget(record.label, record.component);
  SkeletonModel    model = ReadSkeletonVtp(output);
  SkeletonPart &   part = model.parts.at(0);
  part.label = record.label;
  part.component = record.component;
  part.name = record.name;
  part.table = MeasureBranches(part.graph, { report.skeleton->branches.root });
  skeleton.numbers = part.table.numbers;
  skeleton.output = output.string();
  if (Wants("csv") || Wants("precomputed") || m_Targets.table)
  {
    m_AllLabels.parts.push_back(std::move(part));
  }
}

void
SkeletonFiles::WriteTables(const fs::path & output, const SkeletonModel & model)
{
  const std::vector<fs::path> tables = Beside(output, "csv");
  if (!m_Targets.table) // which is written with the same rows
  {
    WriteBranchCsv(m_Transaction.Stage(tables[0]), model, Heads(model.unit));
  }
  WriteSummaryCsv(m_Transaction.Stage(tables[1]), model, Heads(model.unit));
  if (tables.size() > 2)
  {
    WriteContactsCsv(m_Transaction.Stage(tables[2]), model, Heads(model.unit));
  }
}

void
SkeletonFiles::WriteGroup(const CoreReport &               report,
                          const fs::path &                 output,
                          const std::vector<std::size_t> & labels,
                          std::vector<std::string> &       notes)
{
  m_Model.unit = report.input.geometry.unit;
  m_Surfaces.unit = report.input.geometry.unit;
  if (!m_Surfaces.parts.empty() && !m_Surfaces.parts.front().displacement.empty())
  {
    m_Surfaces.refined = report.parameters.refine.surface;
  }
  if (output.extension() == ".vtp")
  {
    m_Model.provenance = SkeletonProvenanceJson(report, labels);
    WriteSkeletonVtp(m_Transaction.Stage(output), m_Model);
  }
  if (m_Targets.table && !m_ToFolder)
  {
    WriteBranchCsv(m_Transaction.Stage(*m_Targets.table), m_Model, Heads(m_Model.unit));
  }
  for (const std::string & ending : m_Targets.also)
  {
    if (ending == "precomputed")
    {
      if (!m_ToFolder)
      {
        WritePrecomputed(m_Model);
      }
      continue;
    }
    const std::vector<fs::path> targets = Beside(output, ending);
    if (ending == "csv" && !m_ToFolder)
    {
      WriteTables(output, m_Model);
    }
    else if (ending == "swc")
    {
      WriteSwc(m_Transaction.Stage(targets[0]), m_Model, { report.skeleton->branches.root }, m_Targets.soma);
    }
    else if (ending == "mrk.json")
    {
      WriteMarkups(m_Transaction.Stage(targets[0]), m_Model);
    }
    else if (ending == "obj")
    {
      WriteSkeletonObj(m_Transaction.Stage(targets[0]), m_Model);
    }
    else if (ending == "graphml")
    {
      WriteGraphMl(m_Transaction.Stage(targets[0]), m_Model);
    }
    else if (ending == "ma")
    {
      ModelOptions triangles;
      triangles.triangles = true;
      WriteStagedModel(m_Transaction, targets[0], m_Surfaces, triangles, notes);
      WriteTextFile(m_Transaction.Stage(targets[1]), RadiiText(m_Surfaces));
    }
  }
  WriteFlow(report);
  m_Model = SkeletonModel();
  m_Surfaces = MedialModel();
  m_Labels.clear();
}

void
SkeletonFiles::Finish(const CoreReport & report, std::vector<std::string> & notes)
{
  m_AllLabels.unit = report.input.geometry.unit;
  if (!m_ToFolder)
  {
    const std::vector<std::size_t> labels = m_Labels;
    WriteGroup(report, m_Output, labels, notes);
  }
  else
  {
    if (Wants("csv"))
    {
      WriteTables(SkeletonTablesPath(m_Output, m_Input), m_AllLabels);
    }
    if (Wants("precomputed"))
    {
      WritePrecomputed(m_AllLabels);
    }
    if (m_Targets.table)
    {
      WriteBranchCsv(m_Transaction.Stage(*m_Targets.table), m_AllLabels, Heads(m_AllLabels.unit));
    }
  }
  for (const auto & [file, text] : Columns(m_AllLabels.unit))
  {
    WriteTextFile(m_Transaction.Stage(file), text);
  }
}

} // namespace voxelcore
