#include "voxelcore/SkeletonTargets.h"

#include "voxelcore/DidYouMean.h"
#include "voxelcore/Error.h"
#include "voxelcore/SkeletonTexts.h"
#include "voxelcore/Text.h"

#include <algorithm>
#include <array>

namespace voxelcore
{

std::vector<std::string>
ParseAlso(const std::string & text)
{
  constexpr std::array<std::string_view, 5> known{ "csv", "swc", "mrk.json", "graphml", "ma" };
  std::vector<std::string>                  endings;
  for (const std::string_view ending : SplitText(text, ','))
  {
    if (std::find(known.begin(), known.end(), ending) == known.end())
    {
      throw UsageError("--also " + text + ": '" + std::string(ending) +
                       "' is not one of csv, swc, mrk.json, graphml, ma" + DidYouMean(ending, known));
    }
    if (std::find(endings.begin(), endings.end(), ending) == endings.end())
    {
      endings.emplace_back(ending);
    }
  }
  return endings;
}

std::vector<Vector3>
ParseInlets(const std::string & text)
{
  std::vector<Vector3> places;
  for (const std::string_view one : SplitText(text, ';'))
  {
    std::vector<std::string> parts;
    for (const std::string_view part : SplitText(one, ','))
    {
      parts.emplace_back(part);
    }
    const auto place = ParsePlace(parts);
    if (!place)
    {
      throw UsageError("--inlet " + text + ": expected X,Y,Z in LPS mm, or several such with semicolons between");
    }
    places.push_back(*place);
  }
  return places;
}

} // namespace voxelcore
