#include "voxelcore/Report/SkeletonTexts.h"

#include "voxelcore/Base/DidYouMean.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParseReal.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Base/TextFields.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace voxelcore
{

std::optional<Vector3>
ParsePlace(const std::vector<std::string> & parts)
{
  Vector3 place{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto value = parts.size() == 3 ? ParseReal(parts[axis]) : std::nullopt;
    if (!value || !std::isfinite(*value))
    {
      return std::nullopt;
    }
    place[axis] = *value;
  }
  return place;
}

std::vector<Vector3>
ParsePlaces(const std::string & text)
{
  std::vector<Vector3> places;
  for (const std::string & one : SplitText(text, ';'))
  {
    std::vector<std::string> parts = SplitText(one, ',');
    ranges::transform(parts, parts.begin(), [](const std::string & part) { return std::string(Trim(part)); });
    const auto place = ParsePlace(parts);
    if (!place)
    {
      throw UsageError("expected X,Y,Z in LPS mm, or several such with semicolons between, not '" + text + "'");
    }
    places.push_back(*place);
  }
  return places;
}

RootChoice
ParseRoot(const std::string & text)
{
  if (text == "thickest")
  {
    return {};
  }
  if (text == "top")
  {
    return { RootChoice::Kind::Top, {} };
  }
  if (text == "bottom")
  {
    return { RootChoice::Kind::Bottom, {} };
  }
  const auto place = ParsePlace(SplitText(text, ','));
  if (!place)
  {
    constexpr std::array<std::string_view, 3> words{ "top", "bottom", "thickest" };
    throw UsageError("--root " + text + ": expected top, bottom, thickest, or a point in LPS mm such as 12.5,-30,101" +
                     DidYouMean(text, words));
  }
  return { RootChoice::Kind::Point, *place };
}

std::string
RootText(const RootChoice & root)
{
  if (root.kind != RootChoice::Kind::Point)
  {
    return root.kind == RootChoice::Kind::Top ? "top" : root.kind == RootChoice::Kind::Bottom ? "bottom" : "thickest";
  }
  std::string text;
  for (const double coordinate : root.point)
  {
    text += (text.empty() ? "" : ",") + RoundTripText(coordinate);
  }
  return text;
}

namespace
{

constexpr std::array<std::string_view, 3> kBorders{ "closed", "open", "overlap" }; // as BorderEnds

} // namespace

BorderEnds
ParseBorder(const std::string & text)
{
  const auto found = std::find(kBorders.begin(), kBorders.end(), text);
  if (found == kBorders.end())
  {
    throw UsageError("--border " + text + ": expected open, closed or overlap" + DidYouMean(text, kBorders));
  }
  return static_cast<BorderEnds>(found - kBorders.begin());
}

std::string
BorderText(BorderEnds ends)
{
  return std::string(kBorders[static_cast<std::size_t>(ends)]);
}

std::string
BorderSideText(const BorderSection & section)
{
  return std::string(1, "ijk"[section.axis]) + (section.isUpper ? "+" : "-");
}

} // namespace voxelcore
