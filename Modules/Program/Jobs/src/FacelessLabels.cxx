#include "FacelessLabels.h"

#include "voxelcore/Jobs/JobTools.h"

#include "voxelcore/Base/TextFields.h"

#include <cstdio>

namespace voxelcore
{

void
TellFacelessLabels(const CoreReport &                 report,
                   const std::vector<std::uint64_t> & facesBefore,
                   std::vector<std::string> &         notes,
                   std::vector<std::string> &         warnings)
{
  constexpr std::size_t named = 5;
  constexpr double      farBeyond = 3;
  const std::size_t     results = report.labels.empty() ? 0 : report.labels.front().pruned.size();
  for (std::size_t i = 0; i < results; ++i)
  {
    std::string text;
    std::size_t count = 0;
    std::string threshold;
    bool        isFar = false;
    for (std::size_t k = 0; k < report.labels.size(); ++k)
    {
      const LabelRecord &  label = report.labels[k];
      const PrunedRecord & pruned = label.pruned.at(i);
      if (facesBefore.at(k) == 0 || pruned.complex.faces > 0)
      {
        continue;
      }
      threshold = pruned.tolerance ? "--tolerance " + pruned.tolerance->height : "--lambda " + pruned.lambda;
      isFar =
        isFar || (pruned.tolerance ? pruned.tolerance->heightMm : pruned.lambdaMm) > farBeyond * label.core.maxRadiusMm;
      if (++count <= named)
      {
        char radius[32];
        (void)std::snprintf(radius, sizeof(radius), "%.3g", label.core.maxRadiusMm);
        text += count > 1 ? ", " : "";
        text += LabelText(label.label, label.name);
        text += " with a largest radius of ";
        text += radius;
        text += InUnit(" mm", report.input.geometry.unit);
      }
    }
    if (count > 0)
    {
      (isFar ? warnings : notes)
        .push_back(Text(threshold,
                        " leaves no face, only curves or a point, of ",
                        text,
                        count > named ? Text(", and ", count - named, " more labels") : "",
                        "; for surfaces give a smaller value"));
    }
  }
}

} // namespace voxelcore
