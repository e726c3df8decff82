#pragma once
// What a user wants done to the shapes of a scan before anything is computed from them.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Labels/LabelMap.h"
#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Lattice/TopologyNumbers.h"
#include "voxelcore/Masks/HollowBody.h"
#include "voxelcore/Masks/MaskDiagnosis.h"
#include "voxelcore/Masks/ShapeClosing.h"
#include "voxelcore/Masks/ShapeMedian.h"
#include "voxelcore/Masks/SliceHoles.h"
#include "voxelcore/Masks/TopologySimplification.h"
#include "voxelcore/Masks/VoxelChanges.h"
#include "voxelcore/Shape/ShapeConnectivity.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

/** Done to each label by itself, in this order. */
struct ShapeEditOptions
{
  std::optional<MedianWidth>   median;
  bool                         denoise = false;
  bool                         mend = false;                     ///< what flips of single voxels have torn or pierced
  std::optional<GapWidth>      close;                            ///< gaps up to so wide
  std::optional<GapWidth>      fillHollows;                      ///< lumens that open only through holes up to so wide
  bool                         openAtBorder = false;             ///< the scan's border closes none of these lumens
  std::optional<SliceAxis>     fillSlices;                       ///< holes of the slices across this axis
  Connectivity                 connectivity = Connectivity::Six; ///< by which the mask is read
  bool                         fillCavities = false;
  bool                         fillUnasked = false; ///< cavities go because a curve cannot: told where there are some
  std::optional<double>        joinTorn;            ///< torn pieces, over gaps of so many diameters (TornPieces.h)
  std::optional<std::uint64_t> minVoxels;           ///< components (6-connected) of fewer voxels are removed
  std::optional<std::uint64_t> largest;             ///< so many components are kept
  bool                         smooth = false;
  std::optional<GapWidth>      simplify; ///< topology, by changes so deep (DepthSimplification.h)
  TopologyRequest              topology; ///< what `simplify` is to reach
  bool                         splitComponents = false;
  std::optional<VoxelChanges>  change; ///< of the only label; before components are split

  bool
  AreAsked() const
  {
    return median || denoise || mend || close || fillHollows || fillSlices || connectivity != Connectivity::Six ||
           fillCavities || joinTorn || minVoxels || largest || smooth || simplify || change || splitComponents;
  }
};

/** What was done to one label. */
struct EditRecord
{
  std::uint64_t cavitiesFilled = 0;
  std::uint64_t voxelsAdded = 0;      ///< in cavities
  std::uint64_t componentsJoined = 0; ///< components that lay in cavities
  std::uint64_t componentsRemoved = 0;
  std::uint64_t voxelsRemoved = 0; ///< with these components

  /** What MedianShape or DenoiseShape changed. */
  struct Filtered
  {
    std::uint64_t voxelsAdded = 0;
    std::uint64_t voxelsRemoved = 0;
  };

  /** By how much MendShape lowered each topology number. */
  struct Mended
  {
    std::uint64_t voxelsAdded = 0;
    std::uint64_t voxelsRemoved = 0;
    std::uint64_t piecesJoined = 0;
    std::uint64_t loopsClosed = 0;
    std::uint64_t cavitiesFilled = 0;
  };

  /** What SmoothShape changed. */
  struct Smoothed
  {
    std::uint64_t voxelsAdded = 0;
    std::uint64_t voxelsRemoved = 0;
    double        largestShift = 0; ///< voxels
  };

  /** What CloseShape, FillHollows, FillSlices or JoinTornPieces changed. */
  struct Filled
  {
    std::uint64_t voxelsAdded = 0;
    std::uint64_t componentsJoined = 0;
    std::uint64_t holes = 0; ///< lumens, or holes over all slices; of others 0
  };

  /** What ConnectOverCorners changed. */
  struct Connected
  {
    TopologyNumbers closed; ///< of the closed mask, and so of the shape
    std::int64_t    piecesJoined = 0;
    std::uint64_t   voxelsAdded = 0;
    std::uint64_t   voxelsRemoved = 0;
    VoxelChanges    changes; ///< all of them; reports have them, provenance in files does not
  };

  /** One cut or fill of SimplifyWithin. */
  struct Change
  {
    bool                        isFill = false;
    Vector3                     centre{ 0, 0, 0 }; ///< LPS mm, the mean of its voxels
    std::uint64_t               voxels = 0;
    double                      cost = 0;              ///< distance of its voxels to the boundary, summed; voxels
    std::array<std::int64_t, 3> difference{ 0, 0, 0 }; ///< it makes to pieces, loops and cavities
  };

  /** What JoinTouchingPieces changed. */
  struct Touching
  {
    std::uint64_t voxelsAdded = 0;
    std::uint64_t piecesJoined = 0;
    std::uint64_t piecesApart = 0; ///< that touch still
    VoxelChanges  changes;         ///< all of them; reports have them, provenance in files does not
  };

  /** What SimplifyWithin changed, and before that JoinTouchingPieces. */
  struct Simplified
  {
    TopologyNumbers     before;
    TopologyNumbers     after;
    bool                asAsked = true;
    std::string         reason; ///< of what was missed
    std::uint64_t       cuts = 0;
    std::uint64_t       fills = 0;
    std::uint64_t       voxelsAdded = 0;
    std::uint64_t       voxelsRemoved = 0;
    std::vector<Change> changes; ///< the costliest first; reports have them, provenance in files does not
  };

  std::optional<Filtered>   filtered;   ///< when asked: by MedianShape
  std::optional<Filtered>   denoised;   ///< when asked
  std::optional<Mended>     mended;     ///< when asked
  std::optional<Filled>     closed;     ///< when asked
  std::optional<Filled>     hollows;    ///< when asked
  std::optional<Filled>     slices;     ///< when asked
  std::optional<Connected>  connected;  ///< when asked: mask read by 26-connectivity
  std::optional<Touching>   touching;   ///< when asked: where pieces touched
  std::optional<Filled>     torn;       ///< when asked: pieces joined
  std::optional<Smoothed>   smoothed;   ///< when asked
  std::optional<Simplified> simplified; ///< when asked
  std::optional<Filtered>   changed;    ///< when asked: by ChangeVoxels
};

/** A label, or one of its components, to work on. */
struct EditedLabel
{
  LabelShape                label;         ///< of a component: its voxels, and the label's name with "#<component>"
  std::int64_t              component = 0; ///< from 1 by size when components are split; else 0
  std::optional<EditRecord> edits;         ///< of the whole label; none when nothing was asked
  // Filled by DiagnoseLabels(), where there is something to say:
  std::optional<HollowBody>    hollow = std::nullopt;
  std::optional<MaskDiagnosis> diagnosis = std::nullopt;
};

struct EditedLabels
{
  std::vector<EditedLabel> labels;          ///< by value, then component
  std::vector<std::string> notes;           ///< what was changed in all, one sentence each
  bool                     touched = false; ///< whether Connectivity::Joined found pieces that touch: else it is Six
};

/** Edits the labels of a scan, whose geometry says what widths mean. A label of which nothing is left is named in a
 *  note, or refused with `keepAll`: who names labels wants each of them.
 *  \throws InputError, naming the scan `where`, also when nothing is left at all, or for a width in mm where the scan
 *  has none; Cancelled */
EditedLabels
EditLabels(std::vector<LabelShape>  labels,
           const ImageGeometry &    geometry,
           const ShapeEditOptions & options,
           bool                     keepAll,
           const std::string &      where,
           const ProgressCallback & progress = {});

/** Makes the voxels of labels hang together, as for filters of other toolkits, and says so in each; with Six nothing
 *  changes. Returns what a user should be told: with Six, which have pieces that touch over edges and corners alone.
 *  \throws InputError with 26 where a mask is too rough for it, Cancelled */
std::vector<std::string>
ConnectLabels(std::vector<LabelShape> & labels,
              const ImageGeometry &     geometry,
              Connectivity              connectivity,
              const std::string &       where);

/** Looks once at the labels that a job is to work on: which look hollow, where other labels count as what fills lumens;
 *  which have pieces that touch over edges and corners alone; and of which noise decides the topology. Says so in
 *  warnings, each with the options that mend it. */
std::vector<std::string>
DiagnoseLabels(std::vector<EditedLabel> &          labels,
               const std::array<std::int64_t, 3> & weight,
               const ProgressCallback &            progress = {});

} // namespace voxelcore
