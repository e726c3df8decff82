#include "voxelcore/Jobs/OutputNames.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Text.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace voxelcore
{

namespace fs = std::filesystem;

bool
IsFolderOutput(const fs::path & output)
{
  std::error_code ignored; // whoever writes there says what is wrong
  return !output.has_filename() || (fs::is_directory(output, ignored) && output.extension() != ".zarr");
}

std::string
ScanName(const fs::path & scan)
{
  std::string name = scan.has_filename() ? scan.filename().string() : scan.parent_path().filename().string();
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  // Longest first: "x.seg.nrrd" is "x".
  static constexpr std::array<std::string_view, 32> extensions{
    ".ome.zarr", ".mgh.gz", ".zarr", ".mgh",     ".mgz",  ".seg.nrrd", ".nii.gz", ".nrrd", ".nhdr", ".nii", ".mha",
    ".mhd",      ".tiff",   ".tif",  ".hdr",     ".img",  ".stl",      ".obj",    ".ply",  ".off",  ".vtk", ".vtp",
    ".dcm",      ".mrc",    ".mnc",  ".gipl.gz", ".gipl", ".h5",       ".raw",    ".gz",   ".lsm",  ".npy"
  };
  for (const std::string_view extension : extensions)
  {
    if (lower.ends_with(extension) && lower.size() > extension.size())
    {
      name.resize(name.size() - extension.size());
      break;
    }
  }
  for (char & c : name)
  {
    const auto byte = static_cast<unsigned char>(c);
    // Bytes of UTF-8 letters stay.
    if (byte < 0x80U && std::isalnum(byte) == 0 && std::string_view("._-+").find(c) == std::string_view::npos)
    {
      c = '_';
    }
  }
  return name.empty() || name == "." || name == ".." ? "scan" : name;
}

std::string
LambdaTag(const Lambda & lambda)
{
  std::string tag = lambda.text;
  if (tag.ends_with('%'))
  {
    tag.replace(tag.size() - 1, 1, "pct");
  }
  return tag;
}

namespace
{

/** Comma-separated lengths, by `parse` one by one. */
template <typename Length>
std::vector<Length>
ParseLengths(std::string_view text, Length (*parse)(std::string_view), const std::string & option)
{
  std::vector<Length> lengths;
  for (const std::string_view part : SplitText(text, ','))
  {
    Length length = parse(part);
    if (length.value == 0)
    {
      length.text = "0"; // the same in every unit
    }
    else if (length.unit == Length::Unit::Millimetre && !length.text.ends_with("mm"))
    {
      length.text += "mm";
    }
    for (const Length & other : lengths)
    {
      if (other.text == length.text)
      {
        throw UsageError(option + " " + std::string(text) + ": " + length.text + " is given twice; give it once");
      }
    }
    lengths.push_back(length);
  }
  return lengths;
}

} // namespace

std::vector<Lambda>
ParseLambdas(std::string_view text)
{
  return ParseLengths<Lambda>(
    text,
    [](std::string_view one) { return ParseLambda(one); },
    "--lambda");
}

std::vector<Tolerance>
ParseTolerances(std::string_view text)
{
  return ParseLengths<Tolerance>(text, ParseTolerance, "--tolerance");
}

std::vector<std::string>
ResultSuffixes(const std::vector<Lambda> & lambdas, const std::vector<Tolerance> & tolerances)
{
  std::vector<std::string> suffixes;
  suffixes.reserve(tolerances.empty() ? lambdas.size() : tolerances.size());
  for (const Tolerance & height : tolerances)
  {
    suffixes.push_back("_tolerance-" + height.text);
  }
  for (const Lambda & lambda : tolerances.empty() ? lambdas : std::vector<Lambda>())
  {
    suffixes.push_back("_lambda-" + LambdaTag(lambda));
  }
  if (suffixes.size() == 1)
  {
    suffixes.front().clear();
  }
  return suffixes;
}

fs::path
FileOutputPath(const fs::path & output, const std::string & suffix)
{
  const std::string name = output.filename().string();
  std::size_t       end = name.size() - output.extension().string().size();
  for (const std::string_view ending : { ".nii.gz", ".ome.zarr" })
  {
    end = name.ends_with(ending) ? name.size() - ending.size() : end;
  }
  return output.parent_path() / (name.substr(0, end) + suffix + name.substr(end));
}

fs::path
FolderOutputPath(const fs::path &    folder,
                 const fs::path &    scan,
                 std::int64_t        label,
                 const std::string & suffix,
                 std::int64_t        component)
{
  return folder /
         (ScanName(scan) + "_label-" + std::to_string(label) +
          (component > 0 ? "_component-" + std::to_string(component) : std::string()) + "_medial" + suffix + ".vtp");
}

namespace
{

std::string
LabelPart(std::int64_t label, std::int64_t component)
{
  return "_label-" + std::to_string(label) +
         (component > 0 ? "_component-" + std::to_string(component) : std::string());
}

/** Also of a core's file. */
std::string
NameOfScan(const fs::path & input)
{
  if (input.extension() != ".vtp")
  {
    return ScanName(input);
  }
  std::string name = ScanName(input.parent_path() / input.stem());
  for (const char * mark : { "_medial", "_label-" })
  {
    const std::size_t at = name.rfind(mark);
    name.resize(at == std::string::npos || at == 0 ? name.size() : at);
  }
  return name;
}

} // namespace

fs::path
SkeletonFolderPath(const fs::path & folder, const fs::path & input, std::int64_t label, std::int64_t component)
{
  return folder / (NameOfScan(input) + LabelPart(label, component) + "_skeleton.vtp");
}

fs::path
VolumeFolderPath(const fs::path &    folder,
                 const fs::path &    scan,
                 std::int64_t        label,
                 std::int64_t        component,
                 const std::string & what)
{
  return folder / (ScanName(scan) + LabelPart(label, component) + "_" + what + ".nrrd");
}

fs::path
SkeletonTablesPath(const fs::path & folder, const fs::path & input)
{
  return folder / (NameOfScan(input) + "_skeleton.vtp");
}

fs::path
SkeletonBesideCore(const fs::path & output)
{
  std::string stem = output.stem().string();
  if (stem.ends_with("_medial") && stem != "_medial")
  {
    stem.resize(stem.size() - std::string_view("_medial").size());
  }
  return IsFolderOutput(output) ? output : output.parent_path() / (stem + "_skeleton.vtp");
}

} // namespace voxelcore
