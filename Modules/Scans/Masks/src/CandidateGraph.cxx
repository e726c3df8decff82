#include "CandidateGraph.h"

#include "voxelcore/Shape/ShapeRuns.h"
#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <bit>

namespace voxelcore
{

namespace
{

/** Number of the component that holds a voxel, from 0. */
class ComponentAt
{
public:
  ComponentAt(Runs runs, bool diagonals, std::int32_t shift)
    : m_Runs(std::move(runs))
    , m_Sets(UniteRuns(m_Runs, diagonals))
    , m_Shift(shift)
  {}

  std::size_t
  Count() const
  {
    return m_Sets.Count();
  }

  /** The first run of the component. */
  std::uint32_t
  operator()(const Voxel & at)
  {
    const std::size_t row = static_cast<std::size_t>(at[2] + m_Shift) * static_cast<std::size_t>(m_Runs.rowsY) +
                            static_cast<std::size_t>(at[1] + m_Shift);
    const auto first = m_Runs.begin.begin();
    const auto run = std::upper_bound(first + static_cast<std::ptrdiff_t>(m_Runs.rowStart[row]),
                                      first + static_cast<std::ptrdiff_t>(m_Runs.rowStart[row + 1]),
                                      at[0]) -
                     first - 1;
    return m_Sets.Find(static_cast<std::size_t>(run));
  }

private:
  Runs         m_Runs;
  UnionFind    m_Sets;
  std::int32_t m_Shift;
};

class GraphMaker
{
public:
  GraphMaker(const PaddedShape & grown, const PaddedShape & cuts, const PaddedShape & shrunk, const PaddedShape & fills)
    : m_Grown(grown)
    , m_Cuts(cuts)
    , m_Shrunk(shrunk)
    , m_Fills(fills)
  {}

  CandidateGraph
  Make(const PaddedCost & cost)
  {
    ListVoxels();
    MakeCandidates(cost);
    MakeEdges();
    MakeTerms();
    return std::move(m_Graph);
  }

private:
  void
  ListVoxels()
  {
    const Voxel & size = m_Cuts.Size();
    m_RowStart.assign(static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]) + 1, 0);
    std::size_t row = 0;
    for (std::int32_t z = 0; z < size[2]; ++z)
    {
      for (std::int32_t y = 0; y < size[1]; ++y, ++row)
      {
        m_RowStart[row] = m_Graph.voxels.size();
        const auto cuts = m_Cuts.Voxels().Row(y, z);
        const auto fills = m_Fills.Voxels().Row(y, z);
        for (std::size_t word = 0; word < cuts.size(); ++word)
        {
          for (std::uint64_t bits = cuts[word] | fills[word]; bits != 0; bits &= bits - 1)
          {
            m_Graph.voxels.push_back({ static_cast<std::int32_t>(64 * word) + std::countr_zero(bits), y, z });
          }
        }
      }
    }
    m_RowStart[row] = m_Graph.voxels.size();
  }

  /** The number of a candidate's voxel. */
  std::size_t
  NumberOf(const Voxel & at) const
  {
    const std::size_t row =
      static_cast<std::size_t>(at[2]) * static_cast<std::size_t>(m_Cuts.Size()[1]) + static_cast<std::size_t>(at[1]);
    const auto begin = m_Graph.voxels.begin();
    return static_cast<std::size_t>(std::lower_bound(begin + static_cast<std::ptrdiff_t>(m_RowStart[row]),
                                                     begin + static_cast<std::ptrdiff_t>(m_RowStart[row + 1]),
                                                     at[0],
                                                     [](const Voxel & voxel, std::int32_t x) { return voxel[0] < x; }) -
                                    begin);
  }

  void
  MakeCandidates(const PaddedCost & cost)
  {
    UnionFind sets(m_Graph.voxels.size());
    for (std::size_t i = 0; i < m_Graph.voxels.size(); ++i)
    {
      const Voxel &       at = m_Graph.voxels[i];
      const PaddedShape & kind = m_Fills.Contains(at) ? m_Fills : m_Cuts;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        Voxel before = at;
        --before[axis];
        if (kind.Contains(before))
        {
          sets.Unite(i, NumberOf(before));
        }
      }
    }
    m_Graph.owner.assign(m_Graph.voxels.size(), kNoCandidate);
    for (std::size_t i = 0; i < m_Graph.voxels.size(); ++i)
    {
      const std::uint32_t first = sets.Find(i);
      if (first == i)
      {
        m_Graph.owner[i] = static_cast<std::uint32_t>(m_Graph.candidates.size());
        m_Graph.candidates.emplace_back().isFill = m_Fills.Contains(m_Graph.voxels[i]);
      }
      m_Graph.owner[i] = m_Graph.owner[first];
      CandidateGraph::Candidate & candidate = m_Graph.candidates[m_Graph.owner[i]];
      ++candidate.voxels;
      candidate.cost += cost(m_Graph.voxels[i]);
    }
  }

  void
  MakeEdges()
  {
    ComponentAt                objectAt(VoxelRuns(m_Grown.Voxels()), false, 0);
    ComponentAt                backgroundAt(BackgroundRuns(m_Shrunk.Voxels()), true, 1);
    std::vector<std::uint32_t> objects;
    std::vector<std::uint32_t> backgrounds;
    m_Graph.objects = objectAt.Count();
    m_Graph.backgrounds = backgroundAt.Count();
    for (std::size_t i = 0; i < m_Graph.voxels.size(); ++i)
    {
      const Voxel &       at = m_Graph.voxels[i];
      const std::uint32_t own = m_Graph.owner[i];
      for (std::uint32_t bit = 0; bit < 27; ++bit)
      {
        const Voxel next = Next(at, bit);
        const bool  isFace = (kFaces27 >> bit & 1U) != 0;
        if (m_Grown.Contains(next))
        {
          if (isFace)
          {
            m_Graph.objectEdges.emplace_back(own, objectAt(next));
            objects.push_back(objectAt(next));
          }
        }
        else if (!m_Shrunk.Contains(next))
        {
          m_Graph.backgroundEdges.emplace_back(own, backgroundAt(next));
          backgrounds.push_back(backgroundAt(next));
        }
      }
    }
    const auto candidates = static_cast<std::uint32_t>(m_Graph.candidates.size());
    Renumber(objects, candidates, m_Graph.objectEdges);
    Renumber(backgrounds, candidates, m_Graph.backgroundEdges);
    for (std::size_t i = 0; i < m_Graph.voxels.size(); ++i)
    {
      for (std::uint32_t bit = 0; bit < 13; ++bit)
      {
        const Voxel next = Next(m_Graph.voxels[i], bit);
        if (!m_Cuts.Contains(next) && !m_Fills.Contains(next))
        {
          continue;
        }
        const std::uint32_t a = m_Graph.owner[i];
        const std::uint32_t b = m_Graph.owner[NumberOf(next)];
        if (a != b)
        {
          m_Graph.backgroundEdges.emplace_back(std::minmax(a, b));
          if ((kFaces27 >> bit & 1U) != 0)
          {
            m_Graph.objectEdges.emplace_back(std::minmax(a, b));
          }
        }
      }
    }
    for (auto * edges : { &m_Graph.objectEdges, &m_Graph.backgroundEdges })
    {
      ranges::sort(*edges);
      edges->erase(std::unique(edges->begin(), edges->end()), edges->end());
    }
  }

  /** Parts that no candidate touches keep their number off the graph: only how many there are counts. */
  static void
  Renumber(std::vector<std::uint32_t> & parts, std::uint32_t first, std::vector<CandidateGraph::Edge> & edges)
  {
    ranges::sort(parts);
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    for (auto & edge : edges)
    {
      edge.second = first + static_cast<std::uint32_t>(ranges::lower_bound(parts, edge.second) - parts.begin());
    }
  }

  static Voxel
  Next(const Voxel & at, std::uint32_t bit)
  {
    const auto n = static_cast<std::int32_t>(bit);
    return { at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1 };
  }

  /** Each voxel, inner face, inner edge and inner corner that holds a candidate's voxel, counted at the first such. */
  void
  MakeTerms()
  {
    std::vector<CandidateGraph::Term> terms;
    std::vector<std::int64_t>         ofOne(m_Graph.candidates.size(), 0);
    for (std::size_t i = 0; i < m_Graph.voxels.size(); ++i)
    {
      const Voxel &                 at = m_Graph.voxels[i];
      std::array<std::uint32_t, 27> owners{};
      const Neighbourhood           object = m_Grown.Around(at);
      const Neighbourhood           open = m_Cuts.Around(at) | m_Fills.Around(at);
      for (std::uint32_t bit = 0; bit < 27; ++bit)
      {
        owners[bit] = (open >> bit & 1U) != 0 ? m_Graph.owner[NumberOf(Next(at, bit))] : kNoCandidate;
      }
      for (int element = 0; element < 27; ++element)
      {
        const std::array<int, 3> kind{ element % 3, element / 3 % 3, element / 9 };
        AddElement(kind, object, open, owners, terms, ofOne);
      }
    }
    for (std::size_t i = 0; i < ofOne.size(); ++i)
    {
      CandidateGraph::Term & term = terms.emplace_back();
      term.who.fill(kNoCandidate);
      term.who[0] = static_cast<std::uint32_t>(i);
      term.euler = ofOne[i];
    }
    ranges::sort(terms, {}, &CandidateGraph::Term::who);
    for (const CandidateGraph::Term & term : terms)
    {
      if (m_Graph.terms.empty() || m_Graph.terms.back().who != term.who)
      {
        m_Graph.terms.push_back({ term.who, 0 });
      }
      m_Graph.terms.back().euler += term.euler;
    }
    std::erase_if(m_Graph.terms, [](const CandidateGraph::Term & term) { return term.euler == 0; });
  }

  /** Along each axis an element reaches over the voxel alone (kind 0), from the one before (1), or to the next (2). */
  static void
  AddElement(const std::array<int, 3> &            kind,
             Neighbourhood                         object,
             Neighbourhood                         open,
             const std::array<std::uint32_t, 27> & owners,
             std::vector<CandidateGraph::Term> &   terms,
             std::vector<std::int64_t> &           ofOne)
  {
    CandidateGraph::Term term;
    term.who.fill(kNoCandidate);
    term.euler = 1;
    std::array<std::array<unsigned, 2>, 3> reach{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      reach[axis] = { kind[axis] == 1 ? 0U : 1U, kind[axis] == 2 ? 2U : 1U };
      term.euler = kind[axis] == 0 ? term.euler : -term.euler;
    }
    for (unsigned z = reach[2][0]; z <= reach[2][1]; ++z)
    {
      for (unsigned y = reach[1][0]; y <= reach[1][1]; ++y)
      {
        for (unsigned x = reach[0][0]; x <= reach[0][1]; ++x)
        {
          const unsigned bit = 9 * z + 3 * y + x;
          if ((open >> bit & 1U) != 0)
          {
            if (bit < 13)
            {
              return;
            }
            // Kept sorted, each once.
            std::size_t place = 0;
            while (term.who[place] < owners[bit])
            {
              ++place;
            }
            if (term.who[place] != owners[bit])
            {
              std::copy_backward(term.who.begin() + static_cast<std::ptrdiff_t>(place),
                                 term.who.end() - 1,
                                 term.who.end());
              term.who[place] = owners[bit];
            }
          }
          else if ((object >> bit & 1U) == 0)
          {
            return;
          }
        }
      }
    }
    if (term.who[1] == kNoCandidate)
    {
      ofOne[term.who[0]] += term.euler;
      return;
    }
    terms.push_back(term);
  }

  const PaddedShape &      m_Grown;
  const PaddedShape &      m_Cuts;
  const PaddedShape &      m_Shrunk;
  const PaddedShape &      m_Fills;
  CandidateGraph           m_Graph;
  std::vector<std::size_t> m_RowStart;
};

} // namespace

CandidateGraph
MakeCandidateGraph(const PaddedShape & grown,
                   const PaddedShape & cuts,
                   const PaddedShape & shrunk,
                   const PaddedShape & fills,
                   const PaddedCost &  cost)
{
  return GraphMaker(grown, cuts, shrunk, fills).Make(cost);
}

} // namespace voxelcore
