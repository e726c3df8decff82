#pragma once
// A curve skeleton with its numbers: what is written and drawn.

#include "voxelcore/Base/Library.h"
#include "voxelcore/Skeleton/BranchTable.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

/** A label of a network. */
struct NetworkLabel
{
  std::int64_t  value = 0;
  std::string   name;
  std::uint64_t voxels = 0;
  double        volumeMm3 = 0;
};

/** A place where two labels of a network touch, as FindLabelContacts() has it. */
struct NetworkContact
{
  std::array<std::int64_t, 2>        labels{}; ///< values, the smaller first
  std::uint64_t                      voxels = 0;
  std::uint64_t                      faces = 0; ///< between voxels of the two
  double                             areaMm2 = 0;
  std::array<double, 3>              centre{}; ///< LPS mm
  std::vector<std::array<double, 3>> places;   ///< where their branches meet; none where none do
};

/** Where two labels follow each other in a network that do not touch: edits of the shape have joined them. */
struct NetworkGap
{
  std::array<std::int64_t, 2> labels{};
  std::array<double, 3>       place{};
};

/** Of the skeleton of several labels taken as one body. Its graph says which label each point is of. */
struct SkeletonNetwork
{
  std::vector<NetworkLabel>   labels; ///< by value
  std::vector<NetworkContact> contacts;
  std::vector<NetworkGap>     gaps;

  /** Empty for a value that no label has. */
  std::string
  NameOf(std::int64_t value) const
  {
    const auto own = ranges::find(labels, value, &NetworkLabel::value);
    return own == labels.end() ? std::string() : own->name;
  }
};

/** Of a branch in a map of probabilities: the unbroken row of thresholds at which it is there. */
struct BranchLife
{
  double lowest = 0;
  double highest = 0;

  double
  Persistence() const
  {
    return highest - lowest;
  }
};

/** The skeleton of one label, or of one component of it; positions in LPS mm. */
struct MeasuredSkeleton
{
  std::int64_t  label = 0;
  std::int64_t  component = 0; ///< from 1 for a label split into its components; 0: the whole label
  std::string   name;
  SkeletonGraph graph;
  BranchTable   table; ///< of this graph

  std::optional<SkeletonNetwork> network{}; ///< of several labels; `label` is then that of their union
  std::vector<BranchLife>        lives{};   ///< of a map of probabilities, per branch; else empty
  std::vector<std::string>       names{};   ///< per branch, where a person gave some; else empty
};

/** The part of a network that is of each of its labels, in their order, measured by itself: nodes where it meets others
 *  stay nodes, and are no tips. Without points where a label has no line. */
std::vector<MeasuredSkeleton>
PartsByLabel(const MeasuredSkeleton & network);

} // namespace voxelcore
