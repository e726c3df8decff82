#include "voxelcore/Thickness/InscribedBalls.h"

#include "BallsInSlab.h"
#include "BoundingBalls.h"

#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace voxelcore
{

namespace
{

// A piece may be so long where the ball of its end sticks out of the one before by no more than this.
constexpr double kCoarseStep = 1.0 / 2;
constexpr double kNoMore = 1.0 / 64;

constexpr double kSlack = 1e-6; ///< of radii and coordinates: more than rounding

constexpr std::size_t kChunk = 4096; ///< cells or facets at a time

/** work(i, of) for all of so many, side by side, with what belongs to each chunk of them. */
template <typename TOfChunk, typename TWork>
void
ForChunks(std::size_t count, std::vector<TOfChunk> & ofChunks, const TWork & work)
{
  ofChunks.resize((count + kChunk - 1) / kChunk);
  RunEach(ofChunks.size(), [&](std::size_t chunk) {
    for (std::size_t i = chunk * kChunk; i < std::min((chunk + 1) * kChunk, count); ++i)
    {
      work(i, ofChunks[chunk]);
    }
  });
}

void
Append(PaintingBalls & balls, const PaintingBalls & more)
{
  balls.centres.insert(balls.centres.end(), more.centres.begin(), more.centres.end());
  balls.radius.insert(balls.radius.end(), more.radius.begin(), more.radius.end());
  balls.value.insert(balls.value.end(), more.value.begin(), more.value.end());
}

} // namespace

/** Of core vertices, the squares that stick into the balls through the boundary vertices about them. */
class InscribedBalls::Squares
{
public:
  /** Of those that `isWanted`. */
  Squares(const CoreBalls & core, const NearSquares & near, const std::vector<char> & isWanted)
    : m_Begin(core.cells.CellCount() + 1, 0)
  {
    std::vector<std::vector<BoundarySquare>> found;
    ForChunks(isWanted.size(), found, [&](std::size_t cell, std::vector<BoundarySquare> & squares) {
      if (isWanted[cell] != 0)
      {
        const std::size_t before = squares.size();
        near.Find(core.cells.centres[cell], core.radius[cell], squares);
        m_Begin[cell + 1] = squares.size() - before;
      }
    });
    std::size_t all = 0;
    for (std::size_t cell = 0; cell < isWanted.size(); ++cell)
    {
      all += m_Begin[cell + 1];
      m_Begin[cell + 1] = all;
    }
    m_All.reserve(all);
    for (std::vector<BoundarySquare> & part : found)
    {
      m_All.insert(m_All.end(), part.begin(), part.end());
      part = {};
    }
  }

  std::span<const BoundarySquare>
  Of(std::uint32_t cell) const
  {
    return { m_All.data() + m_Begin[cell], m_All.data() + m_Begin[cell + 1] };
  }

private:
  std::vector<std::size_t>    m_Begin; ///< by core vertex
  std::vector<BoundarySquare> m_All;
};

InscribedBalls::InscribedBalls(const VoxelShape & shape, const CoreBalls & core, const SpacingWeights & weights)
  : m_Core(core)
  , m_NearSquares(shape, weights)
  , m_Radius(core.cells.CellCount())
  , m_IsNeedless(core.cells.CellCount(), 0)
{
  const DelaunayCells &                    cells = core.cells;
  std::vector<std::vector<BoundarySquare>> found;
  ForChunks(cells.CellCount(), found, [&](std::size_t cell, std::vector<BoundarySquare> & squares) {
    squares.clear();
    m_NearSquares.Find(cells.centres[cell], core.radius[cell], squares);
    m_Radius[cell] = m_NearSquares.DistanceTo(squares, cells.centres[cell], core.radius[cell]);
  });
  for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
  {
    const auto & ends = cells.facetCells[facet];
    for (std::size_t end = 0; end < 2 && ends[1] != kOutside; ++end)
    {
      const std::uint32_t one = ends[end];
      const std::uint32_t other = ends[1 - end];
      if (m_Radius[one] < m_Radius[other] &&
          SticksOut(cells.centres[one], m_Radius[one], cells.centres[other], m_Radius[other]) <= 0)
      {
        m_IsNeedless[one] = 1;
      }
    }
  }
}

PaintingBalls
InscribedBalls::Find(double low, double high) const
{
  const DelaunayCells & cells = m_Core.cells;
  const auto            meets = [&](const Vector3 & centre, double radius) {
    const double reach = radius / m_Core.weights[2] * (1 + kSlack) + kSlack;
    return centre[2] + reach >= low && centre[2] - reach <= high;
  };
  // What lies in a ball along an edge lies in that through the boundary vertices about one of its ends.
  std::vector<char> isNear(cells.CellCount());
  for (std::size_t cell = 0; cell < cells.CellCount(); ++cell)
  {
    isNear[cell] = meets(cells.centres[cell], m_Core.radius[cell]) ? 1 : 0;
  }
  std::vector<std::uint32_t> edges;
  std::vector<char>          isWanted(cells.CellCount(), 0);
  for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
  {
    const auto & ends = cells.facetCells[facet];
    if (ends[1] != kOutside && (isNear[ends[0]] | isNear[ends[1]]) != 0 && PiecesOfEdge(ends) > 1)
    {
      edges.push_back(static_cast<std::uint32_t>(facet));
      for (const std::uint32_t cell : ends)
      {
        isWanted[cell] = m_Radius[cell] < m_Core.radius[cell] ? 1 : 0; // else it has no squares
      }
    }
  }
  const Squares              squares(m_Core, m_NearSquares, isWanted);
  std::vector<PaintingBalls> found;
  ForChunks(edges.size(), found, [&](std::size_t i, PaintingBalls & balls) {
    AddAlongEdge(edges[i], squares, meets, balls);
  });
  PaintingBalls all;
  for (std::size_t cell = 0; cell < cells.CellCount(); ++cell)
  {
    if (m_IsNeedless[cell] == 0 && HoldsMiddle(cells.centres[cell], m_Radius[cell]) &&
        meets(cells.centres[cell], m_Radius[cell]))
    {
      all.Add(cells.centres[cell], m_Radius[cell] * m_Core.unit, m_Radius[cell] * m_Core.unit);
    }
  }
  std::size_t count = all.Count();
  for (const PaintingBalls & part : found)
  {
    count += part.Count();
  }
  all.centres.reserve(count);
  all.radius.reserve(count);
  all.value.reserve(count);
  for (PaintingBalls & part : found)
  {
    Append(all, part);
    part = PaintingBalls();
  }
  return all;
}

int
InscribedBalls::PiecesOfEdge(const std::array<std::uint32_t, 2> & ends) const
{
  return PiecesOf(std::abs(m_Core.radius[ends[0]] - m_Core.radius[ends[1]]), kInscribedStep * m_Core.least);
}

/** By how much one ball sticks out of another. */
double
InscribedBalls::SticksOut(const Vector3 & centre, double radius, const Vector3 & otherCentre, double otherRadius) const
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
InscribedBalls::HoldsMiddle(const Vector3 & centre, double radius) const
{
  double squared = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double d = (centre[axis] - std::floor(centre[axis]) - 0.5) * m_Core.weights[axis];
    squared += d * d;
  }
  return squared <= radius * radius * (1 + kSlack);
}

/** Inscribed balls about places between the ends of an edge, from its greater end on. What lies in a ball through the
 *  edge's boundary vertices lies in that of one of its ends, so that of all squares those count that are nearer to an
 *  end than these vertices are. */
template <typename TMeets>
void
InscribedBalls::AddAlongEdge(std::size_t     facet,
                             const Squares & squares,
                             const TMeets &  meets,
                             PaintingBalls & balls) const
{
  const auto & ends = m_Core.cells.facetCells[facet];
  const bool   turned = m_Radius[ends[0]] < m_Radius[ends[1]];
  const auto   from = ends[turned ? 1 : 0];
  const auto   to = ends[turned ? 0 : 1];
  const int    pieces = PiecesOfEdge(ends);
  Vector3      lastCentre = m_Core.cells.centres[from];
  double       lastRadius = m_Radius[from];
  for (int piece = 1; piece < pieces; ++piece)
  {
    const Vector3 centre =
      Between(m_Core.cells.centres[from], m_Core.cells.centres[to], static_cast<double>(piece) / pieces);
    double radius = m_Core.ToPoint(m_Core.cells.FacetPoints(facet)[0], centre);
    radius = m_NearSquares.DistanceTo(squares.Of(from), centre, radius);
    radius = m_NearSquares.DistanceTo(squares.Of(to), centre, radius);
    const double sticksOut = SticksOut(centre, radius, lastCentre, lastRadius);
    const bool   isThere = radius <= lastRadius &&
                         sticksOut <= (lastRadius - radius < kCoarseStep * m_Core.least ? kNoMore * m_Core.least : 0.0);
    if (!isThere && SticksOut(centre, radius, m_Core.cells.centres[to], m_Radius[to]) > 0)
    {
      if (HoldsMiddle(centre, radius) && meets(centre, radius))
      {
        balls.Add(centre, radius * m_Core.unit, radius * m_Core.unit);
      }
      lastCentre = centre;
      lastRadius = radius;
    }
  }
}

ThicknessBalls
FindThicknessBalls(const VoxelShape &            shape,
                   std::span<const LatticePoint> points,
                   const DelaunayCells &         cells,
                   const SpacingWeights &        weights,
                   double                        boundingStep,
                   const ProgressCallback &      progress)
{
  ReportProgress(progress, "thickness", 0);
  const CoreBalls  core = FindCoreBalls(points, cells, weights);
  constexpr double all = std::numeric_limits<double>::infinity();
  ThicknessBalls   balls;
  balls.inscribed = InscribedBalls(shape, core, weights).Find(-all, all);
  ReportProgress(progress, "thickness", 0.5);
  if (boundingStep > 0)
  {
    balls.bounding = BoundingBalls(shape, core, boundingStep);
  }
  return balls;
}

} // namespace voxelcore
