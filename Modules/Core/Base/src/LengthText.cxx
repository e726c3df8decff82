#include "voxelcore/Base/LengthText.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"

#include <charconv>
#include <cmath>

namespace voxelcore
{

LengthText
ReadLength(std::string_view text, const std::function<void(const char *)> & refuse)
{
  // Blanks around the number and before the unit are the user's; one within a number could mean anything.
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  LengthText length;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    if (!blank(text[i]))
    {
      length.text.push_back(text[i]);
    }
    else if (!length.text.empty() && i + 1 < text.size() &&
             std::string_view("0123456789.").find(text[i + 1]) != std::string_view::npos)
    {
      refuse("has a blank before a digit");
    }
  }
  const char * first = length.text.data();
  const char * last = first + length.text.size();
  const auto   parsed = from_chars(first, last, length.value);
  if (parsed.ec != std::errc{} || !std::isfinite(length.value))
  {
    refuse("is not a number");
  }
  if (std::signbit(length.value) && length.value != 0.0)
  {
    refuse("is negative");
  }
  length.unit.assign(parsed.ptr, last);
  return length;
}

void
RefuseMillimetres(const std::string & length)
{
  throw InputError(length + " is a length in mm, and the scan has no voxel size; give the length in voxels (" +
                   length.substr(0, length.find('m')) +
                   "vox), or the voxel size with --spacing X,Y,Z where the scan is read");
}

} // namespace voxelcore
