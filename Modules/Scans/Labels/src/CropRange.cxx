#include "voxelcore/Labels/CropRange.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/TextFields.h"

#include <algorithm>
#include <limits>

namespace voxelcore
{
namespace
{

/** A voxel index, 0 for an empty text; none for what is no index. */
std::optional<std::int32_t>
ParseIndex(std::string_view text)
{
  if (text.empty())
  {
    return 0;
  }
  const bool digits = std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  const auto value = digits ? ParseInteger(text) : std::nullopt;
  if (!value || *value > std::numeric_limits<std::int32_t>::max())
  {
    return std::nullopt;
  }
  return static_cast<std::int32_t>(*value);
}

} // namespace

std::string
CropText(const CropRange & crop)
{
  std::string text;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const bool whole = crop.first[axis] == 0 && crop.end[axis] == 0;
    text += Text(axis > 0 ? "," : "",
                 whole ? "" : Text(crop.first[axis]),
                 ":",
                 crop.end[axis] > 0 ? Text(crop.end[axis]) : "");
  }
  return text;
}

CropRange
ParseCrop(std::string_view text)
{
  CropRange   crop;
  bool        good = std::count(text.begin(), text.end(), ',') == 2;
  std::size_t at = 0;
  for (std::size_t axis = 0; good && axis < 3; ++axis)
  {
    const std::size_t      comma = std::min(text.find(',', at), text.size());
    const std::string_view range = text.substr(at, comma - at);
    const std::size_t      colon = range.find(':');
    good = colon != std::string_view::npos;
    if (good)
    {
      const std::string_view end = range.substr(colon + 1);
      const auto             first = ParseIndex(range.substr(0, colon));
      const auto             last = ParseIndex(end);
      good = first && last && (end.empty() || *first < *last);
      crop.first[axis] = first.value_or(0);
      crop.end[axis] = last.value_or(0);
    }
    at = comma + 1;
  }
  if (!good)
  {
    throw UsageError(Text("--crop ",
                          Printable(text),
                          ": expected i0:i1,j0:j1,k0:k1 with 0 <= i0 < i1, such as 0:64,:,10: (voxels i0 to i1 - 1)"));
  }
  return crop;
}

CropRange
ResolveCrop(const std::optional<CropRange> &    given,
            const std::array<std::int64_t, 3> & size,
            const std::filesystem::path &       scan)
{
  CropRange crop = given.value_or(CropRange());
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (crop.first[axis] < 0 || crop.end[axis] < 0 || (crop.end[axis] > 0 && crop.end[axis] <= crop.first[axis]))
    {
      throw UsageError(Text("--crop ", CropText(*given), ": an empty range"));
    }
    if (crop.first[axis] >= size[axis] || crop.end[axis] > size[axis])
    {
      RefuseInput(scan,
                  Text("--crop ",
                       CropText(*given),
                       " reaches beyond the scan of ",
                       size[0],
                       " x ",
                       size[1],
                       " x ",
                       size[2],
                       " voxels"),
                  "'voxelcore info' tells where the labels lie");
    }
    crop.end[axis] = crop.end[axis] > 0 ? crop.end[axis] : static_cast<std::int32_t>(size[axis]);
  }
  return crop;
}

} // namespace voxelcore
