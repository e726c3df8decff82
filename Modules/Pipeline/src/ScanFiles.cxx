#include "voxelcore/Error.h"
#include "voxelcore/Sha256.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <fnmatch.h>
#include <fstream>
#include <sstream>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

std::string
Lower(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::string
Trimmed(const std::string & text)
{
  const auto first = text.find_first_not_of(" \t\r\n");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::vector<fs::path>
Matching(const fs::path & directory, const std::string & pattern)
{
  std::vector<fs::path> files;
  std::error_code       ignored;
  for (const auto & entry : fs::directory_iterator(directory.empty() ? fs::path(".") : directory, ignored))
  {
    const std::string name = entry.path().filename().string();
    const bool        fits = pattern.empty() ? Lower(name).ends_with(".tif") || Lower(name).ends_with(".tiff")
                                             : fnmatch(pattern.c_str(), name.c_str(), FNM_PERIOD) == 0;
    if (fits && entry.is_regular_file())
    {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/** The files named by "name%03d.raw 1 20 1", the way NRRD and MetaImage number their slices. */
std::vector<std::string>
Numbered(const std::string & value)
{
  std::istringstream words(value);
  std::string        pattern;
  long               first = 0;
  long               last = -1;
  long               step = 1;
  words >> pattern >> first >> last;
  if (!(words >> step) || step == 0)
  {
    step = 1;
  }
  const auto               percent = pattern.find('%');
  const auto               letter = pattern.find_first_not_of("0123456789", percent + 1);
  std::vector<std::string> names;
  if (percent == std::string::npos || letter == std::string::npos || pattern[letter] != 'd')
  {
    return names;
  }
  const std::string digits = pattern.substr(percent + 1, letter - percent - 1);
  const auto        width = digits.empty() ? std::size_t{ 0 } : std::stoul(digits);
  for (long number = first; step > 0 ? number <= last : number >= last; number += step)
  {
    std::string text = std::to_string(number);
    text.insert(0, text.size() < width ? width - text.size() : 0, '0');
    names.push_back(pattern.substr(0, percent) + text + pattern.substr(letter + 1));
  }
  return names;
}

/** Names of the data files a detached header points to. */
std::vector<std::string>
DataFiles(const fs::path & header, char separator, const std::vector<std::string> & keys)
{
  std::ifstream            file(header);
  std::vector<std::string> names;
  for (std::string line; std::getline(file, line) && line.size() < 4096 && names.empty();)
  {
    const auto at = line.find(separator);
    if (at == std::string::npos ||
        std::find(keys.begin(), keys.end(), Lower(Trimmed(line.substr(0, at)))) == keys.end())
    {
      continue;
    }
    const std::string value = Trimmed(line.substr(at + 1));
    if (Lower(value).starts_with("list"))
    {
      for (std::string name; std::getline(file, name);)
      {
        names.push_back(Trimmed(name));
      }
    }
    else if (value.find('%') != std::string::npos)
    {
      names = Numbered(value);
    }
    else if (Lower(value) != "local")
    {
      names.push_back(value);
    }
  }
  return names;
}

} // namespace

std::vector<fs::path>
ScanFiles(const fs::path & scan)
{
  if (fs::is_directory(scan))
  {
    return Matching(scan, "");
  }
  if (!fs::exists(scan) && scan.filename().string().find_first_of("*?[") != std::string::npos)
  {
    return Matching(scan.parent_path(), scan.filename().string());
  }
  std::vector<fs::path>    files{ scan };
  std::vector<std::string> names;
  const std::string        extension = Lower(scan.extension().string());
  if (extension == ".nhdr")
  {
    names = DataFiles(scan, ':', { "data file", "datafile" });
  }
  else if (extension == ".mhd")
  {
    names = DataFiles(scan, '=', { "elementdatafile" });
  }
  else if (extension == ".hdr" || extension == ".img")
  {
    names.push_back(scan.stem().string() + (extension == ".hdr" ? ".img" : ".hdr"));
  }
  std::sort(names.begin(), names.end());
  for (const std::string & name : names)
  {
    const fs::path file = scan.parent_path() / name; // an absolute name stays as it is
    if (fs::is_regular_file(file))
    {
      files.push_back(file);
    }
  }
  return files;
}

} // namespace voxelcore
