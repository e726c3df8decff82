#include "BodyAtEnd.h"

#include "HeightRegression.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace voxelcore
{

namespace
{

// Where the body's voxels may lie: no ellipse is round whose longer half axis is more than so many of its radii.
constexpr double kReachInRadii = 1.6;

// Thicker bodies are sampled: so many samples a radius tell as much as all voxels.
constexpr double kSamplesPerRadius = 12;

} // namespace

bool
BodyAtEnd::PlaceAxis(const WayLine & line)
{
  const double step = std::max(m_End.voxel, 0.5 * m_End.radius);
  const double last = m_End.isBar ? m_End.way : std::min(m_End.total + 2 * m_End.voxel, m_End.way);
  const int    steps = std::max(1, static_cast<int>(std::ceil((last - m_End.skip) / step)));
  for (int k = 0; k <= steps; ++k)
  {
    m_Axis.push_back(line.At(m_End.skip + (last - m_End.skip) * k / steps));
  }
  PlaceRegression straight;
  const double    reach = std::max(2 * m_End.radius, 4 * m_End.voxel);
  const int       count = std::clamp(static_cast<int>(reach / step), 2, steps + 1);
  for (int k = 0; k < count; ++k)
  {
    straight.Add(m_Axis[static_cast<std::size_t>(k)], -k);
  }
  const Vector3 slope = straight.Slope();
  if (!(Length(slope) > 0))
  {
    return false;
  }
  m_Outwards = AddScaled({}, 1 / Length(slope), slope);
  const Vector3 centre = straight.At(straight.heights.MeanZ());
  m_Axis[0] = AddScaled(centre, Dot(Minus(m_Axis[0], centre), m_Outwards), m_Outwards);
  m_Beyond = m_End.skip + 3 * m_End.radius + 4 * m_End.voxel;
  m_Axis.insert(m_Axis.begin(), AddScaled(m_Axis[0], m_Beyond, m_Outwards));
  return true;
}

std::optional<double>
BodyAtEnd::HeightOf(const Vector3 & place, double reach) const
{
  double nearest = reach * reach;
  double along = -1;
  double way = 0;
  for (std::size_t i = 0; i + 1 < m_Axis.size(); ++i)
  {
    const Vector3 segment = Minus(m_Axis[i + 1], m_Axis[i]);
    const double  length = Length(segment);
    const Vector3 there = Minus(place, m_Axis[i]);
    const double  t = length > 0 ? std::clamp(Dot(there, segment) / (length * length), 0.0, 1.0) : 0;
    const Vector3 off = AddScaled(there, -t, segment);
    if (Dot(off, off) < nearest)
    {
      nearest = Dot(off, off);
      along = way + t * length;
    }
    way += length;
  }
  return along >= 0 && along < way * (1 - 1e-12) ? std::optional(m_Beyond - along) : std::nullopt;
}

void
BodyAtEnd::TakeSamples()
{
  const double reach = kReachInRadii * m_End.radius + 2 * m_End.voxel;
  m_Stride = std::max(1, static_cast<int>(m_End.radius / (kSamplesPerRadius * m_End.voxel)));
  std::array<std::int32_t, 3> low{};
  std::array<std::int32_t, 3> size{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    double least = m_Axis[0][axis];
    double most = least;
    for (const Vector3 & place : m_Axis)
    {
      least = std::min(least, place[axis]);
      most = std::max(most, place[axis]);
    }
    const VoxelBox &   box = m_Shape.Box();
    const std::int32_t first =
      std::max(box.lower[axis], static_cast<std::int32_t>(std::floor((least - reach) / m_Spacing[axis])));
    const std::int32_t last = std::min(box.lower[axis] + box.size[axis] - 1,
                                       static_cast<std::int32_t>(std::ceil((most + reach) / m_Spacing[axis])));
    low[axis] = first;
    size[axis] = last < first ? 0 : (last - first) / m_Stride + 1;
  }
  const auto placeOf = [&](const std::array<std::int32_t, 3> & at) {
    Vector3 place{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      place[axis] = (low[axis] + m_Stride * at[axis] + 0.5) * m_Spacing[axis];
    }
    return place;
  };
  const auto isIn = [&](const std::array<std::int32_t, 3> & at) {
    return m_Shape.Contains(low[0] + m_Stride * at[0], low[1] + m_Stride * at[1], low[2] + m_Stride * at[2]);
  };
  // From the first sample in the body, from the base inwards.
  std::vector<std::uint8_t> seen(static_cast<std::size_t>(size[0]) * size[1] * size[2], 0);
  const auto                numberOf = [&](const std::array<std::int32_t, 3> & at) {
    return (static_cast<std::size_t>(at[2]) * size[1] + at[1]) * size[0] + at[0];
  };
  std::vector<std::array<std::int32_t, 3>> front;
  const auto                               visit = [&](const std::array<std::int32_t, 3> & at) {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (at[axis] < 0 || at[axis] >= size[axis])
      {
        return;
      }
    }
    std::uint8_t & done = seen[numberOf(at)];
    if (done || !isIn(at))
    {
      return;
    }
    done = 1;
    const Vector3 place = placeOf(at);
    if (const auto height = HeightOf(place, reach))
    {
      m_Samples.push_back({ place, *height });
      front.push_back(at);
    }
  };
  for (std::size_t k = 1; k < m_Axis.size() && m_Samples.empty(); ++k)
  {
    std::array<std::int32_t, 3> at{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto voxel = static_cast<std::int32_t>(std::floor(m_Axis[k][axis] / m_Spacing[axis]));
      at[axis] = (voxel - low[axis]) / m_Stride;
    }
    visit(at);
  }
  while (!front.empty())
  {
    const std::array<std::int32_t, 3> at = front.back();
    front.pop_back();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      for (const std::int32_t step : { -1, 1 })
      {
        std::array<std::int32_t, 3> next = at;
        next[axis] += step;
        visit(next);
      }
    }
  }
}

double
BodyAtEnd::VolumeAbove(double height) const
{
  const double wide = std::abs(m_Outwards[0]) * m_Spacing[0] + std::abs(m_Outwards[1]) * m_Spacing[1] +
                      std::abs(m_Outwards[2]) * m_Spacing[2];
  double sum = 0;
  for (const Sample & sample : m_Samples)
  {
    sum += std::clamp(0.5 + (sample.height - height) / (wide * m_Stride), 0.0, 1.0);
  }
  return sum * m_Spacing[0] * m_Spacing[1] * m_Spacing[2] * m_Stride * m_Stride * m_Stride;
}

std::optional<Vector3>
BodyAtEnd::PlaceAt(double height, double from) const
{
  PlaceRegression axis;
  for (const Sample & sample : m_Samples)
  {
    if (sample.height > from)
    {
      axis.Add(sample.place, sample.height);
    }
  }
  return axis.heights.Spread() > 0 ? std::optional(axis.At(height)) : std::nullopt;
}

} // namespace voxelcore
