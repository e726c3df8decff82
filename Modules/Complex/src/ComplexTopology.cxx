#include "voxelcore/ComplexTopology.h"

#include "voxelcore/ParallelTasks.h"
#include "voxelcore/UnionFind.h"

#include <algorithm>
#include <unordered_map>

namespace voxelcore
{

namespace
{

constexpr ElementIndex kOnSeam = 0xFFFFFFFFU; // as a count: what stands beside it is the number of a seam

// Removes free faces until every edge has no live face or at least two: a 2-cycle cannot contain them. Returns the
// flags of the faces left; `cofaces` is of all faces at first, then of those left.
std::vector<std::uint8_t>
DropFreeFaces(const CellComplex & complex, std::vector<Cofaces> & cofaces)
{
  std::vector<std::uint8_t> live(complex.FaceCount(), 1);
  std::vector<ElementIndex> open;
  for (std::size_t first = 0; first < cofaces.size(); ++first) // each with what follows from it, which lies near
  {
    if (cofaces[first].count != 1)
    {
      continue;
    }
    open.push_back(static_cast<ElementIndex>(first));
    while (!open.empty())
    {
      const ElementIndex edge = open.back();
      open.pop_back();
      if (cofaces[edge].count != 1)
      {
        continue;
      }
      const ElementIndex face = cofaces[edge].exclusiveOr;
      live[face] = 0;
      for (const ElementIndex side : complex.FaceEdges(face))
      {
        cofaces[side].Remove(face);
        if (cofaces[side].count == 1)
        {
          open.push_back(side);
        }
      }
    }
  }
  return live;
}

using Equation = std::vector<ElementIndex>; // sorted; the sum of these unknowns is zero over GF(2)

// Keeps what occurs an odd number of times.
void
ReduceModTwo(Equation & equation)
{
  std::sort(equation.begin(), equation.end());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < equation.size();)
  {
    std::size_t j = i;
    while (j < equation.size() && equation[j] == equation[i])
    {
      ++j;
    }
    if ((j - i) % 2 == 1)
    {
      equation[kept++] = equation[i];
    }
    i = j;
  }
  equation.resize(kept);
}

// Rank over GF(2) by elimination on the greatest unknown.
std::int64_t
Rank(std::vector<Equation> & equations)
{
  std::unordered_map<ElementIndex, std::size_t> pivotRow;
  std::int64_t                                  rank = 0;
  Equation                                      sum;
  for (std::size_t row = 0; row < equations.size(); ++row)
  {
    Equation & equation = equations[row];
    while (!equation.empty())
    {
      const auto [found, isNew] = pivotRow.try_emplace(equation.back(), row);
      if (isNew)
      {
        ++rank;
        break;
      }
      const Equation & pivot = equations[found->second];
      sum.clear();
      std::set_symmetric_difference(equation.begin(),
                                    equation.end(),
                                    pivot.begin(),
                                    pivot.end(),
                                    std::back_inserter(sum));
      equation.swap(sum);
    }
  }
  return rank;
}

// The dimension of the space of 2-cycles: sets of faces that meet every edge an even number of times.
std::int64_t
SecondBetti(const CellComplex & complex)
{
  std::vector<Cofaces>            cofaces = CountEdgeCofaces(complex);
  const std::vector<std::uint8_t> live = DropFreeFaces(complex, cofaces);
  if (std::ranges::find(live, std::uint8_t{ 1 }) == live.end()) // as in most shapes without cavities
  {
    return 0;
  }

  // Two faces that alone share an edge are in a cycle together or not at all: they form one sheet, one unknown.
  UnionFind             sheets(complex.FaceCount());
  std::vector<Equation> seams;
  for (std::size_t face = 0; face < complex.FaceCount(); ++face)
  {
    if (!live[face])
    {
      continue;
    }
    for (const ElementIndex edge : complex.FaceEdges(face))
    {
      Cofaces & own = cofaces[edge];
      if (own.count == 2)
      {
        sheets.Unite(face, face ^ own.exclusiveOr);
        continue;
      }
      if (own.count != kOnSeam)
      {
        own = { kOnSeam, static_cast<ElementIndex>(seams.size()) };
        seams.emplace_back();
      }
      seams[own.exclusiveOr].push_back(static_cast<ElementIndex>(face));
    }
  }
  std::vector<Cofaces>().swap(cofaces);

  // Each seam edge is an equation on sheets. One with a single sheet makes it zero, one with two unites them, and both
  // may shorten others; what is left is small.
  std::vector<std::uint8_t> zero(complex.FaceCount(), 0);
  for (bool changed = true; changed;)
  {
    changed = false;
    for (Equation & seam : seams)
    {
      for (ElementIndex & sheet : seam)
      {
        sheet = sheets.Find(sheet);
      }
      std::erase_if(seam, [&](ElementIndex sheet) { return zero[sheet] != 0; });
      ReduceModTwo(seam);
      if (seam.size() == 1)
      {
        zero[seam[0]] = 1;
        changed = true;
      }
      else if (seam.size() == 2)
      {
        sheets.Unite(seam[0], seam[1]);
        changed = true;
      }
    }
    std::erase_if(seams, [](const Equation & seam) { return seam.size() < 3; });
    std::sort(seams.begin(), seams.end());
    seams.erase(std::unique(seams.begin(), seams.end()), seams.end());
  }
  std::int64_t unknowns = 0;
  for (std::size_t face = 0; face < complex.FaceCount(); ++face)
  {
    unknowns += live[face] && sheets.Find(face) == face && !zero[face];
  }
  return unknowns - Rank(seams);
}

} // namespace

TopologyNumbers
ComputeComplexTopology(const CellComplex & complex)
{
  TopologyNumbers numbers;
  RunBoth(
    complex.edges.size() > 10000,
    [&] { numbers.betti[2] = SecondBetti(complex); },
    [&] {
      UnionFind components(complex.vertexCount);
      for (const auto & edge : complex.edges)
      {
        components.Unite(edge[0], edge[1]);
      }
      numbers.betti[0] = static_cast<std::int64_t>(components.Count());
    });
  numbers.euler = static_cast<std::int64_t>(complex.vertexCount) - static_cast<std::int64_t>(complex.edges.size()) +
                  static_cast<std::int64_t>(complex.FaceCount());
  numbers.betti[1] = numbers.betti[0] + numbers.betti[2] - numbers.euler;
  return numbers;
}

} // namespace voxelcore
