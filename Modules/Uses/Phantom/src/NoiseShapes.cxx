#include "Kinds.h"
#include "SplitMix64.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{
namespace
{

/** Where a voxel centre lies between the nodes of a coarse grid, with a weight that is smooth across nodes. */
struct NodePlace
{
  std::size_t node;
  double      weight; ///< of the next node
};

std::vector<NodePlace>
PlacesBetweenNodes(const PhantomOptions & options, std::size_t axis, double pitch)
{
  std::vector<NodePlace> places;
  for (std::int32_t i = 0; i < options.size[axis]; ++i)
  {
    const double at = (i + 0.5) * options.spacing[axis] / pitch;
    const double node = std::floor(at);
    const double t = at - node;
    places.push_back({ static_cast<std::size_t>(node), t * t * t * (t * (t * 6 - 15) + 10) });
  }
  return places;
}

/** One layer of smooth noise: random values on a grid of the given pitch, blended between. */
class NoiseLayer
{
public:
  NoiseLayer(const PhantomOptions & options, double pitch, std::uint64_t stream)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      m_Places[axis] = PlacesBetweenNodes(options, axis, pitch);
      m_Nodes[axis] = m_Places[axis].back().node + 2;
    }
    SplitMix64 random(options.seed, stream);
    m_Values.resize(m_Nodes[0] * m_Nodes[1] * m_Nodes[2]);
    std::generate(m_Values.begin(), m_Values.end(), [&] { return random.Uniform(); });
    m_Row.resize(m_Nodes[0]);
  }

  /** Makes At(x) answer for the row y, z. */
  void
  SetRow(std::size_t y, std::size_t z)
  {
    const NodePlace py = m_Places[1][y];
    const NodePlace pz = m_Places[2][z];
    const auto      value = [&](std::size_t dy, std::size_t dz, std::size_t node) {
      return m_Values[((pz.node + dz) * m_Nodes[1] + py.node + dy) * m_Nodes[0] + node];
    };
    for (std::size_t node = 0; node < m_Nodes[0]; ++node)
    {
      const double near = value(0, 0, node) + py.weight * (value(1, 0, node) - value(0, 0, node));
      const double far = value(0, 1, node) + py.weight * (value(1, 1, node) - value(0, 1, node));
      m_Row[node] = near + pz.weight * (far - near);
    }
  }
  double
  At(std::size_t x) const
  {
    const NodePlace place = m_Places[0][x];
    return m_Row[place.node] + place.weight * (m_Row[place.node + 1] - m_Row[place.node]);
  }

private:
  std::array<std::vector<NodePlace>, 3> m_Places;
  std::array<std::size_t, 3>            m_Nodes{};
  std::vector<double>                   m_Values;
  std::vector<double>                   m_Row;
};

} // namespace

VoxelShape
MakePorous(const PhantomOptions & options, const ProgressCallback & progress)
{
  const double coarsest = std::max(options.spacing[0], std::max(options.spacing[1], options.spacing[2]));
  const double pitch = options.period.value_or(std::max(ShortestSide(options) / 16, 2 * coarsest));
  // Two layers with pitches in no simple ratio hide the axes of the grid of nodes.
  NoiseLayer coarse(options, pitch, 1);
  NoiseLayer fine(options, pitch * 0.61, 2);
  const auto valueOf = [&](std::size_t x) { return coarse.At(x) + 0.5 * fine.At(x); }; // in [0, 1.5)

  // First pass: how often each value occurs; the threshold is where the density is met. Second pass: the voxels.
  constexpr std::size_t      bins = std::size_t{ 1 } << 16;
  std::vector<std::uint64_t> histogram(bins, 0);
  const auto                 binOf = [](double value) {
    return std::min(bins - 1, static_cast<std::size_t>(value * (static_cast<double>(bins) / 1.5)));
  };
  const auto forRow = [&](std::size_t y, std::size_t z) {
    coarse.SetRow(y, z);
    fine.SetRow(y, z);
  };
  for (std::int32_t z = 0; z < options.size[2]; ++z)
  {
    ReportProgress(progress, "measuring", static_cast<double>(z) / options.size[2]);
    for (std::int32_t y = 0; y < options.size[1]; ++y)
    {
      forRow(static_cast<std::size_t>(y), static_cast<std::size_t>(z));
      for (std::int32_t x = 0; x < options.size[0]; ++x)
      {
        ++histogram[binOf(valueOf(static_cast<std::size_t>(x)))];
      }
    }
  }
  const double  voxels = static_cast<double>(options.size[0]) * options.size[1] * options.size[2];
  const auto    wanted = static_cast<std::uint64_t>(std::llround(options.density.value_or(0.5) * voxels));
  std::size_t   threshold = bins;
  std::uint64_t inside = 0;
  while (threshold > 0 && inside < wanted)
  {
    inside += histogram[--threshold];
  }
  return FillRows(options, progress, [&](std::size_t y, std::size_t z) {
    forRow(y, z);
    return [&](std::size_t x) -> bool { return binOf(valueOf(x)) >= threshold; };
  });
}

VoxelShape
MakeNoise(const PhantomOptions & options, const ProgressCallback & progress)
{
  SplitMix64   random(options.seed, 3);
  const double density = options.density.value_or(0.5);
  return FillRows(options, progress, [&](std::size_t, std::size_t) {
    return [&](std::size_t) -> bool { return random.Uniform() < density; };
  });
}

} // namespace voxelcore
