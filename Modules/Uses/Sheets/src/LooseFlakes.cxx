#include "LooseFlakes.h"

#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/VoxelCore/PolygonArea.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <utility>

namespace voxelcore
{

namespace
{

struct Piece
{
  double        area = 0;
  double        thickness = 0; ///< times area
  bool          isLoose = true;
  std::uint32_t part = kNoPiece; ///< of the core: all that hangs together
  double        standOut = 0;
  double        nearest = std::numeric_limits<double>::infinity();
  std::uint32_t hangsOn = kNoPiece; ///< where `nearest` leads
  double        hangsBy = 0;        ///< thickness of the rods on that way
};

using Pieces = std::map<std::uint32_t, Piece>;

Pieces
MeasurePieces(const MedialComplex & core, const SheetPieces & cut, const std::vector<std::uint32_t> & pieceOfFace)
{
  const CellComplex & cells = core.cells;
  UnionFind           parts(cells.vertexCount);
  for (const auto & ends : cells.edges)
  {
    parts.Unite(ends[0], ends[1]);
  }
  Pieces pieces;
  for (ElementIndex face = 0; face < pieceOfFace.size(); ++face)
  {
    const auto   corners = cells.FaceVertices(face);
    const double area = PolygonArea(core.positions, corners);
    Piece &      piece = pieces[pieceOfFace[face]];
    piece.part = static_cast<std::uint32_t>(parts.Find(corners[0]));
    piece.area += area;
    for (const ElementIndex corner : corners)
    {
      piece.thickness += 2 * core.radius[corner] * area / static_cast<double>(corners.size());
    }
  }
  for (ElementIndex edge = 0; edge < cells.edges.size(); ++edge)
  {
    std::uint32_t before = kNoPiece; // fins hold nothing
    for (const ElementIndex face : cut.FacesOf(edge))
    {
      const std::uint32_t piece = cut.IsLive(face) ? pieceOfFace[face] : kNoPiece;
      if (piece != kNoPiece && before != kNoPiece && piece != before)
      {
        pieces.at(piece).isLoose = false;
        pieces.at(before).isLoose = false;
      }
      before = piece != kNoPiece ? piece : before;
    }
  }
  return pieces;
}

/** Of all that hangs together the largest is not loose. */
void
KeepLargest(Pieces & pieces)
{
  std::map<std::uint32_t, Piece *> largest; // of each part
  for (auto & [number, piece] : pieces)
  {
    Piece *& most = largest.try_emplace(piece.part, &piece).first->second;
    most = piece.area > most->area ? &piece : most;
  }
  for (const auto & [part, piece] : largest)
  {
    piece->isLoose = false;
  }
}

struct Reached
{
  double        way = std::numeric_limits<double>::infinity(); ///< less the radius where it began
  std::uint32_t from = kNoPiece;
  double        length = 0;    ///< of rods on the way
  double        thickness = 0; ///< of these, times length
};

/** The shortest ways from `starts` along some edges. */
std::map<ElementIndex, Reached>
WaysAlong(const MedialComplex &             core,
          const SheetPieces &               cut,
          const std::vector<ElementIndex> & edges,
          std::map<ElementIndex, Reached>   starts)
{
  std::map<ElementIndex, std::vector<ElementIndex>> around;
  for (const ElementIndex edge : edges)
  {
    around[core.cells.edges[edge][0]].push_back(edge);
    around[core.cells.edges[edge][1]].push_back(edge);
  }
  using Entry = std::pair<double, ElementIndex>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const auto & [vertex, reached] : starts)
  {
    queue.emplace(reached.way, vertex);
  }
  std::map<ElementIndex, Reached> ways = std::move(starts);
  while (!queue.empty())
  {
    const auto [way, vertex] = queue.top();
    queue.pop();
    const Reached reached = ways.at(vertex);
    for (const ElementIndex edge : way > reached.way ? std::vector<ElementIndex>() : around[vertex])
    {
      const auto &       ends = core.cells.edges[edge];
      const ElementIndex next = ends[0] ^ ends[1] ^ vertex;
      const double       further = way + cut.EdgeLength(edge);
      const double       length = cut.FacesOf(edge).empty() ? cut.EdgeLength(edge) : 0.0;
      Reached &          there = ways[next];
      if (further < there.way)
      {
        there = { further,
                  reached.from,
                  reached.length + length,
                  reached.thickness + length * (core.radius[vertex] + core.radius[next]) };
        queue.emplace(further, next);
      }
    }
  }
  return ways;
}

/** How far loose pieces stand out of where the ways began, and what they hang on. */
void
MeasureLooseOnes(const MedialComplex &              core,
                 const std::vector<std::uint32_t> & pieceOfFace,
                 std::map<ElementIndex, Reached>    ways,
                 Pieces &                           pieces)
{
  for (ElementIndex face = 0; face < pieceOfFace.size(); ++face)
  {
    Piece & piece = pieces.at(pieceOfFace[face]);
    for (const ElementIndex vertex : piece.isLoose ? core.cells.FaceVertices(face) : std::span<const ElementIndex>())
    {
      const Reached reached = ways[vertex];
      piece.standOut = std::max(piece.standOut, reached.way + core.radius[vertex]);
      if (reached.way < piece.nearest)
      {
        piece.nearest = reached.way;
        piece.hangsOn = reached.from;
        piece.hangsBy = reached.length > 0 ? reached.thickness / reached.length : 0;
      }
    }
  }
}

/** Of loose pieces and, where that is asked for, of rods. */
std::vector<ElementIndex>
LooseEdges(const SheetPieces &                cut,
           const std::vector<std::uint32_t> & pieceOfFace,
           const Pieces &                     pieces,
           ElementIndex                       edges,
           bool                               withRods)
{
  std::vector<ElementIndex> found;
  for (ElementIndex edge = 0; edge < edges; ++edge)
  {
    const auto faces = cut.FacesOf(edge);
    const auto isLoose = [&](ElementIndex face) { return pieces.at(pieceOfFace[face]).isLoose; };
    if (faces.empty() ? withRods : std::any_of(faces.begin(), faces.end(), isLoose))
    {
      found.push_back(edge);
    }
  }
  return found;
}

} // namespace

void
JoinLooseFlakes(const MedialComplex &        core,
                const SheetPieces &          pieces,
                double                       sliver,
                std::vector<std::uint32_t> & pieceOfFace)
{
  Pieces found = MeasurePieces(core, pieces, pieceOfFace);
  KeepLargest(found);
  if (std::none_of(found.begin(), found.end(), [](const auto & one) { return one.second.isLoose; }))
  {
    return;
  }
  const auto                edgeCount = static_cast<ElementIndex>(core.cells.edges.size());
  std::vector<ElementIndex> edges = LooseEdges(pieces, pieceOfFace, found, edgeCount, true);
  std::vector<char>         isOnWay(core.cells.vertexCount, 0);
  for (const ElementIndex edge : edges)
  {
    isOnWay[core.cells.edges[edge][0]] = isOnWay[core.cells.edges[edge][1]] = 1;
  }
  std::map<ElementIndex, Reached> starts;
  for (ElementIndex face = 0; face < pieceOfFace.size(); ++face)
  {
    for (const ElementIndex vertex : core.cells.FaceVertices(face))
    {
      if (!found.at(pieceOfFace[face]).isLoose && isOnWay[vertex] != 0)
      {
        starts.try_emplace(vertex, Reached{ -core.radius[vertex], pieceOfFace[face] });
      }
    }
  }
  MeasureLooseOnes(core, pieceOfFace, WaysAlong(core, pieces, edges, std::move(starts)), found);
  for (std::uint32_t & piece : pieceOfFace)
  {
    const Piece & one = found.at(piece);
    // At the tip of a rod it is no less part of a sheet than the rod alone would be.
    const double height = std::max({ sliver, one.thickness / one.area, one.hangsBy });
    if (one.isLoose && one.hangsOn != kNoPiece && one.standOut < height)
    {
      piece = one.hangsOn;
    }
  }
}

void
DropFlakesOfRods(const MedialComplex &        core,
                 const SheetPieces &          pieces,
                 const ShortRods &            shortRods,
                 double                       sliver,
                 std::vector<std::uint32_t> & pieceOfFace)
{
  const auto                      edgeCount = static_cast<ElementIndex>(core.cells.edges.size());
  std::vector<char>               isShort(edgeCount, 0);
  std::map<ElementIndex, Reached> starts;
  for (const ElementIndex edge : shortRods.Edges())
  {
    isShort[edge] = 1;
  }
  for (ElementIndex edge = 0; edge < edgeCount; ++edge)
  {
    for (const ElementIndex end : core.cells.edges[edge])
    {
      if (isShort[edge] == 0 && pieces.FacesOf(edge).empty())
      {
        starts.try_emplace(end, Reached{ -core.radius[end], 0 });
      }
    }
  }
  if (starts.empty() || pieceOfFace.empty())
  {
    return;
  }
  Pieces                          found = MeasurePieces(core, pieces, pieceOfFace);
  const std::vector<ElementIndex> edges = LooseEdges(pieces, pieceOfFace, found, edgeCount, false);
  MeasureLooseOnes(core, pieceOfFace, WaysAlong(core, pieces, edges, std::move(starts)), found);
  for (std::uint32_t & piece : pieceOfFace)
  {
    const Piece & one = found.at(piece);
    if (one.isLoose && one.standOut < std::max(sliver, one.thickness / one.area))
    {
      piece = kNoPiece;
    }
  }
}

} // namespace voxelcore
