#include "SkeletonNotes.h"

#include "voxelcore/Jobs/JobTools.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Report/SkeletonTexts.h"

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
    labels += ranges::any_of(border.sections, isCut) ? 1 : 0;
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
  const auto count = ranges::count_if(report.labels, isAtBorder);
  if (count > 0 && !report.parameters.resolution)
  {
    notes.push_back(Counted(static_cast<std::uint64_t>(count),
                            "body at the border of the scan ends there",
                            "bodies at the border of the scan end there") +
                    ", as in the core; for branches that run up to the border, give the scan instead of the core");
  }
}

void
TellShortLoops(const CoreReport & report, std::vector<std::string> & notes)
{
  constexpr double little = 0.05; // airways of five teams have 0.4 to 1.3 %, an arch over a true ring more
  LabelTexts       told;
  for (const LabelRecord & label : report.labels)
  {
    const bool isTold = label.diagnosis && label.diagnosis->MayBeTree();
    if (!label.skeleton || label.skeleton->network || isTold || (label.edits && label.edits->simplified))
    {
      continue;
    }
    const SkeletonNumbers & numbers = label.skeleton->numbers;
    if (numbers.cycles > 0 && numbers.isolatedLoops == 0 && numbers.closingLength <= little * numbers.totalLength)
    {
      told.Add(LabelText(label.label, label.name),
               Counted(static_cast<std::uint64_t>(numbers.cycles), "loop", "loops") + ", closed by " +
                 ShortText(100 * numbers.closingLength / numbers.totalLength, 2) + " % of the length");
    }
  }
  if (!told.IsEmpty())
  {
    notes.push_back(told.Text() +
                    "; to cut loops: --tree, or --simplify-topology 3vox --loops 0 where there are several pieces");
  }
}

void
TellConnectivity(const std::filesystem::path & input, const CoreReport & report, std::vector<std::string> & notes)
{
  const Connectivity connectivity = report.parameters.edits.connectivity;
  const bool         hasPieces =
    ranges::any_of(report.labels, [](const LabelRecord & label) { return label.shape.betti[0] > 1; });
  if (connectivity != Connectivity::Six)
  {
    notes.push_back(input.string() + " was made with --connectivity " + std::string(ConnectivityName(connectivity)));
  }
  else if (hasPieces)
  {
    notes.push_back(input.string() +
                    " has pieces that share no faces (--connectivity 6): where they touch over edges "
                    "and corners, make the core with --connectivity joined to join them");
  }
}

} // namespace voxelcore
