#include "voxelcore/Skeleton/SomaTree.h"

#include "voxelcore/Base/Library.h"

#include "GraphLines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace voxelcore
{

namespace
{

/** Cuts lines at a ball. */
class SomaCutter
{
public:
  SomaCutter(const SkeletonGraph & graph, const Soma & soma)
    : m_Soma(soma)
  {
    m_Tree.graph = graph;
    SkeletonGraph & own = m_Tree.graph;
    std::size_t     nearest = 0;
    for (std::size_t point = 1; point < own.positions.size(); ++point)
    {
      nearest = Away(point) < Away(nearest) ? point : nearest;
    }
    m_Root = CopyPoint(own, static_cast<ElementIndex>(nearest));
    own.positions[m_Root] = soma.centre;
    own.radius[m_Root] = soma.radius;
    if (!own.sectionRadius.empty())
    {
      own.sectionRadius[m_Root] = soma.radius;
    }
  }

  SomaTree
  Cut()
  {
    for (const auto & line : LinesOf(m_Tree.graph))
    {
      CutLine(line);
    }
    KeepFaces();
    std::vector<std::uint8_t> keep(m_Tree.graph.positions.size(), 0);
    for (std::size_t point = 0; point < keep.size(); ++point)
    {
      keep[point] = point == m_Root || !IsIn(point) ? 1 : 0;
    }
    for (const auto & line : m_Lines)
    {
      for (const ElementIndex point : line)
      {
        keep[point] = 1; // where rounding put it into the ball
      }
    }
    for (const ElementIndex point : m_Dropped)
    {
      keep[point] = 0;
    }
    KeepPoints(m_Tree.graph, m_Lines, keep);
    SortBranches(m_Tree.graph, m_Lines, false);
    const auto & nodes = m_Tree.graph.nodePoints;
    const auto   root =
      ranges::find_if(nodes, [&](ElementIndex point) { return m_Tree.graph.positions[point] == m_Soma.centre; });
    m_Tree.root = static_cast<std::size_t>(root - nodes.begin());
    return std::move(m_Tree);
  }

private:
  double
  Away(std::size_t point) const
  {
    return Distance(m_Tree.graph.positions[point], m_Soma.centre);
  }
  bool
  IsIn(std::size_t point) const
  {
    return Away(point) < m_Soma.radius;
  }

  /** A new point where the way between two of a line, one of them in the ball, meets its surface. */
  ElementIndex
  OnSurface(ElementIndex in, ElementIndex out)
  {
    SkeletonGraph & graph = m_Tree.graph;
    const Vector3   from = Minus(graph.positions[in], m_Soma.centre);
    const Vector3   way = Minus(graph.positions[out], graph.positions[in]);
    // |from + t way| = radius; the greater of both t, from in to out.
    const double a = Dot(way, way);
    const double b = Dot(from, way);
    const double c = Dot(from, from) - m_Soma.radius * m_Soma.radius;
    const double t = std::clamp((-b + std::sqrt(std::max(0.0, b * b - a * c))) / a, 0.0, 1.0);
    const auto   mixed = [&](const std::vector<double> & of) { return (1 - t) * of[in] + t * of[out]; };
    const auto   point = CopyPoint(graph, out);
    graph.positions[point] = AddScaled(graph.positions[in], t, way);
    graph.radius[point] = mixed(graph.radius);
    if (!graph.sectionRadius.empty())
    {
      graph.sectionRadius[point] = mixed(graph.sectionRadius);
    }
    if (!graph.contact.empty())
    {
      graph.contact[point] = 0;
    }
    return point;
  }

  /** Takes the parts of a line that lie outside the ball. */
  void
  CutLine(const std::vector<ElementIndex> & line)
  {
    std::vector<ElementIndex> run;
    for (std::size_t i = 0; i < line.size(); ++i)
    {
      if (!IsIn(line[i]))
      {
        if (run.empty() && i > 0)
        {
          run = { m_Root, OnSurface(line[i - 1], line[i]) };
        }
        run.push_back(line[i]);
      }
      else if (!run.empty())
      {
        run.push_back(OnSurface(line[i], line[i - 1]));
        run.push_back(m_Root);
        Take(std::exchange(run, {}));
      }
    }
    if (run.size() > 1)
    {
      m_Lines.push_back(std::move(run));
    }
  }

  /** One that ends at the soma; where it begins there, too, it is cut. */
  void
  Take(std::vector<ElementIndex> run)
  {
    if (run.front() != m_Root)
    {
      m_Lines.push_back(std::move(run));
      return;
    }
    const SkeletonGraph & graph = m_Tree.graph;
    const auto            first = run.begin() + 2;
    const auto            last = run.end() - 2;
    if (std::all_of(first, last, [&](ElementIndex point) { return Away(point) - graph.radius[point] < m_Soma.radius; }))
    {
      m_Dropped.insert(m_Dropped.end(), run.begin() + 1, run.end() - 1);
      return;
    }
    const auto thinnest =
      std::min_element(first, last, [&](ElementIndex a, ElementIndex b) { return graph.radius[a] < graph.radius[b]; });
    m_Tree.cuts.push_back({ graph.positions[*thinnest], graph.radius[*thinnest] });
    std::vector<ElementIndex> rest(thinnest, run.end());
    run.erase(thinnest + 1, run.end());
    rest.front() = CopyPoint(m_Tree.graph, run.back());
    m_Lines.push_back(std::move(run));
    m_Lines.push_back(std::move(rest));
  }

  void
  KeepFaces()
  {
    SkeletonGraph &            graph = m_Tree.graph;
    std::vector<std::uint64_t> offsets{ 0 };
    std::vector<ElementIndex>  vertices;
    std::vector<std::uint8_t>  closed;
    for (std::size_t face = 0; face < graph.FaceCount(); ++face)
    {
      const std::span<const ElementIndex> own(graph.faceVertices.data() + graph.faceOffsets[face],
                                              graph.faceVertices.data() + graph.faceOffsets[face + 1]);
      if (ranges::none_of(own, [&](ElementIndex point) { return IsIn(point); }))
      {
        vertices.insert(vertices.end(), own.begin(), own.end());
        offsets.push_back(vertices.size());
        closed.push_back(graph.closedFace[face]);
      }
    }
    graph.faceOffsets = std::move(offsets);
    graph.faceVertices = std::move(vertices);
    graph.closedFace = std::move(closed);
  }

  Soma                      m_Soma;
  SomaTree                  m_Tree;
  ElementIndex              m_Root = 0;
  GraphLines                m_Lines;
  std::vector<ElementIndex> m_Dropped; ///< of lines that are left out
};

} // namespace

std::optional<Soma>
FindSoma(const SkeletonGraph & graph, const std::optional<Vector3> & place)
{
  std::optional<Soma> greatest;
  std::optional<Soma> nearest;
  for (std::size_t point = 0; point < graph.positions.size(); ++point)
  {
    const Soma   ball{ graph.positions[point], graph.radius[point] };
    const double away = place ? Distance(ball.centre, *place) : 0;
    if (away <= ball.radius && (!greatest || ball.radius > greatest->radius))
    {
      greatest = ball;
    }
    if (!nearest || away < Distance(nearest->centre, place.value_or(nearest->centre)))
    {
      nearest = ball;
    }
  }
  return greatest ? greatest : nearest;
}

SomaTree
CutAtSoma(const SkeletonGraph & graph, const Soma & soma)
{
  return SomaCutter(graph, soma).Cut();
}

} // namespace voxelcore
