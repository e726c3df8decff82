#include "voxelcore/Refinement/SurfaceEstimate.h"


#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Refinement/TriangleTree.h"

namespace voxelcore
{

namespace
{

class TriangleSurface : public SurfaceEstimate
{
public:
  TriangleSurface(std::span<const Vector3> vertices, std::span<const std::array<std::uint32_t, 3>> triangles)
    : m_Tree(vertices, triangles)
  {}

  SurfacePoint
  Project(const Vector3 & place, double reach) const override
  {
    // Places are asked for one beside the other.
    static thread_local std::uint32_t last = TriangleTree::kNoTriangle;
    const TriangleTree::Nearest       nearest = m_Tree.FindNearest(place, reach, last);
    last = nearest.triangle;
    SurfacePoint point;
    if (nearest.triangle >= m_Tree.TriangleCount())
    {
      return point;
    }
    const Vector3 normal = m_Tree.Normal(nearest.triangle);
    const double  length = Length(normal);
    if (length > 0)
    {
      point = { nearest.point, AddScaled({ 0, 0, 0 }, 1 / length, normal), true };
    }
    return point;
  }

private:
  TriangleTree m_Tree;
};

} // namespace

std::unique_ptr<SurfaceEstimate>
SurfaceFromTriangles(std::span<const Vector3> vertices, std::span<const std::array<std::uint32_t, 3>> triangles)
{
  return std::make_unique<TriangleSurface>(vertices, triangles);
}

} // namespace voxelcore
