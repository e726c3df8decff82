// NIfTI-1 and NIfTI-2: .nii, .nii.gz, and pairs of .hdr and .img.
//
// The header is read here and not by itk::NiftiImageIO, which gives the first volume of a series with its direction
// lost, floats instead of scaled whole numbers, 1 mm for a missing spacing, and believes any size.

#include "HeaderFields.h"
#include "NiftiForms.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/FormatOpeners.h"
#include "voxelcore/Formats/StatedSpacing.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>

namespace voxelcore
{
namespace
{

/** What both versions of the header say. */
struct NiftiHeader
{
  int                         version = 1;
  bool                        swapped = false;
  bool                        pair = false; ///< voxels in an .img file
  std::array<std::int64_t, 8> dim{};
  int                         datatype = 0;
  double                      voxOffset = 0;
  double                      slope = 0;
  double                      intercept = 0;
  int                         units = 0;
  bool                        inVoxels = true; ///< where its description says so
  NiftiPlacement              placement;
};

constexpr int          kRgb = 128;
constexpr int          kRgba = 2304;
constexpr std::size_t  kSize1 = 348;
constexpr std::size_t  kSize2 = 540;
constexpr std::int64_t kMostBlocks = 1 << 30; // on the axes behind the third

void
ReadVersion1(const HeaderFields & f, NiftiHeader & h)
{
  for (std::size_t i = 0; i < 8; ++i)
  {
    h.dim[i] = f.At<std::int16_t>(40 + 2 * i);
  }
  h.datatype = f.At<std::int16_t>(70);
  h.voxOffset = f.At<float>(108);
  h.slope = f.At<float>(112);
  h.intercept = f.At<float>(116);
  h.units = std::to_integer<int>(f.At<std::byte>(123));
  for (std::size_t i = 0; i < kNiftiInVoxels.size(); ++i)
  {
    h.inVoxels = h.inVoxels && f.At<char>(148 + i) == kNiftiInVoxels[i];
  }
  h.placement.qformCode = f.At<std::int16_t>(252);
  h.placement.sformCode = f.At<std::int16_t>(254);
  for (std::size_t i = 0; i < 4; ++i)
  {
    h.placement.pixdim[i] = f.At<float>(76 + 4 * i);
    h.placement.srow[0][i] = f.At<float>(280 + 4 * i);
    h.placement.srow[1][i] = f.At<float>(296 + 4 * i);
    h.placement.srow[2][i] = f.At<float>(312 + 4 * i);
  }
  for (std::size_t i = 0; i < 3; ++i)
  {
    h.placement.quaternion[i] = f.At<float>(256 + 4 * i);
    h.placement.qoffset[i] = f.At<float>(268 + 4 * i);
  }
}

void
ReadVersion2(const HeaderFields & f, NiftiHeader & h)
{
  for (std::size_t i = 0; i < 8; ++i)
  {
    h.dim[i] = f.At<std::int64_t>(16 + 8 * i);
  }
  h.inVoxels = false;
  h.datatype = f.At<std::int16_t>(12);
  h.voxOffset = static_cast<double>(f.At<std::int64_t>(168));
  h.slope = f.At<double>(176);
  h.intercept = f.At<double>(184);
  h.units = f.At<std::int32_t>(500);
  h.placement.qformCode = f.At<std::int32_t>(344);
  h.placement.sformCode = f.At<std::int32_t>(348);
  for (std::size_t i = 0; i < 4; ++i)
  {
    h.placement.pixdim[i] = f.At<double>(104 + 8 * i);
    h.placement.srow[0][i] = f.At<double>(400 + 8 * i);
    h.placement.srow[1][i] = f.At<double>(432 + 8 * i);
    h.placement.srow[2][i] = f.At<double>(464 + 8 * i);
  }
  for (std::size_t i = 0; i < 3; ++i)
  {
    h.placement.quaternion[i] = f.At<double>(352 + 8 * i);
    h.placement.qoffset[i] = f.At<double>(376 + 8 * i);
  }
}

NiftiHeader
ReadNiftiHeader(const std::filesystem::path & path)
{
  std::array<std::byte, kSize2> bytes{};
  const auto                    stream = OpenBytes(path, 0, DetectGzip(path));
  const std::size_t             got = stream->ReadSome(bytes.data(), bytes.size());
  if (got < kSize1)
  {
    RefuseInput(path, "too short for a NIfTI header", "the file is truncated or of another kind: fetch it anew");
  }
  NiftiHeader  h;
  std::int32_t size = 0;
  std::memcpy(&size, bytes.data(), sizeof size);
  const auto swappedSize = static_cast<std::int32_t>(__builtin_bswap32(static_cast<std::uint32_t>(size)));
  h.swapped = swappedSize == std::int32_t{ kSize1 } || swappedSize == std::int32_t{ kSize2 };
  const std::int32_t trueSize = h.swapped ? swappedSize : size;
  const HeaderFields fields(bytes, h.swapped);
  const auto         magicIs = [&](std::size_t at, std::string_view text) {
    return std::memcmp(bytes.data() + at, text.data(), text.size()) == 0;
  };
  if (trueSize == std::int32_t{ kSize1 })
  {
    h.pair = magicIs(344, std::string_view("ni1\0", 4));
    if (!h.pair && !magicIs(344, std::string_view("n+1\0", 4)))
    {
      RefuseInput(path,
                  "no NIfTI file (perhaps ANALYZE 7.5, which does not tell left from right)",
                  "convert it to NIfTI");
    }
    ReadVersion1(fields, h);
  }
  else if (trueSize == std::int32_t{ kSize2 } && got == kSize2)
  {
    h.version = 2;
    h.pair = magicIs(4, std::string_view("ni2\0", 4));
    if (!h.pair && !magicIs(4, std::string_view("n+2\0", 4)))
    {
      RefuseInput(path, "no NIfTI file (its mark is missing)", "check what kind of file it is");
    }
    ReadVersion2(fields, h);
  }
  else
  {
    RefuseInput(path, "no NIfTI file", "check what kind of file it is");
  }
  return h;
}

PixelType
NiftiTypeOf(const std::filesystem::path & path, int datatype)
{
  switch (datatype)
  {
    case 2:
      return PixelType::UInt8;
    case 4:
      return PixelType::Int16;
    case 8:
      return PixelType::Int32;
    case 16:
      return PixelType::Float32;
    case 64:
      return PixelType::Float64;
    case 256:
      return PixelType::Int8;
    case 512:
      return PixelType::UInt16;
    case 768:
      return PixelType::UInt32;
    case 1024:
      return PixelType::Int64;
    case 1280:
      return PixelType::UInt64;
    case kRgb:
    case kRgba:
      return PixelType::UInt8;
    case 32:
    case 1792:
    case 2048:
      RefuseInput(path, "its voxels are complex numbers", "save it with one whole number a voxel");
    default:
      break;
  }
  RefuseInput(path, Text("its voxel type ", datatype, " is not known here"), "save it with a type of whole numbers");
}

/** scan.hdr for scan.img and the other way round, with or without .gz. */
std::filesystem::path
Partner(const std::filesystem::path & path, std::string_view extension)
{
  std::string name = path.filename().string();
  if (LowerCase(name).ends_with(".gz"))
  {
    name.resize(name.size() - 3);
  }
  name.resize(name.size() - std::min<std::size_t>(name.size(), 4));
  const std::string upper = extension == ".hdr" ? ".HDR" : ".IMG";
  for (const std::string & ending : { std::string(extension), Text(extension, ".gz"), upper })
  {
    auto            candidate = path.parent_path() / (name + ending);
    std::error_code ignored;
    if (std::filesystem::exists(candidate, ignored))
    {
      return candidate;
    }
  }
  RefuseInput(path, Text("its other half ", Printable(name), extension, " is not there"), "keep both files together");
}

void
ReadScaling(const NiftiHeader & h, ScanFile & scan)
{
  // A slope of 0 means none (NIfTI-1); one that is no number cannot mean more.
  if (h.slope == 0 || !std::isfinite(h.slope) || !std::isfinite(h.intercept))
  {
    return;
  }
  scan.slope = h.slope;
  scan.intercept = h.intercept;
  if (scan.IsScaled())
  {
    scan.notes.push_back(
      Text("stored values are scaled: value = ", Number(h.slope), " * stored + ", Number(h.intercept)));
  }
}

void
ReadUnits(NiftiHeader & h, const ReadOptions & options, ScanFile & scan)
{
  if (h.inVoxels)
  {
    if (!options.spacing)
    {
      SpacingInVoxels(scan);
    }
    return;
  }
  switch (h.units & 7)
  {
    case 1:
      h.placement.millimetres = 1000.0;
      scan.notes.push_back("lengths were converted to mm from m");
      break;
    case 3:
      h.placement.millimetres = 1e-3;
      scan.notes.push_back("lengths were converted to mm from um");
      break;
    case 2:
      break;
    default:
      scan.notes.push_back("the file states no unit of length: mm are taken");
      break;
  }
}

bool
IsImageHalf(const std::filesystem::path & path)
{
  const std::string name = LowerCase(path.filename().string());
  return name.ends_with(".img") || name.ends_with(".img.gz");
}

} // namespace

std::vector<std::filesystem::path>
NiftiPartner(const std::filesystem::path & path)
{
  if (IsImageHalf(path))
  {
    return { Partner(path, ".hdr") };
  }
  return ReadNiftiHeader(path).pair ? std::vector{ Partner(path, ".img") } : std::vector<std::filesystem::path>();
}

ScanFile
OpenNifti(const std::filesystem::path & path, const ReadOptions & options)
{
  const bool  isImage = IsImageHalf(path);
  const auto  headerPath = isImage ? Partner(path, ".hdr") : path;
  NiftiHeader h = ReadNiftiHeader(headerPath);
  ScanFile    scan;
  scan.path = path;
  scan.format = h.version == 1 ? "NIfTI-1" : "NIfTI-2";
  scan.swapBytes = h.swapped;
  if (h.dim[0] < 1 || h.dim[0] > 7)
  {
    RefuseInput(path, Text("its header gives ", h.dim[0], " dimensions"), "the file is damaged: write it anew");
  }
  if (h.dim[0] < 3)
  {
    RefuseInput(path, Text(h.dim[0], "-D image"), "save one volume with three axes in space");
  }
  std::copy_n(h.dim.begin() + 1, 3, scan.geometry.size.begin());
  // The fourth axis is that of time. Those behind it hold the values of a voxel, each as a volume of its own.
  std::uint64_t volumes = 1;
  std::uint64_t planes = 1;
  for (std::size_t d = 4; d <= static_cast<std::size_t>(h.dim[0]); ++d)
  {
    // Tools leave 0 where 1 is meant on the axes behind the third.
    std::uint64_t & count = d == 4 ? volumes : planes;
    if (h.dim[d] >= 0 && h.dim[d] <= kMostBlocks)
    {
      count *= static_cast<std::uint64_t>(std::max<std::int64_t>(1, h.dim[d]));
    }
    if (h.dim[d] < 0 || h.dim[d] > kMostBlocks || count > std::uint64_t{ kMostBlocks })
    {
      RefuseInput(path, Text("its header gives a side of ", h.dim[d]), "the file is damaged: write it anew");
    }
  }
  scan.type = NiftiTypeOf(path, h.datatype);
  scan.interleaved = h.datatype == kRgb ? 3 : (h.datatype == kRgba ? 4 : 1);
  if (scan.interleaved > 1 && planes > 1)
  {
    RefuseInput(path, "vectors of colours", "save its labels as one whole number a voxel");
  }
  const std::uint64_t volume = ChooseVolume(path, volumes, options);
  const std::uint64_t component = ChooseComponent(path,
                                                  scan.interleaved * planes,
                                                  scan.interleaved > 1 ? "colour image" : "vectors on the fifth axis",
                                                  options);
  if (scan.interleaved > 1)
  {
    scan.component = static_cast<std::ptrdiff_t>(component);
  }
  const std::uint64_t block = planes > 1 ? volume + volumes * component : volume;
  const std::uint64_t blocks = volumes * planes;

  const auto   dataPath = h.pair ? (isImage ? path : Partner(path, ".img")) : headerPath;
  const auto   packing = DetectGzip(dataPath);
  const double least = h.pair ? 0.0 : (h.version == 1 ? 348.0 : 540.0);
  const auto   fileBytes = FileSize(dataPath);
  const auto   possible = fileBytes * LargestExpansion(packing);
  if (!(h.voxOffset >= least && h.voxOffset <= static_cast<double>(possible)))
  {
    RefuseInput(path,
                Text("its header says voxels begin at byte ", Number(h.voxOffset)),
                "the file is damaged: write it anew");
  }
  const auto          offset = static_cast<std::uint64_t>(h.voxOffset);
  const std::uint64_t bytesPerVoxel = PixelBytes(scan.type) * scan.interleaved;
  const std::uint64_t bytes = bytesPerVoxel * CheckSize(path, scan.geometry.size, bytesPerVoxel, possible);
  if (blocks > possible / bytes || (packing == Packing::Plain && offset + bytes * blocks > fileBytes))
  {
    RefuseInput(path,
                Text("it holds ",
                     fileBytes - std::min(offset, fileBytes),
                     " bytes of voxels where ",
                     bytes,
                     " in each of ",
                     blocks,
                     " volumes are needed"),
                "the file is truncated: fetch or write it anew");
  }
  ReadScaling(h, scan);
  ReadUnits(h, options, scan);
  PlaceNifti(h.placement, options, scan);
  scan.voxels = OpenBytes(dataPath, 0, packing);
  scan.voxels->Skip(offset + block * bytes);
  scan.moreVolumes = blocks > 1;
  return scan;
}

} // namespace voxelcore
