#pragma once
// What a user wants done to the shapes of a scan before anything is computed from them.

#include "voxelcore/LabelMap.h"
#include "voxelcore/Progress.h"
#include "voxelcore/ShapeClosing.h"
#include "voxelcore/ShapeMedian.h"
#include "voxelcore/SliceHoles.h"

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
  bool                         mend = false; ///< what flips of single voxels have torn or pierced
  std::optional<GapWidth>      close;        ///< gaps up to so wide
  std::optional<GapWidth>      fillHollows;  ///< lumens that open only through holes up to so wide
  std::optional<SliceAxis>     fillSlices;   ///< holes of the slices across this axis
  bool                         fillCavities = false;
  std::optional<std::uint64_t> minVoxels; ///< components (6-connected) of fewer voxels are removed
  std::optional<std::uint64_t> largest;   ///< so many components are kept
  bool                         smooth = false;
  bool                         splitComponents = false;

  bool
  AreAsked() const
  {
    return median || mend || close || fillHollows || fillSlices || fillCavities || minVoxels || largest || smooth ||
           splitComponents;
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

  /** What MedianShape changed. */
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

  /** What CloseShape, FillHollows or FillSlices changed. */
  struct Filled
  {
    std::uint64_t voxelsAdded = 0;
    std::uint64_t componentsJoined = 0;
    std::uint64_t holes = 0; ///< lumens, or holes over all slices; of closing 0
  };

  std::optional<Filtered> filtered; ///< when asked
  std::optional<Mended>   mended;   ///< when asked
  std::optional<Filled>   closed;   ///< when asked
  std::optional<Filled>   hollows;  ///< when asked
  std::optional<Filled>   slices;   ///< when asked
  std::optional<Smoothed> smoothed; ///< when asked
};

/** A label, or one of its components, to work on. */
struct EditedLabel
{
  LabelShape                label;         ///< of a component: its voxels, and the label's name with "#<component>"
  std::int64_t              component = 0; ///< from 1 by size when components are split; else 0
  std::optional<EditRecord> edits;         ///< of the whole label; none when nothing was asked
};

struct EditedLabels
{
  std::vector<EditedLabel> labels; ///< by value, then component
  std::vector<std::string> notes;  ///< what was changed in all, one sentence each
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

} // namespace voxelcore
