#include "voxelcore/Jobs/SkeletonTargets.h"

#include "voxelcore/Base/DidYouMean.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Text.h"

#include <algorithm>
#include <array>

namespace voxelcore
{

std::vector<std::string>
ParseAlso(const std::string & text)
{
  constexpr std::array<std::string_view, 7> known{ "csv", "swc", "mrk.json", "graphml", "obj", "precomputed", "ma" };
  std::vector<std::string>                  endings;
  for (const std::string_view ending : SplitText(text, ','))
  {
    if (std::find(known.begin(), known.end(), ending) == known.end())
    {
      throw UsageError("--also " + text + ": '" + std::string(ending) +
                       "' is not one of csv, swc, mrk.json, graphml, obj, precomputed, ma" + DidYouMean(ending, known));
    }
    if (std::find(endings.begin(), endings.end(), ending) == endings.end())
    {
      endings.emplace_back(ending);
    }
  }
  return endings;
}

} // namespace voxelcore
