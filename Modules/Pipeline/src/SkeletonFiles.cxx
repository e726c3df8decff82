#include "SkeletonFiles.h"

#include "JobTools.h"
#include "voxelcore/Error.h"
#include "voxelcore/ReportTable.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace voxelcore
{

namespace
{

/** Plain text in the form "x y z r" a line, after their count: what the program of Yan et al. (2016) takes with a .ma. */
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
      std::snprintf(line, sizeof(line), "%.17g %.17g %.17g %.17g\n", p[0], p[1], p[2], part.core.radius[v]);
      text += line;
    }
  }
  return text;
}

std::string
Fixed(double value)
{
  char text[64];
  std::snprintf(text, sizeof(text), "%.2f", value);
  return text;
}

} // namespace

void
AddBranchOptions(nlohmann::ordered_json & json, const BranchOptions & options)
{
  json["prune_branches"] = options.pruneLength      ? nlohmann::ordered_json(options.pruneLength->text)
                           : options.pruneRadii > 0 ? nlohmann::ordered_json(std::to_string(options.pruneRadii) + "r")
                                                    : nlohmann::ordered_json(nullptr);
  json["cut_loops"] = options.cutLoops;
  json["split_at_junctions"] = options.splitAtJunctions;
}

SkeletonFiles::SkeletonFiles(std::filesystem::path output,
                             const BranchOptions & options,
                             OutputTransaction &   transaction)
  : m_Output(std::move(output))
  , m_Options(options)
  , m_Transaction(transaction)
{
  if (m_Output.extension() == ".csv" && !Wants("csv"))
  {
    m_Options.also.insert(m_Options.also.begin(), "csv");
  }
  if (m_Output.extension() == ".vtp")
  {
    m_Transaction.CheckTarget(m_Output);
  }
  for (const std::string & ending : m_Options.also)
  {
    if (ending == "csv")
    {
      for (const char * table : { "_branches.csv", "_summary.csv", "_columns.json" })
      {
        m_Transaction.CheckTarget(Beside(table));
      }
    }
    else
    {
      m_Transaction.CheckTarget(Beside("." + ending));
      if (ending == "ma")
      {
        m_Transaction.CheckTarget(Beside(".r"));
      }
    }
  }
}

bool
SkeletonFiles::Wants(const std::string & ending) const
{
  return std::find(m_Options.also.begin(), m_Options.also.end(), ending) != m_Options.also.end();
}

std::filesystem::path
SkeletonFiles::Beside(const std::string & ending) const
{
  return std::filesystem::path(m_Output).replace_extension().string() + ending;
}

MeasureOptions
SkeletonFiles::Measuring() const
{
  MeasureOptions measuring;
  measuring.root = m_Options.root;
  measuring.radiusShift = 0.25 * std::sqrt(spacing[0] * spacing[0] + spacing[1] * spacing[1] + spacing[2] * spacing[2]);
  return measuring;
}

void
SkeletonFiles::Add(SkeletonPart part, const std::optional<TopologyNumbers> & shape, const ModelPart * surface)
{
  if (m_Options.cutLoops)
  {
    for (const LoopCut & cut : CutLoops(part.graph))
    {
      notes.push_back(LabelText(part.label, part.name) + ": a cycle was cut at " + Fixed(cut.position[0]) + ", " +
                      Fixed(cut.position[1]) + ", " + Fixed(cut.position[2]) + " (LPS mm), radius " +
                      Fixed(cut.radius) + " mm");
    }
  }
  if (m_Options.splitAtJunctions)
  {
    SplitAtJunctions(part.graph);
  }
  part.table = MeasureBranches(part.graph, Measuring());
  if (part.table.numbers.closedFaces > 0)
  {
    notes.push_back(LabelText(part.label, part.name) + ": " + std::to_string(part.table.numbers.closedFaces) +
                    " faces of closed surfaces stay: around a cavity nothing can become a curve");
  }
  model.parts.push_back(std::move(part));
  m_Shapes.push_back(shape);
  if (surface != nullptr && Wants("ma"))
  {
    m_Surfaces.parts.push_back(*surface);
  }
}

void
SkeletonFiles::AddNames()
{
  auto json = nlohmann::ordered_json::parse(model.provenance);
  json["labels"] = nlohmann::ordered_json::array();
  for (const SkeletonPart & part : model.parts)
  {
    json["labels"].push_back({ { "label", part.label }, { "component", part.component }, { "name", part.name } });
  }
  model.provenance = json.dump();
}

SkeletonResult
SkeletonFiles::Write()
{
  if (Wants("ma") && m_Surfaces.parts.empty())
  {
    throw UsageError("--also ma: needs the medial surface; give it to 'voxelcore skeleton'");
  }
  if (m_Output.extension() == ".vtp")
  {
    AddNames();
    WriteSkeletonVtp(m_Transaction.Stage(m_Output), model);
  }
  for (const std::string & ending : m_Options.also)
  {
    if (ending == "csv")
    {
      WriteBranchCsv(m_Transaction.Stage(Beside("_branches.csv")), model);
      WriteSummaryCsv(m_Transaction.Stage(Beside("_summary.csv")), model);
      WriteTextFile(m_Transaction.Stage(Beside("_columns.json")), SkeletonColumnsJson());
    }
    else if (ending == "swc")
    {
      WriteSwc(m_Transaction.Stage(Beside(".swc")), model, Measuring());
    }
    else if (ending == "mrk.json")
    {
      WriteMarkups(m_Transaction.Stage(Beside(".mrk.json")), model);
    }
    else if (ending == "graphml")
    {
      WriteGraphMl(m_Transaction.Stage(Beside(".graphml")), model);
    }
    else if (ending == "ma")
    {
      ModelOptions triangles;
      triangles.triangles = true;
      WriteStagedModel(m_Transaction, Beside(".ma"), m_Surfaces, triangles, notes);
      WriteTextFile(m_Transaction.Stage(Beside(".r")), RadiiText(m_Surfaces));
    }
  }
  std::vector<std::vector<std::string>> rows{ { "label",
                                                "name",
                                                "branches",
                                                "tips",
                                                "junctions",
                                                "cycles",
                                                "length mm",
                                                "mean radius mm",
                                                "shape chi/b0/b1/b2" } };
  for (std::size_t i = 0; i < model.parts.size(); ++i)
  {
    const SkeletonPart &    part = model.parts[i];
    const SkeletonNumbers & n = part.table.numbers;
    rows.push_back({ std::to_string(part.label),
                     part.name,
                     std::to_string(n.branches),
                     std::to_string(n.tips),
                     std::to_string(n.junctions),
                     std::to_string(n.cycles),
                     Fixed(n.totalLength),
                     Fixed(n.meanRadius),
                     m_Shapes[i] ? TopologyText(*m_Shapes[i]) : "-" });
  }
  return { FormatTable(rows), warnings, notes };
}

} // namespace voxelcore
