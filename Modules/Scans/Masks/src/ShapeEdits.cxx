#include "voxelcore/Masks/ShapeEdits.h"

#include "EditRecords.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Shape/ShapeBits.h"
#include "voxelcore/Shape/TouchingPieces.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Masks/DepthSimplification.h"
#include "voxelcore/Masks/ShapeDenoising.h"
#include "voxelcore/Masks/ShapeSmoothing.h"
#include "voxelcore/Masks/TornPieces.h"
#include "voxelcore/Shape/ShapeOperations.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace voxelcore
{

namespace
{

EditRecord::Change
ChangeOf(const JoinedPieces::Joint & joint, const ImageGeometry & geometry)
{
  EditRecord::Change change;
  change.isFill = true;
  change.voxels = joint.voxels.size();
  change.cost = static_cast<double>(change.voxels); // each next to the shape
  change.difference = { 1 - joint.pieces, 0, 0 };
  Vector3 mean{ 0, 0, 0 };
  for (const auto & at : joint.voxels)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      mean[axis] += (at[axis] + 0.5) / static_cast<double>(change.voxels);
    }
  }
  change.centre = LatticeToPhysical(geometry, mean);
  return change;
}

EditRecord::Simplified
RecordOf(const DepthSimplified & result,
         const JoinedPieces &    joined,
         const TopologyNumbers & before,
         const ImageGeometry &   geometry)
{
  const SimplifiedShape & simplified = result.simplified;
  EditRecord::Simplified  record;
  record.before = before;
  for (const JoinedPieces::Joint & joint : joined.joints)
  {
    ++record.fills;
    record.voxelsAdded += joint.voxels.size();
    record.changes.push_back(ChangeOf(joint, geometry));
  }
  record.after = simplified.after;
  record.asAsked = simplified.asAsked;
  record.reason = result.reason;
  record.voxelsAdded += simplified.voxelsAdded;
  record.voxelsRemoved = simplified.voxelsRemoved;
  for (const TopologyChange & change : simplified.changes)
  {
    ++(change.isFill ? record.fills : record.cuts);
    const auto & at = change.centre;
    record.changes.push_back({ change.isFill,
                               LatticeToPhysical(geometry, { at[0] + 0.5, at[1] + 0.5, at[2] + 0.5 }),
                               change.voxels,
                               static_cast<double>(change.cost) / kCostOfOneVoxel,
                               change.difference });
  }
  ranges::stable_sort(record.changes, std::greater(), &EditRecord::Change::cost);
  return record;
}

/** Makes the shape one with the topology of the closed mask, which is counted apart from that, and says what changed.
 *  \throws InputError, which names `label`, where there is none; CertificateError where the numbers differ */
EditRecord::Connected
Connect(VoxelShape & shape, const std::string & label, const ProgressCallback & progress)
{
  EditRecord::Connected record;
  record.closed = ComputeClosedTopology(shape);
  ConnectedShape connected = ConnectOverCorners(shape, progress);
  if (!connected.left.empty())
  {
    const auto &      first = connected.left.front();
    const std::size_t count = connected.left.size();
    throw InputError(label + ": at " + Counted(count, "place", "places") + ", the first by voxel " +
                     std::to_string(first[0]) + "," + std::to_string(first[1]) + "," + std::to_string(first[2]) +
                     ", the mask is too rough for voxels that touch over edges and corners to be joined and nothing "
                     "else; clean it with --denoise or --mend-shape, or give --connectivity 6");
  }
  const TopologyNumbers after = ComputeShapeTopology(connected.shape);
  if (!(after == record.closed))
  {
    throw CertificateError(label + ": the shape made of voxels that touch over edges and corners has " +
                           CountsText(after) + ", and the mask " + CountsText(record.closed));
  }
  record.voxelsAdded = connected.voxelsAdded;
  record.voxelsRemoved = connected.voxelsRemoved;
  if (record.voxelsAdded + record.voxelsRemoved > 0)
  {
    record.piecesJoined = ComputeShapeTopology(shape).betti[0] - after.betti[0];
    record.changes = ChangesBetween(shape, connected.shape);
    shape = std::move(connected.shape);
  }
  return record;
}

/** Joins pieces that touch before a simplification that would take away the lesser of them: of a line of voxels over
 *  corners, one after the other. As many stay apart as were asked for. */
JoinedPieces
JoinTouching(VoxelShape & shape, const TopologyRequest & request)
{
  JoinedPieces joined;
  if (!request.IsGiven() || request.pieces) // else pieces stay as many as they are
  {
    joined = JoinTouchingPieces(shape, std::max<std::int64_t>(1, request.pieces.value_or(1)));
    shape = std::move(joined.shape);
  }
  return joined;
}

EditRecord
EditShape(VoxelShape &             shape,
          const ImageGeometry &    geometry,
          const ShapeEditOptions & options,
          const std::string &      label,
          const ProgressCallback & progress)
{
  EditRecord record;
  const auto give = [&shape] { return std::exchange(shape, VoxelShape()); };
  const auto take = [&shape](EditedShape edited) {
    shape = std::move(edited.shape);
    edited.shape = VoxelShape();
    return edited;
  };
  const auto takeRemoved = [&](EditedShape edited) {
    record.componentsRemoved += edited.componentsRemoved;
    record.voxelsRemoved += edited.voxelsRemoved;
    shape = std::move(edited.shape);
  };
  const auto takeFilled = [&](EditedShape edited) {
    shape = std::move(edited.shape);
    return EditRecord::Filled{ edited.voxelsAdded, edited.componentsJoined, edited.cavitiesFilled };
  };
  // Mended before anything is dropped: pieces torn off belong to what they were torn from.
  StagePlan              plan(progress,
                 { options.median ? 0.3 : 0.0,
                   options.denoise ? 0.5 : 0.0,
                   options.mend ? 2.0 : 0.0,
                   options.close ? 0.5 : 0.0,
                   options.fillHollows ? 0.5 : 0.0,
                   options.fillSlices ? 0.2 : 0.0,
                   options.connectivity != Connectivity::Six ? 0.3 : 0.0,
                   0.1,
                   options.smooth ? 1.0 : 0.0,
                   options.simplify ? 3.0 : 0.0 });
  const ProgressCallback filtering = plan.Next();
  if (options.median)
  {
    EditedShape filtered = take(MedianShape(shape, *options.median, filtering));
    record.filtered = { filtered.voxelsAdded, filtered.voxelsRemoved };
  }
  const ProgressCallback denoising = plan.Next();
  if (options.denoise)
  {
    EditedShape denoised = take(DenoiseShape(shape, geometry.spacing, denoising));
    record.denoised = { denoised.voxelsAdded, denoised.voxelsRemoved };
  }
  const ProgressCallback mending = plan.Next();
  if (options.mend)
  {
    MendedShape mended = MendShape(shape, mending);
    shape = std::move(mended.shape);
    record.mended = { mended.voxelsAdded,
                      mended.voxelsRemoved,
                      mended.piecesJoined,
                      mended.loopsClosed,
                      mended.cavitiesFilled };
  }
  // After mending, as holes of one voxel need no ball; before cavities are filled, as these make some.
  const ProgressCallback closing = plan.Next();
  if (options.close)
  {
    record.closed = takeFilled(CloseShape(give(), BallOfDiameter(*options.close, geometry), closing));
    // A ball leaves apart what meets at a corner alone.
    JoinedPieces joined = JoinTouchingPieces(shape);
    record.closed->voxelsAdded += joined.VoxelsAdded();
    record.closed->componentsJoined += joined.PiecesJoined();
    shape = std::move(joined.shape);
  }
  const ProgressCallback hollows = plan.Next();
  if (options.fillHollows)
  {
    record.hollows = takeFilled(FillHollows(give(),
                                            BallOfDiameter(*options.fillHollows, geometry),
                                            hollows,
                                            options.openAtBorder ? std::nullopt : std::optional(geometry.size)));
  }
  const ProgressCallback slices = plan.Next();
  if (options.fillSlices)
  {
    record.slices = takeFilled(FillSlices(give(), *options.fillSlices, slices));
  }
  // After what repairs the mask, and before its pieces and cavities are looked at.
  const ProgressCallback connecting = plan.Next();
  if (options.connectivity == Connectivity::TwentySix)
  {
    record.connected = Connect(shape, label, connecting);
  }
  else if (options.connectivity == Connectivity::Joined)
  {
    JoinedPieces joined = JoinTouchingPieces(shape);
    if (!joined.joints.empty() || joined.piecesApart > 0)
    {
      record.touching = { joined.VoxelsAdded(),
                          joined.PiecesJoined(),
                          joined.piecesApart,
                          ChangesBetween(shape, joined.shape) };
      shape = std::move(joined.shape);
    }
  }
  ReportProgress(plan.Next("editing"), "", 0);
  // Filled before counting: a hollow thing counts as the solid it becomes, and dust in its cavity is no component any
  // longer.
  if (options.fillCavities)
  {
    const EditedShape filled = take(FillCavities(give()));
    record.cavitiesFilled = filled.cavitiesFilled;
    record.voxelsAdded = filled.voxelsAdded;
    record.componentsJoined = filled.componentsJoined;
  }
  if (options.joinTorn)
  {
    TornPieces torn = JoinTornPieces(give(), geometry.spacing, *options.joinTorn);
    shape = std::move(torn.shape);
    record.torn = { torn.voxelsAdded, torn.piecesJoined, 0 };
  }
  if (options.minVoxels)
  {
    takeRemoved(RemoveSmallComponents(give(), *options.minVoxels));
  }
  if (options.largest)
  {
    takeRemoved(KeepLargestComponents(give(), *options.largest));
  }
  const ProgressCallback smoothing = plan.Next();
  if (options.smooth && shape.Box().size[0] > 0)
  {
    SmoothedShape smoothed = SmoothShape(shape, smoothing);
    shape = std::move(smoothed.shape);
    record.smoothed = { smoothed.voxelsAdded, smoothed.voxelsRemoved, smoothed.largestShift };
  }
  // Last: nothing that comes after changes the topology asked for.
  if (options.simplify && shape.Box().size[0] > 0)
  {
    const LatticeBall     ball = BallOfDepth(*options.simplify, geometry);
    const TopologyNumbers before = ComputeShapeTopology(shape);
    const JoinedPieces    joined = JoinTouching(shape, options.topology);
    DepthSimplified       result = SimplifyWithin(shape, ball, options.topology, plan.Next());
    record.simplified = RecordOf(result, joined, before, geometry);
    shape = Tightened(std::move(result.simplified.shape));
  }
  if (options.change)
  {
    ChangedShape changed = ChangeVoxels(shape, *options.change);
    record.changed = { changed.voxelsAdded, changed.voxelsRemoved };
    shape = std::move(changed.shape);
  }
  return record;
}

void
Append(LabelShape label, const std::optional<EditRecord> & record, bool split, std::vector<EditedLabel> & labels)
{
  if (!split)
  {
    label.voxels = label.shape.CountVoxels();
    labels.push_back({ std::move(label), 0, record });
    return;
  }
  std::vector<VoxelShape> parts = SplitComponents(label.shape);
  label.shape = VoxelShape();
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    const std::uint64_t voxels = parts[i].CountVoxels();
    labels.push_back(
      { { label.value, label.name + "#" + std::to_string(i + 1), voxels, std::move(parts[i]), label.color },
        static_cast<std::int64_t>(i + 1),
        record });
  }
}

/** Empty where none do. */
std::string
TouchingText(const MaskDiagnosis & found)
{
  return found.touching == 0
           ? std::string()
           : Counted(found.touching, "piece touches", "pieces touch") + " others over edges or corners alone" +
               (found.touchingVoxels > 0 ? " (" + ShareText(found.touchingVoxels, found.voxels) + " of the voxels)"
                                         : std::string());
}

void
TellTouching(const LabelTexts & touching, std::vector<std::string> & told)
{
  if (!touching.IsEmpty())
  {
    told.push_back(touching.Text() + "; join them with --connectivity joined");
  }
}

void
TellNoise(const std::vector<EditedLabel> & labels, std::uint64_t leastPiece, std::vector<std::string> & warnings)
{
  constexpr std::uint64_t mostRemoved = 50; // one voxel in so many: what takes more says so
  LabelTexts              told;
  MaskDiagnosis           all;
  std::uint64_t           removed = 0;
  bool                    isMuch = false;
  std::string             first;
  bool                    mayBeTrees = true;
  for (const EditedLabel & one : labels)
  {
    if (one.diagnosis && one.diagnosis->IsNoisy())
    {
      const MaskDiagnosis & found = *one.diagnosis;
      if (first.empty())
      {
        first = "--labels " + std::to_string(one.label.value) + " " + found.NoiseOptions();
      }
      told.Add(LabelText(one.label.value, one.label.name), found.NoiseText());
      all.loops += found.torn + found.loops + found.cavities;
      all.islands += found.islands;
      all.largestIsland = std::max(all.largestIsland, found.largestIsland);
      removed += found.VoxelsRemoved();
      all.voxels += found.voxels;
      isMuch = isMuch || mostRemoved * found.VoxelsRemoved() > found.voxels;
      mayBeTrees = mayBeTrees && found.MayBeTree() && !(one.edits && one.edits->simplified);
    }
  }
  if (told.IsEmpty())
  {
    return;
  }
  // One number of voxels for all labels might take a true piece of another one.
  const std::string options =
    all.islands > 0 && all.largestIsland >= leastPiece ? "one by one, such as " + first : "with " + all.NoiseOptions();
  warnings.push_back(
    told.Text() + "; unless they are real, mend them " + options +
    (isMuch ? ", which removes " + Counted(removed, "voxel", "voxels") + " (" + ShareText(removed, all.voxels) + ")"
            : std::string()) +
    (mayBeTrees ? "; for one tree, give --tree instead" : ""));
}

} // namespace

EditedLabels
EditLabels(std::vector<LabelShape>  labels,
           const ImageGeometry &    geometry,
           const ShapeEditOptions & options,
           bool                     keepAll,
           const std::string &      where,
           const ProgressCallback & progress)
{
  EditedLabels result;
  if (!options.AreAsked())
  {
    for (LabelShape & label : labels)
    {
      result.labels.push_back({ std::move(label), 0, std::nullopt });
    }
    return result;
  }
  if (options.change && labels.size() > 1)
  {
    throw InputError(where + ": --change-voxels changes one label, and here are " + std::to_string(labels.size()) +
                     "; choose one with --labels, or take all as one with --binary");
  }
  EditRecord       sum;
  ShapeEditOptions others = options;
  others.connectivity = Connectivity::Six;
  const bool               joinsOnly = options.connectivity == Connectivity::Joined && !others.AreAsked();
  std::vector<std::string> gone;
  std::vector<std::string> missed;
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    LabelShape &     label = labels[i];
    const double     count = static_cast<double>(labels.size());
    const EditRecord record =
      EditShape(label.shape,
                geometry,
                options,
                where + ": " + LabelText(label.value, label.name),
                PartOfProgress(progress, static_cast<double>(i) / count, static_cast<double>(i + 1) / count));
    AddEdits(record, sum);
    result.touched = result.touched || record.touching;
    if (record.simplified && !record.simplified->asAsked)
    {
      missed.push_back(LabelText(label.value, label.name) + ": the topology asked for was not reached within " +
                       options.simplify->text + " of the boundary: " + CountsText(record.simplified->after) +
                       " are left; " + record.simplified->reason);
    }
    if (label.shape.Box().size[0] == 0)
    {
      gone.push_back(LabelText(label.value, label.name));
      if (keepAll)
      {
        throw InputError(where + ": nothing is left of " + gone.back() +
                         " after removing components; ask for less, or for other --labels");
      }
      continue;
    }
    Append(std::move(label),
           joinsOnly && !record.touching ? std::nullopt : std::optional(record),
           options.splitComponents,
           result.labels);
  }
  if (result.labels.empty())
  {
    throw InputError(where + ": nothing is left of any label after removing components; ask for less");
  }
  result.notes = EditsInWords(sum, options);
  result.notes.insert(result.notes.end(), missed.begin(), missed.end());
  for (const std::string & label : gone)
  {
    result.notes.push_back("nothing is left of " + label);
  }
  return result;
}

std::vector<std::string>
ConnectLabels(std::vector<LabelShape> & labels,
              const ImageGeometry &     geometry,
              Connectivity              connectivity,
              const std::string &       where)
{
  std::vector<std::string> told;
  if (connectivity == Connectivity::Six)
  {
    LabelTexts touching;
    for (const LabelShape & label : labels)
    {
      touching.Add(LabelText(label.value, label.name), TouchingText(DiagnoseTouching(label.shape)));
    }
    TellTouching(touching, told);
    return told;
  }
  ShapeEditOptions options;
  options.connectivity = connectivity;
  EditedLabels edited = EditLabels(std::move(labels), geometry, options, true, where);
  labels.clear();
  for (EditedLabel & one : edited.labels)
  {
    labels.push_back(std::move(one.label));
    labels.back().connectivity =
      connectivity == Connectivity::Joined && !edited.touched ? Connectivity::Six : connectivity;
  }
  return told;
}

std::vector<std::string>
DiagnoseLabels(std::vector<EditedLabel> &          labels,
               const std::array<std::int64_t, 3> & weight,
               const ProgressCallback &            progress)
{
  ReportProgress(progress, "", 0);
  std::vector<std::uint64_t> least(labels.size());
  const auto                 look = [&](std::size_t i) {
    EditedLabel &                   one = labels[i];
    std::vector<const VoxelShape *> others;
    for (const EditedLabel & other : labels)
    {
      if (other.label.value != one.label.value)
      {
        others.push_back(&other.label.shape);
      }
    }
    one.hollow = FindHollowBody(one.label.shape, weight, others);
    MaskDiagnosis found = DiagnoseMask(one.label.shape);
    if (one.edits && one.edits->mended) // what is a voxel wide now came of other edits, and mending does not help
    {
      found.torn = found.tornVoxels = found.loops = found.bridges = found.cavities = 0;
    }
    if (one.edits && one.edits->componentsRemoved > 0) // those that stay were chosen to
    {
      found.islands = found.islandVoxels = found.largestIsland = 0;
    }
    least[i] = found.leastPiece;
    if (found.touching > 0 || found.IsNoisy())
    {
      one.diagnosis = found;
    }
  };
  if (labels.size() == 1) // within a parallel region, even of one thread, each one in there would start threads anew
  {
    look(0);
  }
  else
  {
    RunEach(labels.size(), look);
  }
  std::vector<std::string> warnings;
  for (const EditedLabel & one : labels)
  {
    if (one.hollow)
    {
      warnings.push_back(LabelText(one.label.value, one.label.name) + " " + HollowText(*one.hollow));
    }
  }
  LabelTexts touching;
  for (const EditedLabel & one : labels)
  {
    touching.Add(LabelText(one.label.value, one.label.name),
                 one.diagnosis ? TouchingText(*one.diagnosis) : std::string());
  }
  TellTouching(touching, warnings);
  TellNoise(labels, least.empty() ? 0 : ranges::min(least), warnings);
  return warnings;
}

} // namespace voxelcore
