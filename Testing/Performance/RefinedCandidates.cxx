#include "RefinedCandidates.h"

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Refinement/SurfaceEstimate.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace voxelcore::evaluation
{

std::vector<RefinedCore>
RefineAll(RefinementInput input, const std::vector<double> & lambdas, const std::vector<double> & heights)
{
  const auto surface = SurfaceFromLabels(*input.shape, input.spacing);
  input.surface = surface.get();
  std::vector<RefinedCore> refined = RefineCore(input, lambdas);
  input.byTolerance = true;
  auto byTolerance = RefineCore(input, heights);
  std::move(byTolerance.begin(), byTolerance.end(), std::back_inserter(refined));
  return refined;
}

MedialComplex
RefinedWhereThick(const RefinedCore & refined, const MedialComplex & whole, const Vector3 & spacing)
{
  constexpr double none = 2; // voxels
  constexpr double full = 4;
  const double     voxel = voxelcore::Length(spacing) / std::sqrt(3.0);
  MedialComplex    core = refined.core;
  std::size_t      in = 0; // both have their vertices in the same order
  for (std::size_t v = 0; v < core.positions.size(); ++v)
  {
    const Vector3 from = Minus(core.positions[v], refined.displacement[v]);
    while (in < whole.positions.size() && voxelcore::Length(Minus(whole.positions[in], from)) > 1e-6)
    {
      ++in;
    }
    if (in == whole.positions.size())
    {
      throw std::runtime_error("a refined vertex is none of the whole core's");
    }
    const double part = std::clamp((whole.radius[in] / voxel - none) / (full - none), 0.0, 1.0);
    core.positions[v] = voxelcore::AddScaled(from, part, refined.displacement[v]);
    core.radius[v] = whole.radius[in] + part * (core.radius[v] - whole.radius[in]);
  }
  return core;
}

} // namespace voxelcore::evaluation
