#include "LooseFlakes.h"

#include "voxelcore/PolygonArea.h"
#include "voxelcore/UnionFind.h"

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
    const auto faces = cut.FacesOf(edge);
    for (const ElementIndex face : faces)
    {
      if (pieceOfFace[face] != pieceOfFace[faces.front()])
      {
        pieces.at(pieceOfFace[face]).isLoose = false;
        pieces.at(pieceOfFace[faces.front()]).isLoose = false;
      }
    }
  }
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
  return pieces;
}

/** From the pieces that are not loose along rods and the edges of loose ones. */
void
MeasureLooseOnes(const MedialComplex &              core,
                 const SheetPieces &                cut,
                 const std::vector<std::uint32_t> & pieceOfFace,
                 Pieces &                           pieces)
{
  struct Reached
  {
    double        way = std::numeric_limits<double>::infinity(); ///< less the radius where it began
    std::uint32_t from = kNoPiece;
  };
  const CellComplex &                               cells = core.cells;
  std::map<ElementIndex, std::vector<ElementIndex>> around;
  for (ElementIndex edge = 0; edge < cells.edges.size(); ++edge)
  {
    const auto faces = cut.FacesOf(edge);
    if (faces.empty() || pieces.at(pieceOfFace[faces.front()]).isLoose)
    {
      around[cells.edges[edge][0]].push_back(edge);
      around[cells.edges[edge][1]].push_back(edge);
    }
  }
  std::map<ElementIndex, Reached> ways;
  for (ElementIndex face = 0; face < pieceOfFace.size(); ++face)
  {
    for (const ElementIndex vertex : cells.FaceVertices(face))
    {
      if (!pieces.at(pieceOfFace[face]).isLoose && around.contains(vertex))
      {
        ways.try_emplace(vertex, Reached{ -core.radius[vertex], pieceOfFace[face] });
      }
    }
  }
  using Entry = std::pair<double, ElementIndex>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const auto & [vertex, reached] : ways)
  {
    queue.emplace(reached.way, vertex);
  }
  while (!queue.empty())
  {
    const auto [way, vertex] = queue.top();
    queue.pop();
    const Reached reached = ways.at(vertex);
    for (const ElementIndex edge : way > reached.way ? std::vector<ElementIndex>() : around.at(vertex))
    {
      const auto &       ends = cells.edges[edge];
      const ElementIndex next = ends[0] ^ ends[1] ^ vertex;
      const double       further = way + cut.EdgeLength(edge);
      Reached &          there = ways[next];
      if (further < there.way)
      {
        there = { further, reached.from };
        queue.emplace(further, next);
      }
    }
  }
  for (ElementIndex face = 0; face < pieceOfFace.size(); ++face)
  {
    Piece & piece = pieces.at(pieceOfFace[face]);
    for (const ElementIndex vertex : piece.isLoose ? cells.FaceVertices(face) : std::span<const ElementIndex>())
    {
      const Reached reached = ways[vertex];
      piece.standOut = std::max(piece.standOut, reached.way + core.radius[vertex]);
      if (reached.way < piece.nearest)
      {
        piece.nearest = reached.way;
        piece.hangsOn = reached.from;
      }
    }
  }
}

} // namespace

void
JoinLooseFlakes(const MedialComplex &        core,
                const SheetPieces &          pieces,
                double                       sliver,
                std::vector<std::uint32_t> & pieceOfFace)
{
  Pieces found = MeasurePieces(core, pieces, pieceOfFace);
  if (std::none_of(found.begin(), found.end(), [](const auto & one) { return one.second.isLoose; }))
  {
    return;
  }
  MeasureLooseOnes(core, pieces, pieceOfFace, found);
  for (std::uint32_t & piece : pieceOfFace)
  {
    const Piece & one = found.at(piece);
    if (one.isLoose && one.hangsOn != kNoPiece && one.standOut < std::max(sliver, one.thickness / one.area))
    {
      piece = one.hangsOn;
    }
  }
}

} // namespace voxelcore
