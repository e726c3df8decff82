#include "voxelcore/Report/Annotations.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/OutputFile.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Models/SkeletonModel.h"
#include "voxelcore/Report/CsvText.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>

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
  AnnotationReader(const fs::path & path, std::span<const std::string> kinds)
    : m_Path(path)
    , m_Kinds(kinds)
  {
    std::ifstream file(path, std::ios::binary);
    m_Text.assign(std::istreambuf_iterator<char>(file), {});
    if (!file)
    {
      throw InputError(path.string() + ": cannot read this file; check its name and permissions");
    }
  }

  std::vector<Annotation>
  Csv()
  {
    const auto rows = ParseCsv(m_Text, m_Path.string(), FindSeparator(m_Text));
    if (rows.empty())
    {
      throw InputError(m_Path.string() + ": is empty; expected the columns " + m_Kinds[0] + ", x, y, z, edit, name");
    }
    const auto columns = ColumnPlaces(rows[0]);
    if (!columns.contains(m_Kinds[0]) || (!columns.contains("edit") && !columns.contains("name")))
    {
      throw InputError(m_Path.string() + ": has no columns " + m_Kinds[0] +
                       " and edit; expected those of annotations.csv");
    }
    std::vector<Annotation> result;
    for (std::size_t row = 1; row < rows.size(); ++row)
    {
      m_Where = "line " + std::to_string(rows[row].line);
      const auto field = [&](const std::string & name) {
        const auto at = columns.find(name);
        return at == columns.end() || at->second >= rows[row].fields.size() ? std::string()
                                                                            : rows[row].fields[at->second];
      };
      Annotation one{ m_Where, {}, {}, field("edit"), Name(WithoutGuard(field("name"))), {} };
      if (const std::string number = field(m_Kinds[0]); !number.empty())
      {
        one.number = Number(number);
      }
      if (const std::string label = field("label"); !label.empty())
      {
        one.label = Parsed<std::int64_t>(label, "value of a label");
      }
      if (!field("x").empty() || !field("y").empty() || !field("z").empty())
      {
        one.place = Vector3{ Real(field("x")), Real(field("y")), Real(field("z")) };
      }
      result.push_back(std::move(one));
    }
    return result;
  }

  std::vector<Annotation>
  Markups()
  {
    std::vector<Annotation> result;
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
          const auto & place = point.at("position");
          Annotation   one{
            m_Where,
            {},
            Vector3{ sign * place.at(0).get<double>(), sign * place.at(1).get<double>(), place.at(2).get<double>() },
            point.value("description", ""),
            {},
            {}
          };
          const std::string label = point.value("label", "");
          const std::size_t colon = label.find(':');
          const std::string head = label.substr(0, colon);
          const auto        kind =
            ranges::find_if(m_Kinds, [&](const std::string & word) { return head.starts_with(word + " "); });
          if (kind != m_Kinds.end())
          {
            one.number = Number(head.substr(kind->size() + 1));
            one.name = colon == std::string::npos ? "" : Name(label.substr(colon + 1));
          }
          else
          {
            one.name = Name(label);
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

  template <typename TValue>
  TValue
  Parsed(const std::string & text, const std::string & expected) const
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
    return Parsed<ElementIndex>(text, "number of a " + m_Kinds[0]);
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
    if (ranges::any_of(name, [](char one) { return static_cast<unsigned char>(one) < 0x20U; }))
    {
      Fail("a name holds a line end or another control character; give it on one line");
    }
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

  const fs::path &             m_Path;
  std::span<const std::string> m_Kinds;
  std::string                  m_Text;
  std::string                  m_Where;
};

} // namespace

std::vector<Annotation>
ReadAnnotations(const fs::path & path, std::span<const std::string> kinds)
{
  AnnotationReader reader(path, kinds);
  return path.extension() == ".json" ? reader.Markups() : reader.Csv();
}

void
RefuseAnnotation(const fs::path & path, const Annotation & annotation, const std::string & why)
{
  throw InputError(path.string() + ": " + annotation.where + ": " + why);
}

void
WriteAnnotations(const fs::path &                   csv,
                 const fs::path &                   markups,
                 const std::string &                head,
                 const std::vector<AnnotationRow> & rows,
                 SpatialUnit                        unit)
{
  std::string text = head;
  Json        points = Json::array();
  for (const AnnotationRow & row : rows)
  {
    char place[120];
    (void)std::snprintf(place, sizeof(place), "%.7g,%.7g,%.7g", row.place[0], row.place[1], row.place[2]);
    text += row.columns + "," + place + "," + CsvField(row.edit) + "," + CsvField(row.name) + "\n";
    const std::string what = row.number.empty() ? "" : row.kind + " " + row.number;
    points.push_back({ { "id", std::to_string(points.size() + 1) },
                       { "label", what + (what.empty() || row.name.empty() ? "" : ": ") + row.name },
                       { "description", row.edit },
                       { "associatedNodeID", "" },
                       { "position", row.place },
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

} // namespace voxelcore
