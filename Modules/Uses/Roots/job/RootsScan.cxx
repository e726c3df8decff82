#include "RootsScan.h"

#include "voxelcore/Base/Text.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Imaging/GreyVolume.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Labels/GreyScan.h"
#include "voxelcore/Masks/CleftFilling.h"
#include "voxelcore/Masks/DepthSimplification.h"
#include "voxelcore/Roots/GreyLevels.h"
#include "voxelcore/Roots/RootsJob.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

/** Voxels of the greatest spacing: so far away the walls of a dried root's clefts are looked for. 6: roots of maize are
 *  177, not 171. */
constexpr double kCleftReach = 8;
/** Of loops, cavities and pieces, the share that must go with clefts for them to be filled: of maize 69 % do, of solid
 *  crowns 5 %, where touching roots would be joined (levels of drawn crowns 88.9 %, not 92.4). */
constexpr double kShareOfClefts = 0.5;

/** What is a wall where values are known: brighter than halfway from what is dark beside the roots to the threshold,
 *  and of the piece with most. Bark is dimmer than roots are; noise hangs together no farther. */
VoxelShape
WallsBeside(const VoxelShape & shape, const CoreOptions & core, const ImageGeometry & geometry, double reach)
{
  if (!core.reading.threshold || core.resolution || IsMeshFile(core.scan))
  {
    return shape;
  }
  const GapWidth width{ reach / ranges::min(geometry.spacing), SpatialUnit::Voxels, "" };
  BandValues     values(VoxelsAround(shape, BallOfDepth(width, geometry)));
  VisitGreyRows(core.scan, values.Band().Box(), core.reading, [&](auto y, auto z, std::span<const float> row) {
    values.SetRow(y, z, row);
  });
  const double       level = core.reading.threshold->first;
  std::vector<float> dark;
  ranges::copy_if(values.All(), std::back_inserter(dark), [&](float value) { return value < level; });
  if (dark.empty())
  {
    return shape;
  }
  const auto middle = dark.begin() + static_cast<std::ptrdiff_t>(dark.size() / 2);
  ranges::nth_element(dark, middle);
  return KeepLargestComponents(AtLeast(shape, values, level, 0.5 * (*middle + level)), 1).shape;
}

/** Fills clefts of dried roots, each label's; gives the number of voxels. */
std::uint64_t
FillClefts(InputScan & volume, const CoreOptions & core)
{
  const double  reach = kCleftReach * ranges::max(volume.geometry.spacing);
  std::uint64_t count = 0;
  for (LabelShape & label : volume.labels)
  {
    const VoxelShape walls = WallsBeside(label.shape, core, volume.geometry, reach);
    const auto       scan = core.edits.openAtBorder ? std::nullopt : std::optional(volume.geometry.size);
    EditedShape      filled = FillClefts(std::move(label.shape), walls, volume.geometry.spacing, reach, scan);
    label.shape = std::move(filled.shape);
    label.voxels += filled.voxelsAdded;
    count += filled.voxelsAdded;
  }
  return count;
}

/** Edits by the width in voxels up to which holes are closed, of those tried that with the fewest pieces, loops and
 *  cavities left; the least of equals. Puts it into `core`. Gives how many are left, too. */
std::pair<EditedLabels, std::int64_t>
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
  return { std::move(best), fewest };
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

RootsScan
LookAtScan(CoreOptions & core, bool asIs, std::vector<std::string> & notes)
{
  InputScan volume;
  try
  {
    volume = ReadScanOrMesh(core.scan, core.reading, core.resolution);
  }
  catch (const GreyScanError & error)
  {
    core.reading.threshold = std::pair(error.grey.proposed, std::numeric_limits<double>::infinity());
    core.reading.refuseGrey = false;
    notes.push_back(core.scan.string() + ": " + GreyScanText(error.grey) + "; threshold " + ProposedRange(error.grey) +
                    ", the one that 'voxelcore info' proposes; for another give --threshold");
    volume = ReadScanOrMesh(core.scan, core.reading, core.resolution);
  }
  const auto edit = [&](std::vector<LabelShape> labels, const ShapeEditOptions & edits) {
    return EditLabels(std::move(labels), volume.geometry, edits, core.reading.labels != "all", core.scan.string());
  };
  RootsScan mask;
  if (!asIs && !core.edits.close && !core.edits.fillHollows && !core.edits.fillSlices)
  {
    CoreOptions   other = core;
    InputScan     clefts = volume;
    std::uint64_t voxels = FillClefts(clefts, core);
    auto [edited, left] = EditByBestWidth(volume, core);
    if (voxels > 0 && left > 0)
    {
      auto [filled, leftThen] = EditByBestWidth(clefts, other);
      voxels = static_cast<double>(leftThen) <= (1 - kShareOfClefts) * static_cast<double>(left) ? voxels : 0;
      if (voxels > 0)
      {
        core.edits.fillHollows = other.edits.fillHollows;
        ShapeEditOptions plain = core.edits;
        plain.change.reset();
        mask.plain = std::move(edit(std::move(volume.labels), plain).labels.front().label.shape);
        notes.push_back(Counted(voxels, "voxel", "voxels") + " in clefts of roots filled, which walls surround");
        volume.labels = std::move(clefts.labels);
        edited = std::move(filled);
      }
    }
    mask.scan.edited = std::move(edited);
    const auto hasHollows = [](const EditedLabel & one) {
      return one.edits && one.edits->hollows && one.edits->hollows->voxelsAdded > 0;
    };
    if (ranges::any_of(mask.scan.edited.labels, hasHollows))
    {
      notes.push_back("hollows are filled where they open through holes up to " + core.edits.fillHollows->text +
                      " wide; for another width give --fill-hollows");
    }
  }
  if (mask.scan.edited.labels.empty() || core.edits.simplify || core.edits.change)
  {
    mask.scan.edited = edit(std::move(volume.labels), core.edits);
  }
  volume.labels = {};
  mask.scan.volume = std::move(volume);
  return mask;
}

} // namespace voxelcore
