#include "NoisyLabels.h"

#include "JobTools.h"

#include <cstddef>
#include <cstdint>

namespace voxelcore
{

namespace
{

/** "312 of 313 loops, 41 of 41 cavities" */
std::string
NumbersText(const LabelRecord & label)
{
  std::string text;
  const auto  add = [&](std::uint64_t count, std::int64_t all, const char * what) {
    if (count > 0)
    {
      text += (text.empty() ? "" : ", ") + std::to_string(count) + " of " + std::to_string(all) + " " + what;
    }
  };
  add(label.fine->loops, label.shape.betti[1], "loops");
  add(label.fine->cavities, label.shape.betti[2], "cavities");
  add(label.fine->joined + label.fine->specks, label.shape.betti[0], "pieces");
  return text;
}

} // namespace

void
TellNoisyLabels(const CoreReport & report, std::vector<std::string> & warnings)
{
  constexpr std::size_t   named = 5;
  constexpr std::uint64_t least = 50; // advice that may remove more than one voxel in so many says so
  std::size_t             count = 0;
  bool                    hasSpecks = false;
  bool                    isMuch = false;
  std::string             text;
  for (const LabelRecord & label : report.labels)
  {
    if (!label.fine)
    {
      continue;
    }
    hasSpecks = hasSpecks || label.fine->specks > 0;
    isMuch = isMuch || least * label.fine->specks * (kSpeckVoxels - 1) > label.voxels;
    if (++count <= named)
    {
      text += (count > 1 ? "; " : "") + LabelText(label.label, label.name) + ": " + NumbersText(label);
    }
  }
  if (count > 0)
  {
    warnings.push_back(
      "less than three voxels wide, as noise makes them: " + text +
      (count > named ? "; and those of " + std::to_string(count - named) + " more labels" : std::string()) +
      "; unless they are real, remove them with --mend-shape --smooth-shape" +
      (hasSpecks && !isMuch ? " --min-voxels " + std::to_string(kSpeckVoxels) : std::string()) +
      "; where nothing thinner than two voxels is needed, give --denoise in place of --smooth-shape" +
      (isMuch ? "; pieces of fewer than " + std::to_string(kSpeckVoxels) +
                  " voxels may be more than 2 % of the voxels, and may touch at edges and corners: look at them with "
                  "'voxelcore info' before you remove them"
              : std::string()));
  }
}

} // namespace voxelcore
