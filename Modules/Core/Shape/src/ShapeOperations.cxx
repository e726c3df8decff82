#include "voxelcore/Shape/ShapeOperations.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Shape/ShapeBits.h"
#include "voxelcore/Shape/ShapeRuns.h"

#include "voxelcore/Base/CountBits.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace voxelcore
{

namespace
{

/** The runs of a shape or of its background and what component each is part of, numbered by their first runs. */
struct Components
{
  Runs                       runs;
  std::vector<std::uint32_t> of;     ///< per run
  std::vector<std::uint64_t> voxels; ///< per component
};

Components
FindComponents(Runs runs, bool diagonals)
{
  Components components;
  UnionFind  sets = UniteRuns(runs, diagonals);
  components.of.resize(runs.begin.size());
  components.voxels.reserve(sets.Count());
  for (std::size_t run = 0; run < components.of.size(); ++run)
  {
    const std::size_t first = sets.Find(run);
    if (first == run)
    {
      components.of[run] = static_cast<std::uint32_t>(components.voxels.size());
      components.voxels.push_back(0);
    }
    else
    {
      components.of[run] = components.of[first];
    }
    components.voxels[components.of[run]] += static_cast<std::uint64_t>(runs.end[run] - runs.begin[run]);
  }
  components.runs = std::move(runs);
  return components;
}

/** Calls visit(run, y, z) for all runs, with their row's place among the rows. */
template <typename TVisit>
void
VisitRuns(const Runs & runs, TVisit visit)
{
  std::size_t row = 0;
  for (std::int32_t z = 0; z < runs.rowsZ; ++z)
  {
    for (std::int32_t y = 0; y < runs.rowsY; ++y, ++row)
    {
      for (std::size_t run = runs.rowStart[row]; run < runs.rowStart[row + 1]; ++run)
      {
        visit(run, y, z);
      }
    }
  }
}

/** Component numbers, the largest first. The sort is stable and numbers follow the first voxels: that decides ties. */
std::vector<std::uint32_t>
BySize(const std::vector<std::uint64_t> & voxels)
{
  std::vector<std::uint32_t> order(voxels.size());
  std::iota(order.begin(), order.end(), std::uint32_t{ 0 });
  std::stable_sort(order.begin(), order.end(), [&voxels](std::uint32_t a, std::uint32_t b) {
    return voxels[a] > voxels[b];
  });
  return order;
}

EditedShape
RemoveComponents(VoxelShape shape, const Components & components, const std::vector<std::uint8_t> & removed)
{
  EditedShape edited;
  for (std::size_t component = 0; component < removed.size(); ++component)
  {
    edited.componentsRemoved += removed[component];
    edited.voxelsRemoved += removed[component] ? components.voxels[component] : 0;
  }
  if (edited.componentsRemoved > 0)
  {
    VisitRuns(components.runs, [&](std::size_t run, std::int32_t y, std::int32_t z) {
      if (removed[components.of[run]])
      {
        SetRun(shape.Row(y, z), components.runs.begin[run], components.runs.end[run], false);
      }
    });
  }
  edited.shape = Tightened(std::move(shape));
  return edited;
}

/** What two boxes have in common. */
VoxelBox
CommonBox(const VoxelBox & all, const VoxelBox & box)
{
  VoxelBox common;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::int64_t low = std::max<std::int64_t>(all.lower[axis], box.lower[axis]);
    const std::int64_t high = std::min(std::int64_t{ all.lower[axis] } + all.size[axis],
                                       std::int64_t{ box.lower[axis] } + std::max(box.size[axis], 0));
    if (high <= low)
    {
      return { all.lower, { 0, 0, 0 } };
    }
    common.lower[axis] = static_cast<std::int32_t>(low);
    common.size[axis] = static_cast<std::int32_t>(high - low);
  }
  return common;
}

} // namespace

VoxelShape
VoxelsWithin(const VoxelShape & shape, const VoxelBox & box)
{
  return Tightened(CopyBox(shape, CommonBox(shape.Box(), box)));
}

VoxelBox
BoxOfBoth(const VoxelBox & a, const VoxelBox & b)
{
  if (a.size[0] == 0 || b.size[0] == 0)
  {
    return a.size[0] == 0 ? b : a;
  }
  VoxelBox box;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] = std::min(a.lower[axis], b.lower[axis]);
    box.size[axis] = std::max(a.lower[axis] + a.size[axis], b.lower[axis] + b.size[axis]) - box.lower[axis];
  }
  return box;
}

EditedShape
CropToBox(VoxelShape shape, const VoxelBox & box)
{
  const VoxelBox common = CommonBox(shape.Box(), box);
  EditedShape    edited;
  if (common.size == shape.Box().size)
  {
    edited.shape = Tightened(std::move(shape));
    return edited;
  }
  const std::uint64_t before = shape.CountVoxels();
  edited.shape = Tightened(CopyBox(shape, common));
  edited.voxelsRemoved = before - edited.shape.CountVoxels();
  return edited;
}

EditedShape
RemoveSmallComponents(VoxelShape shape, std::uint64_t minVoxels)
{
  const Components          components = FindComponents(VoxelRuns(shape), false);
  std::vector<std::uint8_t> removed;
  removed.reserve(components.voxels.size());
  for (const std::uint64_t voxels : components.voxels)
  {
    removed.push_back(voxels < minVoxels ? 1 : 0);
  }
  return RemoveComponents(std::move(shape), components, removed);
}

EditedShape
KeepLargestComponents(VoxelShape shape, std::uint64_t count)
{
  const Components                 components = FindComponents(VoxelRuns(shape), false);
  const std::vector<std::uint32_t> order = BySize(components.voxels);
  std::vector<std::uint8_t>        removed(order.size(), 0);
  for (std::size_t place = 0; place < order.size(); ++place)
  {
    removed[order[place]] = place >= count ? 1 : 0;
  }
  return RemoveComponents(std::move(shape), components, removed);
}

EditedShape
FillCavities(VoxelShape shape)
{
  EditedShape edited;
  {
    const Components background = FindComponents(BackgroundRuns(shape), true);
    edited.cavitiesFilled = background.voxels.size() - 1;
    if (edited.cavitiesFilled > 0)
    {
      const std::int64_t before = CountComponents(VoxelRuns(shape), false);
      VisitRuns(background.runs, [&](std::size_t run, std::int32_t y, std::int32_t z) {
        // Component 0 is the outside; no other one reaches the rim by which the rows are more.
        if (background.of[run] != 0)
        {
          SetRun(shape.Row(y - 1, z - 1), background.runs.begin[run], background.runs.end[run], true);
          edited.voxelsAdded += static_cast<std::uint64_t>(background.runs.end[run] - background.runs.begin[run]);
        }
      });
      edited.componentsJoined = static_cast<std::uint64_t>(before - CountComponents(VoxelRuns(shape), false));
    }
  }
  edited.shape = Tightened(std::move(shape));
  return edited;
}

std::vector<std::uint64_t>
ComponentSizes(const VoxelShape & shape)
{
  const Components           components = FindComponents(VoxelRuns(shape), false);
  std::vector<std::uint64_t> sizes(components.voxels.begin(), components.voxels.end());
  ranges::sort(sizes, std::greater());
  return sizes;
}

std::vector<VoxelShape>
SplitComponents(const VoxelShape & shape)
{
  constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
  struct Extent
  {
    std::array<std::int32_t, 3> low{ most, most, most };
    std::array<std::int32_t, 3> high{ 0, 0, 0 }; ///< one past the last
  };
  const Components    components = FindComponents(VoxelRuns(shape), false);
  const Runs &        runs = components.runs;
  std::vector<Extent> extents(components.voxels.size());
  VisitRuns(runs, [&](std::size_t run, std::int32_t y, std::int32_t z) {
    Extent & extent = extents[components.of[run]];
    extent.low = { std::min(extent.low[0], runs.begin[run]), std::min(extent.low[1], y), std::min(extent.low[2], z) };
    extent.high = { std::max(extent.high[0], runs.end[run]),
                    std::max(extent.high[1], y + 1),
                    std::max(extent.high[2], z + 1) };
  });

  const std::vector<std::uint32_t> order = BySize(components.voxels);
  std::vector<std::uint32_t>       place(order.size());
  std::vector<VoxelShape>          parts;
  parts.reserve(order.size());
  for (const std::uint32_t component : order)
  {
    place[component] = static_cast<std::uint32_t>(parts.size());
    const Extent & extent = extents[component];
    VoxelBox       box;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      box.lower[axis] = shape.Box().lower[axis] + extent.low[axis];
      box.size[axis] = extent.high[axis] - extent.low[axis];
    }
    parts.emplace_back(box);
  }
  VisitRuns(runs, [&](std::size_t run, std::int32_t y, std::int32_t z) {
    const auto & low = extents[components.of[run]].low;
    VoxelShape & part = parts[place[components.of[run]]];
    SetRun(part.Row(y - low[1], z - low[2]), runs.begin[run] - low[0], runs.end[run] - low[0], true);
  });
  for (VoxelShape & part : parts)
  {
    part.Compact();
  }
  return parts;
}

std::int32_t
CountBits(const ConstShapeRow & row, std::int32_t begin, std::int32_t end)
{
  if (begin >= end)
  {
    return 0;
  }
  const auto          first = static_cast<std::size_t>(begin) / 64;
  const auto          last = static_cast<std::size_t>(end - 1) / 64;
  const std::uint64_t from = ~std::uint64_t{ 0 } << (static_cast<unsigned>(begin) & 63U);
  const std::uint64_t to = ~std::uint64_t{ 0 } >> (63U - (static_cast<unsigned>(end - 1) & 63U));
  if (first == last)
  {
    return CountBits(row[first] & from & to);
  }
  std::int32_t count = CountBits(row[first] & from) + CountBits(row[last] & to);
  for (std::size_t word = first + 1; word < last; ++word)
  {
    count += CountBits(row[word]);
  }
  return count;
}

} // namespace voxelcore
