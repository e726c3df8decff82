#include "CoreFaces.h"

#include "FoundFaces.h"

#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/SpentMemory.h"

#include <algorithm>
#include <memory>

namespace voxelcore
{

namespace
{

constexpr std::size_t kFacesAhead = 4;
constexpr std::size_t kSteps = 16; // after each of which what it used up goes

// A face among those with the same smallest corner.
struct PlacedFace
{
  double        lambda;
  ElementIndex  second; // smallest corner
  ElementIndex  third;
  std::uint64_t place; // of its turns: that of the first, and how many there are

  std::uint64_t
  First() const
  {
    return place >> kSidesBits;
  }
  std::size_t
  Sides() const
  {
    return place & (kMostSides - 1);
  }
};

// Faces by their smallest corners.
struct PlacedFaces
{
  std::unique_ptr<PlacedFace[]> faces; // no vector, which would write all at once
  std::vector<std::uint32_t>    start; // vertices + 1

  std::size_t
  VertexAt(std::size_t step) const
  {
    return (start.size() - 1) * step / kSteps;
  }
};

bool
IsWorthIt(std::size_t faces)
{
  return faces > 10000;
}

/** Uses `found` up. */
PlacedFaces
PlaceFaces(std::vector<FoundFace> found, std::size_t vertexCount)
{
  const std::size_t count = found.size();
  PlacedFaces       placed;
  placed.start.assign(vertexCount + 2, 0);
  std::uint32_t * const start = placed.start.data();
  // As SortIntoBuckets() does it: each part of the vertices looks at all faces.
  RunInParts(IsWorthIt(count), vertexCount, [&](std::size_t first, std::size_t last) {
    for (const FoundFace & face : found)
    {
      if (face.name[0] - first < last - first)
      {
        ++start[face.name[0] + std::size_t{ 2 }];
      }
    }
  });
  for (std::size_t vertex = 2; vertex < placed.start.size(); ++vertex)
  {
    start[vertex] += start[vertex - 1];
  }
  placed.faces = make_unique_for_overwrite<PlacedFace[]>(count);
  SpentFront    spent(found);
  std::uint64_t firstTurn = 0;
  for (std::size_t step = 0; step < kSteps; ++step)
  {
    const std::size_t begin = count * step / kSteps;
    const std::size_t end = count * (step + 1) / kSteps;
    std::uint64_t     endTurn = firstTurn;
    for (std::size_t i = begin; i < end; ++i)
    {
      endTurn += found[i].sides;
    }
    RunInParts(IsWorthIt(count), vertexCount, [&](std::size_t first, std::size_t last) {
      std::uint64_t turn = firstTurn;
      for (std::size_t i = begin; i < end; ++i)
      {
        const FoundFace & face = found[i];
        if (face.name[0] - first < last - first)
        {
          placed.faces[start[face.name[0] + std::size_t{ 1 }]++] = { face.lambda,
                                                                     face.name[1],
                                                                     face.name[2],
                                                                     turn << kSidesBits | face.sides };
        }
        turn += face.sides;
      }
    });
    firstTurn = endTurn;
    spent.SpendTo(end);
  }
  placed.start.pop_back();
  return placed;
}

// Writes the faces from `begin` on, whose offsets, but for the last's end, stand already.
void
WriteSome(std::span<const PlacedFace> faces,
          std::size_t                 begin,
          const std::vector<Turn> &   turns,
          bool                        writesCorners,
          MedialComplex &             core)
{
  CellComplex & complex = core.cells;
  RunInParts(IsWorthIt(faces.size()), faces.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
    {
      // Step by step: the turns, the edges that they name.
      __builtin_prefetch(&turns[faces[std::min(i + 2 * kFacesAhead, last - 1)].First()]);
      const PlacedFace & ahead = faces[std::min(i + kFacesAhead, last - 1)];
      for (std::size_t side = 0; writesCorners && side < ahead.Sides(); ++side)
      {
        __builtin_prefetch(&complex.edges[turns[ahead.First() + side] >> 1]);
      }
      const PlacedFace &  face = faces[i];
      const std::uint64_t at = complex.faceOffsets[begin + i];
      for (std::size_t side = 0; side < face.Sides(); ++side)
      {
        const Turn turn = turns[face.First() + side];
        if (writesCorners)
        {
          complex.faceVertices[at + side] = Tail(turn, complex.edges);
        }
        complex.faceEdges[at + side] = turn >> 1;
      }
      core.faceLambda[begin + i] = face.lambda;
    }
  });
}

// Before which turn none is of a face of this step or of one that follows.
std::vector<std::uint64_t>
FirstTurns(const PlacedFaces & placed, std::uint64_t turns)
{
  std::vector<std::uint64_t> first(kSteps + 1, turns);
  for (std::size_t step = kSteps; step-- > 0;)
  {
    first[step] = first[step + 1];
    for (std::size_t face = placed.start[placed.VertexAt(step)]; face < placed.start[placed.VertexAt(step + 1)]; ++face)
    {
      first[step] = std::min(first[step], placed.faces[face].First());
    }
  }
  return first;
}

} // namespace

void
WriteFaces(FacetPolygons             polygons,
           std::vector<LatticePoint> sortedPoints,
           const SpacingWeights &    weights,
           CoreUse                   use,
           MedialComplex &           core)
{
  const bool        writesCorners = use == CoreUse::Any;
  CellComplex &     complex = core.cells;
  FoundFaces        found = FindFaces(std::move(polygons), std::move(sortedPoints), weights, complex.edges);
  const std::size_t count = found.faces.size();
  const PlacedFaces placed = PlaceFaces(std::move(found.faces), complex.vertexCount);
  complex.faceOffsets.reserve(count + 1);
  complex.faceVertices.reserve(writesCorners ? found.turns.size() : 0);
  complex.faceEdges.reserve(found.turns.size());
  core.faceLambda.reserve(count);
  const std::vector<std::uint64_t> firstTurns = FirstTurns(placed, found.turns.size());
  SpentFront                       spentFaces(std::span(placed.faces.get(), count));
  SpentFront                       spentTurns(found.turns);
  for (std::size_t step = 0; step < kSteps; ++step)
  {
    const std::size_t vertex = placed.VertexAt(step);
    const std::size_t endVertex = placed.VertexAt(step + 1);
    const std::size_t begin = placed.start[vertex];
    const std::size_t end = placed.start[endVertex];
    RunInParts(IsWorthIt(end - begin), endVertex - vertex, [&](std::size_t first, std::size_t last) {
      for (std::size_t bucket = vertex + first; bucket < vertex + last; ++bucket)
      {
        std::sort(placed.faces.get() + placed.start[bucket],
                  placed.faces.get() + placed.start[bucket + 1],
                  [](const PlacedFace & a, const PlacedFace & b) {
                    return a.second != b.second ? a.second < b.second : a.third < b.third;
                  });
      }
    });
    for (std::size_t face = begin; face < end; ++face)
    {
      complex.faceOffsets.push_back(complex.faceOffsets.back() + placed.faces[face].Sides());
    }
    complex.faceVertices.resize(writesCorners ? complex.faceOffsets.back() : 0);
    complex.faceEdges.resize(complex.faceOffsets.back());
    core.faceLambda.resize(end);
    WriteSome({ placed.faces.get() + begin, end - begin }, begin, found.turns, writesCorners, core);
    spentFaces.SpendTo(end);
    spentTurns.SpendTo(firstTurns[step + 1]);
  }
}

} // namespace voxelcore
