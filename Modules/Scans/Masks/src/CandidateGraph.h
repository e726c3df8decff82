#pragma once
// Cuts and fills to choose from, and how they hang together.

#include "SimpleFlips.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace voxelcore
{

constexpr std::uint32_t kNoCandidate = ~std::uint32_t{ 0 };

/** Candidates are the 6-connected components of what growth and shrinking left. Parts are the components of what is
 *  always in (6-connected) and of what is always out (26-connected). Whatever candidates are in, the components of the
 *  shape are those of parts and candidates that are in over objectEdges; of the background likewise. */
struct CandidateGraph
{
  struct Candidate
  {
    bool          isFill = false;
    std::uint64_t voxels = 0;
    std::uint64_t cost = 0;
  };
  /** Inner elements that are in when all these candidates are. */
  struct Term
  {
    std::array<std::uint32_t, 8> who{}; ///< ascending; unused ones are kNoCandidate
    std::int64_t                 euler = 0;

    std::size_t
    Size() const
    {
      std::size_t size = 0;
      while (size < who.size() && who[size] != kNoCandidate)
      {
        ++size;
      }
      return size;
    }
  };
  using Edge = std::pair<std::uint32_t, std::uint32_t>; ///< candidate, candidate or candidates + part; each once

  std::vector<Candidate> candidates;
  std::vector<Edge>      objectEdges;
  std::vector<Edge>      backgroundEdges;
  std::size_t            objects = 0;
  std::size_t            backgrounds = 0;
  std::vector<Term>      terms;

  std::vector<Voxel>         voxels; ///< of all candidates, in scan order
  std::vector<std::uint32_t> owner;  ///< the candidate of each
};

/** Of the grown kernel and what it left of the shape, and the shrunk neighbourhood and what it left beyond it. */
CandidateGraph
MakeCandidateGraph(const PaddedShape & grown,
                   const PaddedShape & cuts,
                   const PaddedShape & shrunk,
                   const PaddedShape & fills,
                   const PaddedCost &  cost);

} // namespace voxelcore
