#include "BorderNotes.h"

#include "voxelcore/SkeletonTexts.h"
#include "voxelcore/TextFields.h"

#include <algorithm>
#include <set>

namespace voxelcore
{

void
TellBorderCuts(const CoreReport & report, std::vector<std::string> & notes)
{
  std::size_t           labels = 0;
  std::size_t           ends = 0;
  std::set<std::string> sides;
  for (const LabelRecord & label : report.labels)
  {
    if (!label.skeleton || !label.skeleton->border)
    {
      continue;
    }
    const BorderNumbers & border = *label.skeleton->border;
    const auto            isCut = [](const BorderSection & section) { return section.isCut; };
    labels += std::ranges::any_of(border.sections, isCut) ? 1 : 0;
    ends += border.ends;
    for (const BorderSection & section : border.sections)
    {
      if (section.isCut)
      {
        sides.insert(BorderSideText(section));
      }
    }
  }
  if (labels == 0)
  {
    return;
  }
  std::string where;
  for (const std::string & side : sides)
  {
    where += (where.empty() ? "" : ", ") + side;
  }
  notes.push_back("the border of the scan cuts " + Counted(labels, "body", "bodies") + " (" + where + "); " +
                  Counted(ends, "branch runs", "branches run") +
                  " up to it; to let bodies end before it: --border closed");
}

void
TellClosedBorder(const CoreReport & report, std::vector<std::string> & notes)
{
  const ImageGeometry & geometry = report.input.geometry;
  const auto &          crop = report.parameters.reading.crop;
  const auto            isAtBorder = [&](const LabelRecord & label) {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::int64_t first = crop ? crop->first[axis] : 0;
      const std::int64_t end = crop ? std::int64_t{ crop->end[axis] } : geometry.size[axis];
      const std::int64_t low = label.box.lower[axis];
      if (end - first > 1 && (low <= first || low + label.box.size[axis] >= end))
      {
        return true;
      }
    }
    return false;
  };
  const auto count = std::ranges::count_if(report.labels, isAtBorder);
  if (count > 0 && !report.parameters.resolution)
  {
    notes.push_back(Counted(static_cast<std::uint64_t>(count),
                            "body at the border of the scan ends there",
                            "bodies at the border of the scan end there") +
                    ", as in the core; for branches that run up to the border, give the scan instead of the core");
  }
}

} // namespace voxelcore
