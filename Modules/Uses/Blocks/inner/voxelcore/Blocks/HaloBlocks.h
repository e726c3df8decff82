#pragma once
// Exact halo blocks: the Delaunay cells of a shape computed block by block, each by itself, and joined to what one run
// over the whole gives, bit for bit. The way to volumes larger than a machine, and to TetGen within its limits.
//
// Why a block can be computed alone. Let c be the centre of a cell inside the shape S, in block b. Its open ball holds
// no boundary vertex, so its radius is at most the distance from c to the nearest of them; r(B), an upper bound of that
// distance over the voxels of S in a small box B of b that holds c, bounds it. Let S' agree with S in all voxels around
// every lattice point within r(B) of B, for all B.
//  1. Within the closed ball of c, S and S' have the same boundary vertices: the cell is a cell of S'.
//  2. Conversely, let c be the centre of a cell inside S', in B. The distance from c to the boundary vertices of S is
//  at
//     most r(B), and these are boundary vertices of S' as well: the radius is at most r(B), and as in 1 it is a cell of
//     S.
//  3. The cells in a 6-connected component of S' need that component alone: its boundary squares are facets of the
//     Delaunay complex of every set of lattice points that holds its boundary vertices (paper, Theorem 3.1), so no cell
//     in it has a corner outside it. Components of S' that do not meet b are left out.
// So any engine runs on S' as on any shape, and the cells whose exact centre lies in b (half-open) are the block's
// share: no tolerance, no cell twice, none missing. The bounds are exact integers in squared weighted lattice units.

#include "voxelcore/Delaunay/DelaunayCells.h"
#include "voxelcore/Shape/PartTopology.h"

#include <functional>
#include <iosfwd>
#include <string>

namespace voxelcore
{

/** A box of lattice coordinates, lower <= x < upper; empty when they are equal along an axis. */
struct HaloBlock
{
  LatticePoint lower{};
  LatticePoint upper{};

  friend bool
  operator==(const HaloBlock &, const HaloBlock &) = default;
};

/** Stands for a number of the whole that no one knew when the plan was made. */
inline constexpr std::uint64_t kNotCounted = ~std::uint64_t{ 0 };

/** How a shape is cut, and what the parts must add up to. The same for the same shape, weights and count. */
struct BlockPlan
{
  /** They part all lattice corners of the shape's box. Some are empty when there are more than can be cut. */
  std::vector<HaloBlock>       blocks;
  std::array<std::int64_t, 3>  weight{ 1, 1, 1 };    ///< of SpacingWeights
  std::uint64_t                boundaryVertices = 0; ///< of the shape
  std::uint64_t                boundarySquares = 0;  ///< faces between a voxel that is in and one that is not
  std::array<std::uint64_t, 2> digest{};             ///< of all that, and of the shape's box and voxels
};

/** Cuts the shape into `count` blocks with about the same number of boundary vertices each, by halving: each time where
 *  the cut meets least of the inside.
 *  \throws UsageError when count is 0 or above 2^20; InputError when the numbers would leave the exact range (as
 *  ComputeDelaunayCells). */
BlockPlan
PlanBlocks(const VoxelShape & shape, const SpacingWeights & weights, std::size_t count);

/** The same with blocks of one's own, which must part the lattice corners of the shape's box.
 *  \throws UsageError when they do not. */
BlockPlan
PlanBlocks(const VoxelShape & shape, const SpacingWeights & weights, std::vector<HaloBlock> blocks);

/** Whether the plan was made for this shape and these weights, and is as it was made. */
bool
IsPlanOf(const BlockPlan & plan, const VoxelShape & shape, const SpacingWeights & weights);

/** Stands for "a cell of another block" in the facets of a share. */
inline constexpr std::uint32_t kOtherBlock = 0xFFFFFFFEU;

/** A block's part of the Delaunay cells of the whole shape. Self-contained: joining needs shares alone. */
struct BlockShare
{
  std::array<std::uint64_t, 2> digest{};       ///< of the plan
  std::uint64_t                blockCount = 0; ///< of the plan
  std::uint64_t                block = 0;      ///< which one this is
  std::array<std::int64_t, 3>  weight{ 1, 1, 1 };
  std::uint64_t                boundaryVertices = 0; ///< of the whole shape
  std::uint64_t                boundarySquares = 0;  ///< of the whole shape
  std::uint64_t                ownSquares = 0;       ///< those whose least corner lies in the block

  /** The boundary vertices in the block and those its cells refer to, in scan order (z, then y, then x fastest), in
   *  lattice coordinates of the scan. */
  std::vector<LatticePoint> points;
  std::vector<std::uint8_t> isOwn; ///< per point: 1 when it lies in the block

  /** The cells whose centre lies in the block, in canonical order, with all their facets, as in DelaunayCells; indices
   *  refer to `points`. A facet's second cell may be kOutside, or kOtherBlock: then the polygon runs counter-clockwise
   *  seen from outside its first. The centres are left out: they follow from the tetrahedra. */
  DelaunayCells cells;

  /** Of the voxels in the block. */
  TopologyPart topology;

  // What computing it took; not written to files.
  std::uint64_t subshapeVertices = 0; ///< boundary vertices of the subshape the engine ran on
  std::uint64_t subshapeReal = 0;     ///< those among them that are boundary vertices of the whole
};

/** Computes the part of one block. Besides the given shape it needs memory for the subshape alone, as a run over it
 *  would: for fat shapes, whose balls reach far, that is much of the whole.
 *  \throws UsageError when there is no such block; InputError when the plan belongs to another shape or other weights;
 *  CertificateError when a cell's ball is larger than proven; what ComputeDelaunayCells throws. */
BlockShare
ComputeBlockShare(const VoxelShape &       shape,
                  const SpacingWeights &   weights,
                  const BlockPlan &        plan,
                  std::size_t              block,
                  Engine                   engine = Engine::Auto,
                  const ProgressCallback & progress = {});

/** Writes a share in its binary form: version, checksum, the same bytes on every machine.
 *  \throws OutputError when the stream fails. */
void
WriteBlockShare(const BlockShare & share, std::ostream & stream);

/** Reads what WriteBlockShare wrote. `name` says in errors what was read.
 *  \throws InputError when it is not a share, of another version, cut off, or damaged. */
BlockShare
ReadBlockShare(std::istream & stream, const std::string & name);

/** The whole: as BoundaryVertices() and ComputeDelaunayCells() give it for the shape. */
struct JoinedCells
{
  std::vector<LatticePoint> points;
  DelaunayCells             cells;
  TopologyNumbers           topology; ///< of the shape, from the blocks' voxels
};

/** Gives share number i of those to join, from a file perhaps. */
using ShareSource = std::function<BlockShare(std::size_t)>;

/** Joins `count` shares, in any order. Each is asked for twice, one at a time, so that never more than one is in memory
 *  beside the result. Checks exactly that the cells fill the shape once: the surface of each cell is closed and its
 *  points lie on one sphere; each facet is a boundary square, of which there are as many as the shape has, or is met
 *  from both sides by one cell each.
 *  Takes up to 300 bytes a boundary vertex at its peak (roots 233, gyroid sheets 296), the result included (133, 169).
 *  \throws InputError when shares are missing, repeated or do not belong together; CertificateError, naming the place,
 *  when cells are missing, doubled or do not fit; Cancelled when the callback says so. */
JoinedCells
JoinBlockShares(std::size_t count, const ShareSource & source, const ProgressCallback & progress = {});

/** The same for shares in memory. */
JoinedCells
JoinBlockShares(const std::vector<BlockShare> & shares);

} // namespace voxelcore
