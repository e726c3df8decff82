#include "LsmInfo.h"

#include "TiffHandle.h"
#include "voxelcore/Base/Library.h"

#include <bit>
#include <cmath>

namespace voxelcore
{
namespace
{

constexpr std::uint32_t kLsmTag = 34412;
constexpr std::size_t   kLeastBytes = 90; // up to the kind of scan

/** Little endian, as all of the file. */
template <typename T>
T
At(const unsigned char * block, std::size_t offset)
{
  std::array<unsigned char, sizeof(T)> bytes{};
  std::memcpy(bytes.data(), block + offset, sizeof(T));
  if (std::endian::native == std::endian::big)
  {
    std::reverse(bytes.begin(), bytes.end());
  }
  return bit_cast<T>(bytes);
}

} // namespace

std::optional<LsmInfo>
ReadLsmInfo(const std::filesystem::path & path, const TiffHandle & tiff)
{
  // A tag that libtiff does not know comes with its count.
  std::uint32_t count = 0;
  const void *  data = nullptr;
  if (TIFFGetField(tiff.Get(), kLsmTag, &count, &data) != 1 || data == nullptr)
  {
    return std::nullopt;
  }
  const auto * block = static_cast<const unsigned char *>(data);
  const auto * field = TIFFFindField(tiff.Get(), kLsmTag, TIFF_ANY);
  if (field == nullptr || TIFFFieldDataType(field) != TIFF_BYTE || count < kLeastBytes ||
      (At<std::uint32_t>(block, 0) != 0x0400494CU && At<std::uint32_t>(block, 0) != 0x0300494CU))
  {
    tiff.RefuseDamaged("its block of LSM is none");
  }
  if (FileSize(path) > UINT32_MAX)
  {
    RefuseInput(path, "an LSM file above 4 GB, which does not say where its slices lie", "save it as OME-TIFF in Fiji");
  }
  const auto side = [&](std::size_t offset) { return At<std::int32_t>(block, offset); };
  for (const std::size_t offset : { 8U, 12U, 16U, 20U, 24U })
  {
    if (side(offset) < 1)
    {
      tiff.RefuseDamaged("its block of LSM gives a side that is none");
    }
  }
  constexpr std::uint16_t stack = 0;
  constexpr std::uint16_t stacksInTime = 6;
  if (const auto kind = At<std::uint16_t>(block, 88); kind != stack && kind != stacksInTime)
  {
    RefuseInput(path,
                Text("a scan of LSM that is no stack of slices (kind ", kind, ")"),
                Text("save a stack as OME-TIFF in Fiji, or with 'bfconvert' of Bio-Formats"));
  }
  LsmInfo info;
  info.width = static_cast<std::uint32_t>(side(8));
  info.height = static_cast<std::uint32_t>(side(12));
  info.pages.program = "LSM";
  info.pages.frames = static_cast<std::uint64_t>(side(24));
  info.pages.images = static_cast<std::uint64_t>(side(16)) * info.pages.frames;
  info.spacing.source = "LSM";
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double metres = At<double>(block, 40 + 8 * axis);
    if (std::isfinite(metres) && metres > 0)
    {
      info.spacing.mm[axis] = 1e3 * metres;
    }
  }
  return info;
}

} // namespace voxelcore
