#include "voxelcore/Thickness/InscribedBalls.h"

#include "BoundingBalls.h"
#include "CoreBalls.h"
#include "NearSquares.h"

#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>

namespace voxelcore
{

namespace
{

// A piece may be so long where the ball of its end sticks out of the one before by no more than this.
constexpr double kCoarseStep = 1.0 / 2;
constexpr double kNoMore = 1.0 / 64;

/** The balls that lie in the shape. */
class InscribedBalls
{
public:
  InscribedBalls(const VoxelShape & shape, const CoreBalls & core, const SpacingWeights & weights)
    : m_Core(core)
    , m_NearSquares(shape, weights)
  {
    FindRadii();
  }

  PaintingBalls
  Find(const ProgressCallback & progress) const
  {
    PaintingBalls     inscribed;
    std::vector<char> needless(m_Core.cells.CellCount(), 0);
    for (std::size_t facet = 0; facet < m_Core.cells.FacetCount(); ++facet)
    {
      const auto & ends = m_Core.cells.facetCells[facet];
      for (std::size_t end = 0; end < 2 && ends[1] != kOutside; ++end)
      {
        const std::uint32_t one = ends[end];
        const std::uint32_t other = ends[1 - end];
        if (m_Inscribed[one] < m_Inscribed[other] &&
            SticksOut(m_Core.cells.centres[one], m_Inscribed[one], m_Core.cells.centres[other], m_Inscribed[other]) <=
              0)
        {
          needless[one] = 1;
        }
      }
    }
    for (std::size_t cell = 0; cell < m_Core.cells.CellCount(); ++cell)
    {
      if (needless[cell] == 0 && HoldsMiddle(m_Core.cells.centres[cell], m_Inscribed[cell]))
      {
        inscribed.Add(m_Core.cells.centres[cell], m_Inscribed[cell] * m_Core.unit, m_Inscribed[cell] * m_Core.unit);
      }
    }
    ReportProgress(progress, "thickness", 0.5);
    constexpr std::size_t      chunk = 4096;
    const std::size_t          count = (m_Core.cells.FacetCount() + chunk - 1) / chunk;
    std::vector<PaintingBalls> found(count);
    RunEach(count, [&](std::size_t i) {
      for (std::size_t facet = i * chunk; facet < std::min((i + 1) * chunk, m_Core.cells.FacetCount()); ++facet)
      {
        if (m_Core.cells.facetCells[facet][1] != kOutside)
        {
          AddAlongEdge(facet, found[i]);
        }
      }
    });
    std::size_t all = inscribed.Count();
    for (const PaintingBalls & part : found)
    {
      all += part.Count();
    }
    inscribed.centres.reserve(all);
    inscribed.radius.reserve(all);
    inscribed.value.reserve(all);
    for (PaintingBalls & part : found)
    {
      inscribed.centres.insert(inscribed.centres.end(), part.centres.begin(), part.centres.end());
      inscribed.radius.insert(inscribed.radius.end(), part.radius.begin(), part.radius.end());
      inscribed.value.insert(inscribed.value.end(), part.value.begin(), part.value.end());
      part = PaintingBalls();
    }
    return inscribed;
  }

private:
  void
  FindRadii()
  {
    constexpr std::size_t                    chunk = 4096;
    const std::size_t                        cells = m_Core.cells.CellCount();
    std::vector<std::vector<BoundarySquare>> found((cells + chunk - 1) / chunk);
    m_Inscribed.resize(cells);
    m_SquaresBegin.assign(cells + 1, 0);
    RunEach(found.size(), [&](std::size_t i) {
      for (std::size_t cell = i * chunk; cell < std::min((i + 1) * chunk, cells); ++cell)
      {
        const std::size_t before = found[i].size();
        m_NearSquares.Find(m_Core.cells.centres[cell], m_Core.radius[cell], found[i]);
        m_Inscribed[cell] = m_NearSquares.DistanceTo(std::span(found[i]).subspan(before),
                                                     m_Core.cells.centres[cell],
                                                     m_Core.radius[cell]);
        m_SquaresBegin[cell + 1] = found[i].size() - before;
      }
    });
    std::partial_sum(m_SquaresBegin.begin(), m_SquaresBegin.end(), m_SquaresBegin.begin());
    m_Squares.reserve(m_SquaresBegin.back());
    for (std::vector<BoundarySquare> & part : found)
    {
      m_Squares.insert(m_Squares.end(), part.begin(), part.end());
      part = {};
    }
  }

  /** By how much one ball sticks out of another. */
  double
  SticksOut(const Vector3 & centre, double radius, const Vector3 & otherCentre, double otherRadius) const
  {
    double squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double d = (centre[axis] - otherCentre[axis]) * m_Core.weights[axis];
      squared += d * d;
    }
    return std::sqrt(squared) + radius - otherRadius;
  }

  /** Whether a ball may hold the middle of a voxel; the nearest is that of the voxel its centre is in. */
  bool
  HoldsMiddle(const Vector3 & centre, double radius) const
  {
    constexpr double rounding = 1e-6;
    double           squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double d = (centre[axis] - std::floor(centre[axis]) - 0.5) * m_Core.weights[axis];
      squared += d * d;
    }
    return squared <= radius * radius * (1 + rounding);
  }

  /** Inscribed balls about places between the ends of an edge, from its greater end on. What lies in a ball through the
   *  edge's boundary vertices lies in that of one of its ends, so that of all squares those count that are nearer to an
   *  end than these vertices are. */
  void
  AddAlongEdge(std::size_t facet, PaintingBalls & balls) const
  {
    const auto & ends = m_Core.cells.facetCells[facet];
    const bool   turned = m_Inscribed[ends[0]] < m_Inscribed[ends[1]];
    const auto   from = ends[turned ? 1 : 0];
    const auto   to = ends[turned ? 0 : 1];
    const int    pieces = PiecesOf(std::abs(m_Core.radius[from] - m_Core.radius[to]), kInscribedStep * m_Core.least);
    Vector3      lastCentre = m_Core.cells.centres[from];
    double       lastRadius = m_Inscribed[from];
    for (int piece = 1; piece < pieces; ++piece)
    {
      const Vector3 centre =
        Between(m_Core.cells.centres[from], m_Core.cells.centres[to], static_cast<double>(piece) / pieces);
      double radius = m_Core.ToPoint(m_Core.cells.FacetPoints(facet)[0], centre);
      radius = m_NearSquares.DistanceTo(SquaresOf(from), centre, radius);
      radius = m_NearSquares.DistanceTo(SquaresOf(to), centre, radius);
      const double sticksOut = SticksOut(centre, radius, lastCentre, lastRadius);
      const bool   isThere =
        radius <= lastRadius &&
        sticksOut <= (lastRadius - radius < kCoarseStep * m_Core.least ? kNoMore * m_Core.least : 0.0);
      if (!isThere && SticksOut(centre, radius, m_Core.cells.centres[to], m_Inscribed[to]) > 0)
      {
        if (HoldsMiddle(centre, radius))
        {
          balls.Add(centre, radius * m_Core.unit, radius * m_Core.unit);
        }
        lastCentre = centre;
        lastRadius = radius;
      }
    }
  }

  /** The squares that stick into the ball through the boundary vertices about a core vertex. */
  std::span<const BoundarySquare>
  SquaresOf(std::uint32_t cell) const
  {
    return { m_Squares.data() + m_SquaresBegin[cell], m_Squares.data() + m_SquaresBegin[cell + 1] };
  }

  const CoreBalls &           m_Core;
  NearSquares                 m_NearSquares;
  std::vector<double>         m_Inscribed; ///< r of each core vertex
  std::vector<std::size_t>    m_SquaresBegin;
  std::vector<BoundarySquare> m_Squares; ///< of each core vertex: those nearer than R
};

} // namespace

ThicknessBalls
FindThicknessBalls(const VoxelShape &            shape,
                   std::span<const LatticePoint> points,
                   const DelaunayCells &         cells,
                   const SpacingWeights &        weights,
                   double                        boundingStep,
                   const ProgressCallback &      progress)
{
  ReportProgress(progress, "thickness", 0);
  const CoreBalls core = FindCoreBalls(points, cells, weights);
  ThicknessBalls  balls;
  for (const double radius : core.radius)
  {
    balls.reach = std::max(balls.reach, radius * core.unit);
  }
  balls.inscribed = InscribedBalls(shape, core, weights).Find(progress);
  if (boundingStep > 0)
  {
    balls.bounding = BoundingBalls(shape, core, boundingStep);
  }
  return balls;
}

} // namespace voxelcore
