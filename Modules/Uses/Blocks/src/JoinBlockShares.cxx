#include "voxelcore/Blocks/HaloBlocks.h"

#include "CheckShare.h"
#include "voxelcore/Delaunay/CanonicalCells.h"

#include "voxelcore/Base/Error.h"

#include <algorithm>
#include <string>
#include <tuple>

namespace voxelcore
{

namespace
{

constexpr std::uint32_t nowhere = 0xFFFFFFFFU;

auto
ScanKey(const LatticePoint & p)
{
  return std::tie(p.z, p.y, p.x);
}

// A facet towards another block: points of the whole, from the smallest on in the lesser of the two directions.
struct OpenFacet
{
  std::array<std::uint32_t, 3> key; // two facets share two points at most
  std::uint64_t                facet;
  bool                         turned; // the key runs against the polygon
};

class Joiner
{
public:
  // First round: what the shares are, and their points.
  void
  AddPoints(const BlockShare & share)
  {
    if (m_Shares == 0)
    {
      m_First.digest = share.digest;
      m_First.blockCount = share.blockCount;
      m_First.weight = share.weight;
      m_First.boundaryVertices = share.boundaryVertices;
      m_First.boundarySquares = share.boundarySquares;
    }
    if (share.digest != m_First.digest || share.blockCount != m_First.blockCount || share.weight != m_First.weight ||
        share.boundaryVertices != m_First.boundaryVertices || share.boundarySquares != m_First.boundarySquares)
    {
      throw InputError("block " + std::to_string(share.block + 1) +
                       " was cut from another shape, or with other options, "
                       "than the first one given; compute it again");
    }
    if (share.block >= share.blockCount)
    {
      throw InputError("a block has the number " + std::to_string(share.block + 1) + " of " +
                       std::to_string(share.blockCount) + "; compute it again");
    }
    const auto at = std::lower_bound(m_Blocks.begin(), m_Blocks.end(), share.block);
    if (at != m_Blocks.end() && *at == share.block)
    {
      throw InputError("block " + std::to_string(share.block + 1) + " was given twice; give it once");
    }
    m_Blocks.insert(at, share.block);
    for (std::size_t point = 0; point < share.points.size(); ++point)
    {
      if (share.isOwn[point] != 0)
      {
        m_Joined.points.push_back(share.points[point]);
      }
    }
    m_OwnSquares += share.ownSquares;
    m_Topology.push_back(share.topology);
    m_Cells += share.cells.CellCount();
    m_Facets += share.cells.FacetCount();
    m_Corners += share.cells.facetPoints.size();
    ++m_Shares;
  }

  void
  EndPoints()
  {
    if (m_Shares == 0)
    {
      throw InputError("there are no blocks to join");
    }
    for (std::uint64_t block = 0; block < m_First.blockCount; ++block)
    {
      if (block >= m_Blocks.size() || m_Blocks[block] != block)
      {
        throw InputError("block " + std::to_string(block + 1) + " of " + std::to_string(m_First.blockCount) +
                         " is missing");
      }
    }
    auto & points = m_Joined.points;
    std::sort(points.begin(), points.end(), [](const LatticePoint & a, const LatticePoint & b) {
      return ScanKey(a) < ScanKey(b);
    });
    const auto twin = std::adjacent_find(points.begin(), points.end());
    if (twin != points.end())
    {
      Misfit(*twin, "two blocks claim it");
    }
    if (m_First.boundaryVertices != kNotCounted && points.size() != m_First.boundaryVertices)
    {
      throw CertificateError("the blocks hold " + std::to_string(points.size()) + " of the shape's " +
                             std::to_string(m_First.boundaryVertices) + " boundary vertices; compute them again");
    }
    if (m_Cells >= kOtherBlock || m_Facets >= kOtherBlock)
    {
      throw InputError("the blocks hold more than 2^32 - 2 cells or facets; crop or split the shape");
    }
    m_Joined.cells.tetrahedra.reserve(m_Cells);
    m_Joined.cells.facetCells.reserve(m_Facets);
    m_Joined.cells.facetOffsets.reserve(m_Facets + 1);
    m_Joined.cells.facetPoints.reserve(m_Corners);
    m_Squares.assign(points.size(), 0);
  }

  // Second round: cells and facets.
  void
  AddCells(const BlockShare & share)
  {
    CheckCells(share);
    const std::vector<std::uint32_t> number = NumbersOf(share.points);
    DelaunayCells &                  cells = m_Joined.cells;
    const auto                       firstCell = static_cast<std::uint32_t>(cells.CellCount());
    for (const auto & t : share.cells.tetrahedra)
    {
      cells.tetrahedra.push_back({ number[t[0]], number[t[1]], number[t[2]], number[t[3]] });
    }
    for (std::size_t facet = 0; facet < share.cells.FacetCount(); ++facet)
    {
      for (const std::uint32_t point : share.cells.FacetPoints(facet))
      {
        cells.facetPoints.push_back(number[point]);
      }
      const auto & pair = share.cells.facetCells[facet];
      cells.facetCells.push_back({ firstCell + pair[0], pair[1] >= kOtherBlock ? pair[1] : firstCell + pair[1] });
      cells.facetOffsets.push_back(cells.facetPoints.size());
      if (pair[1] == kOutside)
      {
        AddSquare(cells.FacetCount() - 1);
      }
      else if (pair[1] == kOtherBlock)
      {
        AddOpen(cells.FacetCount() - 1);
      }
    }
  }

  JoinedCells
  Finish()
  {
    const std::uint64_t squares = m_First.boundarySquares != kNotCounted ? m_First.boundarySquares : m_OwnSquares;
    if (m_SquareCount != squares || m_OwnSquares != squares)
    {
      throw CertificateError("the blocks hold " + std::to_string(m_SquareCount) + " of the shape's " +
                             std::to_string(squares) + " boundary squares; compute them again");
    }
    std::vector<std::uint8_t>().swap(m_Squares);
    LinkOpenFacets();
    SpacingWeights weights;
    weights.weight = m_First.weight;
    m_Joined.cells = MakeCanonical(std::move(m_Joined.cells), m_Joined.points, weights);
    m_Joined.topology = JoinTopologyParts(m_Topology);
    return std::move(m_Joined);
  }

private:
  // The points' numbers in the whole; both lists are in scan order.
  std::vector<std::uint32_t>
  NumbersOf(const std::vector<LatticePoint> & points) const
  {
    std::vector<std::uint32_t> number;
    number.reserve(points.size());
    auto at = m_Joined.points.begin();
    for (const LatticePoint & p : points)
    {
      // Own points follow each other closely; others are looked up in what is left.
      const auto end = m_Joined.points.end();
      for (std::ptrdiff_t step = 1; at != end && ScanKey(*at) < ScanKey(p); step *= 2)
      {
        if (end - at > step && ScanKey(*(at + step)) < ScanKey(p))
        {
          at += step;
          continue;
        }
        at = std::lower_bound(at, end - at > step ? at + step + 1 : end, p, [](const auto & a, const auto & b) {
          return ScanKey(a) < ScanKey(b);
        });
        break;
      }
      if (at == end || *at != p)
      {
        Misfit(p, "a cell has it as a corner, but it is no boundary vertex of any block");
      }
      number.push_back(static_cast<std::uint32_t>(at - m_Joined.points.begin()));
    }
    return number;
  }

  // A facet on the boundary is a unit square of the lattice, met once: a bit for its axis at its least corner.
  void
  AddSquare(std::size_t facet)
  {
    const auto           polygon = m_Joined.cells.FacetPoints(facet);
    const LatticePoint & least = m_Joined.points[*std::min_element(polygon.begin(), polygon.end())];
    std::int32_t         sums[3] = { 0, 0, 0 };
    bool                 unit = polygon.size() == 4;
    for (const std::uint32_t point : polygon)
    {
      const LatticePoint & p = m_Joined.points[point];
      const std::int32_t   d[3] = { p.x - least.x, p.y - least.y, p.z - least.z };
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        unit = unit && d[axis] >= 0 && d[axis] <= 1;
        sums[axis] += d[axis];
      }
    }
    // Its corners are distinct, as CheckCells saw, so two axes take up two of them each.
    const std::size_t axis = sums[0] == 0 ? 0 : sums[1] == 0 ? 1 : 2;
    if (!unit || sums[0] + sums[1] + sums[2] != 4 || sums[axis] != 0)
    {
      Misfit(least, "a facet on the boundary is not a side of a voxel");
    }
    std::uint8_t & seen = m_Squares[*std::min_element(polygon.begin(), polygon.end())];
    if ((seen >> axis & 1U) != 0)
    {
      Misfit(least, "two cells lie behind one boundary square");
    }
    seen = static_cast<std::uint8_t>(seen | 1U << axis);
    ++m_SquareCount;
  }

  void
  AddOpen(std::size_t facet)
  {
    const auto        polygon = m_Joined.cells.FacetPoints(facet);
    const std::size_t size = polygon.size();
    const auto least = static_cast<std::size_t>(std::min_element(polygon.begin(), polygon.end()) - polygon.begin());
    const auto at = [&](std::size_t step) { return polygon[(least + step) % size]; };
    OpenFacet  open{ { at(0), at(1), at(2) }, facet, false };
    if (at(size - 1) < at(1))
    {
      open = { { at(0), at(size - 1), at(size - 2) }, facet, true };
    }
    m_Open.push_back(open);
  }

  bool
  AreOpposite(const OpenFacet & a, const OpenFacet & b) const
  {
    const auto        p = m_Joined.cells.FacetPoints(a.facet);
    const auto        q = m_Joined.cells.FacetPoints(b.facet);
    const std::size_t size = p.size();
    if (a.turned == b.turned || q.size() != size)
    {
      return false;
    }
    const auto i = static_cast<std::size_t>(std::min_element(p.begin(), p.end()) - p.begin());
    const auto j = static_cast<std::size_t>(std::min_element(q.begin(), q.end()) - q.begin());
    for (std::size_t step = 0; step < size; ++step)
    {
      if (p[(i + step) % size] != q[(j + size - step) % size])
      {
        return false;
      }
    }
    return true;
  }

  // Makes one facet of the two that two blocks have of it.
  void
  LinkOpenFacets()
  {
    std::sort(m_Open.begin(), m_Open.end(), [](const OpenFacet & a, const OpenFacet & b) {
      return std::tie(a.key, a.facet) < std::tie(b.key, b.facet);
    });
    DelaunayCells & cells = m_Joined.cells;
    for (std::size_t i = 0; i < m_Open.size(); i += 2)
    {
      const LatticePoint & place = m_Joined.points[m_Open[i].key[0]];
      if (i + 1 == m_Open.size() || m_Open[i + 1].key != m_Open[i].key)
      {
        Misfit(place, "a facet of a cell there has no cell on its other side");
      }
      if (!AreOpposite(m_Open[i], m_Open[i + 1]) || (i + 2 < m_Open.size() && m_Open[i + 2].key == m_Open[i].key))
      {
        Misfit(place, "cells there overlap");
      }
      cells.facetCells[m_Open[i].facet][1] = cells.facetCells[m_Open[i + 1].facet][0];
      cells.facetCells[m_Open[i + 1].facet] = { nowhere, nowhere };
    }
    std::vector<OpenFacet>().swap(m_Open);
    DropLinked();
  }

  void
  DropLinked()
  {
    DelaunayCells & cells = m_Joined.cells;
    std::size_t     kept = 0;
    std::uint64_t   end = 0;
    for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
    {
      if (cells.facetCells[facet][0] == nowhere)
      {
        continue;
      }
      const auto polygon = cells.FacetPoints(facet);
      const auto corners = polygon.size();
      std::copy(polygon.begin(), polygon.end(), cells.facetPoints.begin() + static_cast<std::ptrdiff_t>(end));
      end += corners;
      cells.facetCells[kept] = cells.facetCells[facet];
      cells.facetOffsets[++kept] = end;
    }
    cells.facetCells.resize(kept);
    cells.facetOffsets.resize(kept + 1);
    cells.facetPoints.resize(end);
  }

  BlockShare                 m_First; // what all shares have in common
  std::size_t                m_Shares = 0;
  std::vector<std::uint64_t> m_Blocks; // sorted
  std::uint64_t              m_OwnSquares = 0;
  std::vector<TopologyPart>  m_Topology;
  std::uint64_t              m_Cells = 0;
  std::uint64_t              m_Facets = 0;
  std::uint64_t              m_Corners = 0;
  std::vector<std::uint8_t>  m_Squares; // per point: the boundary squares met of which it is the least corner
  std::uint64_t              m_SquareCount = 0;
  std::vector<OpenFacet>     m_Open;
  JoinedCells                m_Joined;
};

} // namespace

JoinedCells
JoinBlockShares(std::size_t count, const ShareSource & source, const ProgressCallback & progress)
{
  Joiner joiner;
  for (std::size_t i = 0; i < count; ++i)
  {
    ReportProgress(progress, "join", 0.5 * static_cast<double>(i) / static_cast<double>(count));
    joiner.AddPoints(source(i));
  }
  joiner.EndPoints();
  for (std::size_t i = 0; i < count; ++i)
  {
    ReportProgress(progress, "join", 0.5 + 0.5 * static_cast<double>(i) / static_cast<double>(count));
    joiner.AddCells(source(i));
  }
  return joiner.Finish();
}

JoinedCells
JoinBlockShares(const std::vector<BlockShare> & shares)
{
  return JoinBlockShares(shares.size(), [&shares](std::size_t i) { return shares[i]; });
}

} // namespace voxelcore
