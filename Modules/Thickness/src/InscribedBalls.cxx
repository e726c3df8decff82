#include "voxelcore/InscribedBalls.h"

#include "OctantAxes.h"
#include "NearSquares.h"

#include "voxelcore/ParallelTasks.h"
#include "voxelcore/Vectors.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>

namespace voxelcore
{

namespace
{

// How much longer a radius is at the far end of a piece of an edge: of a voxel's shortest side.
constexpr double kInscribedStep = 1.0 / 8;
// A piece may be so long where the ball of its end sticks out of the one before by no more than this.
constexpr double kCoarseStep = 1.0 / 2;
constexpr double kNoMore = 1.0 / 64;

class Finder
{
public:
  Finder(const VoxelShape &            shape,
         std::span<const LatticePoint> points,
         const DelaunayCells &         cells,
         const SpacingWeights &        weights)
    : m_Points(points)
    , m_Cells(cells)
    , m_Unit(weights.unit)
    , m_NearSquares(shape, weights)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      m_Weights[axis] = static_cast<double>(weights.weight[axis]);
    }
    m_Least = *std::min_element(m_Weights.begin(), m_Weights.end());
    const auto table = OctantAxes();
    m_Axes.reserve(points.size());
    for (const LatticePoint & at : points)
    {
      unsigned octants = 0;
      for (unsigned octant = 0; octant < 8; ++octant)
      {
        const auto side = [octant](unsigned axis) { return static_cast<std::int32_t>(octant >> axis & 1U) - 1; };
        octants |= (shape.Contains(at.x + side(0), at.y + side(1), at.z + side(2)) ? 1U : 0U) << octant;
      }
      m_Axes.push_back(table[octants]);
    }
    FindRadii();
  }

  ThicknessBalls
  Find(double boundingStep, const ProgressCallback & progress)
  {
    ThicknessBalls balls;
    for (const double radius : m_Radius)
    {
      balls.reach = std::max(balls.reach, radius * m_Unit);
    }
    FindInscribed(balls.inscribed, progress);
    m_Squares.clear();
    if (boundingStep > 0)
    {
      FindVertexBounds();
      CutEdges(boundingStep * m_Least);
      balls.bounding.centres = m_Cells.centres;
      balls.bounding.radius = m_Radius;
      balls.bounding.value = m_Bound;
      for (const Sample & one : m_Samples)
      {
        balls.bounding.Add(one.centre, one.radius, one.bound);
      }
      AddNearBoundary(balls.bounding);
      for (std::size_t i = 0; i < balls.bounding.Count(); ++i)
      {
        balls.bounding.radius[i] *= m_Unit;
        balls.bounding.value[i] *= m_Unit;
      }
    }
    return balls;
  }

private:
  /** A place on an edge of the core. Lengths in lattice units. */
  struct Sample
  {
    Vector3 centre;
    double  radius;
    double  bound;
  };

  Vector3
  FromPoint(std::uint32_t point, const Vector3 & place) const
  {
    const LatticePoint & at = m_Points[point];
    return { (place[0] - at.x) * m_Weights[0], (place[1] - at.y) * m_Weights[1], (place[2] - at.z) * m_Weights[2] };
  }
  double
  ToPoint(std::uint32_t point, const Vector3 & place) const
  {
    const Vector3 d = FromPoint(point, place);
    return std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  }
  static double
  LengthIn(std::uint8_t axes, const Vector3 & d)
  {
    double squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      squared += (axes >> axis & 1U) != 0 ? d[axis] * d[axis] : 0.0;
    }
    return std::sqrt(squared);
  }
  /** The greatest G of the boundary vertices of a facet. */
  double
  BoundAt(std::size_t facet, const Vector3 & place) const
  {
    double greatest = 0;
    for (const std::uint32_t point : m_Cells.FacetPoints(facet))
    {
      greatest = std::max(greatest, LengthIn(m_Axes[point], FromPoint(point, place)));
    }
    return greatest;
  }

  /** Of each cell the first of its points: distances to others may be rounded otherwise. */
  std::vector<std::uint32_t>
  FirstPoints() const
  {
    std::vector<std::uint32_t> first(m_Cells.CellCount(), kOutside);
    for (std::size_t facet = 0; facet < m_Cells.FacetCount(); ++facet)
    {
      for (const std::uint32_t cell : m_Cells.facetCells[facet])
      {
        if (cell != kOutside)
        {
          first[cell] = std::min(first[cell], m_Cells.FacetPoints(facet)[0]);
        }
      }
    }
    return first;
  }

  void
  FindRadii()
  {
    constexpr std::size_t                    chunk = 4096;
    const std::size_t                        cells = m_Cells.CellCount();
    const std::vector<std::uint32_t>         first = FirstPoints();
    std::vector<std::vector<BoundarySquare>> found((cells + chunk - 1) / chunk);
    m_Radius.resize(cells);
    m_Inscribed.resize(cells);
    m_SquaresBegin.assign(cells + 1, 0);
    RunEach(found.size(), [&](std::size_t i) {
      for (std::size_t cell = i * chunk; cell < std::min((i + 1) * chunk, cells); ++cell)
      {
        const std::size_t before = found[i].size();
        m_Radius[cell] = ToPoint(first[cell], m_Cells.centres[cell]);
        m_NearSquares.Find(m_Cells.centres[cell], m_Radius[cell], found[i]);
        m_Inscribed[cell] =
          m_NearSquares.DistanceTo(std::span(found[i]).subspan(before), m_Cells.centres[cell], m_Radius[cell]);
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

  void
  FindVertexBounds()
  {
    m_Bound.assign(m_Cells.CellCount(), 0);
    for (std::size_t facet = 0; facet < m_Cells.FacetCount(); ++facet)
    {
      for (const std::uint32_t cell : m_Cells.facetCells[facet])
      {
        if (cell != kOutside)
        {
          m_Bound[cell] = std::max(m_Bound[cell], BoundAt(facet, m_Cells.centres[cell]));
        }
      }
    }
  }

  /** Cuts the edges into pieces; each end of a piece gets the greater of both bounds. */
  void
  CutEdges(double step)
  {
    for (std::size_t facet = 0; facet < m_Cells.FacetCount(); ++facet)
    {
      const auto & ends = m_Cells.facetCells[facet];
      if (ends[1] == kOutside)
      {
        continue;
      }
      const Vector3 & from = m_Cells.centres[ends[0]];
      const Vector3 & to = m_Cells.centres[ends[1]];
      const double    first = BoundAt(facet, from);
      const double    last = BoundAt(facet, to);
      const double    change = std::max(std::abs(m_Radius[ends[0]] - m_Radius[ends[1]]), std::abs(first - last));
      const int       pieces = PiecesOf(change, step);
      double          before = first;
      for (int piece = 1; piece <= pieces; ++piece)
      {
        Sample       end{ {}, 0, last };
        const double reached = before;
        if (piece < pieces)
        {
          end.centre = Between(from, to, static_cast<double>(piece) / pieces);
          end.radius = ToPoint(m_Cells.FacetPoints(facet)[0], end.centre);
          end.bound = BoundAt(facet, end.centre);
        }
        before = end.bound;
        double & back = piece == 1 ? m_Bound[ends[0]] : m_Samples.back().bound;
        back = std::max(back, end.bound);
        if (piece == pieces)
        {
          m_Bound[ends[1]] = std::max(m_Bound[ends[1]], reached);
          continue;
        }
        end.bound = std::max(end.bound, reached);
        m_Samples.push_back(end);
      }
    }
  }

  static int
  PiecesOf(double change, double step)
  {
    return std::max(1, static_cast<int>(std::ceil(change / step * (1 - 1e-9))));
  }
  static Vector3
  Between(const Vector3 & from, const Vector3 & to, double part)
  {
    return { from[0] + part * (to[0] - from[0]),
             from[1] + part * (to[1] - from[1]),
             from[2] + part * (to[2] - from[2]) };
  }

  /** By how much one ball sticks out of another. */
  double
  SticksOut(const Vector3 & centre, double radius, const Vector3 & otherCentre, double otherRadius) const
  {
    double squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double d = (centre[axis] - otherCentre[axis]) * m_Weights[axis];
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
      const double d = (centre[axis] - std::floor(centre[axis]) - 0.5) * m_Weights[axis];
      squared += d * d;
    }
    return squared <= radius * radius * (1 + rounding);
  }

  void
  FindInscribed(PaintingBalls & inscribed, const ProgressCallback & progress)
  {
    std::vector<char> needless(m_Cells.CellCount(), 0);
    for (std::size_t facet = 0; facet < m_Cells.FacetCount(); ++facet)
    {
      const auto & ends = m_Cells.facetCells[facet];
      for (std::size_t end = 0; end < 2 && ends[1] != kOutside; ++end)
      {
        const std::uint32_t one = ends[end];
        const std::uint32_t other = ends[1 - end];
        if (m_Inscribed[one] < m_Inscribed[other] &&
            SticksOut(m_Cells.centres[one], m_Inscribed[one], m_Cells.centres[other], m_Inscribed[other]) <= 0)
        {
          needless[one] = 1;
        }
      }
    }
    for (std::size_t cell = 0; cell < m_Cells.CellCount(); ++cell)
    {
      if (needless[cell] == 0 && HoldsMiddle(m_Cells.centres[cell], m_Inscribed[cell]))
      {
        inscribed.Add(m_Cells.centres[cell], m_Inscribed[cell] * m_Unit, m_Inscribed[cell] * m_Unit);
      }
    }
    ReportProgress(progress, "thickness", 0.5);
    constexpr std::size_t      chunk = 4096;
    const std::size_t          count = (m_Cells.FacetCount() + chunk - 1) / chunk;
    std::vector<PaintingBalls> found(count);
    RunEach(count, [&](std::size_t i) {
      for (std::size_t facet = i * chunk; facet < std::min((i + 1) * chunk, m_Cells.FacetCount()); ++facet)
      {
        if (m_Cells.facetCells[facet][1] != kOutside)
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
  }

  /** Inscribed balls about places between the ends of an edge, from its greater end on. What lies in a ball through the
   *  edge's boundary vertices lies in that of one of its ends, so that of all squares those count that are nearer to an
   *  end than these vertices are. */
  void
  AddAlongEdge(std::size_t facet, PaintingBalls & balls) const
  {
    const auto & ends = m_Cells.facetCells[facet];
    const bool   turned = m_Inscribed[ends[0]] < m_Inscribed[ends[1]];
    const auto   from = ends[turned ? 1 : 0];
    const auto   to = ends[turned ? 0 : 1];
    const int    pieces = PiecesOf(std::abs(m_Radius[from] - m_Radius[to]), kInscribedStep * m_Least);
    Vector3      lastCentre = m_Cells.centres[from];
    double       lastRadius = m_Inscribed[from];
    for (int piece = 1; piece < pieces; ++piece)
    {
      const Vector3 centre = Between(m_Cells.centres[from], m_Cells.centres[to], static_cast<double>(piece) / pieces);
      double        radius = ToPoint(m_Cells.FacetPoints(facet)[0], centre);
      radius = m_NearSquares.DistanceTo(SquaresOf(from), centre, radius);
      radius = m_NearSquares.DistanceTo(SquaresOf(to), centre, radius);
      const double sticksOut = SticksOut(centre, radius, lastCentre, lastRadius);
      const bool   isThere =
        radius <= lastRadius && sticksOut <= (lastRadius - radius < kCoarseStep * m_Least ? kNoMore * m_Least : 0.0);
      if (!isThere && SticksOut(centre, radius, m_Cells.centres[to], m_Inscribed[to]) > 0)
      {
        if (HoldsMiddle(centre, radius))
        {
          balls.Add(centre, radius * m_Unit, radius * m_Unit);
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

  /** The balls of boundary squares: about places on them, and on the edges that pass through them, so far up as one
   *  can hold the centre of a voxel below. */
  void
  AddNearBoundary(PaintingBalls & balls) const
  {
    for (std::size_t facet = 0; facet < m_Cells.FacetCount(); ++facet)
    {
      if (m_Cells.facetCells[facet][1] == kOutside)
      {
        AddSquare(facet, balls);
      }
    }
  }
  void
  AddSquare(std::size_t facet, PaintingBalls & balls) const
  {
    const auto          corners = m_Cells.FacetPoints(facet);
    const std::uint32_t cell = m_Cells.facetCells[facet][0];
    Vector3             middle{};
    for (const std::uint32_t corner : corners)
    {
      const LatticePoint & at = m_Points[corner];
      middle = { middle[0] + 0.25 * at.x, middle[1] + 0.25 * at.y, middle[2] + 0.25 * at.z };
    }
    std::size_t normal = 0;
    while (FromPoint(corners[0], middle)[normal] != 0)
    {
      ++normal;
    }
    const double on = BoundAt(facet, middle);
    const double radius = ToPoint(corners[0], middle);
    balls.Add(middle, radius, on);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double half = m_Weights[axis] / 2;
      if (axis == normal || 4 * half * half < SquaresBut(axis))
      {
        continue; // too short to hold the centre of a voxel
      }
      for (const double side : { -0.5, 0.5 })
      {
        Vector3 edge = middle;
        edge[3 - normal - axis] += side;
        balls.Add(edge, half, on);
      }
    }
    // A voxel's centre below the square is below the middle, but not in the next voxel, or beside it.
    const double wide = SquaresBut(normal);
    const double w = m_Weights[normal];
    const double highest =
      std::max((wide / 4 - LeastSquareBut(normal) - w * w / 4) / w, (wide / 4 - w * w * 9 / 4) / (3 * w));
    const double end = std::min(highest, std::abs(m_Cells.centres[cell][normal] - middle[normal]) * w);
    if (end <= 0)
    {
      return;
    }
    const auto   pieces = static_cast<int>(std::ceil(end / (kInscribedStep * m_Least)));
    const double up = m_Cells.centres[cell][normal] > middle[normal] ? end / w : -end / w;
    Vector3      from = middle;
    for (int piece = 1; piece <= pieces; ++piece)
    {
      Vector3 to = middle;
      to[normal] += up * piece / pieces;
      balls.Add(from, ToPoint(corners[0], from), BoundAt(facet, to));
      from = to;
    }
  }
  /** Of the weights along the other axes, the sum of the squares. */
  double
  SquaresBut(std::size_t axis) const
  {
    return Dot(m_Weights, m_Weights) - m_Weights[axis] * m_Weights[axis];
  }
  double
  LeastSquareBut(std::size_t axis) const
  {
    const double least = std::min(m_Weights[(axis + 1) % 3], m_Weights[(axis + 2) % 3]);
    return least * least;
  }

  std::span<const LatticePoint> m_Points;
  const DelaunayCells &         m_Cells;
  double                        m_Unit;
  NearSquares                   m_NearSquares;
  Vector3                       m_Weights{};
  double                        m_Least = 0; ///< of the weights
  std::vector<std::uint8_t>     m_Axes;      ///< of each boundary vertex: A, as bits
  std::vector<double>           m_Radius;    ///< R of each core vertex
  std::vector<double>           m_Inscribed; ///< r of each core vertex
  std::vector<double>           m_Bound;     ///< of each core vertex
  std::vector<Sample>           m_Samples;
  std::vector<std::size_t>      m_SquaresBegin;
  std::vector<BoundarySquare>   m_Squares; ///< of each core vertex: those nearer than R
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
  return Finder(shape, points, cells, weights).Find(boundingStep, progress);
}

} // namespace voxelcore
