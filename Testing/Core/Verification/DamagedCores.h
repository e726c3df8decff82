#pragma once
// Cores damaged on purpose, and what verification says of them.

#include "Core/Verification/VerificationFixtures.h"
#include "voxelcore/Complex/SimplePairCollapse.h"

#include <string>
#include <vector>

namespace voxelcore::testing
{

using Names = std::vector<std::string>;

/** An ellipsoid with a rod, spacings 0.5, 0.5, 1, with its core: all checks pass. */
VerificationCase
GoodCase(double threshold = 0);

/** The checks that fail. Each must come with a sentence, or the running test fails. */
Names
Failures(const VerificationCase & subject);

/** The running test fails unless these checks, perhaps among others, fail. */
void
ExpectFails(const VerificationCase & subject, const Names & checks);

/** A face with at least so many corners. */
std::size_t
FaceWithCorners(const CellComplex & cells, std::size_t corners);

/** The first edge on no face. */
std::size_t
EdgeWithoutFace(const CellComplex & cells);

/** Drops elements; what is left keeps its order and measures. */
void
Keep(MedialComplex & core, const LiveElements & live);

/** Everything, to be thinned out. */
LiveElements
AllOf(const CellComplex & cells);

/** Appends a face with the given corners; its sides must be edges already. */
void
AppendFace(MedialComplex & core, const std::vector<ElementIndex> & corners, double lambda);

/** Makes polygon `face` run the other way round from the same first corner. */
void
ReversePolygon(CellComplex & cells, std::size_t face);

} // namespace voxelcore::testing
