#pragma once
// What the formats need to know about the cells of a core: which stand alone, and the same core in triangles.

#include "voxelcore/VoxelCore/MedialComplex.h"

namespace voxelcore
{

/** The vertices on no edge, in order. */
std::vector<ElementIndex>
IsolatedVertices(const CellComplex & cells);

/** A flag (0 or 1) per edge: whether it lies on a face. */
std::vector<std::uint8_t>
EdgesOnFaces(const CellComplex & cells);

/** \throws UsageError where the measure of an edge on a face is not known (NaN), so that it cannot be kept. */
void
RequireEdgeMeasures(const MedialComplex & core);

/** The vertices and edges that are cells of a file, in order: those on no edge, or face; with tolerances also those
 *  that outlast theirs, so that a threshold on the heights of a file's cells shows what is left at any height. */
std::vector<ElementIndex>
VertexCells(const MedialComplex & core);
std::vector<ElementIndex>
LineCells(const MedialComplex & core);

/** Makes the edges of a complex anew, in canonical order (by first, then second vertex; smaller index first), from the
 *  corners of its faces and from its edges on no face (any order of ends). Sets `edges` and `faceEdges`.
 *  \throws Error when there are more than an ElementIndex can count. */
void
BuildEdges(CellComplex & cells, std::span<const std::array<ElementIndex, 2>> looseEdges);

} // namespace voxelcore
