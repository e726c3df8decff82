#pragma once
// Small cohorts, and what a batch made of them.

#include "VoxelCoreTesting/TemporaryFolder.h"
#include "Program.h"
#include "Scans.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <random>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace voxelcore::testing
{

/** A few boxes; another seed, other boxes. */
inline void
WriteTinyScan(const std::filesystem::path & path, unsigned seed)
{
  std::mt19937 random(seed);
  TestScan     scan({ 12, 11, 10 });
  for (std::uint8_t label = 1; label <= 2; ++label)
  {
    const std::size_t x = 1 + random() % 4;
    const std::size_t y = 1 + random() % 4;
    scan.Fill({ x, y, 1 }, { x + 3 + random() % 4, y + 3 + random() % 3, 4 + random() % 5 }, label);
  }
  WriteNrrd(path, scan);
}

/** s0.nrrd, s1.nrrd, ... */
inline void
WriteTinyScans(const std::filesystem::path & folder, unsigned count)
{
  for (unsigned i = 0; i < count; ++i)
  {
    WriteTinyScan(folder / ("s" + std::to_string(i) + ".nrrd"), i);
  }
}

/** Of a batch into `folder`/out. */
inline ProgramResult
RunBatch(const TemporaryFolder &          folder,
         const std::vector<std::string> & more,
         const ProgramLimits &            limits = {},
         const Watcher &                  watcher = {})
{
  std::vector<std::string> arguments{ "batch", "-o", folder / "out" };
  arguments.insert(arguments.end(), more.begin(), more.end());
  return RunProgram(arguments, limits, watcher);
}

/** cases.csv without its last columns, those of times and memory, which hold no text. */
inline std::string
WithoutTimes(const std::string & table)
{
  const std::string head = table.substr(0, table.find('\n'));
  const auto last = std::count(head.begin() + static_cast<std::ptrdiff_t>(head.find(",seconds_")), head.end(), ',');
  std::istringstream lines(table);
  std::string        text;
  for (std::string line; std::getline(lines, line);)
  {
    for (std::ptrdiff_t i = 0; i < last; ++i)
    {
      line.resize(line.rfind(','));
    }
    text += line + "\n";
  }
  return text;
}

/** The text of every file below a folder, by its path; times and memory aside, and digests of what holds them. */
inline std::map<std::string, std::string>
FolderContents(const std::filesystem::path & folder, bool timesAside = true)
{
  static const std::regex            inReport(R"re("seconds": \{[^}]*\}|"peak_memory_mb": [0-9.e+-]+)re");
  static const std::regex            inRecord(R"re("seconds": [0-9.e+-]+|\n "sha256": "[0-9a-f]*")re");
  static const std::regex            ofReport(R"re((_report.json",)\s*"bytes": [0-9]+,\s*"sha256": "[0-9a-f]*")re");
  std::map<std::string, std::string> contents;
  for (const auto & entry : std::filesystem::recursive_directory_iterator(folder))
  {
    const std::string name = entry.path().lexically_relative(folder).string();
    std::string       text = entry.is_directory() ? "a folder" : ReadAll(entry.path());
    if (timesAside && name.ends_with("_report.json"))
    {
      text = std::regex_replace(text, inReport, "");
    }
    else if (timesAside && name.ends_with("_case.json"))
    {
      text = std::regex_replace(std::regex_replace(text, inRecord, ""), ofReport, "$1");
    }
    else if (timesAside && name == "cases.csv")
    {
      text = WithoutTimes(text);
    }
    contents[name] = text;
  }
  return contents;
}

} // namespace voxelcore::testing
