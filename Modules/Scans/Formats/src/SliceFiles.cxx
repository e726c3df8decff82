// A folder or a pattern of TIFF, PNG, BMP or JPEG slices as one volume, in natural order (2 before 10).

#include "BmpFile.h"
#include "JpegFile.h"
#include "PngFile.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Formats/FormatOpeners.h"
#include "TiffFile.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>

namespace voxelcore
{
namespace
{

/** A name cut into text and numbers: "slice_0012.tif" -> "slice_", 12, ".tif". */
struct NamePart
{
  std::string   text; ///< as written, digits too
  bool          number = false;
  std::uint64_t value = 0;
};

std::vector<NamePart>
CutName(const std::string & name)
{
  std::vector<NamePart> parts;
  for (std::size_t at = 0; at < name.size();)
  {
    const bool  digits = name[at] >= '0' && name[at] <= '9';
    std::size_t end = at + 1;
    while (end < name.size() && (name[end] >= '0' && name[end] <= '9') == digits)
    {
      ++end;
    }
    NamePart part;
    part.text = name.substr(at, end - at);
    const auto value = digits ? ParseInteger(part.text) : std::nullopt;
    part.number = value.has_value();
    part.value = static_cast<std::uint64_t>(value.value_or(0));
    parts.push_back(std::move(part));
    at = end;
  }
  return parts;
}

struct Slice
{
  std::filesystem::path path;
  std::vector<NamePart> parts;
};

bool
NaturallyLess(const Slice & a, const Slice & b)
{
  return std::lexicographical_compare(a.parts.begin(),
                                      a.parts.end(),
                                      b.parts.begin(),
                                      b.parts.end(),
                                      [](const NamePart & x, const NamePart & y) {
                                        if (x.number && y.number && x.value != y.value)
                                        {
                                          return x.value < y.value;
                                        }
                                        return x.text < y.text;
                                      });
}

enum class SliceKind : std::uint8_t
{
  None,
  Tiff,
  Png,
  Bmp,
  Jpeg
};

SliceKind
SliceKindOf(const std::filesystem::path & path)
{
  const std::string extension = LowerCase(path.extension().string());
  return extension == ".tif" || extension == ".tiff"   ? SliceKind::Tiff
         : extension == ".png"                         ? SliceKind::Png
         : extension == ".bmp"                         ? SliceKind::Bmp
         : extension == ".jpg" || extension == ".jpeg" ? SliceKind::Jpeg
                                                       : SliceKind::None;
}

const char *
NameOf(SliceKind kind)
{
  return kind == SliceKind::Png ? "PNG" : kind == SliceKind::Bmp ? "BMP" : kind == SliceKind::Jpeg ? "JPEG" : "TIFF";
}

/** The slice as one page; of another kind as if it were one of TIFF. */
TiffPages
InspectSlice(const std::filesystem::path & path, const ReadOptions & options)
{
  const SliceKind kind = SliceKindOf(path);
  TiffPages       page;
  if (kind == SliceKind::Tiff)
  {
    return InspectTiff(path, options);
  }
  page.offsets = { 0 };
  if (kind != SliceKind::Png)
  {
    page.lossy = kind == SliceKind::Jpeg;
    const GreyPage grey = page.lossy ? InspectJpeg(path) : InspectBmp(path);
    page.width = grey.width;
    page.height = grey.height;
    ChooseComponent(path, 1, "grey picture", options);
    return page;
  }
  const PngPage png = InspectPng(path, options);
  page.width = png.width;
  page.height = png.height;
  page.bits = static_cast<std::uint16_t>(png.bits);
  page.samples = static_cast<std::uint16_t>(png.samples);
  page.type = png.Type();
  return page;
}

/** Whether the name fits the pattern: `*` anything, `%d` `%04d` or a run of `#` a number. */
bool
Fits(std::string_view pattern, std::string_view name)
{
  if (pattern.empty())
  {
    return name.empty();
  }
  const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
  if (pattern[0] == '*')
  {
    for (std::size_t skip = 0; skip <= name.size(); ++skip)
    {
      if (Fits(pattern.substr(1), name.substr(skip)))
      {
        return true;
      }
    }
    return false;
  }
  std::size_t width = 0; // of the number the pattern has here
  std::size_t length = 0;
  bool        exact = false;
  if (pattern[0] == '#')
  {
    length = std::min(pattern.find_first_not_of('#'), pattern.size());
    width = length;
    exact = true;
  }
  else if (pattern[0] == '%')
  {
    std::size_t d = 1;
    while (d < pattern.size() && isDigit(pattern[d]))
    {
      ++d;
    }
    if (d < pattern.size() && pattern[d] == 'd' && d < 8)
    {
      width = d > 1 ? static_cast<std::size_t>(ParseInteger(pattern.substr(1, d - 1)).value_or(0)) : 1;
      length = d + 1;
    }
  }
  if (length > 0)
  {
    std::size_t digits = 0;
    while (digits < name.size() && isDigit(name[digits]))
    {
      ++digits;
    }
    // `###` and `%03d` also stand for 1000 once three digits do not suffice.
    const bool fits = digits >= width && (digits == width || name[0] != '0' || (!exact && width <= 1));
    return fits && digits > 0 && Fits(pattern.substr(length), name.substr(digits));
  }
  return !name.empty() && name[0] == pattern[0] && Fits(pattern.substr(1), name.substr(1));
}

/** SkyScan's reconstruction (NRecon) lays a picture of the specimen beside its slices. */
bool
IsSpare(const std::filesystem::path & path)
{
  return LowerCase(path.stem().string()).ends_with("_spr");
}

/** The voxel size that the log of SkyScan's reconstruction states: "x_rec.log" beside slices x_rec00000017. */
StatedSpacing
SkyScanSpacing(const std::filesystem::path & slice)
{
  std::string stem = slice.stem().string();
  stem.resize(stem.find_last_not_of("0123456789") + 1); // npos + 1 is 0
  const std::filesystem::path log = slice.parent_path() / (stem + ".log");
  StatedSpacing               stated;
  std::ifstream               file(log, std::ios::binary);
  bool                        isReconstruction = false;
  std::string                 line;
  for (int lines = 0; lines < 10000 && std::getline(file, line); ++lines)
  {
    const std::string_view text = Trim(line);
    isReconstruction = text.starts_with('[') ? text == "[Reconstruction]" : isReconstruction;
    constexpr std::string_view name = "Pixel Size (um)=";
    const auto                 value = text.starts_with(name) ? ParseReal(text.substr(name.size())) : std::nullopt;
    if (isReconstruction && value && *value > 0 && std::isfinite(*value))
    {
      const double mm = *value / 1000;
      stated.mm = { mm, mm, mm };
      stated.source = Text("'", Printable(log.filename().string()), "'");
    }
  }
  return stated;
}

/** Of a folder. A JPEG picture beside other scans is a preview. */
bool
IsSlice(const std::filesystem::directory_entry & entry, bool takesJpeg)
{
  const std::string name = entry.path().filename().string();
  const SliceKind   kind = SliceKindOf(entry.path());
  std::error_code   ignored;
  return kind != SliceKind::None && (kind != SliceKind::Jpeg || takesJpeg) && !name.starts_with('.') &&
         !IsSpare(entry.path()) && entry.is_regular_file(ignored);
}

/** Whether a folder holds JPEG pictures and, but for texts, nothing else. */
bool
AreJpegs(const std::filesystem::path & folder)
{
  std::error_code ignored;
  bool            found = false;
  for (const auto & entry : std::filesystem::directory_iterator(folder, ignored))
  {
    const std::string name = LowerCase(entry.path().filename().string());
    const bool        isText =
      ranges::any_of(std::initializer_list<std::string_view>{ ".txt", ".log", ".csv", ".json", ".xml", ".md", ".db" },
                     [&](std::string_view ending) { return name.ends_with(ending); });
    if (name.starts_with('.') || isText)
    {
      continue;
    }
    if (SliceKindOf(entry.path()) != SliceKind::Jpeg)
    {
      return false;
    }
    found = true;
  }
  return found;
}

std::vector<Slice>
FindSlices(const std::filesystem::path & path)
{
  std::error_code             error;
  const bool                  folder = std::filesystem::is_directory(path, error);
  const std::filesystem::path where = folder ? path : (path.has_parent_path() ? path.parent_path() : ".");
  const std::string           pattern = folder ? "" : path.filename().string();
  if (!folder && std::count(pattern.begin(), pattern.end(), '*') > 4)
  {
    RefuseInput(path, "too many * in the pattern", "use one");
  }
  const bool         takesJpeg = !folder || AreJpegs(path);
  std::vector<Slice> slices;
  auto               entries = std::filesystem::directory_iterator(where, error);
  if (error)
  {
    RefuseInput(where, Text("cannot be read (", error.message(), ")"), "check its name and permissions");
  }
  for (const auto & entry : entries)
  {
    const std::string name = entry.path().filename().string();
    if (IsSlice(entry, takesJpeg) && (folder || Fits(pattern, name)))
    {
      slices.push_back({ entry.path(), CutName(name) });
    }
  }
  if (slices.empty() && std::filesystem::is_regular_file(path, error))
  {
    slices.push_back({ path, {} }); // called like a pattern
  }
  if (slices.empty())
  {
    RefuseInput(path,
                folder ? "no TIFF, PNG, BMP or JPEG slices in this folder"
                       : "no TIFF, PNG, BMP or JPEG slices of this pattern",
                "check the name");
  }
  const SliceKind kind = SliceKindOf(slices.front().path);
  const auto      other =
    std::find_if(slices.begin(), slices.end(), [kind](const Slice & slice) { return SliceKindOf(slice.path) != kind; });
  if (other != slices.end())
  {
    RefuseInput(path,
                Text("both ", NameOf(kind), " and ", NameOf(SliceKindOf(other->path)), " slices"),
                "give a pattern such as slice_*.png");
  }
  std::sort(slices.begin(), slices.end(), NaturallyLess);
  return slices;
}

/** "slice 3 is missing", "slices 3 to 5 and 9 are missing" */
std::string
MissingSlices(const std::vector<std::pair<std::uint64_t, std::uint64_t>> & gaps)
{
  constexpr std::size_t shown = 5;
  const bool            one = gaps.size() == 1 && gaps[0].first == gaps[0].second;
  const std::size_t     count = std::min(gaps.size(), shown);
  std::string           text = one ? "slice " : "slices ";
  for (std::size_t g = 0; g < count; ++g)
  {
    const bool last = g + 1 == count && count == gaps.size();
    text += g == 0 ? "" : last ? " and " : ", ";
    text += Text(gaps[g].first);
    text += gaps[g].first == gaps[g].second ? "" : Text(" to ", gaps[g].second);
  }
  text += count < gaps.size() ? " and others" : "";
  return text + (one ? " is missing" : " are missing");
}

/** Slices must be numbered without a gap, in one place of names that are alike otherwise. */
void
CheckNumbering(const std::filesystem::path & path, const std::vector<Slice> & slices)
{
  const auto & first = slices.front().parts;
  std::size_t  counting = first.size();
  const auto   refuse = [&](const Slice & slice) {
    RefuseInput(path,
                Text("slices are not numbered alike ('",
                     Printable(slices.front().path.filename().string()),
                     "', '",
                     Printable(slice.path.filename().string()),
                     "')"),
                "keep the slices of one volume in one folder, or give a pattern such as slice_*.tif");
  };
  for (const Slice & slice : slices)
  {
    if (slice.parts.size() != first.size())
    {
      refuse(slice);
    }
    for (std::size_t p = 0; p < first.size(); ++p)
    {
      const bool same = first[p].number ? slice.parts[p].number && slice.parts[p].value == first[p].value
                                        : slice.parts[p].text == first[p].text;
      if (!same)
      {
        if (!first[p].number || !slice.parts[p].number || (counting != first.size() && counting != p))
        {
          refuse(slice);
        }
        counting = p;
      }
    }
  }
  std::vector<std::pair<std::uint64_t, std::uint64_t>> gaps; // first and last of each
  for (std::size_t s = 1; s < slices.size(); ++s)
  {
    if (counting == first.size()) // 1.tif and 01.tif
    {
      refuse(slices[s]);
    }
    const std::uint64_t before = slices[s - 1].parts[counting].value;
    const std::uint64_t now = slices[s].parts[counting].value;
    if (now == before)
    {
      RefuseInput(path, Text("two slices have the number ", now), "remove one of them");
    }
    if (now != before + 1)
    {
      gaps.emplace_back(before + 1, now - 1);
    }
  }
  if (!gaps.empty())
  {
    RefuseInput(path, MissingSlices(gaps), "add what is missing, or number the slices without a gap");
  }
}

std::string
Describe(const TiffPages & page)
{
  return Text(page.width,
              " x ",
              page.height,
              ", ",
              page.bits,
              " bits",
              page.samples > 1 ? Text(", ", page.samples, " values a pixel") : std::string());
}

} // namespace

bool
AreSlices(const std::filesystem::path & path)
{
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored) ||
         (!std::filesystem::exists(path, ignored) &&
          path.filename().string().find_first_of("*#%") != std::string::npos);
}

bool
HasSlices(const std::filesystem::path & folder)
{
  std::error_code ignored;
  const auto      entries = std::filesystem::directory_iterator(folder, ignored);
  const bool      takesJpeg = AreJpegs(folder);
  return std::any_of(begin(entries), end(entries), [&](const auto & entry) { return IsSlice(entry, takesJpeg); });
}

std::vector<std::filesystem::path>
SlicePaths(const std::filesystem::path & path)
{
  std::vector<std::filesystem::path> files;
  for (const Slice & slice : FindSlices(path))
  {
    files.push_back(slice.path);
  }
  return files;
}

ScanFile
OpenSlices(const std::filesystem::path & path, const ReadOptions & options)
{
  const std::vector<Slice> slices = FindSlices(path);
  CheckNumbering(path, slices);
  ScanFile                           scan;
  std::vector<std::filesystem::path> files;
  TiffPages                          common;
  for (const Slice & slice : slices)
  {
    const TiffPages page = InspectSlice(slice.path, options);
    if (page.offsets.size() != 1)
    {
      RefuseInput(slice.path,
                  Text("a stack of ", page.offsets.size(), " pages among slices"),
                  "name one stack, or slices");
    }
    if (files.empty())
    {
      common = page;
    }
    else if (!AreAlike(page, common))
    {
      RefuseInput(slice.path,
                  Text("this slice (", Describe(page), ") is not like the first (", Describe(common), ")"),
                  "a volume needs equal slices");
    }
    else if (page.spacing != common.spacing && !options.spacing)
    {
      RefuseInput(slice.path,
                  "this slice states another voxel size than the first",
                  "give the true one with --spacing X,Y,Z");
    }
    common.lossy = common.lossy || page.lossy;
    files.push_back(slice.path);
  }
  scan.path = path;
  const SliceKind kind = SliceKindOf(files.front());
  scan.format = Text(NameOf(kind), " slices");
  if (kind == SliceKind::Jpeg)
  {
    common.lossy = false; // said here
    scan.warnings.emplace_back(
      "JPEG slices: values are not quite what was saved, so that labels in them are lost; take them as a grey scan "
      "with "
      "--threshold LO:HI");
  }
  DescribeTiff(common, scan);
  scan.geometry.size = { common.width, common.height, static_cast<std::int64_t>(files.size()) };
  ChooseVolume(path, 1, options);
  CheckSize(path, scan.geometry.size, PixelBytes(common.type), ~std::uint64_t{ 0 });
  NoteOneSlice(files.size(), scan);
  if (files.size() > 1)
  {
    scan.notes.push_back(
      Text(files.size(), " slices from ", files.front().filename().string(), " to ", files.back().filename().string()));
  }
  const StatedSpacing logged = SkyScanSpacing(files.front());
  const Vector3       spacing = CompleteSpacing(logged.mm[0] ? logged : common.spacing, options, scan);
  SetGeometry(scan, { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } }, spacing, { 0, 0, 0 }, options);
  scan.voxels = OpenParts(files, common.PageBytes(), [kind, options](const std::filesystem::path & file) {
    return kind == SliceKind::Png    ? OpenPngPage(file, options)
           : kind == SliceKind::Bmp  ? OpenBmpPage(file)
           : kind == SliceKind::Jpeg ? OpenJpegPage(file)
                                     : OpenTiffPages(file, InspectTiff(file, options));
  });
  return scan;
}

} // namespace voxelcore
