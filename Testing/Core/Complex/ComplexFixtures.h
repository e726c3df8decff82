#pragma once
// Small complexes whose topology a person can check, random ones, and the slow sure way to count their holes.

#include "voxelcore/Complex/CellComplex.h"
#include "voxelcore/Lattice/TopologyNumbers.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace voxelcore::testing
{

/** Corners of a polygon, in cyclic order. */
using Corners = std::vector<ElementIndex>;

/** A complex of the polygons with all their sides, and the edges given beside them; edges sorted, each once. */
CellComplex
MakeComplex(std::size_t                                                vertexCount,
            const std::vector<Corners> &                               polygons,
            const std::vector<std::pair<ElementIndex, ElementIndex>> & edges = {});

/** The complex again with its vertices renumbered: vertex v becomes numbers[v]. */
CellComplex
Renumber(const CellComplex & complex, const std::vector<ElementIndex> & numbers);

/** Betti numbers from dense Gaussian elimination of both boundary matrices over GF(2). */
TopologyNumbers
DenseTopology(const CellComplex & complex);

/** A random subset of the squares, edges and corners of a cubical grid with `side` cubes a side, closed under taking
 *  sides: each with about the given probability (percent). */
CellComplex
RandomCubicalComplex(std::uint32_t seed, std::uint32_t side, unsigned facePercent, unsigned edgePercent);

/** The same of the triangles of the grid's division of each cube into six tetrahedra. */
CellComplex
RandomSimplicialComplex(std::uint32_t seed, std::uint32_t side, unsigned facePercent, unsigned edgePercent);

/** A closed torus of 3 x 3 quadrilaterals. */
CellComplex
Torus();

/** The six squares of a cube, and those of a second cube glued to one of them (11 in all) if asked. */
CellComplex
CubeSurface(bool withNeighbour = false);

struct NamedComplex
{
  std::string     name;
  CellComplex     complex;
  TopologyNumbers expected;
};

/** Complexes whose numbers are known from a textbook. */
std::vector<NamedComplex>
KnownComplexes();

} // namespace voxelcore::testing
