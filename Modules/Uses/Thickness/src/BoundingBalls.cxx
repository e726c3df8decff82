#include "BoundingBalls.h"

#include "OctantAxes.h"

#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace voxelcore
{

namespace
{

/** G of InscribedBalls.h, and the balls that get it. */
class Bounds
{
public:
  Bounds(const VoxelShape & shape, const CoreBalls & core)
    : m_Core(core)
  {
    const auto table = OctantAxes();
    m_Axes.reserve(core.points.size());
    for (const LatticePoint & at : core.points)
    {
      unsigned octants = 0;
      for (unsigned octant = 0; octant < 8; ++octant)
      {
        const auto side = [octant](unsigned axis) { return static_cast<std::int32_t>(octant >> axis & 1U) - 1; };
        octants |= (shape.Contains(at.x + side(0), at.y + side(1), at.z + side(2)) ? 1U : 0U) << octant;
      }
      m_Axes.push_back(table[octants]);
    }
  }

  PaintingBalls
  Find(double boundingStep)
  {
    FindVertexBounds();
    CutEdges(boundingStep * m_Core.least);
    PaintingBalls balls{ m_Core.cells.centres, m_Core.radius, std::move(m_Bound) };
    for (const Sample & one : m_Samples)
    {
      balls.Add(one.centre, one.radius, one.bound);
    }
    AddNearBoundary(balls);
    for (std::size_t i = 0; i < balls.Count(); ++i)
    {
      balls.radius[i] *= m_Core.unit;
      balls.value[i] *= m_Core.unit;
    }
    return balls;
  }

private:
  /** A place on an edge of the core. */
  struct Sample
  {
    Vector3 centre;
    double  radius;
    double  bound;
  };

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
    for (const std::uint32_t point : m_Core.cells.FacetPoints(facet))
    {
      greatest = std::max(greatest, LengthIn(m_Axes[point], m_Core.FromPoint(point, place)));
    }
    return greatest;
  }

  void
  FindVertexBounds()
  {
    m_Bound.assign(m_Core.cells.CellCount(), 0);
    for (std::size_t facet = 0; facet < m_Core.cells.FacetCount(); ++facet)
    {
      for (const std::uint32_t cell : m_Core.cells.facetCells[facet])
      {
        if (cell != kOutside)
        {
          m_Bound[cell] = std::max(m_Bound[cell], BoundAt(facet, m_Core.cells.centres[cell]));
        }
      }
    }
  }

  /** Cuts the edges into pieces; each end of a piece gets the greater of both bounds. */
  void
  CutEdges(double step)
  {
    for (std::size_t facet = 0; facet < m_Core.cells.FacetCount(); ++facet)
    {
      const auto & ends = m_Core.cells.facetCells[facet];
      if (ends[1] == kOutside)
      {
        continue;
      }
      const Vector3 & from = m_Core.cells.centres[ends[0]];
      const Vector3 & to = m_Core.cells.centres[ends[1]];
      const double    first = BoundAt(facet, from);
      const double    last = BoundAt(facet, to);
      const double change = std::max(std::abs(m_Core.radius[ends[0]] - m_Core.radius[ends[1]]), std::abs(first - last));
      const int    pieces = PiecesOf(change, step);
      double       before = first;
      for (int piece = 1; piece <= pieces; ++piece)
      {
        Sample       end{ {}, 0, last };
        const double reached = before;
        if (piece < pieces)
        {
          end.centre = Between(from, to, static_cast<double>(piece) / pieces);
          end.radius = m_Core.ToPoint(m_Core.cells.FacetPoints(facet)[0], end.centre);
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

  /** The balls of boundary squares: about places on them, and on the edges that pass through them, so far up as one
   *  can hold the centre of a voxel below. */
  void
  AddNearBoundary(PaintingBalls & balls) const
  {
    for (std::size_t facet = 0; facet < m_Core.cells.FacetCount(); ++facet)
    {
      if (m_Core.cells.facetCells[facet][1] == kOutside)
      {
        AddSquare(facet, balls);
      }
    }
  }
  void
  AddSquare(std::size_t facet, PaintingBalls & balls) const
  {
    const auto          corners = m_Core.cells.FacetPoints(facet);
    const std::uint32_t cell = m_Core.cells.facetCells[facet][0];
    Vector3             middle{};
    for (const std::uint32_t corner : corners)
    {
      const LatticePoint & at = m_Core.points[corner];
      middle = { middle[0] + 0.25 * at.x, middle[1] + 0.25 * at.y, middle[2] + 0.25 * at.z };
    }
    std::size_t normal = 0;
    while (m_Core.FromPoint(corners[0], middle)[normal] != 0)
    {
      ++normal;
    }
    const double on = BoundAt(facet, middle);
    const double radius = m_Core.ToPoint(corners[0], middle);
    balls.Add(middle, radius, on);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double half = m_Core.weights[axis] / 2;
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
    const double w = m_Core.weights[normal];
    const double highest =
      std::max((wide / 4 - LeastSquareBut(normal) - w * w / 4) / w, (wide / 4 - w * w * 9 / 4) / (3 * w));
    const double end = std::min(highest, std::abs(m_Core.cells.centres[cell][normal] - middle[normal]) * w);
    if (end <= 0)
    {
      return;
    }
    const auto   pieces = static_cast<int>(std::ceil(end / (kInscribedStep * m_Core.least)));
    const double up = m_Core.cells.centres[cell][normal] > middle[normal] ? end / w : -end / w;
    Vector3      from = middle;
    for (int piece = 1; piece <= pieces; ++piece)
    {
      Vector3 to = middle;
      to[normal] += up * piece / pieces;
      balls.Add(from, m_Core.ToPoint(corners[0], from), BoundAt(facet, to));
      from = to;
    }
  }
  /** Of the weights along the other axes, the sum of the squares. */
  double
  SquaresBut(std::size_t axis) const
  {
    return Dot(m_Core.weights, m_Core.weights) - m_Core.weights[axis] * m_Core.weights[axis];
  }
  double
  LeastSquareBut(std::size_t axis) const
  {
    const double least = std::min(m_Core.weights[(axis + 1) % 3], m_Core.weights[(axis + 2) % 3]);
    return least * least;
  }

  const CoreBalls &         m_Core;
  std::vector<std::uint8_t> m_Axes;  ///< of each boundary vertex: A, as bits
  std::vector<double>       m_Bound; ///< of each core vertex
  std::vector<Sample>       m_Samples;
};

} // namespace

PaintingBalls
BoundingBalls(const VoxelShape & shape, const CoreBalls & core, double step)
{
  return Bounds(shape, core).Find(step);
}

} // namespace voxelcore
