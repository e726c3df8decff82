#pragma once
// A whole core while it burns.

#include "PackedEdgePoints.h"
#include "voxelcore/Base/PackedNumbers.h"
#include "RefinedResults.h"
#include "ShelvedTolerances.h"

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/VoxelCore/MedialComplex.h"

#include <vector>

namespace voxelcore
{

/** Holds what fire does not ask for, of a core and of what is kept for its refinement, in as little memory as brings
 *  it back: all but tolerances below a height comes back to the last bit. */
class ShelvedCore
{
public:
  ShelvedCore(MedialComplex & core, RefinementParts & kept, double height);

  /** The places that were kept. */
  std::vector<Vector3>
  Places() const;

  void
  GiveBack(MedialComplex & core, RefinementParts & kept) &&;

private:
  ShelvedTolerances    m_Tolerances;
  PackedArray<double>  m_VertexLambda;
  PackedArray<double>  m_EdgeLambda;
  PackedArray<double>  m_FaceLambda;
  PackedArray<Vector3> m_Places;
  PackedEdgePoints     m_EdgePoints;
};

} // namespace voxelcore
