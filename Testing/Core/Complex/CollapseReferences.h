#pragma once
// What collapsing simple pairs means, done slowly in two other ways.

#include "Core/Complex/ComplexFixtures.h"

#include "voxelcore/Complex/SimplePairCollapse.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <random>
#include <set>
#include <tuple>
#include <vector>

namespace voxelcore::testing
{

struct Measures
{
  std::vector<double> vertex;
  std::vector<double> edge;
  std::vector<double> face;
};

/** Whole numbers below `levels`, so that many are equal; monotone as radius measures are, or not. */
inline Measures
RandomMeasures(const CellComplex & complex, std::mt19937 & generator, unsigned levels, bool isMonotone)
{
  const auto draw = [&] { return static_cast<double>(generator() % levels); };
  Measures   measures{ std::vector<double>(complex.vertexCount),
                     std::vector<double>(complex.edges.size()),
                     std::vector<double>(complex.FaceCount()) };
  std::generate(measures.face.begin(), measures.face.end(), draw);
  std::generate(measures.edge.begin(), measures.edge.end(), draw);
  std::generate(measures.vertex.begin(), measures.vertex.end(), draw);
  if (isMonotone)
  {
    for (std::size_t f = 0; f < complex.FaceCount(); ++f)
    {
      for (const ElementIndex edge : complex.FaceEdges(f))
      {
        measures.edge[edge] = std::max(measures.edge[edge], measures.face[f]);
      }
    }
    for (std::size_t e = 0; e < complex.edges.size(); ++e)
    {
      for (const ElementIndex vertex : complex.edges[e])
      {
        measures.vertex[vertex] = std::max(measures.vertex[vertex], measures.edge[e]);
      }
    }
  }
  return measures;
}

/** The definition, word for word: look at all pairs, remove the smallest, look again. */
inline LiveElements
CollapseByRescanning(const CellComplex & complex, const Measures & measures, LiveElements live, double threshold)
{
  using Pair =
    std::tuple<double, double, int, std::size_t, std::size_t>; // measures, dimension and index of e, index of f
  while (true)
  {
    std::optional<Pair> smallest;
    const auto          offer = [&](const Pair & pair) {
      if (std::get<0>(pair) < threshold && std::get<1>(pair) < threshold && (!smallest || pair < *smallest))
      {
        smallest = pair;
      }
    };
    for (std::size_t v = 0; v < complex.vertexCount; ++v)
    {
      std::vector<std::size_t> bounded;
      for (std::size_t e = 0; e < complex.edges.size(); ++e)
      {
        if (live.edges[e] != 0 && (complex.edges[e][0] == v || complex.edges[e][1] == v))
        {
          bounded.push_back(e);
        }
      }
      bool inFace = false;
      for (std::size_t f = 0; f < complex.FaceCount(); ++f)
      {
        const auto corners = complex.FaceVertices(f);
        inFace = inFace || (live.faces[f] != 0 && std::find(corners.begin(), corners.end(), v) != corners.end());
      }
      if (live.vertices[v] != 0 && bounded.size() == 1 && !inFace)
      {
        offer({ measures.vertex[v], measures.edge[bounded[0]], 0, v, bounded[0] });
      }
    }
    for (std::size_t e = 0; e < complex.edges.size(); ++e)
    {
      std::vector<std::size_t> bounded;
      for (std::size_t f = 0; f < complex.FaceCount(); ++f)
      {
        const auto edges = complex.FaceEdges(f);
        if (live.faces[f] != 0 && std::find(edges.begin(), edges.end(), e) != edges.end())
        {
          bounded.push_back(f);
        }
      }
      if (live.edges[e] != 0 && bounded.size() == 1)
      {
        offer({ measures.edge[e], measures.face[bounded[0]], 1, e, bounded[0] });
      }
    }
    if (!smallest)
    {
      return live;
    }
    const auto [lower, upper, dimension, element, coface] = *smallest;
    (dimension == 0 ? live.vertices : live.edges)[element] = 0;
    (dimension == 0 ? live.edges : live.faces)[coface] = 0;
  }
}

/** The same for large complexes: pairs wait in order, and are looked at again when their turn comes. */
inline LiveElements
CollapseInOrder(const CellComplex & complex, const Measures & measures, LiveElements live, double threshold)
{
  using Pair = std::tuple<double, double, int, ElementIndex>; // measures, dimension and index of e
  std::set<Pair>       pairs;
  std::vector<Cofaces> ofVertex = CountVertexCofaces(complex);
  std::vector<Cofaces> ofEdge = CountEdgeCofaces(complex);
  const auto           offerVertex = [&](ElementIndex v) {
    if (ofVertex[v].count == 1 && std::max(measures.vertex[v], measures.edge[ofVertex[v].exclusiveOr]) < threshold)
    {
      pairs.insert({ measures.vertex[v], measures.edge[ofVertex[v].exclusiveOr], 0, v });
    }
  };
  const auto offerEdge = [&](ElementIndex e) {
    if (ofEdge[e].count == 1 && std::max(measures.edge[e], measures.face[ofEdge[e].exclusiveOr]) < threshold)
    {
      pairs.insert({ measures.edge[e], measures.face[ofEdge[e].exclusiveOr], 1, e });
    }
  };
  const auto dropEdge = [&](ElementIndex e) {
    live.edges[e] = 0;
    for (const ElementIndex v : complex.edges[e])
    {
      ofVertex[v].Remove(e);
      offerVertex(v);
    }
  };
  for (std::size_t v = 0; v < complex.vertexCount; ++v)
  {
    offerVertex(static_cast<ElementIndex>(v));
  }
  for (std::size_t e = 0; e < complex.edges.size(); ++e)
  {
    offerEdge(static_cast<ElementIndex>(e));
  }
  while (!pairs.empty())
  {
    const auto [lower, upper, dimension, element] = *pairs.begin();
    pairs.erase(pairs.begin());
    if (dimension == 0 && ofVertex[element].count == 1)
    {
      live.vertices[element] = 0;
      dropEdge(ofVertex[element].exclusiveOr);
    }
    else if (dimension == 1 && ofEdge[element].count == 1)
    {
      const ElementIndex face = ofEdge[element].exclusiveOr;
      live.faces[face] = 0;
      for (const ElementIndex e : complex.FaceEdges(face))
      {
        ofEdge[e].Remove(face);
        offerEdge(e);
      }
      dropEdge(element);
    }
  }
  return live;
}

inline LiveElements
AllLive(const CellComplex & complex)
{
  return { std::vector<std::uint8_t>(complex.vertexCount, 1),
           std::vector<std::uint8_t>(complex.edges.size(), 1),
           std::vector<std::uint8_t>(complex.FaceCount(), 1) };
}

inline void
ExpectSame(const LiveElements & a, const LiveElements & b)
{
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.edges, b.edges);
  EXPECT_EQ(a.faces, b.faces);
}

inline CellComplex
RandomComplex(std::uint32_t seed)
{
  const unsigned facePercent = 20 + seed * 13 % 80;
  return seed % 2 == 0 ? RandomCubicalComplex(seed, 1 + seed % 3, facePercent, seed % 60)
                       : RandomSimplicialComplex(seed, 1, facePercent, seed % 60);
}

inline constexpr double kAll = std::numeric_limits<double>::infinity();

} // namespace voxelcore::testing
