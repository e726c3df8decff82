#pragma once
// Small Delaunay cells inside a voxel shape, found one from another across their facets.
//
// Boundary squares are facets (Theorem 3.1). From a facet whose inner side is unknown, the next cell is fixed by the
// boundary vertex that minimises the pencil parameter of the spheres through the facet's circle; a growing ball on the
// bits of a window finds it, exact integers decide. The smallest cells, the corners of single voxels, come from a
// table.

#include "TracingBricks.h"
#include "BrickQueue.h"
#include "CapScan.h"
#include "CellHull.h"
#include "FacetFront.h"
#include "LatticeWindow.h"
#include "Pencil.h"

#include "voxelcore/Delaunay/DelaunayCells.h"

namespace voxelcore
{

/** In facetCells: the cell on this side is not known yet. */
inline constexpr std::uint32_t kOpen = 0xFFFFFFFEU;

/** What all tracers of one shape share. */
struct TracingInput
{
  const VoxelShape &                 shape;
  const std::vector<LatticePoint> &  points;
  const SpacingWeights &             weights;
  const VertexRows &                 rows;
  const TracingBricks &              grid;
  const std::vector<std::uint32_t> & load; ///< per brick: boundary vertices that it or a side of it holds
  Facets                             facets;
};

/** Cells and facets in any order, centres not filled in; and what is still to be found. Where facets on the boundary
 *  are not asked for, most are but noted in voxelSides, and facets without a cell may stand among the others. */
struct Tracing
{
  DelaunayCells              cells;
  std::vector<std::uint32_t> open;  ///< facets with kOpen on a side, beyond which someone else has to look
  std::vector<std::uint32_t> deep;  ///< facets with kOpen on a side, beyond which the sphere exceeds the tracer's limit
  std::vector<std::uint32_t> unmet; ///< complete boundary squares whose voxel lies in a brick of someone else
};

/** Puts the tracings of disjoint sets of bricks together, of a shape with so many points: facets that two of them left
 *  open may close each other. */
Tracing
JoinTracings(std::vector<Tracing> parts, std::size_t points);

/** Finds the cells of radius up to 7 times the smallest weight whose centres lie in the bricks it takes from a queue,
 *  ascending from its start or descending from its end, as far as they can be reached within them. Which bricks it gets
 *  may differ from run to run; with those of all tracers joined and gone on from, nothing found does. Not for use by
 *  two threads at once. */
class CellTracer
{
public:
  CellTracer(const TracingInput & input, BrickQueue & bricks, bool fromEnd);

  /** Up to which it finds cells, in units of length. */
  static double
  LargestRadius(const SpacingWeights & weights);

  /** Takes bricks and starts at their own boundary. \throws Cancelled. */
  Tracing
  Trace(const ProgressCallback & progress);

  /** Goes on from facets left open, through all bricks of the queue. \throws Cancelled. */
  Tracing
  Continue(Tracing tracing, const ProgressCallback & progress);

private:
  static constexpr std::int32_t halo = LatticeWindow::halo;
  static constexpr std::int32_t brickWidth = LatticeWindow::brick;

  struct Pending
  {
    std::uint32_t facet;
    double        from; ///< distance of centre from circle below which no sphere is left to look at; -inf at first
  };

  void
  ProcessBrick(std::size_t brick, bool seed);
  void
  ProcessPending(const ProgressCallback & progress);
  Tracing
  Finish();
  std::uint8_t
  CornerMask(std::int32_t x, std::int32_t y, std::int32_t z) const;
  /** A bit a voxel of a row of the window: all corners of some side are boundary vertices. */
  std::uint64_t
  FullSides(std::int32_t y, std::int32_t z) const;
  void
  FindVoxelCells();
  void
  SeedVoxelCells();
  void
  SeedSquare(std::int32_t x, std::int32_t y, std::int32_t z, unsigned mask);
  void
  Drain();
  template <typename TNumber>
  void
  TraceFacet(Pending pending);
  void
  CreateCell(std::span<const std::uint32_t> facet, bool inwards);
  void
  AddFacet(std::uint32_t cell, std::span<const std::uint32_t> polygon);
  bool
  IsBoundarySquare(std::span<const std::uint32_t> polygon) const;
  /** The number of the facet that NewFacet() makes, of so many corners. */
  std::uint32_t
  NextFacet(std::size_t corners) const
  {
    return corners == 4 && !m_FreeSquares.empty() ? m_FreeSquares.back()
                                                  : static_cast<std::uint32_t>(m_Result.FacetCount());
  }
  std::uint32_t
  NewFacet(std::uint32_t first, std::uint32_t second, std::span<const std::uint32_t> polygon);
  /** Makes the cell of a set of points that affinely span space; its facets come by AddFacet(). */
  std::uint32_t
  NewCell(const std::array<std::uint32_t, 4> & tetrahedron);
  /** A side of the cell that lies on the boundary, across an axis. */
  void
  AddVoxelSide(std::uint32_t cell, std::size_t axis, std::span<const std::uint32_t> square);
  /** Where facets on the boundary are not asked for, only notes this one, once its cell is known, so that another facet
   *  may have its place. Not for one that waits to be looked across. */
  void
  NoteVoxelSide(std::uint32_t facet);
  void
  Close(std::uint32_t facet, std::uint32_t cell)
  {
    auto & sides = m_Result.facetCells[facet];
    sides[sides[0] == kOpen ? 0 : 1] = cell;
  }
  bool
  IsOpen(std::uint32_t facet) const
  {
    return m_Result.facetCells[facet][0] == kOpen || m_Result.facetCells[facet][1] == kOpen;
  }
  /** A boundary vertex in window coordinates. */
  LatticePoint
  Local(std::uint32_t index) const
  {
    const LatticePoint & p = m_Input.points[index];
    return { p.x - m_Window.origin.x, p.y - m_Window.origin.y, p.z - m_Window.origin.z };
  }
  /** The brick of a centre in window coordinates; of one so near to another brick that two tracers could disagree by
   *  rounding, that which is not this tracer's, if any. */
  std::size_t
  BrickOf(const std::array<double, 3> & centre) const;
  void
  Defer(std::size_t brick, const Pending & pending);

  TracingInput  m_Input;
  BrickQueue &  m_Bricks;
  bool          m_FromEnd;
  std::size_t   m_First;
  std::size_t   m_Last;
  bool          m_Wide; // weights beyond 1: numbers need 128 bits
  MetricWeights m_Weights;
  double        m_Limit; // radius, in units of length
  LatticeWindow m_Window;
  std::size_t   m_Brick = 0;
  DelaunayCells m_Result;
  FacetFront    m_Front;
  HullMemo      m_Hulls;

  std::vector<Pending>              m_Stack;
  std::vector<std::vector<Pending>> m_Pending; // per brick of the queue
  std::vector<std::uint8_t>         m_Done;    // per brick of the queue: this tracer has been through it
  std::vector<std::size_t>          m_Revisit;
  std::vector<std::uint32_t>        m_Deep;
  std::vector<std::uint32_t>        m_FreeSquares; // facets of four corners without a cell

  CapVertices                m_Found;   // by the running trace
  std::vector<LatticePoint>  m_Apexes;  // the best candidates of the running trace, in window coordinates
  std::vector<std::uint64_t> m_Members; // of the cell being made: packed as for its hull, and their indices below
  std::vector<std::uint32_t> m_Packed;  // of the same
  std::vector<std::uint32_t> m_Polygon;

  // Voxels of the brick with a cell of their own: one bit each per row, and the number of the row's first cell.
  std::array<std::uint32_t, 32 * 32> m_VoxelBits{};
  std::array<std::uint32_t, 32 * 32> m_VoxelFirst{};
};

} // namespace voxelcore
