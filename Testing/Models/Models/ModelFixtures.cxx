#include "Models/Models/ModelFixtures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace voxelcore::testing
{

MedialComplex
MakeCore(std::size_t                                      vertices,
         const std::vector<std::array<ElementIndex, 2>> & looseEdges,
         const std::vector<std::vector<ElementIndex>> &   faces,
         double                                           seed)
{
  MedialComplex core;
  core.cells.vertexCount = vertices;
  std::map<std::array<ElementIndex, 2>, ElementIndex> edges;
  for (const auto & edge : looseEdges)
  {
    edges[edge];
  }
  const auto edgeOf = [](const std::vector<ElementIndex> & face, std::size_t i) {
    const ElementIndex a = face[i];
    const ElementIndex b = face[(i + 1) % face.size()];
    return std::array<ElementIndex, 2>{ std::min(a, b), std::max(a, b) };
  };
  for (const auto & face : faces)
  {
    for (std::size_t i = 0; i < face.size(); ++i)
    {
      edges[edgeOf(face, i)];
    }
  }
  for (auto & [edge, index] : edges)
  {
    index = static_cast<ElementIndex>(core.cells.edges.size());
    core.cells.edges.push_back(edge);
    core.edgeLambda.push_back(std::sqrt(2.0 + seed + index));
  }
  for (const auto & face : faces)
  {
    for (std::size_t i = 0; i < face.size(); ++i)
    {
      core.cells.faceVertices.push_back(face[i]);
      core.cells.faceEdges.push_back(edges[edgeOf(face, i)]);
    }
    core.faceLambda.push_back(std::sqrt(3.0 + seed + static_cast<double>(core.faceLambda.size())) / 7);
    core.cells.faceOffsets.push_back(core.cells.faceVertices.size());
  }
  for (std::size_t v = 0; v < vertices; ++v)
  {
    const double d = static_cast<double>(v) + seed;
    core.positions.push_back({ d / 3, std::sqrt(d + 1), -1e-7 * std::sqrt(d + 2) });
    core.radius.push_back(std::sqrt(d + 5) / 3);
    core.vertexLambda.push_back(std::sqrt(d + 7) / 3);
  }
  return core;
}

MedialModel
MixedModel()
{
  MedialModel model;
  model.parts.push_back({ 3, MakeCore(9, { { 3, 4 } }, { { 0, 1, 2, 3 }, { 1, 2, 6, 7, 8 } }, 0.25) });
  model.parts.push_back({ 7, MakeCore(2, {}, {}, 1.75) });
  model.parts.push_back({ 300, MakeCore(2, { { 0, 1 } }, {}, 2.125) });
  model.provenance = R"({"input":{"path":"a b.nrrd","note":"µ < 1 & \"x\""}})";
  return model;
}

MedialModel
RandomModel(std::uint64_t seed, int n, int parts)
{
  std::mt19937_64 random(seed);
  MedialModel     model;
  for (int p = 0; p < parts; ++p)
  {
    const auto point = [n](int x, int y, int z) { return static_cast<ElementIndex>((z * n + y) * n + x); };
    std::vector<std::array<ElementIndex, 2>> edges;
    std::vector<std::vector<ElementIndex>>   faces;
    for (int z = 0; z + 1 < n; ++z)
    {
      for (int y = 0; y + 1 < n; ++y)
      {
        for (int x = 0; x + 1 < n; ++x)
        {
          if (random() % 3 == 0)
          {
            faces.push_back({ point(x, y, z), point(x + 1, y, z), point(x + 1, y + 1, z), point(x, y + 1, z) });
          }
          if (random() % 3 == 0)
          {
            faces.push_back({ point(x, y, z), point(x, y, z + 1), point(x, y + 1, z + 1), point(x, y + 1, z) });
          }
          if (random() % 4 == 0)
          {
            edges.push_back({ point(x, y, z), point(x + 1, y, z) });
          }
        }
      }
    }
    model.parts.push_back(
      { 5 * p - 2,
        MakeCore(static_cast<std::size_t>(n * n * n), edges, faces, static_cast<double>(random() % 1000) / 7) });
    for (double & radius : model.parts.back().core.radius)
    {
      radius += n * n; // neighbours in the grid are far apart
    }
  }
  model.provenance = "{}";
  return model;
}

} // namespace voxelcore::testing
