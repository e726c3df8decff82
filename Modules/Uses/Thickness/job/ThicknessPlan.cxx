#include "ThicknessPlan.h"

#include "voxelcore/Jobs/CostModel.h"
#include "voxelcore/Shape/ShapeOperations.h"

#include <algorithm>
#include <omp.h>

namespace voxelcore
{

namespace
{

// Of the voxels as they are, measured on shells and porous volumes where all balls are held at once, as they are of a
// flat block. Of many slabs (256 voxels high) it is 410.
constexpr double       kInscribedBytes = 1300; ///< a boundary vertex
constexpr std::int32_t kSmallest = 64;         ///< side of a block, voxels

class Planner
{
public:
  Planner(const VoxelShape &       shape,
          const ImageGeometry &    geometry,
          const CertifiedRequest & request,
          const ThicknessOptions & options,
          double                   bytes)
    : m_Shape(shape)
    , m_Geometry(geometry)
    , m_Request(request)
    , m_Options(options)
    , m_Bytes(bytes)
  {}

  void
  Divide(const VoxelBox & block, std::vector<VoxelBox> & blocks) const
  {
    std::size_t longest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
    {
      longest = block.size[axis] > block.size[longest] ? axis : longest;
    }
    if (block.size[longest] < 2 * kSmallest || Fits(block))
    {
      blocks.push_back(block);
      return;
    }
    VoxelBox first = block;
    VoxelBox second = block;
    first.size[longest] = block.size[longest] / 2;
    second.lower[longest] += first.size[longest];
    second.size[longest] -= first.size[longest];
    Divide(first, blocks);
    Divide(second, blocks);
  }

private:
  bool
  Fits(const VoxelBox & block) const
  {
    const double   reach = GuessReach(VoxelsWithin(m_Shape, WindowOf(block, kNear, m_Shape.Box())), m_Geometry);
    const VoxelBox window = WindowOf(block, MarginOfBlocks(m_Request, m_Geometry, reach), m_Shape.Box());
    return ThicknessBytes(CountBoundary(VoxelsWithin(m_Shape, window)), m_Options) <= m_Bytes;
  }

  static constexpr std::array<std::int32_t, 3> kNear{ 16, 16, 16 };

  const VoxelShape &       m_Shape;
  const ImageGeometry &    m_Geometry;
  const CertifiedRequest & m_Request;
  const ThicknessOptions & m_Options;
  double                   m_Bytes;
};

} // namespace

double
ThicknessBytes(const BoundaryCounts & counts, const ThicknessOptions & options)
{
  const double values = static_cast<double>(counts.voxels) * (sizeof(float) + sizeof(std::uint32_t));
  if (options.core.refine.surface.empty())
  {
    return values + kInscribedBytes * static_cast<double>(counts.vertices);
  }
  return values + static_cast<double>(PredictJob({ counts }, options.core, omp_get_max_threads()).memoryBytes);
}

std::vector<VoxelBox>
PlanThickness(const VoxelShape &       shape,
              const ImageGeometry &    geometry,
              const CertifiedRequest & request,
              const ThicknessOptions & options,
              double                   bytes)
{
  const BoundaryCounts counts = CountBoundary(shape);
  if (ThicknessBytes(counts, options) <= bytes)
  {
    return { shape.Box() };
  }
  // The whole's map, with what is at the border, and its voxels stay in memory beside each block.
  const double beside =
    static_cast<double>(counts.voxels) * (sizeof(float) + sizeof(char)) +
    static_cast<double>(shape.WordsPerRow()) * sizeof(std::uint64_t) * shape.Box().size[1] * shape.Box().size[2];
  std::vector<VoxelBox> blocks;
  Planner(shape, geometry, request, options, bytes - beside).Divide(shape.Box(), blocks);
  return blocks;
}

} // namespace voxelcore
