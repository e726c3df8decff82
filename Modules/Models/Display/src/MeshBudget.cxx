#include "MeshBudget.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

std::vector<std::size_t>
SharesOfBudget(const std::vector<MeshDemand> & meshes, std::size_t budget)
{
  constexpr std::size_t kLeast = 64; // with fewer triangles even a ball is no ball
  std::size_t           count = 0;
  double                lightest = 1;
  for (const MeshDemand & mesh : meshes)
  {
    count += mesh.triangles > 0 ? 1 : 0;
    lightest = std::min(lightest, mesh.weight);
  }
  const std::size_t        least = std::clamp<std::size_t>(budget / (2 * std::max<std::size_t>(count, 1)), 4, kLeast);
  std::vector<std::size_t> shares(meshes.size());
  const auto               fill = [&](double part) {
    std::size_t sum = 0;
    for (std::size_t i = 0; i < meshes.size(); ++i)
    {
      const auto size = static_cast<double>(meshes[i].triangles);
      shares[i] = std::min(meshes[i].triangles,
                           std::max(least, static_cast<std::size_t>(std::ceil(part * meshes[i].weight * size))));
      sum += shares[i];
    }
    return sum;
  };
  double low = 0;
  double high = 1 / lightest;
  if (fill(high) > budget)
  {
    for (int halving = 0; halving < 40; ++halving)
    {
      const double middle = (low + high) / 2;
      (fill(middle) > budget ? high : low) = middle;
    }
    fill(low);
  }
  return shares;
}

} // namespace voxelcore
