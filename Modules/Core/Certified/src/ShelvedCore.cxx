#include "ShelvedCore.h"

#include <utility>

namespace voxelcore
{

ShelvedCore::ShelvedCore(MedialComplex & core, RefinementParts & kept, double height)
  : m_Tolerances(std::exchange(core.tolerances, {}), height)
  , m_VertexLambda(std::exchange(core.vertexLambda, {}))
  , m_EdgeLambda(std::exchange(core.edgeLambda, {}))
  , m_FaceLambda(std::exchange(core.faceLambda, {}))
  , m_Places(std::exchange(kept.core.positions, {}))
  , m_EdgePoints(std::exchange(kept.edgePoints, {}))
{}

std::vector<Vector3>
ShelvedCore::Places() const
{
  return m_Places.Copy();
}

void
ShelvedCore::GiveBack(MedialComplex & core, RefinementParts & kept) &&
{
  core.tolerances = std::move(m_Tolerances).Take();
  core.vertexLambda = std::move(m_VertexLambda).Take();
  core.edgeLambda = std::move(m_EdgeLambda).Take();
  core.faceLambda = std::move(m_FaceLambda).Take();
  kept.core.positions = std::move(m_Places).Take();
  kept.edgePoints = std::move(m_EdgePoints).Take();
}

} // namespace voxelcore
