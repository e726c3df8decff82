// Whether two models are the same.

#include "voxelcore/Models/MedialModel.h"

#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <bit>

namespace voxelcore
{
namespace
{

bool
Same(double a, double b)
{
  return bit_cast<std::uint64_t>(a) == bit_cast<std::uint64_t>(b);
}

bool
Same(const Vector3 & a, const Vector3 & b)
{
  return Same(a[0], b[0]) && Same(a[1], b[1]) && Same(a[2], b[2]);
}

template <typename Value>
bool
Same(const std::vector<Value> & a, const std::vector<Value> & b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Value & x, const Value & y) {
    return Same(x, y);
  });
}

} // namespace

bool
SameBits(const ModelPart & a, const ModelPart & b)
{
  const MedialComplex & x = a.core;
  const MedialComplex & y = b.core;
  return a.label == b.label && a.component == b.component && x.cells.vertexCount == y.cells.vertexCount &&
         x.cells.edges == y.cells.edges && x.cells.faceOffsets == y.cells.faceOffsets &&
         x.cells.faceVertices == y.cells.faceVertices && x.cells.faceEdges == y.cells.faceEdges &&
         Same(x.positions, y.positions) && Same(x.radius, y.radius) && Same(x.vertexLambda, y.vertexLambda) &&
         Same(x.edgeLambda, y.edgeLambda) && Same(x.faceLambda, y.faceLambda) &&
         Same(x.tolerances.vertices, y.tolerances.vertices) && Same(x.tolerances.edges, y.tolerances.edges) &&
         Same(x.tolerances.faces, y.tolerances.faces) && Same(a.displacement, b.displacement) &&
         Same(a.thickness, b.thickness) && Same(a.radiusMargin, b.radiusMargin);
}

bool
SameBits(const MedialModel & a, const MedialModel & b)
{
  return a.provenance == b.provenance && a.hasEdges == b.hasEdges && a.refined == b.refined && a.inLps == b.inLps &&
         a.unit == b.unit &&
         std::equal(a.parts.begin(),
                    a.parts.end(),
                    b.parts.begin(),
                    b.parts.end(),
                    [](const ModelPart & x, const ModelPart & y) { return SameBits(x, y); });
}

} // namespace voxelcore
