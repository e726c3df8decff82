#include "voxelcore/Cohort/CaseRecord.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/JsonText.h"
#include "voxelcore/Base/TemporaryNames.h"
#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Jobs/OutputTransaction.h"
#include "voxelcore/Report/BuildFacts.h"
#include "voxelcore/Report/CoreReport.h"
#include "voxelcore/Report/Sha256.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

using Json = nlohmann::ordered_json;

std::string
RecordText(const Json & json)
{
  return json.dump(1, ' ', false, Json::error_handler_t::replace);
}

/** Lists of label names belong to what a result depends on. */
std::string
NamesDigest(const fs::path & scan)
{
  std::string digests;
  for (const fs::path & list : LabelListFiles(scan))
  {
    digests += list.extension().string() + " " + FileSha256(list) + "\n";
  }
  return digests;
}

std::set<fs::path>
FilesOf(const fs::path & folder)
{
  std::set<fs::path> files;
  const std::string  start = folder.filename().string() + "_";
  std::error_code    error; // whoever removes folder or files while a case runs, costs this case alone
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
  {
    std::error_code gone;
    if (entry->path().filename().string().starts_with(start) && !fs::is_directory(entry->symlink_status(gone)))
    {
      files.insert(entry->path());
    }
  }
  return files;
}

} // namespace

std::string
CaseKey(const fs::path &              scan,
        const std::string &           options,
        const ReadOptions &           reading,
        const std::vector<fs::path> & masks)
{
  return CaseKeyOf(ScanSha256(scan, reading), scan, options, masks);
}

std::string
CaseKeyOf(const std::string &           digest,
          const fs::path &              scan,
          const std::string &           options,
          const std::vector<fs::path> & masks)
{
  std::string text = digest + "\n" + NamesDigest(scan) + SourceDigest() + "\n" + options;
  for (const fs::path & mask : masks)
  {
    text += "mask " + ScanSha256(mask) + "\n";
  }
  return TextSha256(text);
}

fs::path
RecordPath(const fs::path & folder)
{
  return folder / (folder.filename().string() + "_case.json");
}

std::vector<RecordedFile>
ListOutputs(const fs::path & folder)
{
  std::vector<RecordedFile> outputs;
  for (const fs::path & file : FilesOf(folder))
  {
    const std::string name = file.filename().string();
    if (file != RecordPath(folder) && !WriterOf(file)) // none that is being written
    {
      std::error_code gone; // then the digest says so
      const auto      bytes = fs::file_size(file, gone);
      outputs.push_back({ name, bytes, FileSha256(file) });
    }
  }
  return outputs;
}

void
WriteCaseRecord(const fs::path & folder, const CaseRecord & record, TemporaryRegistry * temporaries)
{
  Json json;
  json["id"] = record.id;
  json["scan"] = record.scan;
  json["key"] = record.key;
  json["version"] = VoxelCoreVersion();
  json["sources"] = SourceDigest();
  json["status"] = record.done ? "done" : "failed";
  json["reason"] = record.reason;
  json["warnings"] = record.warnings;
  json["outputs"] = Json::array();
  for (const RecordedFile & output : record.outputs)
  {
    json["outputs"].push_back({ { "name", output.name }, { "bytes", output.bytes }, { "sha256", output.sha256 } });
  }
  json["seconds"] = record.seconds;
  // What was replaced (bytes that are no UTF-8) must be what the digest is of.
  json = Json::parse(RecordText(json));
  json["sha256"] = TextSha256(RecordText(json));
  OutputTransaction transaction(true, temporaries);
  WriteTextFile(transaction.Stage(RecordPath(folder)), RecordText(json) + "\n");
  transaction.Commit();
}

bool
WriteRecordIfThere(const fs::path & folder, const CaseRecord & record, TemporaryRegistry * temporaries)
{
  try
  {
    WriteCaseRecord(folder, record, temporaries);
    return true;
  }
  catch (const OutputError &)
  {
    std::error_code error;
    if (fs::is_directory(folder, error))
    {
      throw;
    }
    return false;
  }
}

std::optional<CaseRecord>
ReadCaseRecord(const fs::path & folder)
{
  std::ifstream     file(RecordPath(folder), std::ios::binary);
  const std::string text{ std::istreambuf_iterator<char>(file), {} };
  try
  {
    Json              json = Json::parse(PlainJson(text));
    const std::string digest = json.at("sha256").get<std::string>();
    json.erase("sha256");
    if (digest != TextSha256(RecordText(json)))
    {
      return std::nullopt;
    }
    CaseRecord record;
    json.at("id").get_to(record.id);
    json.at("scan").get_to(record.scan);
    json.at("key").get_to(record.key);
    record.done = json.at("status") == "done";
    json.at("reason").get_to(record.reason);
    json.at("warnings").get_to(record.warnings);
    json.at("seconds").get_to(record.seconds);
    for (const Json & output : json.at("outputs"))
    {
      record.outputs.push_back({ output.at("name").get<std::string>(),
                                 output.at("bytes").get<std::uint64_t>(),
                                 output.at("sha256").get<std::string>() });
    }
    return record;
  }
  catch (const nlohmann::json::exception &)
  {
    return std::nullopt;
  }
}

std::string
ScanDigestOfResults(const fs::path & folder)
{
  std::ifstream     file(folder / (folder.filename().string() + "_report.json"), std::ios::binary);
  const std::string text{ std::istreambuf_iterator<char>(file), {} };
  try
  {
    const Json report = Json::parse(PlainJson(text));
    return report.at(report.contains("input") ? "input" : "a").at("sha256").get<std::string>();
  }
  catch (const nlohmann::json::exception &)
  {
    return "";
  }
}

bool
IsDone(const fs::path & folder, const std::string & key)
{
  const auto record = ReadCaseRecord(folder);
  if (!record || !record->done || record->key != key)
  {
    return false;
  }
  try
  {
    return std::all_of(record->outputs.begin(), record->outputs.end(), [&](const RecordedFile & output) {
      const fs::path  path = folder / fs::path(output.name).filename();
      std::error_code missing;
      return fs::file_size(path, missing) == output.bytes && !missing && FileSha256(path) == output.sha256;
    });
  }
  catch (const InputError &)
  {
    return false; // what cannot be read is made again
  }
}

void
ClearCase(const fs::path & folder)
{
  std::error_code ignored;
  fs::remove(RecordPath(folder), ignored);
  for (const fs::path & file : FilesOf(folder))
  {
    std::error_code error;
    fs::remove(file, error);
    if (error)
    {
      throw OutputError(file.string() + ": cannot remove: " + error.message());
    }
  }
}

} // namespace voxelcore
