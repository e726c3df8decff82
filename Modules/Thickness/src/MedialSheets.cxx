#include "voxelcore/MedialSheets.h"

#include "SheetPieces.h"

#include "voxelcore/PolygonArea.h"
#include "voxelcore/UnionFind.h"
#include "voxelcore/Vectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr int kFinSteps = 4;

/** Eigenvector to the greatest eigenvalue of a symmetric matrix, by Jacobi's rotations; `greatest` gets the value. */
Vector3
GreatestAxis(std::array<Vector3, 3> m, double & greatest)
{
  std::array<Vector3, 3> v{ Vector3{ 1, 0, 0 }, Vector3{ 0, 1, 0 }, Vector3{ 0, 0, 1 } };
  for (int sweep = 0; sweep < 30; ++sweep)
  {
    for (std::size_t p = 0; p < 2; ++p)
    {
      for (std::size_t q = p + 1; q < 3; ++q)
      {
        if (m[p][q] == 0)
        {
          continue;
        }
        const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
        const double t = (theta >= 0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1);
        const double s = t * c;
        for (std::size_t k = 0; k < 3; ++k)
        {
          const double a = m[k][p];
          const double b = m[k][q];
          m[k][p] = c * a - s * b;
          m[k][q] = s * a + c * b;
        }
        for (std::size_t k = 0; k < 3; ++k)
        {
          const double a = m[p][k];
          const double b = m[q][k];
          m[p][k] = c * a - s * b;
          m[q][k] = s * a + c * b;
          const double d = v[k][p];
          const double e = v[k][q];
          v[k][p] = c * d - s * e;
          v[k][q] = s * d + c * e;
        }
      }
    }
  }
  const std::size_t best = m[0][0] >= m[1][1] ? (m[0][0] >= m[2][2] ? 0 : 2) : (m[1][1] >= m[2][2] ? 1 : 2);
  greatest = m[best][best];
  Vector3           axis{ v[0][best], v[1][best], v[2][best] };
  const std::size_t main = std::abs(axis[0]) >= std::abs(axis[1]) ? (std::abs(axis[0]) >= std::abs(axis[2]) ? 0 : 2)
                                                                  : (std::abs(axis[1]) >= std::abs(axis[2]) ? 1 : 2);
  if (axis[main] < 0)
  {
    axis = { -axis[0], -axis[1], -axis[2] };
  }
  return axis;
}

/** Twice the vector area of a polygon. */
Vector3
AreaVector(const MedialComplex & core, std::span<const ElementIndex> corners)
{
  Vector3 sum{ 0, 0, 0 };
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
  {
    const Vector3 & first = core.positions[corners[0]];
    sum =
      AddScaled(sum, 1, Cross(Minus(core.positions[corners[i]], first), Minus(core.positions[corners[i + 1]], first)));
  }
  return sum;
}

class Cutter
{
public:
  Cutter(const MedialComplex & core, double sliver)
    : m_Core(core)
    , m_Cells(core.cells)
    , m_Sliver(sliver)
    , m_Pieces(core)
    , m_Nodes(core.cells.vertexCount)
  {}

  MedialSheets
  Cut()
  {
    for (int step = 1; step <= kFinSteps; ++step)
    {
      m_Pieces.RemoveFins(m_Sliver * step / kFinSteps);
    }
    m_Pieces.Find();
    m_Pieces.DrawSeamsOn(m_Sliver);
    m_Pieces.Find();
    m_Pieces.JoinStrips(m_Sliver);
    NumberSheets();
    FindCurves();
    NumberCurves();
    MeasureSheets();
    FindPiecesOfVertices();
    return std::move(m_Result);
  }

private:
  /** A seam's edge, or a rod's. */
  struct CurveEdge
  {
    bool                       isRod = false;
    std::vector<std::uint32_t> sheets{};         ///< at the edge, one as often as it is
    std::vector<std::uint32_t> key{};            ///< those that meet in the seam, each once
    std::uint32_t              strip = kNoPiece; ///< it is on the border of these strips, which hang together
  };

  static void
  SortOnce(std::vector<std::uint32_t> & numbers)
  {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  }

  bool
  IsSeam(ElementIndex edge) const
  {
    return m_Pieces.LiveCount(edge) > 2 || m_Pieces.IsDrawn(edge);
  }

  /** Calls visit(face, whether it is a strip's) for the faces at an edge that are no fins. */
  template <typename TVisit>
  void
  ForFaces(ElementIndex edge, TVisit && visit) const
  {
    for (const ElementIndex face : m_Pieces.FacesOf(edge))
    {
      if (m_Pieces.IsLive(face))
      {
        visit(face, m_Pieces.IsStrip(face));
      }
    }
  }

  /** What lies between seams is taken for a part of them: all sheets about it meet in one seam, along all its sides. */
  void
  FindSeamEdges()
  {
    std::uint32_t pieces = 0;
    for (ElementIndex face = 0; face < m_Result.sheetOfFace.size(); ++face)
    {
      pieces = m_Pieces.IsLive(face) ? std::max(pieces, m_Pieces.OwnPiece(face) + 1) : pieces;
    }
    UnionFind                               strips(pieces); // those that hang together
    std::vector<std::vector<std::uint32_t>> about(pieces);  // sheets
    for (ElementIndex edge = 0; edge < m_Cells.edges.size(); ++edge)
    {
      std::uint32_t before = kNoPiece;
      if (!IsSeam(edge))
      {
        continue;
      }
      ForFaces(edge, [&](ElementIndex face, bool isStrip) {
        if (isStrip)
        {
          strips.Unite(before == kNoPiece ? m_Pieces.OwnPiece(face) : before, m_Pieces.OwnPiece(face));
          before = m_Pieces.OwnPiece(face);
        }
      });
    }
    for (ElementIndex edge = 0; edge < m_Cells.edges.size(); ++edge)
    {
      if (!IsSeam(edge))
      {
        continue;
      }
      CurveEdge                  seam;
      std::vector<std::uint32_t> others;
      ForFaces(edge, [&](ElementIndex face, bool isStrip) {
        seam.sheets.push_back(m_Result.sheetOfFace[face]);
        if (isStrip)
        {
          seam.strip = strips.Find(m_Pieces.OwnPiece(face));
        }
        else
        {
          others.push_back(m_Result.sheetOfFace[face]);
        }
      });
      std::sort(seam.sheets.begin(), seam.sheets.end());
      if (seam.strip != kNoPiece)
      {
        auto & all = about[seam.strip];
        all.insert(all.end(), others.begin(), others.end());
        SortOnce(all);
      }
      if (m_Pieces.IsDrawn(edge))
      {
        // Parts two sheets and is no seam; where it leads to another seam, the two are one.
        m_Nodes.Unite(m_Cells.edges[edge][0], m_Cells.edges[edge][1]);
        continue;
      }
      m_Edges[edge] = std::move(seam);
    }
    for (auto & [edge, seam] : m_Edges)
    {
      seam.key = seam.strip != kNoPiece ? about[seam.strip] : seam.sheets;
      SortOnce(seam.key);
    }
  }

  void
  NumberSheets()
  {
    std::vector<std::uint32_t>      pieces = m_Pieces.PieceOfFaces();
    std::map<std::uint32_t, double> areas;
    for (ElementIndex face = 0; face < pieces.size(); ++face)
    {
      areas[pieces[face]] += PolygonArea(m_Core.positions, m_Cells.FaceVertices(face));
    }
    std::vector<std::pair<double, std::uint32_t>> order;
    for (const auto & [piece, area] : areas)
    {
      order.emplace_back(-area, piece);
    }
    std::sort(order.begin(), order.end());
    std::map<std::uint32_t, std::uint32_t> numbers;
    for (const auto & [area, piece] : order)
    {
      numbers.emplace(piece, static_cast<std::uint32_t>(numbers.size()));
    }
    for (std::uint32_t & piece : pieces)
    {
      piece = numbers.at(piece);
    }
    m_Result.sheetOfFace = std::move(pieces);
    m_Result.sheets.resize(numbers.size());
  }

  bool
  HasFaces(ElementIndex vertex) const
  {
    return m_FacesAt[vertex] != 0;
  }

  /** Whether a rod that hangs on a sheet, or on other rods, by one end hardly stands out. */
  bool
  IsSpur(const CurveRecord & rod)
  {
    const std::array<ElementIndex, 2> ends{ rod.vertices.front(), rod.vertices.back() };
    for (std::size_t foot = 0; foot < 2 && rod.isRod; ++foot)
    {
      const ElementIndex tip = ends[1 - foot];
      const bool         hangs = HasFaces(ends[foot]) || m_EdgesAt.at(m_Nodes.Find(ends[foot])).size() > 2;
      if (hangs && !HasFaces(tip) && m_EdgesAt.at(m_Nodes.Find(tip)).size() == 1)
      {
        double standOut = 0;
        for (const ElementIndex vertex : rod.vertices)
        {
          standOut = std::max(standOut,
                              Distance(m_Core.positions[ends[foot]], m_Core.positions[vertex]) + m_Core.radius[vertex] -
                                m_Core.radius[ends[foot]]);
        }
        return standOut < m_Sliver;
      }
    }
    return false;
  }

  /** Chains of seams and rods; short seams are drawn together until none is left. */
  void
  FindCurves()
  {
    m_FacesAt.assign(m_Cells.vertexCount, 0);
    for (const ElementIndex vertex : m_Cells.faceVertices)
    {
      ++m_FacesAt[vertex];
    }
    FindSeamEdges();
    for (ElementIndex edge = 0; edge < m_Cells.edges.size(); ++edge)
    {
      if (m_Pieces.FacesOf(edge).empty())
      {
        m_Edges[edge].isRod = true;
      }
    }
    for (bool changed = true; changed;)
    {
      changed = false;
      FindChains();
      GroupChains();
      for (const auto & chain : m_Chains)
      {
        if (IsSpur(chain.record))
        {
          changed = true;
          for (const ElementIndex edge : chain.edges)
          {
            m_Edges.erase(edge);
          }
          m_Spurs.push_back(chain.record.vertices);
          continue;
        }
        if (chain.record.isRod || chain.record.length >= m_Sliver)
        {
          continue;
        }
        changed = true;
        for (const ElementIndex edge : chain.edges)
        {
          m_Nodes.Unite(m_Cells.edges[edge][0], m_Cells.edges[edge][1]);
          m_Edges.erase(edge);
        }
      }
    }
  }

  struct Chain
  {
    CurveRecord               record;
    std::vector<ElementIndex> edges;
  };

  /** Whether curves pass through a node without stopping. */
  bool
  GoesOn(std::uint32_t node) const
  {
    const auto & edges = m_EdgesAt.at(node);
    if (edges.size() != 2 || edges[0] == edges[1])
    {
      return false;
    }
    const CurveEdge & a = m_Edges.at(edges[0]);
    const CurveEdge & b = m_Edges.at(edges[1]);
    return a.isRod == b.isRod && a.key == b.key && a.sheets == b.sheets && (!a.isRod || !HasFaces(node));
  }

  void
  FindChains()
  {
    m_EdgesAt.clear();
    for (const auto & [edge, unused] : m_Edges)
    {
      for (const ElementIndex end : m_Cells.edges[edge])
      {
        m_EdgesAt[m_Nodes.Find(end)].push_back(edge);
      }
    }
    m_Chains.clear();
    std::set<ElementIndex> taken;
    const auto             walk = [&](ElementIndex first, ElementIndex from) {
      Chain        chain;
      ElementIndex edge = first;
      ElementIndex at = from;
      chain.record.isRod = m_Edges.at(first).isRod;
      chain.record.sheets = m_Edges.at(first).sheets;
      chain.record.vertices.push_back(at);
      while (taken.insert(edge).second)
      {
        const auto &       ends = m_Cells.edges[edge];
        const ElementIndex next = ends[0] ^ ends[1] ^ at;
        const double       length = m_Pieces.EdgeLength(edge) * (m_Edges.at(edge).strip == kNoPiece ? 1 : 0.5);
        chain.record.thickness += length * (m_Core.radius[at] + m_Core.radius[next]);
        chain.record.length += length;
        chain.edges.push_back(edge);
        chain.record.vertices.push_back(next);
        const std::uint32_t node = m_Nodes.Find(next);
        if (!GoesOn(node))
        {
          break;
        }
        const auto & around = m_EdgesAt.at(node);
        edge = around[0] == edge ? around[1] : around[0];
        // The next edge begins at another vertex of the node where that was drawn together.
        at = m_Nodes.Find(m_Cells.edges[edge][0]) == node ? m_Cells.edges[edge][0] : m_Cells.edges[edge][1];
        if (at != next && !taken.contains(edge))
        {
          chain.record.vertices.push_back(at);
        }
      }
      chain.record.isClosed =
        chain.edges.size() > 1 &&
        m_Nodes.Find(chain.record.vertices.front()) == m_Nodes.Find(chain.record.vertices.back()) &&
        GoesOn(m_Nodes.Find(chain.record.vertices.front()));
      if (chain.record.isClosed)
      {
        chain.record.vertices.pop_back();
      }
      chain.record.thickness = chain.record.length > 0 ? chain.record.thickness / chain.record.length
                                                                   : 2 * m_Core.radius[chain.record.vertices.front()];
      m_Chains.push_back(std::move(chain));
    };
    for (const auto & [node, edges] : m_EdgesAt)
    {
      for (const ElementIndex edge : GoesOn(node) ? std::vector<ElementIndex>() : edges)
      {
        if (!taken.contains(edge))
        {
          const auto & ends = m_Cells.edges[edge];
          walk(edge, m_Nodes.Find(ends[0]) == node ? ends[0] : ends[1]);
        }
      }
    }
    for (const auto & [edge, unused] : m_Edges)
    {
      if (!taken.contains(edge))
      {
        walk(edge, m_Cells.edges[edge][0]);
      }
    }
  }

  /** Makes chains one seam where the same sheets meet in them and they touch or run along the same strips. */
  void
  GroupChains()
  {
    std::map<ElementIndex, std::uint32_t> chainOf;
    for (std::uint32_t chain = 0; chain < m_Chains.size(); ++chain)
    {
      for (const ElementIndex edge : m_Chains[chain].edges)
      {
        chainOf[edge] = chain;
      }
    }
    UnionFind  groups(m_Chains.size());
    const auto unite = [&](ElementIndex a, ElementIndex b) {
      const CurveEdge & one = m_Edges.at(a);
      const CurveEdge & other = m_Edges.at(b);
      if (!one.isRod && !other.isRod && one.key == other.key)
      {
        groups.Unite(chainOf.at(a), chainOf.at(b));
      }
    };
    for (const auto & [node, edges] : m_EdgesAt)
    {
      for (std::size_t i = 0; i < edges.size(); ++i)
      {
        for (std::size_t j = i + 1; j < edges.size(); ++j)
        {
          unite(edges[i], edges[j]);
        }
      }
    }
    std::map<std::uint32_t, ElementIndex> along;
    for (const auto & [edge, curve] : m_Edges)
    {
      if (curve.strip != kNoPiece)
      {
        unite(along.try_emplace(curve.strip, edge).first->second, edge);
      }
    }
    std::vector<std::vector<std::uint32_t>> members(m_Chains.size());
    for (std::uint32_t chain = 0; chain < m_Chains.size(); ++chain)
    {
      members[groups.Find(chain)].push_back(chain);
    }
    std::vector<Chain> grouped;
    for (auto & group : members)
    {
      if (!group.empty())
      {
        grouped.push_back(OneOf(group));
      }
    }
    m_Chains = std::move(grouped);
  }

  /** Several chains as one. */
  Chain
  OneOf(std::vector<std::uint32_t> & group) const
  {
    std::stable_sort(group.begin(), group.end(), [&](std::uint32_t a, std::uint32_t b) {
      return m_Chains[a].record.length > m_Chains[b].record.length;
    });
    Chain  one = m_Chains[group.front()];
    double thickness = one.record.thickness * one.record.length;
    for (std::size_t i = 1; i < group.size(); ++i)
    {
      const Chain & other = m_Chains[group[i]];
      one.record.length += other.record.length;
      thickness += other.record.thickness * other.record.length;
      one.record.isClosed = false;
      one.edges.insert(one.edges.end(), other.edges.begin(), other.edges.end());
    }
    one.record.thickness = one.record.length > 0 ? thickness / one.record.length : one.record.thickness;
    for (const ElementIndex edge : one.edges)
    {
      if (m_Edges.at(edge).strip != kNoPiece)
      {
        one.record.sheets = m_Edges.at(edge).key;
      }
    }
    return one;
  }

  void
  NumberCurves()
  {
    // Points that stand alone.
    std::vector<std::uint8_t> used(m_Cells.vertexCount, 0);
    for (const auto & ends : m_Cells.edges)
    {
      used[ends[0]] = 1;
      used[ends[1]] = 1;
    }
    for (ElementIndex vertex = 0; vertex < used.size(); ++vertex)
    {
      if (used[vertex] == 0)
      {
        Chain chain;
        chain.record.isRod = true;
        chain.record.vertices = { vertex };
        chain.record.thickness = 2 * m_Core.radius[vertex];
        m_Chains.push_back(std::move(chain));
      }
    }
    std::stable_sort(m_Chains.begin(), m_Chains.end(), [](const Chain & a, const Chain & b) {
      return a.record.isRod != b.record.isRod ? b.record.isRod : a.record.length > b.record.length;
    });
    std::map<ElementIndex, std::uint32_t> curveOf;
    for (std::uint32_t curve = 0; curve < m_Chains.size(); ++curve)
    {
      for (const ElementIndex edge : m_Chains[curve].edges)
      {
        curveOf[edge] = curve;
      }
    }
    std::map<std::uint32_t, std::uint32_t> junctions; // by node
    const auto                             isJunction = [&](std::uint32_t node) {
      const auto & edges = m_EdgesAt.at(node);
      if (GoesOn(node))
      {
        return false;
      }
      const auto isOther = [&](ElementIndex edge) { return curveOf.at(edge) != curveOf.at(edges[0]); };
      return m_Edges.at(edges[0]).isRod ? edges.size() > 1 || HasFaces(node)
                                                                    : std::any_of(edges.begin(), edges.end(), isOther);
    };
    for (const auto & [node, unused] : m_EdgesAt)
    {
      if (isJunction(node))
      {
        junctions.emplace(node, static_cast<std::uint32_t>(junctions.size()));
        m_Result.junctions.push_back(node);
      }
    }
    m_Result.curveOfEdge.assign(m_Cells.edges.size(), kNoPiece);
    for (Chain & chain : m_Chains)
    {
      const auto number = static_cast<std::uint32_t>(m_Result.curves.size());
      for (const ElementIndex edge : chain.edges)
      {
        m_Result.curveOfEdge[edge] = number;
      }
      std::set<std::uint32_t> ends;
      for (const ElementIndex edge : chain.edges)
      {
        for (const ElementIndex vertex : m_Cells.edges[edge])
        {
          if (const auto place = junctions.find(m_Nodes.Find(vertex)); place != junctions.end())
          {
            ends.insert(place->second);
          }
        }
      }
      std::copy_n(ends.begin(), std::min<std::size_t>(2, ends.size()), chain.record.junctions.begin());
      m_Result.curves.push_back(std::move(chain.record));
    }
  }

  void
  MeasureSheets()
  {
    std::vector<std::array<Vector3, 3>> tensors(m_Result.sheets.size());
    std::vector<double>                 squares(m_Result.sheets.size(), 0);
    for (auto & tensor : tensors)
    {
      tensor = { Vector3{ 0, 0, 0 }, Vector3{ 0, 0, 0 }, Vector3{ 0, 0, 0 } };
    }
    for (ElementIndex face = 0; face < m_Result.sheetOfFace.size(); ++face)
    {
      const std::uint32_t number = m_Result.sheetOfFace[face];
      SheetRecord &       sheet = m_Result.sheets[number];
      const auto          corners = m_Cells.FaceVertices(face);
      const double        area = PolygonArea(m_Core.positions, corners);
      double              thickness = 0;
      for (const ElementIndex corner : corners)
      {
        thickness += 2 * m_Core.radius[corner] / static_cast<double>(corners.size());
      }
      sheet.area += area;
      sheet.thickness += area * thickness;
      squares[number] += area * thickness * thickness;
      const Vector3 vector = AreaVector(m_Core, corners);
      const double  length = Length(vector);
      for (std::size_t i = 0; i < 3 && length > 0; ++i)
      {
        for (std::size_t j = 0; j < 3; ++j)
        {
          tensors[number][i][j] += area * (vector[i] / length) * (vector[j] / length);
        }
      }
    }
    for (std::size_t number = 0; number < m_Result.sheets.size(); ++number)
    {
      SheetRecord & sheet = m_Result.sheets[number];
      if (sheet.area > 0)
      {
        sheet.thickness /= sheet.area;
        sheet.thicknessDeviation =
          std::sqrt(std::max(0.0, squares[number] / sheet.area - sheet.thickness * sheet.thickness));
        double greatest = 0;
        sheet.normal = GreatestAxis(tensors[number], greatest);
        sheet.flatness = greatest / sheet.area;
      }
    }
    for (ElementIndex edge = 0; edge < m_Cells.edges.size(); ++edge)
    {
      for (const ElementIndex face : m_Pieces.FacesOf(edge))
      {
        if (m_Pieces.IsLive(face))
        {
          SheetRecord & sheet = m_Result.sheets[m_Result.sheetOfFace[face]];
          sheet.freeBorder += m_Pieces.LiveCount(edge) == 1 ? m_Pieces.EdgeLength(edge) : 0.0;
        }
      }
    }
    for (const CurveRecord & curve : m_Result.curves)
    {
      for (const std::uint32_t one : curve.sheets)
      {
        m_Result.sheets[one].seamBorder += curve.length;
        for (const std::uint32_t other : curve.sheets)
        {
          if (other != one)
          {
            m_Result.sheets[one].neighbours.push_back(other);
          }
        }
      }
    }
    for (SheetRecord & sheet : m_Result.sheets)
    {
      auto & all = sheet.neighbours;
      std::sort(all.begin(), all.end());
      all.erase(std::unique(all.begin(), all.end()), all.end());
    }
  }

  void
  FindPiecesOfVertices()
  {
    auto & pieces = m_Result.pieceOfVertex;
    pieces.assign(m_Cells.vertexCount, kNoPiece);
    std::vector<std::pair<ElementIndex, std::uint32_t>> at;
    at.reserve(m_Cells.faceVertices.size());
    for (ElementIndex face = 0; face < m_Result.sheetOfFace.size(); ++face)
    {
      for (const ElementIndex vertex : m_Cells.FaceVertices(face))
      {
        at.emplace_back(vertex, m_Result.sheetOfFace[face]);
      }
    }
    std::sort(at.begin(), at.end());
    for (std::size_t i = 0; i < at.size();)
    {
      const ElementIndex vertex = at[i].first;
      std::size_t        most = 0;
      while (i < at.size() && at[i].first == vertex)
      {
        const std::size_t first = i;
        while (i < at.size() && at[i] == at[first])
        {
          ++i;
        }
        if (i - first > most)
        {
          most = i - first;
          pieces[vertex] = at[first].second;
        }
      }
    }
    const auto sheets = static_cast<std::uint32_t>(m_Result.sheets.size());
    for (std::uint32_t curve = 0; curve < m_Result.curves.size(); ++curve)
    {
      for (const ElementIndex vertex : m_Result.curves[curve].vertices)
      {
        if (m_Result.curves[curve].isRod && pieces[vertex] == kNoPiece)
        {
          pieces[vertex] = sheets + curve;
        }
      }
    }
    // The last that went first: its foot has a piece.
    std::for_each(m_Spurs.rbegin(), m_Spurs.rend(), [&](const std::vector<ElementIndex> & spur) {
      const std::uint32_t foot = pieces[spur.front()] != kNoPiece ? pieces[spur.front()] : pieces[spur.back()];
      for (const ElementIndex vertex : spur)
      {
        pieces[vertex] = pieces[vertex] == kNoPiece ? foot : pieces[vertex];
      }
    });
  }

  const MedialComplex &                              m_Core;
  const CellComplex &                                m_Cells;
  double                                             m_Sliver;
  SheetPieces                                        m_Pieces;
  UnionFind                                          m_Nodes; ///< of vertices: what was drawn together
  std::vector<std::uint32_t>                         m_FacesAt;
  std::map<ElementIndex, CurveEdge>                  m_Edges;
  std::map<std::uint32_t, std::vector<ElementIndex>> m_EdgesAt; ///< by node
  std::vector<Chain>                                 m_Chains;
  std::vector<std::vector<ElementIndex>>             m_Spurs; ///< rods that are passed over
  MedialSheets                                       m_Result;
};

} // namespace

MedialSheets
CutIntoSheets(const MedialComplex & core, double sliver)
{
  return Cutter(core, sliver).Cut();
}

VoxelOwners
PiecesOfVoxels(const MedialSheets & sheets, const VoxelOwners & owners)
{
  VoxelOwners pieces = owners;
  for (std::uint32_t & value : pieces.values)
  {
    value = value == 0 ? 0 : sheets.pieceOfVertex[value - 1] + 1;
  }
  return pieces;
}

} // namespace voxelcore
