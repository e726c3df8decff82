#include "NearestSets.h"

#include "Vectors.h"
#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

namespace voxelcore::verification
{
namespace
{

using Basis = std::array<std::uint32_t, 4>;

/** Beyond so many candidates that are not all cospherical, trying all spheres would take too long. Large cospherical
 *  sets are those of centres with small denominators, where the next point is far away for any sensible tolerance. */
constexpr std::size_t kMostAmbiguous = 64;

std::array<LatticePoint, 4>
PointsOf(const BoundaryTree & tree, const Basis & basis)
{
  const std::vector<LatticePoint> & points = tree.Points();
  return { points[basis[0]], points[basis[1]], points[basis[2]], points[basis[3]] };
}

/** The nearest set of one position. */
class SetFinder
{
public:
  SetFinder(const BoundaryTree & tree, const SpacingWeights & weights, double tolerance)
    : m_Tree(tree)
    , m_Weights(weights)
    , m_Tolerance(tolerance)
  {
    // A position off by the tolerance along each axis is off by the reach; so are the distances, one up and one down.
    m_Slack = 2 * Reach(weights, tolerance);
  }

  /** Returns the smallest distance; the set is empty when the position is no such centre. */
  double
  Find(const std::array<double, 3> & position, std::vector<std::uint32_t> & set, Basis & basis)
  {
    set.clear();
    const double distance = m_Tree.FindNearest(position, m_Slack, m_Found);
    // From infinitely far away all points are equally near.
    if (m_Found.size() < 4 || !std::isfinite(distance))
    {
      return distance;
    }
    if (const auto sphere = FirstSphere(basis); sphere && Fits(*sphere, position))
    {
      const bool allOn = std::all_of(m_Found.begin(), m_Found.end(), [&](const auto & candidate) {
        return PowerSign(*sphere, m_Tree.Points()[candidate.point], m_Weights) == 0;
      });
      if (allOn)
      {
        for (const auto & candidate : m_Found)
        {
          set.push_back(candidate.point);
        }
        return distance;
      }
    }
    // Other points lie so close to the sphere that doubles cannot tell: try all spheres through four candidates.
    if (m_Found.size() > kMostAmbiguous)
    {
      return distance;
    }
    if (const auto sphere = BestEmptySphere(position, basis))
    {
      for (const auto & candidate : m_Found)
      {
        if (PowerSign(*sphere, m_Tree.Points()[candidate.point], m_Weights) == 0)
        {
          set.push_back(candidate.point);
        }
      }
    }
    return distance;
  }

private:
  double
  Deviation(const ExactCentre & sphere, const std::array<double, 3> & position) const
  {
    const std::array<double, 3> centre = Coordinates(sphere, m_Weights);
    double                      deviation = 0;
    for (std::size_t a = 0; a < 3; ++a)
    {
      deviation = std::max(deviation, std::abs(centre[a] - position[a]));
    }
    return deviation;
  }

  bool
  Fits(const ExactCentre & sphere, const std::array<double, 3> & position) const
  {
    return Deviation(sphere, position) <= m_Tolerance;
  }

  /** The sphere through the first candidates that span space. */
  std::optional<ExactCentre>
  FirstSphere(Basis & basis) const
  {
    for (std::size_t k = 2; k + 1 < m_Found.size(); ++k)
    {
      for (std::size_t l = k + 1; l < m_Found.size(); ++l)
      {
        const Basis candidate{ m_Found[0].point, m_Found[1].point, m_Found[k].point, m_Found[l].point };
        if (const auto sphere = SphereThrough(PointsOf(m_Tree, candidate), m_Weights))
        {
          basis = candidate;
          return sphere;
        }
      }
    }
    return std::nullopt;
  }

  /** Of all spheres through four candidates with no candidate inside, the one centred nearest to the position. */
  std::optional<ExactCentre>
  BestEmptySphere(const std::array<double, 3> & position, Basis & basis) const
  {
    std::optional<ExactCentre> best;
    double                     bestDeviation = std::numeric_limits<double>::infinity();
    const std::size_t          n = m_Found.size();
    for (std::size_t i = 0; i < n; ++i)
    {
      for (std::size_t j = i + 1; j < n; ++j)
      {
        for (std::size_t k = j + 1; k < n; ++k)
        {
          for (std::size_t l = k + 1; l < n; ++l)
          {
            const Basis candidate{ m_Found[i].point, m_Found[j].point, m_Found[k].point, m_Found[l].point };
            const auto  sphere = SphereThrough(PointsOf(m_Tree, candidate), m_Weights);
            if (!sphere || !Fits(*sphere, position))
            {
              continue;
            }
            const double deviation = Deviation(*sphere, position);
            const bool   better = deviation < bestDeviation;
            if (better && std::none_of(m_Found.begin(), m_Found.end(), [&](const auto & other) {
                  return PowerSign(*sphere, m_Tree.Points()[other.point], m_Weights) < 0;
                }))
            {
              best = sphere;
              bestDeviation = deviation;
              basis = candidate;
            }
          }
        }
      }
    }
    return best;
  }

  const BoundaryTree &                 m_Tree;
  const SpacingWeights &               m_Weights;
  double                               m_Tolerance;
  double                               m_Slack;
  std::vector<BoundaryTree::Candidate> m_Found;
};

} // namespace

NearestSets
FindNearestSets(const BoundaryTree &                   tree,
                const SpacingWeights &                 weights,
                std::span<const std::array<double, 3>> positions,
                double                                 tolerance,
                const std::function<void(double)> &    progress)
{
  constexpr std::size_t blockSize = 512;
  constexpr std::size_t blocksAtOnce = 128;
  const std::size_t     count = positions.size();
  NearestSets           sets;
  sets.offsets.reserve(count + 1);
  sets.basis.resize(count);
  sets.distance.resize(count);
  // In batches, so that someone watching can stop it, with a list of points and set sizes per block of vertices.
  for (std::size_t first = 0; first < count; first += blockSize * blocksAtOnce)
  {
    const std::size_t                       last = std::min(count, first + blockSize * blocksAtOnce);
    const std::size_t                       blocks = (last - first + blockSize - 1) / blockSize;
    std::vector<std::vector<std::uint32_t>> points(blocks);
    std::vector<std::vector<std::size_t>>   sizes(blocks);
    FirstFailure                            failure;
#pragma omp parallel if (blocks > 4)
    {
      SetFinder                  finder(tree, weights, tolerance);
      std::vector<std::uint32_t> set;
#pragma omp for schedule(dynamic)
      for (std::size_t block = 0; block < blocks; ++block)
      {
        failure.Guard(block, [&] {
          const std::size_t begin = first + block * blockSize;
          for (std::size_t v = begin; v < std::min(last, begin + blockSize); ++v)
          {
            sets.distance[v] = finder.Find(positions[v], set, sets.basis[v]);
            sizes[block].push_back(set.size());
            points[block].insert(points[block].end(), set.begin(), set.end());
          }
        });
      }
    }
    failure.Rethrow();
    for (std::size_t block = 0; block < blocks; ++block)
    {
      for (const std::size_t size : sizes[block])
      {
        sets.offsets.push_back(sets.offsets.back() + size);
      }
      sets.points.insert(sets.points.end(), points[block].begin(), points[block].end());
    }
    if (progress)
    {
      progress(static_cast<double>(last) / static_cast<double>(count));
    }
  }
  return sets;
}

ExactCentre
CentreOf(const NearestSets & sets, const BoundaryTree & tree, const SpacingWeights & weights, std::size_t vertex)
{
  return *SphereThrough(PointsOf(tree, sets.basis[vertex]), weights);
}

void
Intersect(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b, std::vector<std::uint32_t> & common)
{
  common.clear();
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
}

} // namespace voxelcore::verification
