#include "voxelcore/Verification/BettiReduction.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace voxelcore
{
namespace
{

constexpr ElementIndex kNone = 0xFFFFFFFFU;

/** A set of integers below a bound that can toggle one and find the greatest: a tree of words, each bit of a level
 *  standing for a word of the level below that is not 0. */
class PivotSet
{
public:
  explicit PivotSet(std::size_t bound)
  {
    do
    {
      bound = (bound + 63) / 64;
      m_Levels.emplace_back(std::max<std::size_t>(bound, 1), 0);
    } while (bound > 1);
  }

  void
  Toggle(std::size_t i)
  {
    for (auto & level : m_Levels)
    {
      std::uint64_t & word = level[i / 64];
      const bool      wasEmpty = word == 0;
      word ^= std::uint64_t{ 1 } << (i % 64);
      if (wasEmpty == (word == 0))
      {
        return;
      }
      i /= 64;
    }
  }

  /** kNone when empty. */
  ElementIndex
  Greatest() const
  {
    if (m_Levels.back()[0] == 0)
    {
      return kNone;
    }
    std::size_t i = 0;
    for (std::size_t level = m_Levels.size(); level-- > 0;)
    {
      i = i * 64 + 63 - static_cast<std::size_t>(std::countl_zero(m_Levels[level][i]));
    }
    return static_cast<ElementIndex>(i);
  }

private:
  std::vector<std::vector<std::uint64_t>> m_Levels;
};

/** Items 0 .. keys.size()-1 by increasing key below `bound`, equal keys by item. */
std::vector<ElementIndex>
CountingOrder(const std::vector<ElementIndex> & keys, std::size_t bound)
{
  std::vector<ElementIndex> starts(bound + 1, 0);
  for (const ElementIndex key : keys)
  {
    ++starts[key + 1];
  }
  for (std::size_t key = 0; key < bound; ++key)
  {
    starts[key + 1] += starts[key];
  }
  std::vector<ElementIndex> order(keys.size());
  for (std::size_t item = 0; item < keys.size(); ++item)
  {
    order[starts[keys[item]]++] = static_cast<ElementIndex>(item);
  }
  return order;
}

/** Place of each edge in the filtration: by its greater end. */
std::vector<ElementIndex>
EdgePlaces(const CellComplex & complex)
{
  std::vector<ElementIndex> keys(complex.edges.size());
  for (std::size_t e = 0; e < keys.size(); ++e)
  {
    keys[e] = std::max(complex.edges[e][0], complex.edges[e][1]);
  }
  const std::vector<ElementIndex> order = CountingOrder(keys, complex.vertexCount);
  for (std::size_t place = 0; place < order.size(); ++place)
  {
    keys[order[place]] = static_cast<ElementIndex>(place);
  }
  return keys;
}

/** Reduces the columns of the faces; returns the rank. Pivots: per place of an edge whether it is one. */
std::int64_t
ReduceFaces(const CellComplex & complex, const std::vector<ElementIndex> & edgePlaces, std::vector<bool> & pivots)
{
  const std::size_t         edgeCount = complex.edges.size();
  std::vector<ElementIndex> keys(complex.FaceCount());
  for (std::size_t f = 0; f < keys.size(); ++f)
  {
    for (const ElementIndex edge : complex.FaceEdges(f))
    {
      keys[f] = std::max(keys[f], edgePlaces[edge]);
    }
  }
  const std::vector<ElementIndex> order = CountingOrder(keys, edgeCount);
  // The column with a given pivot: a face whose boundary is the column, or (holdsStored) a stretch of `stored`.
  std::vector<ElementIndex>  columnOf(edgeCount, kNone);
  std::vector<bool>          holdsStored(edgeCount, false);
  std::vector<std::uint64_t> storedOffsets{ 0 };
  std::vector<ElementIndex>  stored;
  std::int64_t               rank = 0;
  PivotSet                   column(edgeCount);
  for (const ElementIndex face : order)
  {
    if (columnOf[keys[face]] == kNone)
    {
      // Often reduced as it is; but an edge met twice cancels, so the greatest must be met an odd number of times.
      std::size_t times = 0;
      for (const ElementIndex edge : complex.FaceEdges(face))
      {
        times += edgePlaces[edge] == keys[face] ? 1 : 0;
      }
      if (times % 2 == 1)
      {
        columnOf[keys[face]] = face;
        pivots[keys[face]] = true;
        ++rank;
        continue;
      }
    }
    for (const ElementIndex edge : complex.FaceEdges(face))
    {
      column.Toggle(edgePlaces[edge]);
    }
    ElementIndex pivot = column.Greatest();
    while (pivot != kNone && columnOf[pivot] != kNone)
    {
      if (holdsStored[pivot])
      {
        const ElementIndex id = columnOf[pivot];
        for (std::uint64_t i = storedOffsets[id]; i < storedOffsets[id + 1]; ++i)
        {
          column.Toggle(stored[i]);
        }
      }
      else
      {
        for (const ElementIndex edge : complex.FaceEdges(columnOf[pivot]))
        {
          column.Toggle(edgePlaces[edge]);
        }
      }
      pivot = column.Greatest();
    }
    if (pivot == kNone)
    {
      continue;
    }
    columnOf[pivot] = static_cast<ElementIndex>(storedOffsets.size() - 1);
    holdsStored[pivot] = true;
    pivots[pivot] = true;
    ++rank;
    for (ElementIndex top = pivot; top != kNone; top = column.Greatest())
    {
      stored.push_back(top);
      column.Toggle(top);
    }
    storedOffsets.push_back(stored.size());
  }
  return rank;
}

/** Reduces the columns of the edges that are no pivots of a face; returns the rank. */
std::int64_t
ReduceEdges(const CellComplex & complex, const std::vector<ElementIndex> & edgePlaces, const std::vector<bool> & pivots)
{
  std::vector<ElementIndex> order(edgePlaces.size());
  for (std::size_t e = 0; e < order.size(); ++e)
  {
    order[edgePlaces[e]] = static_cast<ElementIndex>(e);
  }
  std::vector<ElementIndex> other(complex.vertexCount, kNone); // of the column whose greater vertex is this one
  std::int64_t              rank = 0;
  for (std::size_t place = 0; place < order.size(); ++place)
  {
    if (pivots[place])
    {
      continue; // clearing: it ends a cycle that a face bounds, so its column reduces to 0
    }
    ElementIndex low = complex.edges[order[place]][0];
    ElementIndex high = complex.edges[order[place]][1];
    while (low != high)
    {
      if (low > high)
      {
        std::swap(low, high);
      }
      if (other[high] == kNone)
      {
        other[high] = low;
        ++rank;
        break;
      }
      high = other[high];
    }
  }
  return rank;
}

} // namespace

TopologyNumbers
ReduceToTopologyNumbers(const CellComplex & complex)
{
  const auto                      vertices = static_cast<std::int64_t>(complex.vertexCount);
  const auto                      edges = static_cast<std::int64_t>(complex.edges.size());
  const auto                      faces = static_cast<std::int64_t>(complex.FaceCount());
  const std::vector<ElementIndex> edgePlaces = EdgePlaces(complex);
  std::vector<bool>               pivots(complex.edges.size(), false);
  const std::int64_t              faceRank = ReduceFaces(complex, edgePlaces, pivots);
  const std::int64_t              edgeRank = ReduceEdges(complex, edgePlaces, pivots);
  TopologyNumbers                 numbers;
  numbers.euler = vertices - edges + faces;
  numbers.betti = { vertices - edgeRank, edges - edgeRank - faceRank, faces - faceRank };
  return numbers;
}

} // namespace voxelcore
