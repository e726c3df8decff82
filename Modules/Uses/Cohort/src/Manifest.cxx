#include "voxelcore/Cohort/Manifest.h"

#include "voxelcore/Base/DidYouMean.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Report/CsvText.h"
#include "voxelcore/Report/Sha256.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <numeric>
#include <tuple>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

bool
IsLetterOrDigit(char c)
{
  return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

std::string
ReadText(const fs::path & path)
{
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string   text{ std::istreambuf_iterator<char>(file), {} };
  if (!file)
  {
    throw InputError(path.string() + ": cannot read: " + std::strerror(errno != 0 ? errno : EIO));
  }
  return text;
}

enum class Column
{
  Id,
  Scan,
  Note,
  Option
};

struct ColumnRole
{
  Column            kind = Column::Note;
  const Parameter * option = nullptr;
};

std::string
Normalized(std::string text)
{
  for (char & c : text)
  {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c == '_' ? '-' : c;
  }
  return text;
}

std::string
Trimmed(const std::string & text)
{
  const auto first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/** Options that say how a batch as a whole is run. */
bool
IsOfTheBatch(std::string_view name)
{
  return name == "force" || name == "progress" || name == "quiet";
}

ColumnRole
RoleOf(const std::string & head, std::span<const Parameter> options, const std::string & where)
{
  const std::string name = WithoutFormerName("--" + Normalized(Trimmed(head))).substr(2);
  if (name == "id" || name == "participant-id")
  {
    return { Column::Id, nullptr };
  }
  if (name == "scan" || name == "note")
  {
    return { name == "scan" ? Column::Scan : Column::Note, nullptr };
  }
  std::string                   known;
  std::vector<std::string_view> names{ "id", "scan", "note" };
  for (const Parameter & parameter : options)
  {
    if (!IsOfTheBatch(parameter.name))
    {
      if (parameter.name == name)
      {
        return { Column::Option, &parameter };
      }
      known += (known.empty() ? "" : ", ") + std::string(parameter.name);
      names.push_back(parameter.name);
    }
  }
  const std::string nearest = DidYouMean(name, names);
  throw InputError(where + ": column '" + head + "' is not known" +
                   (nearest.empty() ? "; use id, scan, note and the options " + known : nearest));
}

std::vector<ColumnRole>
RolesOf(const CsvRow & head, std::span<const Parameter> options, const std::string & where)
{
  std::vector<ColumnRole>    roles;
  std::map<std::string, int> seen;
  for (const std::string & name : head.fields)
  {
    roles.push_back(RoleOf(name, options, where));
    const ColumnRole & role = roles.back();
    const std::string  key = role.kind == Column::Option ? std::string(role.option->name)
                             : role.kind == Column::Id   ? "id"
                             : role.kind == Column::Scan ? "scan"
                                                         : "";
    if (!key.empty() && ++seen[key] > 1)
    {
      throw InputError(Text(where, ": column '", key, "' is there twice; keep one"));
    }
  }
  for (const char * needed : { "id", "scan" })
  {
    if (!seen.contains(needed))
    {
      throw InputError(where + ": has no column '" + needed +
                       "'; the first line must name the columns, such as id,scan,lambda");
    }
  }
  return roles;
}

/** A relative path of a file, from the folder of the manifest; without one it still looks like a path. */
std::string
FileFrom(const fs::path & folder, const std::string & text)
{
  const std::string path = (folder / text).lexically_normal().string();
  return NamesFile(path) ? path : "./" + path;
}

/** A field of a flag; empty text for "not given". */
std::string
FlagValue(const std::string & text, const std::string & where)
{
  const std::string word = Normalized(text);
  if (word == "yes" || word == "true" || word == "1")
  {
    return "true";
  }
  if (word == "no" || word == "false" || word == "0")
  {
    return "false";
  }
  throw InputError(where + ": '" + text + "': expected yes or no");
}

/** Spreadsheets that separate fields by semicolons write 1,5 for 1.5, which would be two values. */
void
RefuseDecimalComma(const std::string & name, const std::string & text, const std::string & where)
{
  const std::size_t comma = text.find(',');
  const auto        isDigit = [&](std::size_t at) { return at < text.size() && text[at] >= '0' && text[at] <= '9'; };
  if ((name == "lambda" || name == "tolerance") && comma != std::string::npos && comma > 0 && isDigit(comma - 1) &&
      isDigit(comma + 1) && text.substr(0, comma).find_first_not_of("0123456789") == std::string::npos)
  {
    std::string point = text;
    point[comma] = '.';
    throw InputError(where + ": " + name + ": '" + text + "' may be a decimal comma; write " + point +
                     ", or give each of several values its unit");
  }
}

CohortCase
CaseFrom(const CsvRow &                  row,
         const std::vector<ColumnRole> & roles,
         const fs::path &                folder,
         const std::string &             where,
         char                            separator)
{
  CohortCase one;
  if (row.fields.size() != roles.size())
  {
    throw InputError(where + ": has " + std::to_string(row.fields.size()) + " fields, the first line " +
                     std::to_string(roles.size()) + "; write as many");
  }
  for (std::size_t i = 0; i < roles.size(); ++i)
  {
    const std::string text = Trimmed(row.fields[i]);
    if (roles[i].kind == Column::Id)
    {
      one.id = text;
    }
    else if (roles[i].kind == Column::Scan)
    {
      one.scan = text.empty() ? "" : (folder / text).lexically_normal().string();
    }
    else if (roles[i].kind == Column::Option && !text.empty())
    {
      const Parameter & option = *roles[i].option;
      if (separator == ';')
      {
        RefuseDecimalComma(std::string(option.name), text, where);
      }
      one.values[std::string(option.name)] = option.kind == ParameterKind::Flag
                                               ? FlagValue(text, where + ": " + std::string(option.name))
                                             : NamesFileOf(option, text) ? FileFrom(folder, text)
                                                                         : text;
    }
  }
  if (one.id.empty() || one.scan.empty())
  {
    throw InputError(where + ": the " + (one.id.empty() ? "id" : "scan") + " is empty; write one");
  }
  one.folder = CaseFolder(one.id);
  return one;
}

} // namespace

bool
NamesFileOf(const Parameter & option, const std::string & value)
{
  return option.kind == ParameterKind::Input || (option.name == "within" && NamesFile(value));
}

std::string
CaseFolder(const std::string & id)
{
  constexpr std::size_t kLongest = 64;
  const std::string     own = id.starts_with("sub-") && id.size() > 4 ? id.substr(4) : id;
  std::string           kept;
  for (const char c : own)
  {
    if (IsLetterOrDigit(c) || c == '-' || c == '_' || c == '/')
    {
      kept += c == '/' ? '_' : c;
    }
  }
  if (kept == own && own.size() <= kLongest)
  {
    return "sub-" + own;
  }
  return "sub-" + kept.substr(0, kLongest) + "x" + TextSha256(own).substr(0, 8);
}

std::optional<std::pair<std::size_t, std::size_t>>
CaseThatIsThereTwice(const std::vector<CohortCase> & cases)
{
  std::vector<std::size_t> order(cases.size());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(cases[a].folder, a) < std::tie(cases[b].folder, b);
  });
  std::optional<std::pair<std::size_t, std::size_t>> twice;
  for (std::size_t i = 1; i < order.size(); ++i)
  {
    if (cases[order[i]].folder == cases[order[i - 1]].folder && (!twice || order[i] < twice->second))
    {
      twice.emplace(order[i - 1], order[i]);
    }
  }
  return twice;
}

std::vector<CohortCase>
ReadManifest(const fs::path & manifest, std::span<const Parameter> options)
{
  const std::string name = manifest.string();
  std::string       text = ReadText(manifest);
  const char        separator = Normalized(manifest.extension().string()) == ".tsv" ? '\t' : FindSeparator(text);
  auto              rows = ParseCsv(text, name, separator);
  std::string().swap(text);
  if (rows.empty())
  {
    throw InputError(name + ": is empty; the first line must name the columns, such as id,scan,lambda");
  }
  const auto              roles = RolesOf(rows.front(), options, name);
  std::vector<CohortCase> cases;
  cases.reserve(rows.size() - 1);
  const auto where = [&](std::size_t row) { return name + ": line " + std::to_string(rows[row].line); };
  for (std::size_t i = 1; i < rows.size(); ++i)
  {
    cases.push_back(CaseFrom(rows[i], roles, manifest.parent_path(), where(i), separator));
    std::vector<std::string>().swap(rows[i].fields);
  }
  if (const auto twice = CaseThatIsThereTwice(cases))
  {
    throw InputError(where(twice->second + 1) + ": the id '" + cases[twice->second].id + "' is on line " +
                     std::to_string(rows[twice->first + 1].line) + " already; give each case its own");
  }
  if (cases.empty())
  {
    throw InputError(name + ": has no row below its first line");
  }
  return cases;
}

} // namespace voxelcore
