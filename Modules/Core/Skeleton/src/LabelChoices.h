#pragma once
// The label of each point of a graph.

#include "voxelcore/Shape/LabelContacts.h"
#include "voxelcore/Skeleton/SkeletonGraph.h"

#include <array>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace voxelcore
{

/** Labels are their positions in the list. */
struct LabelShare
{
  std::uint32_t label = 0;
  double        share = 0;
};

/** Per point the labels in its ball, by label; the shares sum up to 1. */
using LabelShares = std::vector<std::vector<LabelShare>>;

double
ShareOf(const std::vector<LabelShare> & shares, std::uint32_t label);

/** Where the ball holds no label it grows until it does. */
LabelShares
FindLabelShares(const SkeletonGraph & graph, const std::vector<LabelShape> & labels, const ImageGeometry & geometry);

using LabelPairs = std::set<std::array<std::uint32_t, 2>>; ///< the smaller first

/** The cheapest labels of all points (LabelNetwork.h). */
std::vector<std::uint32_t>
ChooseLabels(const SkeletonGraph & graph, const LabelShares & shares, const LabelPairs & touching, std::size_t labels);

} // namespace voxelcore
