#include "voxelcore/Complex/ComplexTopology.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/Prefetch.h"
#include "voxelcore/Base/UnionFind.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr ElementIndex kOnSeam = 0xFFFFFFFFU; // as a count: what stands beside it is the number of a seam

// What lies at an edge. Of its own: a collapse has other counts, and a fault in these must not cancel out here.
struct FacesAtEdge
{
  ElementIndex count = 0;
  ElementIndex faces = 0; // exclusive or: the face, where there is one

  void
  Remove(ElementIndex face)
  {
    --count;
    faces ^= face;
  }
};

std::vector<FacesAtEdge>
CountFacesAtEdges(const CellComplex & complex)
{
  constexpr std::size_t    ahead = 32;
  std::vector<FacesAtEdge> at(complex.edges.size());
  std::size_t              side = 0;
  for (std::size_t face = 0; face < complex.FaceCount(); ++face)
  {
    for (; side < complex.faceOffsets[face + 1]; ++side)
    {
      if (side + ahead < complex.faceEdges.size())
      {
        FetchLine(&at[complex.faceEdges[side + ahead]]);
      }
      FacesAtEdge & own = at[complex.faceEdges[side]];
      ++own.count;
      own.faces ^= static_cast<ElementIndex>(face);
    }
  }
  return at;
}

// Faces with a free edge that wait to be dropped, first come, first served: it is known ahead which memory they need.
class OpenFaces
{
public:
  OpenFaces(const CellComplex & complex, std::vector<FacesAtEdge> & cofaces, std::vector<std::uint8_t> & live)
    : m_Complex(complex)
    , m_Cofaces(cofaces.data())
    , m_Live(live.data())
  {}

  // A face may come several times.
  void
  Add(ElementIndex face)
  {
    MakeRoom(1);
    m_Faces[m_End++] = face;
  }

  // Drops them and those that become free then, until so many are left: of these it is known what to fetch.
  void
  DropTo(std::size_t few)
  {
    while (m_End - m_Next > few)
    {
      FetchAhead();
      const ElementIndex face = m_Faces[m_Next++];
      if (m_Live[face] == 0)
      {
        continue;
      }
      m_Live[face] = 0;
      const auto sides = m_Complex.FaceEdges(face);
      MakeRoom(sides.size());
      for (const ElementIndex side : sides)
      {
        FacesAtEdge & own = m_Cofaces[side];
        own.Remove(face);
        m_Faces[m_End] = own.faces; // without a jump, which would be hard to foretell
        m_End += own.count == 1 ? 1 : 0;
      }
    }
  }

private:
  void
  MakeRoom(std::size_t count)
  {
    if (m_End + count <= m_Faces.size())
    {
      return;
    }
    std::copy(m_Faces.begin() + static_cast<std::ptrdiff_t>(m_Next),
              m_Faces.begin() + static_cast<std::ptrdiff_t>(m_End),
              m_Faces.begin());
    m_End -= std::exchange(m_Next, 0);
    if (2 * (m_End + count) > m_Faces.size())
    {
      m_Faces.resize(2 * (m_End + count));
    }
  }

  void
  FetchAhead() const
  {
    const auto ahead = [&](std::size_t steps, auto && fetch) {
      if (m_Next + steps < m_End)
      {
        fetch(m_Faces[m_Next + steps]);
      }
    };
    ahead(24, [&](ElementIndex face) {
      FetchLine(&m_Complex.faceOffsets[face]);
      FetchLine(m_Live + face);
    });
    ahead(16, [&](ElementIndex face) { FetchLine(&m_Complex.faceEdges[m_Complex.faceOffsets[face]]); });
    ahead(8, [&](ElementIndex face) {
      for (const ElementIndex side : m_Complex.FaceEdges(face))
      {
        FetchLine(m_Cofaces + side);
      }
    });
  }

  const CellComplex &       m_Complex;
  FacesAtEdge *             m_Cofaces;
  std::uint8_t *            m_Live;
  std::vector<ElementIndex> m_Faces = std::vector<ElementIndex>(4096);
  std::size_t               m_Next = 0;
  std::size_t               m_End = 0;
};

// Removes free faces until every edge has no live face or at least two: a 2-cycle cannot contain them. Returns the
// flags of the faces left; `cofaces` is of all faces at first, then of those left.
std::vector<std::uint8_t>
DropFreeFaces(const CellComplex & complex, std::vector<FacesAtEdge> & cofaces)
{
  constexpr std::size_t     few = 32;
  std::vector<std::uint8_t> live(complex.FaceCount(), 1);
  OpenFaces                 open(complex, cofaces, live);
  for (const FacesAtEdge & own : cofaces) // each with what follows from it, which lies near
  {
    if (own.count == 1)
    {
      open.Add(own.faces);
      open.DropTo(few);
    }
  }
  open.DropTo(0);
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
  std::vector<FacesAtEdge>        cofaces = CountFacesAtEdges(complex);
  const std::vector<std::uint8_t> live = DropFreeFaces(complex, cofaces);
  if (ranges::find(live, std::uint8_t{ 1 }) == live.end()) // as in most shapes without cavities
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
      FacesAtEdge & own = cofaces[edge];
      if (own.count == 2)
      {
        sheets.Unite(face, face ^ own.faces);
        continue;
      }
      if (own.count != kOnSeam)
      {
        own = { kOnSeam, static_cast<ElementIndex>(seams.size()) };
        seams.emplace_back();
      }
      seams[own.faces].push_back(static_cast<ElementIndex>(face));
    }
  }
  std::vector<FacesAtEdge>().swap(cofaces);

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
