#include "voxelcore/Sheets/MedialSheets.h"

#include "LooseFlakes.h"
#include "SeamChains.h"
#include "SheetPieces.h"
#include "ShortRods.h"

#include "voxelcore/Lattice/GreatestAxis.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/VoxelCore/PolygonArea.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr int kFinSteps = 4;

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
  {}

  MedialSheets
  Cut()
  {
    RemoveFins();
    do
    {
      m_Pieces.DrawSeamsOn(m_Sliver);
      m_Pieces.Find();
      m_Pieces.DrawThroughNecks(m_Sliver);
      m_Pieces.Find();
    } while (RemoveFins()); // fins that hung on a sheet round the ends of their seams
    m_Pieces.JoinStrips(m_Sliver);
    std::vector<std::uint32_t> pieces = m_Pieces.PieceOfFaces();
    JoinLooseFlakes(m_Core, m_Pieces, m_Sliver, pieces);
    const ShortRods shortRods(m_Core, m_Pieces, pieces, m_Sliver);
    DropFlakesOfRods(m_Core, m_Pieces, shortRods, m_Sliver, pieces);
    NumberSheets(std::move(pieces));
    SeamChains seams(m_Core, m_Pieces, shortRods, m_Result.sheetOfFace, m_Sliver);
    seams.Find();
    seams.Number(m_Result);
    MeasureSheets();
    FindPiecesOfVertices();
    GiveFlakesToRods();
    return std::move(m_Result);
  }

private:
  bool
  RemoveFins()
  {
    bool removed = false;
    for (int step = 1; step <= kFinSteps; ++step)
    {
      removed = m_Pieces.RemoveFins(m_Sliver, static_cast<double>(step) / kFinSteps) || removed;
    }
    return removed;
  }

  void
  NumberSheets(std::vector<std::uint32_t> pieces)
  {
    std::map<std::uint32_t, double> areas;
    for (ElementIndex face = 0; face < pieces.size(); ++face)
    {
      areas[pieces[face]] += PolygonArea(m_Core.positions, m_Cells.FaceVertices(face));
    }
    areas.erase(kNoPiece);
    std::vector<std::pair<double, std::uint32_t>> order;
    order.reserve(areas.size());
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
      piece = piece != kNoPiece ? numbers.at(piece) : kNoPiece;
    }
    m_Result.sheetOfFace = std::move(pieces);
    m_Result.sheets.resize(numbers.size());
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
      if (number == kNoPiece)
      {
        continue;
      }
      SheetRecord & sheet = m_Result.sheets[number];
      const auto    corners = m_Cells.FaceVertices(face);
      const double  area = PolygonArea(m_Core.positions, corners);
      double        thickness = 0;
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
        if (m_Pieces.IsLive(face) && m_Result.sheetOfFace[face] != kNoPiece)
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
        if (m_Result.sheetOfFace[face] != kNoPiece)
        {
          at.emplace_back(vertex, m_Result.sheetOfFace[face]);
        }
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
    // What was passed over is part of what the balls at its ends belong to.
    using Entry = std::pair<double, ElementIndex>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    std::vector<double>                    ways(m_Cells.vertexCount, std::numeric_limits<double>::infinity());
    std::vector<std::vector<ElementIndex>> around(m_Cells.vertexCount);
    for (ElementIndex edge = 0; edge < m_Cells.edges.size(); ++edge)
    {
      const auto & ends = m_Cells.edges[edge];
      for (const ElementIndex end : ends)
      {
        if (pieces[ends[0]] == kNoPiece || pieces[ends[1]] == kNoPiece)
        {
          around[end].push_back(edge);
          if (pieces[end] != kNoPiece && ways[end] > 0)
          {
            ways[end] = -m_Core.radius[end];
            queue.emplace(ways[end], end);
          }
        }
      }
    }
    while (!queue.empty())
    {
      const auto [way, vertex] = queue.top();
      queue.pop();
      for (const ElementIndex edge : way > ways[vertex] ? std::vector<ElementIndex>() : around[vertex])
      {
        const auto &       ends = m_Cells.edges[edge];
        const ElementIndex next = ends[0] ^ ends[1] ^ vertex;
        const double       further = way + m_Pieces.EdgeLength(edge);
        if (further < ways[next])
        {
          ways[next] = further;
          pieces[next] = pieces[vertex];
          queue.emplace(further, next);
        }
      }
    }
  }

  void
  GiveFlakesToRods()
  {
    for (ElementIndex face = 0; face < m_Result.sheetOfFace.size(); ++face)
    {
      std::uint32_t & piece = m_Result.sheetOfFace[face];
      for (const ElementIndex vertex : piece == kNoPiece ? m_Cells.FaceVertices(face) : std::span<const ElementIndex>())
      {
        piece = std::min(piece, m_Result.pieceOfVertex[vertex]);
      }
    }
  }

  const MedialComplex & m_Core;
  const CellComplex &   m_Cells;
  double                m_Sliver;
  SheetPieces           m_Pieces;
  MedialSheets          m_Result;
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
