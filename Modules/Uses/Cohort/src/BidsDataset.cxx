#include "BidsDataset.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/JsonText.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/OutputFile.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Report/CsvText.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

using Json = nlohmann::ordered_json;

bool
IsWord(std::string_view text)
{
  return !text.empty() && ranges::all_of(text, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; });
}

/** "acq-hr" is a key and a label, both of letters and digits. */
bool
IsEntity(std::string_view part)
{
  const std::size_t dash = part.find('-');
  return dash != std::string_view::npos && IsWord(part.substr(0, dash)) && IsWord(part.substr(dash + 1));
}

std::string
LettersAndDigits(std::string text)
{
  std::erase_if(text, [](char c) { return !IsWord({ &c, 1 }); });
  return text;
}

/** The folder of the dataset that a scan lies in. */
std::optional<fs::path>
SourceOf(const fs::path & scan)
{
  std::error_code ignored;
  for (fs::path folder = fs::absolute(scan).parent_path(); folder.has_relative_path(); folder = folder.parent_path())
  {
    if (fs::exists(folder / "dataset_description.json", ignored))
    {
      return folder;
    }
  }
  return std::nullopt;
}

std::string
ReadAll(const fs::path & path)
{
  std::ifstream file(path, std::ios::binary);
  std::string   text{ std::istreambuf_iterator<char>(file), {} };
  if (!file)
  {
    throw InputError(path.string() + ": cannot read this file; run the batch again");
  }
  return text;
}

/** "skeletonBranches" of "skeleton_branches". */
std::string
SuffixOf(const std::string & name)
{
  std::string suffix;
  bool        isNext = false;
  for (const char c : name)
  {
    if (IsWord({ &c, 1 }))
    {
      suffix += isNext ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    }
    isNext = !IsWord({ &c, 1 }) && !suffix.empty();
  }
  return suffix;
}

/** A table as BIDS has it; `names` receives its columns. */
std::string
TsvOf(const fs::path & table, std::vector<std::string> & names)
{
  auto rows = ParseCsv(ReadAll(table), table.string());
  if (rows.empty())
  {
    throw InputError(table.string() + ": is empty; run the batch again");
  }
  for (const auto & [name, place] : ColumnPlaces(rows.front()))
  {
    rows.front().fields[place] = name;
  }
  names = rows.front().fields;
  std::string text;
  for (CsvRow & row : rows)
  {
    for (std::size_t i = 0; i < row.fields.size(); ++i)
    {
      ranges::replace_if(
        row.fields[i],
        [](char c) { return c == '\t' || c == '\n' || c == '\r'; },
        ' ');
      text += (i > 0 ? "\t" : "") + (row.fields[i].empty() ? "n/a" : row.fields[i]);
    }
    text += "\n";
  }
  return text;
}

/** What the columns of a table mean: that of the descriptions which has these columns. */
Json
MeaningOf(const std::vector<std::string> & names, const std::vector<Json> & descriptions)
{
  for (const Json & tables : descriptions)
  {
    for (const auto & [table, columns] : tables.items())
    {
      std::vector<std::string> known;
      for (const auto & [name, told] : columns.items())
      {
        known.push_back(name);
      }
      if (known == names)
      {
        return columns;
      }
    }
  }
  throw Error("a table has columns that nothing describes");
}

void
LinkOrCopy(const fs::path & from, const fs::path & to)
{
  std::error_code error;
  fs::create_hard_link(from, to, error);
  if (error) // not on every file system, nor from one to another
  {
    fs::copy_file(from, to, error);
  }
  if (error)
  {
    FailOutput(to, error.value());
  }
}

class CaseOfDataset
{
public:
  CaseOfDataset(const fs::path & target, const fs::path & folder, const CaseRecord & record)
    : m_Folder(folder)
    , m_Record(record)
    , m_Prefix(folder.filename().string() + "_")
  {
    const BidsPlace place = BidsPlaceOf(record.scan, folder.filename().string());
    m_Start = target / place.folder / (place.entities + "_");
    std::error_code error;
    fs::create_directories(m_Start.parent_path(), error);
    if (error)
    {
      FailOutput(m_Start.parent_path(), error.value());
    }
    const auto source = SourceOf(record.scan);
    m_Sources = Json::array({ source ? "bids:source:" + fs::relative(record.scan, *source).generic_string()
                                     : fs::path(record.scan).filename().string() });
  }

  void
  Write() const
  {
    std::vector<Json> descriptions;
    for (const RecordedFile & output : m_Record.outputs)
    {
      if (output.name.ends_with("_columns.json"))
      {
        descriptions.push_back(Json::parse(ReadAll(m_Folder / output.name)));
      }
    }
    for (const RecordedFile & output : m_Record.outputs)
    {
      if (output.name.starts_with(m_Prefix) && !output.name.ends_with("_columns.json"))
      {
        WriteOne(output.name, descriptions);
      }
    }
  }

private:
  void
  WriteOne(const std::string & name, const std::vector<Json> & descriptions) const
  {
    const std::string own = name.substr(m_Prefix.size());
    const std::size_t dot = std::min(own.find('.'), own.size());
    const std::string ending = own.substr(dot);
    const std::string start = m_Start.string() + SuffixOf(own.substr(0, dot));
    if (ending == ".csv")
    {
      std::vector<std::string> names;
      WriteTextFile(start + ".tsv", TsvOf(m_Folder / name, names));
      WriteTextFile(start + ".json", MeaningOf(names, descriptions).dump(2) + "\n");
      return;
    }
    LinkOrCopy(m_Folder / name, start + ending);
    std::error_code ignored;
    if (!ending.ends_with(".json") && !fs::exists(start + ".json", ignored))
    {
      WriteTextFile(start + ".json", Json{ { "Sources", m_Sources } }.dump(2) + "\n");
    }
  }

  fs::path           m_Folder;
  const CaseRecord & m_Record;
  std::string        m_Prefix;
  fs::path           m_Start;
  Json               m_Sources;
};

/** \throws InputError where the names of two cases would be the same */
class TakenPlaces
{
public:
  void
  Add(const std::string & scan, const std::string & caseFolder)
  {
    const BidsPlace place = BidsPlaceOf(scan, caseFolder);
    const auto [there, isNew] = m_Scans.emplace(place.folder + "/" + place.entities, scan);
    if (!isNew)
    {
      throw InputError(scan + ": with --bids its results would have the names of those of " + there->second + ", " +
                       place.entities + "; rename one scan, so that an entity such as acq- tells them apart");
    }
  }

private:
  std::map<std::string, std::string> m_Scans;
};

} // namespace

BidsPlace
BidsPlaceOf(const std::string & scan, const std::string & caseFolder)
{
  constexpr std::array<std::string_view, 8> datatypes{ "anat", "func", "dwi", "fmap", "pet", "perf", "micr", "ct" };
  const fs::path                            path(scan);
  const std::string                         name = path.filename().string();
  const auto                                parts = SplitText(name.substr(0, name.find('.')), '_');
  BidsPlace                                 place;
  std::string                               session;
  const bool isNamed = !parts.empty() && parts.front().starts_with("sub-") && IsEntity(parts.front());
  if (!isNamed)
  {
    const std::string subject = LettersAndDigits(caseFolder.substr(caseFolder.find('-') + 1));
    place.entities = "sub-" + subject;
    place.folder = place.entities;
  }
  bool hasDesc = false;
  for (const std::string_view part : isNamed ? parts : decltype(parts)())
  {
    if (!IsEntity(part))
    {
      continue; // the suffix
    }
    place.entities += (place.entities.empty() ? "" : "_") + std::string(part);
    hasDesc = hasDesc || part.starts_with("desc-");
    if (part.starts_with("sub-"))
    {
      place.folder = part;
    }
    else if (part.starts_with("ses-"))
    {
      session = part;
    }
  }
  place.entities += hasDesc ? "" : "_desc-voxelcore";
  place.folder += session.empty() ? "" : "/" + session;
  const std::string datatype = path.parent_path().filename().string();
  place.folder += "/" + (ranges::find(datatypes, datatype) != datatypes.end() ? datatype : "anat");
  return place;
}

void
RequireBidsPlaces(const std::vector<CohortCase> & cases)
{
  TakenPlaces taken;
  for (const CohortCase & one : cases)
  {
    taken.Add(one.scan, one.folder);
  }
}

void
WriteBidsDataset(const fs::path &                                                target,
                 const fs::path &                                                folder,
                 const std::string &                                             description,
                 const std::vector<std::pair<std::string, const CaseRecord *>> & cases)
{
  std::error_code error;
  fs::create_directory(target, error);
  if (error)
  {
    FailOutput(target, error.value());
  }
  TakenPlaces        taken;
  std::set<fs::path> sources;
  for (const auto & [name, record] : cases)
  {
    taken.Add(record->scan, name);
    CaseOfDataset(target, folder / name, *record).Write();
    if (const auto source = SourceOf(record->scan))
    {
      sources.insert(*source);
    }
  }
  Json json = Json::parse(description);
  if (sources.size() == 1)
  {
    json["DatasetLinks"] = { { "source", fs::relative(*sources.begin(), folder / "bids").generic_string() } };
  }
  WriteTextFile(target / "dataset_description.json", json.dump(2) + "\n");
  WriteTextFile(target / "README",
                "Medial surfaces, curve skeletons and their measures, written by voxelcore batch.\n");
}

} // namespace voxelcore
