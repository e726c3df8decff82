#include "RootAnnotations.h"

#include "voxelcore/Jobs/JobTools.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Models/SkeletonModel.h"
#include "voxelcore/Report/Annotations.h"

#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include <nlohmann/json.hpp>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

using Json = nlohmann::ordered_json;

} // namespace

std::vector<RootAnnotation>
ReadRootAnnotations(const fs::path & path)
{
  const std::string           kinds[]{ "root" };
  std::vector<RootAnnotation> result;
  for (const Annotation & one : ReadAnnotations(path, kinds))
  {
    RootEdit edit;
    try
    {
      edit = ParseRootEdit(one.edit);
    }
    catch (const UsageError & error)
    {
      RefuseAnnotation(path, one, Printable(error.what()));
    }
    edit.name = one.name;
    result.push_back({ one.where, one.number, one.place, std::move(edit) });
  }
  return result;
}

std::vector<RootEdit>
EditsOf(const std::vector<RootAnnotation> & annotations,
        const fs::path &                    path,
        const SkeletonGraph &               graph,
        const RootHierarchy &               roots,
        std::vector<std::string> &          misfits)
{
  const auto rootOf = [&](const RootAnnotation & one) {
    if (!one.tip)
    {
      return one.number && *one.number < roots.axes.size() ? *one.number : kNoRoot;
    }
    ElementIndex found = kNoRoot;
    double       nearest = std::numeric_limits<double>::infinity();
    for (ElementIndex axis = 0; axis < roots.axes.size(); ++axis)
    {
      const ElementIndex tip = roots.axes[axis].points.back();
      const double       away = Distance(graph.positions[tip], *one.tip);
      if (away <= 2 * SectionRadii(graph)[tip] && (away < nearest || (away == nearest && one.number == axis)))
      {
        nearest = away;
        found = axis;
      }
    }
    return found;
  };
  std::map<ElementIndex, const RootAnnotation *> byNumber;
  for (const RootAnnotation & one : annotations)
  {
    if (one.number && !byNumber.emplace(*one.number, &one).second)
    {
      throw InputError(path.string() + ": " + one.where + ": root " + std::to_string(*one.number) +
                       " stands twice; keep one");
    }
  }
  std::vector<RootEdit> edits;
  std::vector<char>     hasOne(roots.axes.size(), 0);
  for (const RootAnnotation & one : annotations)
  {
    if (one.edit.kind == RootEdit::Kind::None && one.edit.name.empty())
    {
      continue;
    }
    RootEdit    edit = one.edit;
    std::string why;
    edit.root = rootOf(one);
    if (edit.root == kNoRoot)
    {
      why = one.tip ? "no root ends there" : "there is no such root";
    }
    else if (std::exchange(hasOne[edit.root], 1) != 0)
    {
      why = "another line is of that root";
    }
    else if (edit.other != kNoRoot)
    {
      const auto at = byNumber.find(edit.other);
      edit.other = rootOf(at == byNumber.end() ? RootAnnotation{ one.where, edit.other, {}, {} } : *at->second);
      why = edit.other == kNoRoot ? "the other root is not there" : "";
    }
    if (why.empty())
    {
      edits.push_back(std::move(edit));
      continue;
    }
    const std::string text = RootEditText(one.edit);
    misfits.push_back(path.string() + ": " + one.where + ": '" + Printable(text.empty() ? one.edit.name : text) +
                      "' is left out: " + why);
  }
  return edits;
}

RootEditing::RootEditing(const fs::path & path, const RootRules & rules)
  : m_Path(path)
  , m_Rules(rules)
{
  if (!path.empty())
  {
    m_Annotations = ReadRootAnnotations(path);
  }
}

const RootHierarchy &
RootEditing::operator()(const SkeletonGraph & graph, const RootHierarchy & roots, const BodyFrame & frame)
{
  std::vector<RootAnnotation> inFrame = m_Annotations;
  for (RootAnnotation & one : inFrame)
  {
    one.tip = one.tip ? std::optional(frame.Enter(*one.tip)) : std::nullopt;
  }
  found = roots;
  misfits.clear();
  edits = EditsOf(inFrame, m_Path, graph, roots, misfits);
  try
  {
    edited = EditRoots(graph, roots, edits, m_Rules);
  }
  catch (const UsageError & error)
  {
    throw InputError(m_Path.string() + ": " + error.what());
  }
  return edited.roots;
}

void
WriteRootAnnotations(const fs::path &      csv,
                     const fs::path &      markups,
                     const SkeletonGraph & graph,
                     const RootEditing &   editing,
                     SpatialUnit           unit,
                     HeadUnits             units)
{
  const auto & [found, edits, edited] = std::tie(editing.found, editing.edits, editing.edited);
  std::vector<RootEdit> said(found.axes.size());
  for (const RootEdit & edit : edits)
  {
    said[edit.root] = edit;
  }
  std::vector<AnnotationRow> rows;
  for (ElementIndex root = 0; root < found.axes.size(); ++root)
  {
    const std::string number = std::to_string(root);
    rows.push_back({ "root",
                     number,
                     number + "," + (edited.now[root] == kNoRoot ? "" : std::to_string(edited.now[root])),
                     graph.positions[found.axes[root].points.back()],
                     RootEditText(said[root]),
                     said[root].name });
  }
  WriteAnnotations(csv, markups, HeadLine(kAnnotationColumns, units), rows, unit);
}

std::string
RootEditsJson(const std::vector<RootEdit> & edits)
{
  Json json = Json::array();
  for (const RootEdit & edit : edits)
  {
    json.push_back({ { "root", edit.root }, { "edit", RootEditText(edit) }, { "name", edit.name } });
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace voxelcore
