#include "RootAnnotations.h"

#include "voxelcore/Jobs/JobTools.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Models/SkeletonModel.h"
#include "voxelcore/Report/CsvText.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <tuple>

#include <nlohmann/json.hpp>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

using Json = nlohmann::ordered_json;

constexpr std::size_t  kLongestName = 200;
constexpr const char * kSchema =
  "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/"
  "markups-schema-v1.0.3.json#";

/** Reads one annotation after another; errors name file and place. */
class AnnotationReader
{
public:
  explicit AnnotationReader(const fs::path & path)
    : m_Path(path)
  {
    std::ifstream file(path, std::ios::binary);
    m_Text.assign(std::istreambuf_iterator<char>(file), {});
    if (!file)
    {
      throw InputError(path.string() + ": cannot read this file; check its name and permissions");
    }
  }

  std::vector<RootAnnotation>
  Csv()
  {
    const auto rows = ParseCsv(m_Text, m_Path.string(), FindSeparator(m_Text));
    if (rows.empty())
    {
      throw InputError(m_Path.string() + ": is empty; expected the columns root, x, y, z, edit, name");
    }
    const auto columns = ColumnPlaces(rows[0]);
    if (!columns.contains("root") || (!columns.contains("edit") && !columns.contains("name")))
    {
      throw InputError(m_Path.string() + ": has no columns root and edit; expected those of annotations.csv");
    }
    std::vector<RootAnnotation> result;
    for (std::size_t row = 1; row < rows.size(); ++row)
    {
      m_Where = "line " + std::to_string(rows[row].line);
      const auto field = [&](const char * name) {
        const auto at = columns.find(name);
        return at == columns.end() || at->second >= rows[row].fields.size() ? std::string()
                                                                            : rows[row].fields[at->second];
      };
      RootAnnotation one{ m_Where, {}, {}, Edit(field("edit")) };
      one.edit.name = Name(WithoutGuard(field("name")));
      if (const std::string number = field("root"); !number.empty())
      {
        one.number = Number(number);
      }
      if (!field("x").empty() || !field("y").empty() || !field("z").empty())
      {
        one.tip = Vector3{ Real(field("x")), Real(field("y")), Real(field("z")) };
      }
      result.push_back(std::move(one));
    }
    return result;
  }

  std::vector<RootAnnotation>
  Markups()
  {
    std::vector<RootAnnotation> result;
    try
    {
      // Members in order would be searched one by one.
      const auto json = nlohmann::json::parse(m_Text);
      for (const auto & list : json.at("markups"))
      {
        const double sign = list.value("coordinateSystem", "LPS") == "RAS" ? -1 : 1;
        for (const auto & point : list.at("controlPoints"))
        {
          m_Where = "point " + std::to_string(result.size() + 1);
          const auto &   place = point.at("position");
          RootAnnotation one{
            m_Where,
            {},
            Vector3{ sign * place.at(0).get<double>(), sign * place.at(1).get<double>(), place.at(2).get<double>() },
            Edit(point.value("description", ""))
          };
          const std::string label = point.value("label", "");
          const std::size_t colon = label.find(':');
          const std::string head = label.substr(0, colon);
          if (head.starts_with("root "))
          {
            one.number = Number(head.substr(5));
            one.edit.name = colon == std::string::npos ? "" : Name(label.substr(colon + 1));
          }
          else
          {
            one.edit.name = Name(label);
          }
          result.push_back(std::move(one));
        }
      }
    }
    catch (const nlohmann::json::exception & error)
    {
      throw InputError(m_Path.string() + ": is no point list of 3D Slicer: " + Printable(error.what()));
    }
    return result;
  }

private:
  [[noreturn]] void
  Fail(const std::string & what) const
  {
    throw InputError(m_Path.string() + ": " + m_Where + ": " + what);
  }

  RootEdit
  Edit(const std::string & text) const
  {
    try
    {
      return ParseRootEdit(text);
    }
    catch (const UsageError & error)
    {
      Fail(Printable(error.what()));
    }
  }

  template <typename TValue>
  TValue
  Parsed(const std::string & text, const char * expected) const
  {
    TValue value{};
    const auto [end, error] = from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
    {
      Fail("'" + Printable(text) + "' is no " + expected);
    }
    return value;
  }

  ElementIndex
  Number(const std::string & text) const
  {
    return Parsed<ElementIndex>(text, "number of a root");
  }

  double
  Real(const std::string & text) const
  {
    const auto value = Parsed<double>(text, "coordinate");
    if (!std::isfinite(value))
    {
      Fail("'" + Printable(text) + "' is no coordinate");
    }
    return value;
  }

  std::string
  Name(const std::string & text) const
  {
    const auto  first = text.find_first_not_of(" \t\r");
    std::string name = first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") + 1 - first);
    if (name.size() > kLongestName)
    {
      Fail("a name is longer than " + std::to_string(kLongestName) + " bytes");
    }
    return name;
  }

  /** The apostrophe that keeps a spreadsheet from computing text is not the text's. */
  static std::string
  WithoutGuard(const std::string & text)
  {
    const bool isGuarded =
      text.size() > 1 && text[0] == '\'' &&
      (std::string_view("=+-@").find(text[1]) != std::string_view::npos || static_cast<unsigned char>(text[1]) < 0x20U);
    return isGuarded ? text.substr(1) : text;
  }

  const fs::path & m_Path;
  std::string      m_Text;
  std::string      m_Where;
};

} // namespace

std::vector<RootAnnotation>
ReadRootAnnotations(const fs::path & path)
{
  AnnotationReader reader(path);
  return path.extension() == ".json" ? reader.Markups() : reader.Csv();
}

std::vector<RootEdit>
EditsOf(const std::vector<RootAnnotation> & annotations,
        const fs::path &                    path,
        const SkeletonGraph &               graph,
        const RootHierarchy &               roots)
{
  const auto rootOf = [&](const RootAnnotation & one) {
    if (!one.tip)
    {
      if (!one.number || *one.number >= roots.axes.size())
      {
        throw InputError(path.string() + ": " + one.where + ": there is no such root; roots are 0 to " +
                         std::to_string(roots.axes.size() - 1));
      }
      return *one.number;
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
    if (found == kNoRoot)
    {
      throw InputError(path.string() + ": " + one.where +
                       ": no root ends there; give the file that was made of this scan with these options");
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
  for (const RootAnnotation & one : annotations)
  {
    if (one.edit.kind == RootEdit::Kind::None && one.edit.name.empty())
    {
      continue;
    }
    RootEdit edit = one.edit;
    edit.root = rootOf(one);
    if (edit.other != kNoRoot)
    {
      const auto at = byNumber.find(edit.other);
      edit.other = rootOf(at == byNumber.end() ? RootAnnotation{ one.where, edit.other, {}, {} } : *at->second);
    }
    edits.push_back(std::move(edit));
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
  edits = EditsOf(inFrame, m_Path, graph, roots);
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
  std::string text = HeadLine(kAnnotationColumns, units);
  Json        points = Json::array();
  for (ElementIndex root = 0; root < found.axes.size(); ++root)
  {
    const Vector3 &   tip = graph.positions[found.axes[root].points.back()];
    const std::string number = std::to_string(root);
    const std::string edit = RootEditText(said[root]);
    char              place[120];
    (void)std::snprintf(place, sizeof(place), "%.7g,%.7g,%.7g", tip[0], tip[1], tip[2]);
    const std::string now = edited.now[root] == kNoRoot ? "" : std::to_string(edited.now[root]);
    for (const std::string & field : { number, now, std::string(place), edit })
    {
      text += field;
      text += ',';
    }
    text += CsvField(said[root].name);
    text += '\n';
    points.push_back({ { "id", std::to_string(root + 1) },
                       { "label", "root " + number + (said[root].name.empty() ? "" : ": " + said[root].name) },
                       { "description", edit },
                       { "associatedNodeID", "" },
                       { "position", tip },
                       { "selected", true },
                       { "locked", false },
                       { "visibility", true },
                       { "positionStatus", "defined" } });
  }
  WriteTextFile(csv, text);
  const Json json{ { "@schema", kSchema },
                   { "markups",
                     Json::array({ { { "type", "Fiducial" },
                                     { "coordinateSystem", "LPS" },
                                     { "coordinateUnits", UnitName(unit) },
                                     { "controlPoints", std::move(points) } } }) } };
  WriteTextFile(markups, json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
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
