#include "RootsScan.h"

#include "voxelcore/Base/Text.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Labels/GreyScan.h"
#include "voxelcore/Roots/RootsJob.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace voxelcore
{

namespace
{

/** Edits by the width in voxels up to which holes are closed, of those tried that with the fewest pieces, loops and
 *  cavities left; the least of equals. Puts it into `core`. */
EditedLabels
EditByBestWidth(const LabelMap & volume, CoreOptions & core)
{
  // In voxels of the greatest spacing. Lumens must be wider than that to be found, holes narrower to be closed.
  const Vector3 & spacing = volume.geometry.spacing;
  const auto [least, most] = std::minmax({ spacing[0], spacing[1], spacing[2] });
  EditedLabels            best;
  std::optional<GapWidth> bestWidth;
  std::int64_t            fewest = 0;
  for (const double holes : { 2.5, 4.0, 6.0 })
  {
    ShapeEditOptions edits = core.edits;
    edits.simplify.reset(); // it would cut the loops by which widths are compared
    edits.change.reset();
    edits.fillHollows = ParseGapWidth(RoundTripText(std::round(10 * holes * most / least) / 10) + "vox");
    EditedLabels edited =
      EditLabels(volume.labels, volume.geometry, edits, core.reading.labels != "all", core.scan.string());
    std::int64_t left = 0;
    for (const EditedLabel & one : edited.labels)
    {
      const auto betti = ComputeShapeTopology(one.label.shape).betti;
      left += betti[0] - 1 + betti[1] + betti[2];
    }
    if (!bestWidth || left < fewest)
    {
      bestWidth = edits.fillHollows;
      best = std::move(edited);
      fewest = left;
    }
    if (fewest == 0)
    {
      break;
    }
  }
  core.edits.fillHollows = bestWidth;
  return best;
}

} // namespace

void
CleanForRoots(ShapeEditOptions & edits)
{
  edits.mend = true;
  edits.fillCavities = true;
  if (!edits.largest && !edits.minVoxels)
  {
    edits.largest = 1;
  }
}

CleanMask
LookAtScan(CoreOptions & core, bool asIs, std::vector<std::string> & notes)
{
  InputScan volume;
  try
  {
    volume = ReadScanOrMesh(core.scan, core.reading, core.resolution);
  }
  catch (const GreyScanError & error)
  {
    core.reading.threshold = std::pair(error.grey.half, std::numeric_limits<double>::infinity());
    core.reading.refuseGrey = false;
    notes.push_back(
      core.scan.string() + ": " + GreyScanText(error.grey) + "; threshold " + RoundTripText(error.grey.half) +
      ":inf, halfway between background and roots (Otsu: " + OtsuRange(error.grey) + "); for another give --threshold");
    volume = ReadScanOrMesh(core.scan, core.reading, core.resolution);
  }
  CleanMask mask{ volume.geometry, BorderOf(volume), {} };
  if (!asIs && !core.edits.close && !core.edits.fillHollows && !core.edits.fillSlices)
  {
    mask.edited = EditByBestWidth(volume, core);
    notes.push_back("hollows are filled where they open through holes up to " + core.edits.fillHollows->text +
                    " wide; for another width give --fill-hollows");
    if (!core.edits.simplify && !core.edits.change)
    {
      return mask;
    }
  }
  mask.edited =
    EditLabels(std::move(volume.labels), volume.geometry, core.edits, core.reading.labels != "all", core.scan.string());
  return mask;
}

} // namespace voxelcore
