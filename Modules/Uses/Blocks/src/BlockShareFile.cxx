// A share as bytes. All numbers are little-endian base 128 (seven bits a byte, the highest bit says that more follow);
// signed ones are folded to 0, -1, 1, -2, ... The parts in order:
//   "VoxelBlk", version; digest, block count, block, weights, boundary vertices and squares of the whole, own squares;
//   numbers of points, cells, facets and corners of facets; checksum of all so far
//   points in scan order as steps; cells as four points; facets as corners, cells, points; topology; checksum of all
// A checksum is eight bytes. Differences of neighbouring numbers are small: about a third of the bytes in memory.

#include "voxelcore/Blocks/HaloBlocks.h"

#include "ShareCoding.h"

#include <algorithm>
#include <limits>

namespace voxelcore
{

namespace
{

constexpr std::array<std::uint8_t, 8> magic{ 'V', 'o', 'x', 'e', 'l', 'B', 'l', 'k' };
constexpr std::uint64_t               version = 2;
constexpr std::int64_t                leastCoordinate = std::numeric_limits<std::int32_t>::min();
constexpr std::int64_t                greatestCoordinate = std::numeric_limits<std::int32_t>::max();

// A point is its step along x in its row, or 1 for the next row that has one, or 0 for the next layer; the lowest bit
// says whether the block owns it.
void
WritePoints(const BlockShare & share, Encoder & to)
{
  LatticePoint last{ 0, 0, 0 };
  for (std::size_t i = 0; i < share.points.size(); ++i)
  {
    const LatticePoint & p = share.points[i];
    const unsigned       own = share.isOwn[i] != 0 ? 1 : 0;
    if (i == 0 || p.z != last.z)
    {
      to.Number(own);
      to.Step(last.z, p.z);
      to.Step(last.y, p.y);
      to.Step(last.x, p.x);
    }
    else if (p.y != last.y)
    {
      to.Number(2 | own);
      to.Step(last.y, p.y);
      to.Step(last.x, p.x);
    }
    else
    {
      to.Number(static_cast<std::uint64_t>(std::int64_t{ p.x } - last.x + 1) << 1 | own);
    }
    last = p;
  }
}

void
ReadPoints(BlockShare & share, Decoder & from)
{
  LatticePoint last{ 0, 0, 0 };
  const auto   coordinate = [&from](std::int32_t before, bool after) {
    return static_cast<std::int32_t>(
      from.Step(before, after ? std::int64_t{ before } + 1 : leastCoordinate, greatestCoordinate));
  };
  for (std::size_t i = 0; i < share.points.size(); ++i)
  {
    const std::uint64_t code = from.Number(0, std::uint64_t{ 1 } << 34);
    const std::uint64_t step = code >> 1;
    if (step == 0)
    {
      last.z = coordinate(last.z, i > 0);
    }
    else if (i == 0)
    {
      from.FailDamaged();
    }
    if (step <= 1)
    {
      last.y = coordinate(last.y, step == 1);
      last.x = coordinate(last.x, false);
    }
    else
    {
      const std::int64_t x = last.x + static_cast<std::int64_t>(step) - 1;
      if (x > greatestCoordinate)
      {
        from.FailDamaged();
      }
      last.x = static_cast<std::int32_t>(x);
    }
    share.points[i] = last;
    share.isOwn[i] = code & 1U;
  }
}

void
WriteCells(const DelaunayCells & cells, Encoder & to)
{
  std::int64_t last = 0;
  for (const auto & t : cells.tetrahedra)
  {
    to.Step(last, t[0]);
    to.Step(t[0], t[1]);
    to.Step(t[1], t[2]);
    to.Step(t[2], t[3]);
    last = t[0];
  }
  std::int64_t lastCell = 0;
  for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
  {
    const auto   polygon = cells.FacetPoints(facet);
    const auto & pair = cells.facetCells[facet];
    to.Number(polygon.size());
    to.Step(lastCell, pair[0]);
    lastCell = pair[0];
    // 0: outside; 1: another block's; else 2 and the step from the first cell.
    to.Number(pair[1] == kOutside      ? 0
              : pair[1] == kOtherBlock ? 1
                                       : Fold(std::int64_t{ pair[1] } - std::int64_t{ pair[0] }) + 2);
    for (const std::uint32_t point : polygon)
    {
      to.Step(last, point);
      last = point;
    }
  }
}

void
ReadCells(DelaunayCells & cells, std::size_t pointCount, std::size_t corners, Decoder & from)
{
  const auto point = [&from, pointCount](std::int64_t before) {
    return static_cast<std::uint32_t>(from.Step(before, 0, static_cast<std::int64_t>(pointCount) - 1));
  };
  const auto   lastOfCells = static_cast<std::int64_t>(cells.CellCount()) - 1;
  std::int64_t last = 0;
  for (auto & t : cells.tetrahedra)
  {
    t[0] = point(last);
    t[1] = point(t[0]);
    t[2] = point(t[1]);
    t[3] = point(t[2]);
    last = t[0];
  }
  std::int64_t lastCell = 0;
  for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
  {
    const std::uint64_t size = from.Number(3, corners);
    if (size > corners - cells.facetOffsets[facet])
    {
      from.FailDamaged();
    }
    cells.facetOffsets[facet + 1] = cells.facetOffsets[facet] + size;
    auto & pair = cells.facetCells[facet];
    lastCell = from.Step(lastCell, 0, lastOfCells);
    pair[0] = static_cast<std::uint32_t>(lastCell);
    const std::uint64_t second = from.Number(0, std::uint64_t{ 1 } << 34);
    if (second < 2)
    {
      pair[1] = second == 0 ? kOutside : kOtherBlock;
    }
    else
    {
      const std::int64_t cell = lastCell + Unfold(second - 2);
      if (cell < 0 || cell > lastOfCells || cell == lastCell)
      {
        from.FailDamaged();
      }
      pair[1] = static_cast<std::uint32_t>(cell);
    }
    for (std::uint64_t i = cells.facetOffsets[facet]; i < cells.facetOffsets[facet + 1]; ++i)
    {
      cells.facetPoints[i] = point(last);
      last = cells.facetPoints[i];
    }
  }
  if (cells.facetOffsets.back() != corners)
  {
    from.FailDamaged();
  }
}

void
WriteRuns(const std::vector<FaceRun> & runs, Encoder & to)
{
  to.Number(runs.size());
  FaceRun last;
  for (const FaceRun & run : runs)
  {
    to.Step(last.row, run.row);
    to.Step(last.end, run.begin);
    to.Number(static_cast<std::uint64_t>(run.end - run.begin));
    to.Number(run.set);
    last = run;
  }
}

std::vector<FaceRun>
ReadRuns(std::uint32_t sets, Decoder & from)
{
  std::vector<FaceRun> runs; // grows as bytes come
  FaceRun              last;
  for (std::uint64_t left = from.Number(); left > 0; --left)
  {
    FaceRun run;
    run.row = static_cast<std::int32_t>(from.Step(last.row, leastCoordinate, greatestCoordinate));
    run.begin = static_cast<std::int32_t>(from.Step(last.end, leastCoordinate, greatestCoordinate));
    const std::uint64_t length = from.Number(1, static_cast<std::uint64_t>(greatestCoordinate - run.begin));
    run.end = static_cast<std::int32_t>(run.begin + static_cast<std::int64_t>(length));
    const std::uint64_t set = from.Number(0, std::uint64_t{ 1 } << 32U);
    if (set >= sets)
    {
      from.FailDamaged();
    }
    run.set = static_cast<std::uint32_t>(set);
    runs.push_back(run);
    last = run;
  }
  return runs;
}

void
WriteTopology(const TopologyPart & topology, Encoder & to)
{
  for (const std::int64_t number : { topology.euler, topology.closedShape, topology.closedBackground })
  {
    to.Number(Fold(number));
  }
  to.Number(topology.openShape);
  to.Number(topology.openBackground);
  for (const TopologyPart::Face & face : topology.faces)
  {
    to.Step(0, face.plane);
    WriteRuns(face.shape, to);
    WriteRuns(face.background, to);
  }
}

TopologyPart
ReadTopology(Decoder & from)
{
  TopologyPart topology;
  for (std::int64_t * number : { &topology.euler, &topology.closedShape, &topology.closedBackground })
  {
    *number = Unfold(from.Number());
  }
  for (std::uint32_t * number : { &topology.openShape, &topology.openBackground })
  {
    *number = static_cast<std::uint32_t>(from.Number(0, kOtherBlock));
  }
  for (TopologyPart::Face & face : topology.faces)
  {
    face.plane = static_cast<std::int32_t>(from.Step(0, leastCoordinate, greatestCoordinate));
    face.shape = ReadRuns(topology.openShape, from);
    face.background = ReadRuns(topology.openBackground, from);
  }
  return topology;
}

} // namespace

void
WriteBlockShare(const BlockShare & share, std::ostream & stream)
{
  Encoder to(stream);
  for (const std::uint8_t byte : magic)
  {
    to.Byte(byte);
  }
  to.Number(version);
  for (const std::uint64_t number : { share.digest[0], share.digest[1], share.blockCount, share.block })
  {
    to.Number(number);
  }
  for (const std::int64_t weight : share.weight)
  {
    to.Number(static_cast<std::uint64_t>(weight));
  }
  for (const std::uint64_t number : { share.boundaryVertices,
                                      share.boundarySquares,
                                      share.ownSquares,
                                      std::uint64_t{ share.points.size() },
                                      std::uint64_t{ share.cells.CellCount() },
                                      std::uint64_t{ share.cells.FacetCount() },
                                      std::uint64_t{ share.cells.facetPoints.size() } })
  {
    to.Number(number);
  }
  to.Sum();
  WritePoints(share, to);
  WriteCells(share.cells, to);
  WriteTopology(share.topology, to);
  to.Sum();
  to.Flush();
  stream.flush();
  if (!stream)
  {
    throw OutputError("cannot write a block's part; is the disk full?");
  }
}

BlockShare
ReadBlockShare(std::istream & stream, const std::string & name)
{
  stream.seekg(0, std::ios::end);
  const auto bytes = static_cast<std::uint64_t>(std::max<std::streamoff>(0, stream.tellg()));
  stream.seekg(0);
  Decoder from(stream, name);
  for (const std::uint8_t byte : magic)
  {
    if (from.AtEnd() || from.Byte() != byte)
    {
      from.Fail("is not a block's part as 'core --block' writes it");
    }
  }
  const std::uint64_t itsVersion = from.Number();
  if (itsVersion != version)
  {
    from.Fail("has version " + std::to_string(itsVersion) + " of a block's part; this program reads version " +
              std::to_string(version) + ": compute this block again with it");
  }
  BlockShare share;
  share.digest = { from.Number(), from.Number() };
  share.blockCount = from.Number();
  share.block = from.Number();
  for (std::int64_t & weight : share.weight)
  {
    weight = static_cast<std::int64_t>(from.Number());
  }
  share.boundaryVertices = from.Number();
  share.boundarySquares = from.Number();
  share.ownSquares = from.Number();
  const std::uint64_t points = from.Number();
  const std::uint64_t cells = from.Number();
  const std::uint64_t facets = from.Number();
  const std::uint64_t corners = from.Number();
  from.Sum(); // before memory is asked for by these numbers
  if (share.block >= share.blockCount || points >= kOtherBlock || cells >= kOtherBlock || facets >= kOtherBlock)
  {
    from.FailDamaged();
  }
  // A point and a corner take a byte or more, a cell four, a facet three. The sum is no proof of that.
  if (corners > bytes || points + 4 * cells + 3 * facets + corners > bytes)
  {
    from.FailCutOff();
  }
  share.points.resize(points);
  share.isOwn.resize(points);
  ReadPoints(share, from);
  share.cells.tetrahedra.resize(cells);
  share.cells.facetCells.resize(facets);
  share.cells.facetOffsets.resize(facets + 1);
  share.cells.facetPoints.resize(corners);
  ReadCells(share.cells, points, corners, from);
  share.topology = ReadTopology(from);
  from.Sum();
  if (!from.AtEnd())
  {
    from.Fail("goes on after its end; compute this block again");
  }
  return share;
}

} // namespace voxelcore
