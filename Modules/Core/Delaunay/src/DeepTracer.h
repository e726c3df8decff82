#pragma once
// The cells beyond the reach of CellTracer, found one from another across their facets.

#include "GrowingBallTree.h"
#include "CellHull.h"
#include "CellTracer.h"
#include "FacetTable.h"
#include "MarkedPoints.h"

namespace voxelcore
{

/** Which of several threads finds a cell: points belong to slabs along an axis, a cell to the least slab that one of
 *  its points belongs to. */
struct PointSlabs
{
  int                       axis = 0;
  std::vector<std::int32_t> cuts; ///< the first coordinate of each slab but the first

  std::size_t
  Of(const LatticePoint & p) const
  {
    const std::int32_t own = axis == 0 ? p.x : axis == 1 ? p.y : p.z;
    return static_cast<std::size_t>(std::upper_bound(cuts.begin(), cuts.end(), own) - cuts.begin());
  }
};

/** What tracers of deep cells share. The deep facets of a tracing, its walls, enclose all cells that it lacks, and all
 *  points of these cells are points of the walls. `ordered` are these points, near ones side by side. */
struct DeepInput
{
  const Tracing &                    tracing;
  const std::vector<LatticePoint> &  points;
  const SpacingWeights &             weights;
  const std::vector<std::uint32_t> & ordered;
  const PointSlabs &                 slabs;
  double                             radius; ///< that balls beyond the walls exceed
};

/** Finds all missing cells of a slab. All cells around a point of it are reached from one another across facets with
 *  this point, and from walls with it: so a tracer asks nobody for anything, but finds cells of lesser slabs, too,
 *  which it does not count as its own. */
class DeepTracer
{
public:
  DeepTracer(const DeepInput & input, std::size_t slab);

  /** The slab's cells. Their facets towards others have kOpen as second cell and are listed in `deep`.
   *  \throws Cancelled; CertificateError where no point lies beyond a facet (a fault of this engine). */
  Tracing
  Trace(const ProgressCallback & progress);

  /** By number among the walls: the cell of Trace() beyond it, or kOpen. */
  const std::vector<std::uint32_t> &
  BeyondWalls() const
  {
    return m_BeyondWall;
  }

private:
  void
  RebuildTree();
  template <typename TVisit>
  void
  VisitFront(TVisit visit);
  void
  CopyPolygon(std::uint32_t facet);
  bool
  IsOpen(std::uint32_t facet) const
  {
    return (facet < m_WallCount ? m_BeyondWall[facet] : m_Cells.facetCells[facet - m_WallCount][1]) == kOpen;
  }
  template <typename TNumber>
  void
  Decide();
  void
  TraceFacet(std::uint32_t facet, double radius);
  void
  AddFacet(std::uint32_t cell, std::span<const std::uint32_t> polygon, std::size_t step);
  bool
  TouchesSlab(std::span<const std::uint32_t> polygon) const;
  Tracing
  TakeOwn();

  DeepInput                  m_Input;
  std::size_t                m_Slab;
  std::uint32_t              m_WallCount; // facets are numbered on from the walls
  bool                       m_Small;     // 64 bits hold in-sphere values
  std::vector<std::uint32_t> m_BeyondWall;
  DelaunayCells              m_Cells;
  std::vector<std::uint8_t>  m_IsOwn; // of several slabs: per cell
  FacetTable                 m_Front;
  std::size_t                m_FrontThen = 0; // when the tree was built
  std::vector<std::uint32_t> m_OwnWalls;      // with a point of the slab
  MarkedPoints               m_OnWallsOfOthers;
  MarkedPoints               m_InTree;
  std::vector<std::uint32_t> m_PlaceInTree; // by number among those
  GrowingBallTree            m_Tree;
  HullMemo                   m_Hulls;

  // Facets to look across, by the radius of the ball before it: so that points which only small balls touch are behind
  // when large ones come.
  std::vector<std::vector<std::uint32_t>> m_Queue;
  std::size_t                             m_Step = 0;

  std::vector<std::uint32_t> m_Polygon; // of the facet looked across, counter-clockwise seen from where is looked
  std::vector<std::uint32_t> m_Apexes;
  std::vector<std::uint32_t> m_Members; // of the cell being made
  std::vector<LatticePoint>  m_Places;  // of the same
  std::vector<std::uint32_t> m_Packed;  // of the same, where they are near
  std::vector<std::uint32_t> m_Facet;   // of the same
};

} // namespace voxelcore
