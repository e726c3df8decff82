#include "FinishedLabels.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/JsonText.h"
#include "voxelcore/Report/BuildFacts.h"
#include "voxelcore/Report/Sha256.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

using Json = nlohmann::ordered_json;

constexpr std::int64_t kTables = -1; // instead of a component

std::string
Dump(const Json & json)
{
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace

FinishedLabels::FinishedLabels(fs::path file, std::string key)
  : m_File(std::move(file))
  , m_Key(std::move(key))
{
  Open(false);
  if (m_Lock.IsOpen())
  {
    Read();
  }
}

void
FinishedLabels::Open(bool create)
{
  const auto refuse = [this](const std::string & why) { throw OutputError(m_File.string() + ": " + why); };
  m_Lock = LockedFile(m_File, create);
  if (!m_Lock.IsOpen() && (create || errno != ENOENT))
  {
    refuse(errno == EWOULDBLOCK ? "another run is writing into this folder; wait for it, or give another folder"
                                : std::string("cannot write: ") + std::strerror(errno));
  }
}

void
FinishedLabels::Read()
{
  std::ifstream     file(m_File, std::ios::binary);
  std::stringstream all;
  all << file.rdbuf();
  for (std::string text; std::getline(all, text);)
  {
    m_EndsInLine = !all.eof();
    if (std::optional<Line> line = ParseLine(text))
    {
      m_Lines.push_back(std::move(*line));
    }
  }
}

std::string
FinishedLabels::LineText(const Line & line)
{
  Json json;
  json["label"] = line.value;
  json["component"] = line.component;
  json["key"] = line.key;
  json["files"] = Json::array();
  for (const File & file : line.files)
  {
    json["files"].push_back({ { "name", file.name }, { "bytes", file.bytes }, { "sha256", file.sha256 } });
  }
  json["notes"] = line.notes;
  json["record"] = Json::parse(line.record);
  json = Json::parse(Dump(json)); // bytes that are no UTF-8 are replaced before the digest is taken
  json["sha256"] = TextSha256(Dump(json));
  return Dump(json) + "\n";
}

std::optional<FinishedLabels::Line>
FinishedLabels::ParseLine(const std::string & text)
{
  try
  {
    Json              json = Json::parse(PlainJson(text));
    const std::string digest = json.at("sha256").get<std::string>();
    json.erase("sha256");
    if (digest != TextSha256(Dump(json)))
    {
      return std::nullopt;
    }
    Line line{ json.at("key").get<std::string>(),
               json.at("label").get<std::int64_t>(),
               json.at("component").get<std::int64_t>(),
               {},
               Dump(json.at("record")),
               json.at("notes").get<std::vector<std::string>>() };
    for (const Json & file : json.at("files"))
    {
      line.files.push_back({ fs::path(file.at("name").get<std::string>()).filename().string(),
                             file.at("bytes").get<std::uint64_t>(),
                             file.at("sha256").get<std::string>() });
    }
    return line;
  }
  catch (const nlohmann::json::exception &)
  {
    return std::nullopt;
  }
}

bool
FinishedLabels::IsThere(const File & file) const
{
  const fs::path  path = m_File.parent_path() / file.name;
  std::error_code missing;
  return fs::file_size(path, missing) == file.bytes && !missing && FileSha256(path) == file.sha256;
}

std::optional<FinishedLabels::Label>
FinishedLabels::Find(std::int64_t value, std::int64_t component, const std::string & name) const
{
  const auto isThere = [this](const File & file) { return IsThere(file); };
  const auto line = std::find_if(m_Lines.rbegin(), m_Lines.rend(), [&](const Line & one) {
    return one.value == value && one.component == component && one.key == m_Key;
  });
  if (line == m_Lines.rend())
  {
    return std::nullopt;
  }
  if (!line->files.empty() && std::all_of(line->files.begin(), line->files.end(), isThere))
  {
    LabelRecord record = ParseLabelRecord(line->record);
    if (record.name == name)
    {
      return Label{ std::move(record), line->notes };
    }
  }
  RemoveUnlessOthers(*line);
  return std::nullopt;
}

// What is not whole, or no longer wanted, unless it is whole as another command left it.
void
FinishedLabels::RemoveUnlessOthers(const Line & line) const
{
  for (const File & file : line.files)
  {
    const bool isOthers = std::any_of(m_Lines.begin(), m_Lines.end(), [&](const Line & other) {
      return other.key != line.key && std::any_of(other.files.begin(), other.files.end(), [&](const File & same) {
               return same.name == file.name && IsThere(same);
             });
    });
    if (!isOthers)
    {
      std::error_code ignored; // the place is looked at again when it is written to
      fs::remove(m_File.parent_path() / file.name, ignored);
    }
  }
}

void
FinishedLabels::Finish(const Label & label, SpatialUnit unit, OutputTransaction & transaction)
{
  Append({ m_Key,
           label.record.label,
           label.record.component,
           StagedInFolder(transaction),
           LabelRecordJson(label.record, unit),
           label.notes });
  transaction.Commit();
}

bool
FinishedLabels::IsTable(const fs::path & target) const
{
  return std::any_of(m_Lines.begin(), m_Lines.end(), [&](const Line & line) {
    return line.component == kTables && std::any_of(line.files.begin(), line.files.end(), [&](const File & file) {
             return file.name == target.filename() && IsThere(file);
           });
  });
}

void
FinishedLabels::RemoveTables() const
{
  for (const Line & line : m_Lines)
  {
    for (const File & file : line.component == kTables ? line.files : std::vector<File>())
    {
      if (IsThere(file))
      {
        std::error_code ignored;
        fs::remove(m_File.parent_path() / file.name, ignored);
      }
    }
  }
}

void
FinishedLabels::NoteTables(const OutputTransaction & transaction)
{
  Line line{ "tables", 0, kTables, StagedInFolder(transaction), "{}", {} };
  if (!line.files.empty())
  {
    Append(line);
  }
}

std::vector<FinishedLabels::File>
FinishedLabels::StagedInFolder(const OutputTransaction & transaction) const
{
  std::vector<File> files;
  for (const auto & [temporary, target] : transaction.StagedFiles())
  {
    const fs::path parent = target.has_parent_path() ? target.parent_path() : fs::path(".");
    if (parent == m_File.parent_path().lexically_normal())
    {
      files.push_back({ target.filename().string(), fs::file_size(temporary), FileSha256(temporary) });
    }
  }
  return files;
}

void
FinishedLabels::Append(const Line & line)
{
  if (!m_Lock.IsOpen())
  {
    Open(true);
  }
  const std::string text = (m_EndsInLine ? "" : "\n") + LineText(line);
  m_EndsInLine = false; // until all of it is there
  if (!m_Lock.Append(text))
  {
    throw OutputError(m_File.string() + ": cannot write: " + std::strerror(errno));
  }
  m_EndsInLine = true;
}

std::string
LabelKey(const CoreReport & report, const std::string & more)
{
  std::string text = report.input.sha256 + "\n" + SourceDigest() + "\n" + more + "\n";
  // With tolerances there is one lambda.
  const std::size_t results = std::max(report.parameters.lambda.size(), report.parameters.tolerances.size());
  for (std::size_t which = 0; which < results; ++which)
  {
    text += ProvenanceJson(report, {}, which) + "\n";
  }
  return TextSha256(text + (report.skeleton ? SkeletonProvenanceJson(report, {}) : std::string()));
}

} // namespace voxelcore
