#include "voxelcore/Base/CountBits.h"
#include "voxelcore/Blocks/BlockRegions.h"
#include "voxelcore/Blocks/HaloBlocks.h"

#include "BlockParts.h"
#include "BoundaryBits.h"
#include "HaloRegion.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Lattice/Predicates.h"
#include "voxelcore/Shape/BoundaryVertices.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

bool
InScanOrder(const LatticePoint & a, const LatticePoint & b)
{
  return a.z != b.z ? a.z < b.z : a.y != b.y ? a.y < b.y : a.x < b.x;
}

std::int32_t
Coordinate(const LatticePoint & p, std::size_t axis)
{
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

bool
Holds(const HaloBlock & block, const LatticePoint & p)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (Coordinate(p, axis) < Coordinate(block.lower, axis) || Coordinate(p, axis) >= Coordinate(block.upper, axis))
    {
      return false;
    }
  }
  return true;
}

// Sign of the sphere's centre along an axis less a whole number, exactly. Rounding is monotone, so the rounded
// coordinate decides unless it is that number.
int
CompareCentre(double                 rounded,
              const CircumSphere &   sphere,
              std::size_t            axis,
              std::int32_t           plane,
              const SpacingWeights & weights)
{
  if (rounded != plane)
  {
    return rounded < plane ? -1 : 1;
  }
  // centre - plane = base - plane + n / (2 det w^2): 12 w^2 N^4 and 18 w^2 N^4 at most, far below the in-sphere bound.
  const std::int64_t w = weights.weight[axis];
  const Int128       steps = Int128{ Coordinate(sphere.base, axis) } - plane;
  const Int128       value = 2 * sphere.det * (w * w) * steps + sphere.n[axis];
  return (value > 0) - (value < 0);
}

// Which cells have their exact centre in the half-open block.
std::vector<std::uint8_t>
CellsIn(const HaloBlock &                 block,
        const DelaunayCells &             cells,
        const std::vector<LatticePoint> & points,
        const SpacingWeights &            weights)
{
  const auto                count = static_cast<std::ptrdiff_t>(cells.CellCount());
  std::vector<std::uint8_t> kept(cells.CellCount(), 0);
#pragma omp parallel for schedule(static) if (count > 10000)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto         cell = static_cast<std::size_t>(i);
    const auto &       t = cells.tetrahedra[cell];
    const CircumSphere sphere = MakeCircumSphere(points[t[0]], points[t[1]], points[t[2]], points[t[3]], weights);
    bool               in = true;
    for (std::size_t axis = 0; axis < 3 && in; ++axis)
    {
      const double rounded = cells.centres[cell][axis];
      in = CompareCentre(rounded, sphere, axis, Coordinate(block.lower, axis), weights) >= 0 &&
           CompareCentre(rounded, sphere, axis, Coordinate(block.upper, axis), weights) < 0;
    }
    kept[cell] = in ? 1 : 0;
  }
  return kept;
}

// The kept cells with their facets; indices still refer to the points of the subshape.
DelaunayCells
Select(const DelaunayCells & all, const std::vector<std::uint8_t> & kept)
{
  DelaunayCells              cells;
  std::vector<std::uint32_t> number(all.CellCount(), kOtherBlock);
  for (std::size_t cell = 0; cell < all.CellCount(); ++cell)
  {
    if (kept[cell] != 0)
    {
      number[cell] = static_cast<std::uint32_t>(cells.tetrahedra.size());
      cells.tetrahedra.push_back(all.tetrahedra[cell]);
    }
  }
  for (std::size_t facet = 0; facet < all.FacetCount(); ++facet)
  {
    std::array<std::uint32_t, 2> pair = all.facetCells[facet];
    pair[0] = number[pair[0]];
    pair[1] = pair[1] == kOutside ? kOutside : number[pair[1]];
    const bool turned = pair[0] == kOtherBlock;
    if (turned)
    {
      std::swap(pair[0], pair[1]);
    }
    if (pair[0] >= kOtherBlock) // neither cell is kept
    {
      continue;
    }
    const auto polygon = all.FacetPoints(facet);
    cells.facetPoints.insert(cells.facetPoints.end(), polygon.begin(), polygon.end());
    if (turned) // the smallest point stays first
    {
      std::reverse(cells.facetPoints.end() - static_cast<std::ptrdiff_t>(polygon.size()) + 1, cells.facetPoints.end());
    }
    cells.facetCells.push_back(pair);
    cells.facetOffsets.push_back(cells.facetPoints.size());
  }
  return cells;
}

// Lists the share's points and lets its cells refer to them.
void
ListPoints(BlockShare &                      share,
           const VoxelShape &                shape,
           const HaloBlock &                 block,
           const std::vector<LatticePoint> & subshapePoints)
{
  const auto & o = shape.Box().lower;
  BoundaryBits(shape).Visit(
    { std::max(block.lower.x - o[0], 0), std::max(block.lower.y - o[1], 0), std::max(block.lower.z - o[2], 0) },
    { block.upper.x - o[0], block.upper.y - o[1], block.upper.z - o[2] },
    [&](std::int32_t x, std::int32_t y, std::int32_t z) {
      share.points.push_back({ o[0] + x, o[1] + y, o[2] + z });
    });
  // Those the cells use beside their own, merged in: both lists are in scan order.
  std::vector<std::uint8_t> used(subshapePoints.size(), 0);
  for (const std::uint32_t point : share.cells.facetPoints)
  {
    used[point] = 1;
  }
  std::vector<LatticePoint>  merged;
  std::vector<std::uint32_t> number(subshapePoints.size(), 0);
  merged.reserve(share.points.size() + share.points.size() / 8);
  auto own = share.points.begin();
  for (std::size_t point = 0; point < subshapePoints.size(); ++point)
  {
    if (used[point] == 0)
    {
      continue;
    }
    while (own != share.points.end() && InScanOrder(*own, subshapePoints[point]))
    {
      merged.push_back(*own++);
    }
    if (own != share.points.end() && *own == subshapePoints[point])
    {
      ++own;
    }
    number[point] = static_cast<std::uint32_t>(merged.size());
    merged.push_back(subshapePoints[point]);
  }
  merged.insert(merged.end(), own, share.points.end());
  share.points = std::move(merged);
  share.isOwn.resize(share.points.size());
  std::transform(share.points.begin(), share.points.end(), share.isOwn.begin(), [&block](const LatticePoint & p) {
    return Holds(block, p) ? std::uint8_t{ 1 } : std::uint8_t{ 0 };
  });
  for (std::uint32_t & point : share.cells.facetPoints)
  {
    point = number[point];
  }
  for (auto & tetrahedron : share.cells.tetrahedra)
  {
    for (std::uint32_t & point : tetrahedron)
    {
      point = number[point];
    }
  }
}

/** The voxel behind each lattice corner of a block. */
VoxelBox
VoxelsOf(const HaloBlock & block)
{
  return { { block.lower.x, block.lower.y, block.lower.z },
           { block.upper.x - block.lower.x, block.upper.y - block.lower.y, block.upper.z - block.lower.z } };
}

/** Boundary squares whose least corner lies in the block, of a shape that shows all voxels around these. */
std::uint64_t
CountOwnSquares(const VoxelShape & shape, const HaloBlock & block)
{
  const auto &       o = shape.Box().lower;
  const std::int32_t first = block.lower.x - o[0];
  const std::int32_t end = block.upper.x - o[0];
  std::uint64_t      squares = 0;
  const auto         at = [&](const ConstShapeRow & row, std::int32_t word) {
    return word >= 0 && word < static_cast<std::int32_t>(row.size()) ? row[static_cast<std::size_t>(word)]
                                                                             : std::uint64_t{ 0 };
  };
  for (std::int32_t z = block.lower.z - o[2]; z < block.upper.z - o[2]; ++z)
  {
    for (std::int32_t y = block.lower.y - o[1]; y < block.upper.y - o[1]; ++y)
    {
      const ConstShapeRow here = shape.RowAnywhere(y, z);
      const ConstShapeRow south = shape.RowAnywhere(y - 1, z);
      const ConstShapeRow below = shape.RowAnywhere(y, z - 1);
      for (std::int32_t word = first >> 6; word << 6 < end; ++word)
      {
        const std::uint64_t own = BoundaryBits::Between(first, end, word);
        const std::uint64_t bits = at(here, word);
        const auto          count = [own](std::uint64_t sides) { return CountBits(sides & own); };
        squares += count(bits ^ (bits << 1 | at(here, word - 1) >> 63)) + count(bits ^ at(south, word)) +
                   count(bits ^ at(below, word));
      }
    }
  }
  return squares;
}

} // namespace

BlockShare
ShareOf(const VoxelShape &       shape,
        const VoxelShape &       subshape,
        const SpacingWeights &   weights,
        const BlockPlan &        plan,
        std::size_t              block,
        Engine                   engine,
        const ProgressCallback & progress)
{
  BlockShare share;
  share.digest = plan.digest;
  share.blockCount = plan.blocks.size();
  share.block = block;
  share.weight = plan.weight;
  share.boundaryVertices = plan.boundaryVertices;
  share.boundarySquares = plan.boundarySquares;
  share.ownSquares = CountOwnSquares(shape, plan.blocks[block]);
  share.topology = ComputeTopologyPart(shape, VoxelsOf(plan.blocks[block]));

  const std::vector<LatticePoint> points = BoundaryVertices(subshape);
  {
    const DelaunayCells all = ComputeDelaunayCells(subshape, points, weights, engine, progress);
    share.cells = Select(all, CellsIn(plan.blocks[block], all, points, weights));
  }
  ListPoints(share, shape, plan.blocks[block], points);
  share.subshapeVertices = points.size();
  const BoundaryBits bits(shape);
  const auto &       o = shape.Box().lower;
  for (const LatticePoint & p : points)
  {
    share.subshapeReal += bits.Contains(p.x - o[0], p.y - o[1], p.z - o[2]) ? 1 : 0;
  }
  return share;
}

void
RequireBlock(const BlockPlan & plan, std::size_t block)
{
  if (block >= plan.blocks.size())
  {
    throw UsageError("there is no block " + std::to_string(block) + "; choose one of the plan's " +
                     std::to_string(plan.blocks.size()));
  }
}

BlockShare
ComputeBlockShare(const VoxelShape &       shape,
                  const SpacingWeights &   weights,
                  const BlockPlan &        plan,
                  std::size_t              block,
                  Engine                   engine,
                  const ProgressCallback & progress)
{
  RequireBlock(plan, block);
  if (!IsPlanOf(plan, shape, weights))
  {
    throw InputError("the plan of the blocks was made for another shape or other weights; make it again");
  }
  return ShareOf(shape,
                 MakeHaloRegion(shape, weights, plan.blocks[block], progress),
                 weights,
                 plan,
                 block,
                 engine,
                 progress);
}

BlockShare
ComputeBlockShare(const VoxelShape &       part,
                  const SpacingWeights &   weights,
                  const BlockPlan &        plan,
                  const BlockRegion &      region,
                  std::size_t              block,
                  Engine                   engine,
                  const ProgressCallback & progress)
{
  RequireBlock(plan, block);
  if (plan.weight != weights.weight || !IsRegionOf(region, part))
  {
    throw InputError("the plan of the blocks was made for another shape or other weights; make it again");
  }
  return ShareOf(part,
                 MakeHaloRegion(part, weights, plan.blocks[block], progress),
                 weights,
                 plan,
                 block,
                 engine,
                 progress);
}

} // namespace voxelcore
