// Inputs of a batch that are no manifests: scans, patterns, folders.

#include "voxelcore/Base/Error.h"
#include "voxelcore/Cohort/CaseRecord.h"
#include "voxelcore/Cohort/Manifest.h"
#include "voxelcore/Formats/FormatOpeners.h"
#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Jobs/SystemFiles.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

/** A scan's path and the parts of it that may go into its id. Of tens of thousands, paths are kept as text. */
struct Found
{
  std::string scan;
  std::string id;
};

std::string
Lower(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

bool
EndsInOneOf(const fs::path & path, std::initializer_list<const char *> endings)
{
  const std::string name = Lower(path.filename().string());
  return std::any_of(endings.begin(), endings.end(), [&](const char * ending) { return name.ends_with(ending); });
}

bool
IsVolume(const fs::path & path)
{
  return EndsInOneOf(path,
                     { ".nrrd",
                       ".nhdr",
                       ".nii",
                       ".nii.gz",
                       ".hdr",
                       ".hdr.gz",
                       ".mha",
                       ".mhd",
                       ".mgh",
                       ".mgz",
                       ".npy",
                       ".lsm",
                       ".mrc",
                       ".mnc",
                       ".gipl",
                       ".gipl.gz" });
}

bool
IsImage(const fs::path & path)
{
  return EndsInOneOf(path, { ".tif", ".tiff", ".png", ".bmp", ".dcm" });
}

/** Whether a file is read together with the scan beside it: its voxels, the names of its labels, its description. */
bool
BelongsToAScan(const fs::path & path)
{
  return EndsInOneOf(
    path,
    { ".raw", ".raw.gz", ".zraw", ".img", ".img.gz", ".bval", ".bvec", ".json", ".txt", ".label", ".ctab", ".lut" });
}

bool
IsManifest(const fs::path & path)
{
  return EndsInOneOf(path, { ".csv", ".tsv" });
}

[[noreturn]] void
RefuseUnreadable(const fs::path & path, const std::error_code & error)
{
  throw InputError(path.string() + ": cannot be read (" + error.message() + "); check its name and permissions");
}

/** All scans below a folder, without those below `output`; and what is none. */
void
Walk(const fs::path &           folder,
     const fs::path &           output,
     std::vector<std::string> & scans,
     std::vector<fs::path> &    passedOver)
{
  std::error_code notThere;
  if (fs::equivalent(folder, output, notThere))
  {
    return;
  }
  if (fs::is_regular_file(RecordPath(folder), notThere))
  {
    return; // what a batch has made of a scan: its maps and pictures are no scans of this one
  }
  if (IsZarr(folder) || IsPrecomputed(folder))
  {
    scans.push_back(folder.string());
    return;
  }
  std::vector<std::string> names;
  std::vector<std::string> images;
  std::error_code          error;
  for (const auto & entry : fs::directory_iterator(folder, error))
  {
    std::string name = entry.path().filename().string();
    if (!name.starts_with('.'))
    {
      names.push_back(std::move(name));
    }
  }
  if (error)
  {
    RefuseUnreadable(folder, error);
  }
  std::sort(names.begin(), names.end());
  for (const std::string & name : names)
  {
    const fs::path entry = folder / name;
    if (fs::is_directory(entry, error))
    {
      if (!fs::is_symlink(entry, error)) // a link upwards would never end
      {
        Walk(entry, output, scans, passedOver);
      }
    }
    else if (IsVolume(entry))
    {
      scans.push_back(entry.string());
    }
    else if (IsImage(entry))
    {
      images.push_back(entry.string());
    }
    else if (!BelongsToAScan(entry))
    {
      passedOver.push_back(entry);
    }
  }
  if (images.size() == 1)
  {
    scans.push_back(images.front());
  }
  else if (!images.empty())
  {
    scans.push_back(folder.string());
  }
}

/** Below a folder the folders between belong to the name: "site-2/seg". */
std::string
IdBelow(const fs::path & folder, const fs::path & scan)
{
  const fs::path between = scan.lexically_relative(folder).parent_path();
  return (between.empty() || between == "." ? fs::path() : between / "").string() + ScanName(scan);
}

void
AddInput(const fs::path &        input,
         const fs::path &        output,
         std::vector<Found> &    found,
         std::vector<fs::path> & passedOver)
{
  std::error_code error;
  if (fs::is_directory(input, error))
  {
    const fs::path           folder = input.has_filename() ? input : input.parent_path();
    std::vector<std::string> scans;
    Walk(folder, output, scans, passedOver);
    if (scans.empty())
    {
      throw InputError(input.string() +
                       ": no scan in this folder; see 'voxelcore batch --help' for what counts as one");
    }
    for (const std::string & scan : scans)
    {
      found.push_back({ scan, scan == folder.string() ? ScanName(scan) : IdBelow(folder, scan) });
    }
    return;
  }
  if (error == std::errc::permission_denied || error == std::errc::filename_too_long)
  {
    RefuseUnreadable(input, error);
  }
  if (!error)
  {
    found.push_back({ input.string(), ScanName(input) });
    return;
  }
  const std::vector<std::string> matches = MatchesOf(input);
  if (matches.empty())
  {
    throw InputError(input.string() + ": no such file, and nothing that matches; check its name");
  }
  for (const std::string & match : matches)
  {
    found.push_back({ match, ScanName(match) });
  }
}

std::string
Normal(const std::string & path)
{
  std::error_code error; // of no path at all
  return fs::absolute(path, error).lexically_normal().string();
}

/** The id with the file's whole name. */
std::string
WithFileName(const std::string & id, const std::string & scan)
{
  return (fs::path(id).parent_path() / fs::path(scan).filename()).string();
}

/** Scans of one name get their file's whole name, then the folders above, until they differ. */
void
TellApart(std::vector<Found> & found)
{
  const auto doubled = [&] {
    std::map<std::string, std::vector<std::size_t>> byFolder;
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      byFolder[CaseFolder(found[i].id)].push_back(i);
    }
    std::vector<std::size_t> all;
    for (const auto & [folder, which] : byFolder)
    {
      if (which.size() > 1)
      {
        all.insert(all.end(), which.begin(), which.end());
      }
    }
    return all;
  };
  for (const std::size_t i : doubled())
  {
    found[i].id = WithFileName(found[i].id, found[i].scan);
  }
  for (const std::size_t i : doubled())
  {
    found[i].id = Normal(found[i].scan);
  }
}

/** A scan that has results in `output` under a name that it could bear keeps that name, whatever others have come. */
void
KeepNames(std::vector<Found> &             found,
          const std::vector<std::string> & plain,
          const std::vector<CohortCase> &  named,
          const fs::path &                 output)
{
  std::set<std::string> taken;
  for (const CohortCase & one : named)
  {
    taken.insert(one.folder);
  }
  for (const Found & one : found)
  {
    taken.insert(CaseFolder(one.id));
  }
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    const std::string scan = Normal(found[i].scan);
    const auto        isItsOwn = [&](const std::string & id) {
      const auto record = ReadCaseRecord(output / CaseFolder(id));
      return record && Normal(record->scan) == scan;
    };
    if (isItsOwn(found[i].id))
    {
      continue;
    }
    for (const std::string & id : { plain[i], WithFileName(plain[i], found[i].scan), scan })
    {
      if (!taken.contains(CaseFolder(id)) && isItsOwn(id))
      {
        found[i].id = id;
        break;
      }
    }
  }
}

} // namespace

std::vector<CohortCase>
FindCases(const std::vector<fs::path> & inputs,
          std::span<const Parameter>    options,
          const fs::path &              output,
          std::vector<fs::path> *       passedOver)
{
  std::vector<CohortCase> cases;
  std::vector<Found>      found;
  std::set<std::string>   known;
  std::vector<fs::path>   others;
  for (const fs::path & input : inputs)
  {
    if (IsManifest(input) && !fs::is_directory(input))
    {
      auto rows = ReadManifest(input, options);
      if (cases.empty()) // tens of thousands are not there twice
      {
        cases.swap(rows);
      }
      cases.insert(cases.end(), std::move_iterator(rows.begin()), std::move_iterator(rows.end()));
    }
    else
    {
      AddInput(input, output, found, others);
    }
  }
  std::erase_if(found, [&](const Found & one) { return !known.insert(Normal(one.scan)).second; });
  if (passedOver != nullptr)
  {
    *passedOver = std::move(others);
  }
  known.clear();
  std::vector<std::string> plain;
  for (const Found & one : found)
  {
    plain.push_back(one.id);
  }
  TellApart(found);
  if (!output.empty())
  {
    KeepNames(found, plain, cases, output);
  }
  cases.reserve(cases.size() + found.size());
  for (Found & one : found)
  {
    std::string folder = CaseFolder(one.id);
    cases.push_back({ std::move(one.id), std::move(folder), std::move(one.scan), {} });
  }
  if (const auto twice = CaseThatIsThereTwice(cases))
  {
    throw InputError("the id '" + cases[twice->second].id +
                     "' occurs twice among the inputs; give ids of your own in a manifest");
  }
  return cases;
}

} // namespace voxelcore
