#include "EndByVolume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace voxelcore
{

namespace
{

// How thick a branch is, is measured over so long a way before its cap: three radii, and 16 voxels, or a thin one is
// measured by too few.
constexpr double kSlabInRadii = 3;
constexpr double kSlabInVoxels = 16;

// Where the body's voxels may lie: no ellipse is round whose longer half axis is more than so many of its radii.
constexpr double kReachInRadii = 1.6;

// A section whose radius is by so much larger than that of its balls is not round.
constexpr double kRound = 1.3;

// Thicker bodies are sampled: so many samples a radius tell as much as all voxels.
constexpr double kSamplesPerRadius = 12;

// How far the number of voxels in a body is off its volume, per square root of the voxels at its surface.
constexpr double kCountNoise = 0.3;

// A slope of three standard deviations counts half: rough walls vary along the way, not from bin to bin alone.
constexpr double kSlopePrior = 9;

// The tube is measured up to so many voxels below where its cap begins.
constexpr double kBelowCap = 0.5;

// A stub on a thick stem is too short to be measured: its balls tell how thick it is.
constexpr double kFreeCap = 0.6;      ///< of its cap must be free at least
constexpr double kStubRadius = 1.8;   ///< voxels; of thinner stubs balls do not tell it well
constexpr double kStubInVoxels = 1.5; ///< below the cap that was found, from which on the tube there is measured

constexpr double kBarBegins = 0.25; ///< of a short bar's line: where it is measured

constexpr double kPointed = 0.3; ///< growth of the radius along the way, from which on an end is no tube's

/** Least squares of values over one variable. */
struct Regression
{
  double count = 0;
  double sumZ = 0;
  double sumZZ = 0;

  void
  Add(double z)
  {
    ++count;
    sumZ += z;
    sumZZ += z * z;
  }
  double
  MeanZ() const
  {
    return sumZ / count;
  }
  double
  Spread() const
  {
    return sumZZ - sumZ * sumZ / count;
  }
};

/** Places with their heights: where a line through them has a given height. */
struct PlaceRegression
{
  Regression heights;
  Vector3    sum{};
  Vector3    products{};

  void
  Add(const Vector3 & place, double z)
  {
    heights.Add(z);
    sum = AddScaled(sum, 1, place);
    products = AddScaled(products, z, place);
  }

  Vector3
  Slope() const
  {
    return AddScaled({}, 1 / heights.Spread(), AddScaled(products, -heights.MeanZ(), sum));
  }

  Vector3
  At(double z) const
  {
    return AddScaled(AddScaled({}, 1 / heights.count, sum), z - heights.MeanZ(), Slope());
  }
};

struct Sample
{
  Vector3 place;
  double  height; ///< above the base, outwards
};

/** The end of a branch: an axis from within the branch, straight on from its base. Lengths in mm along the grid. */
class EndOfBranch
{
public:
  EndOfBranch(const VoxelShape & shape,
              const Vector3 &    spacing,
              const WayLine &    line,
              double             free,
              double             radius,
              bool               isBar)
    : m_Shape(shape)
    , m_Spacing(spacing)
    , m_Line(line)
    , m_Radius(radius)
    , m_Voxel(Length(spacing) / std::sqrt(3.0))
    , m_Deep(std::max(radius, m_Voxel) + 0.5 * m_Voxel)
    , m_Total(std::min(free, m_Deep + std::max(kSlabInRadii * radius, kSlabInVoxels * m_Voxel)))
    , m_Skip(std::min(radius, 0.4 * m_Total))
    , m_IsStub(m_Total - m_Deep < std::max(m_Radius, 2 * m_Voxel))
    , m_IsBar(isBar && m_IsStub)
  {}

  std::optional<Vector3>
  Find()
  {
    const bool isTooShort = m_IsStub && !m_IsBar && (m_Total < kFreeCap * m_Deep || m_Radius < kStubRadius * m_Voxel);
    if (isTooShort || !PlaceAxis() || !TakeSamples())
    {
      return std::nullopt;
    }
    const auto height = m_IsBar ? HeightOfBar() : m_IsStub ? HeightOfStub() : Height();
    if (!height)
    {
      return std::nullopt;
    }
    // The body's own axis: that of the samples.
    PlaceRegression axis;
    const double    from = m_IsStub ? m_Skip - m_Total : m_Skip - m_Deep - 2 * std::max(m_Radius, 3 * m_Voxel);
    for (const Sample & sample : m_Samples)
    {
      if (sample.height > from)
      {
        axis.Add(sample.place, sample.height);
      }
    }
    return axis.heights.Spread() > 0 ? std::optional(axis.At(*height)) : std::nullopt;
  }

private:
  bool
  PlaceAxis()
  {
    const double step = std::max(m_Voxel, 0.5 * m_Radius);
    const double last = m_IsBar ? m_Line.way.back() : std::min(m_Total + 2 * m_Voxel, m_Line.way.back());
    const int    steps = std::max(1, static_cast<int>(std::ceil((last - m_Skip) / step)));
    for (int k = 0; k <= steps; ++k)
    {
      m_Axis.push_back(m_Line.At(m_Skip + (last - m_Skip) * k / steps));
    }
    PlaceRegression straight;
    const double    reach = std::max(2 * m_Radius, 4 * m_Voxel);
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
    m_Beyond = m_Skip + 3 * m_Radius + 4 * m_Voxel;
    m_Axis.insert(m_Axis.begin(), AddScaled(m_Axis[0], m_Beyond, m_Outwards));
    return true;
  }

  /** The height of the nearest place of the axis; none beyond its ends or further away than a round body is thick. */
  std::optional<double>
  HeightOf(const Vector3 & place, double reach) const
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

  /** Voxels around the axis that hang together with it. */
  bool
  TakeSamples()
  {
    const double reach = kReachInRadii * m_Radius + 2 * m_Voxel;
    m_Stride = std::max(1, static_cast<int>(m_Radius / (kSamplesPerRadius * m_Voxel)));
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
    return !m_Samples.empty();
  }

  double
  VolumeAbove(double height) const
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

  /** That of the centre of the half ball. */
  std::optional<double>
  Height() const
  {
    // What lies above where the tube is measured is all that may tell where it ends, and bumps of the wall there count
    // as those of the cap do. So the tube is measured again, up to the cap that was found.
    const double bottom = m_Skip - m_Total;
    const double deep = m_Skip - m_Deep;
    const auto   first = HeightAbove(deep, bottom);
    const double top = first ? *first - kBelowCap * m_Voxel : deep;
    return top > deep ? HeightAbove(top, bottom) : first;
  }

  /** The same of a bar with an end on either side: it is a tube in its middle at most. */
  std::optional<double>
  HeightOfBar() const
  {
    return HeightAbove(m_Skip - kBarBegins * m_Line.way.back(), m_Skip - (1 - kBarBegins) * m_Line.way.back());
  }

  /** The same of a tube as thick as its balls, and then as what was found to lie below its cap. */
  std::optional<double>
  HeightOfStub() const
  {
    const double top = m_Skip - std::min(m_Deep, m_Total);
    const double content = VolumeAbove(top);
    const auto   radiusUpTo = [&](double height) {
      return std::sqrt((content - VolumeAbove(height)) / (std::numbers::pi * (height - top)));
    };
    if (radiusUpTo(top + m_Voxel) > kRound * m_Radius + 0.25 * m_Voxel)
    {
      return std::nullopt;
    }
    const double first = HeightOfCap(top, content, [&](double) { return m_Radius; });
    const double tube = first - kBelowCap * m_Voxel;
    if (tube - top < kStubInVoxels * m_Voxel)
    {
      return first;
    }
    return HeightOfCap(top, content, [radius = radiusUpTo(tube)](double) { return radius; });
  }

  /** Of the cap's centre, where a tube with this radius at each height, and the cap on it, have a content above the
   *  top. */
  template <class RadiusAt>
  double
  HeightOfCap(double top, double content, const RadiusAt & radiusAt) const
  {
    const auto contentWith = [&](double z) {
      const double a = radiusAt(top);
      const double b = radiusAt(z);
      return std::numbers::pi / 3 * (z - top) * (a * a + a * b + b * b) + 2 * std::numbers::pi / 3 * b * b * b;
    };
    double low = top - 2 * radiusAt(top);
    double high = m_Beyond;
    for (int step = 0; step < 60; ++step)
    {
      const double middle = 0.5 * (low + high);
      (contentWith(middle) < content ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  /** The same by a tube measured from the bottom to a top. */
  std::optional<double>
  HeightAbove(double top, double bottom) const
  {
    constexpr int kBins = 8;
    const double  bin = (top - bottom) / kBins;
    const double  content = VolumeAbove(top);
    double        areas[kBins];
    Regression    heights;
    double        mean = 0;
    double        product = 0;
    double        above = content;
    for (int k = 0; k < kBins; ++k)
    {
      const double below = VolumeAbove(top - (k + 1) * bin);
      areas[k] = (below - above) / bin;
      above = below;
      const double z = top - (k + 0.5) * bin;
      heights.Add(z);
      mean += areas[k] / kBins;
      product += areas[k] * z;
    }
    if (!(mean > 0))
    {
      return std::nullopt;
    }
    double slope = (product - kBins * mean * heights.MeanZ()) / heights.Spread();
    double residual = 0;
    for (int k = 0; k < kBins; ++k)
    {
      const double off = areas[k] - mean - slope * (top - (k + 0.5) * bin - heights.MeanZ());
      residual += off * off;
    }
    const double radius = std::sqrt(mean / std::numbers::pi);
    if (radius > kRound * m_Radius + 0.25 * m_Voxel)
    {
      return std::nullopt;
    }
    // A slope that noise may have made counts little: that of the bins, at least that of voxels.
    const double voxels = kCountNoise * std::sqrt(2 * std::numbers::pi * radius * bin) * m_Voxel * m_Voxel / bin;
    const double noise = std::max(residual / (kBins - 2), voxels * voxels) / heights.Spread();
    slope *= slope * slope / (slope * slope + kSlopePrior * noise);
    const double growth = slope / (2 * std::numbers::pi * radius);
    if (!(std::abs(growth) < kPointed))
    {
      return std::nullopt;
    }
    return HeightOfCap(top, content, [&](double z) { return std::max(0.0, radius + growth * (z - heights.MeanZ())); });
  }

  const VoxelShape &   m_Shape;
  const Vector3        m_Spacing;
  const WayLine &      m_Line;
  const double         m_Radius;
  const double         m_Voxel;
  const double         m_Deep;   ///< below the tip as it was: here the cap is no more
  const double         m_Total;  ///< so far below it the branch is looked at
  const double         m_Skip;   ///< so far below it the curve may run off the axis
  const bool           m_IsStub; ///< too little is left below the cap to measure the tube
  const bool           m_IsBar;  ///< that is so, and the other end is a tip as well
  std::vector<Vector3> m_Axis;   ///< from beyond the end inwards; the second is the base, at height 0
  Vector3              m_Outwards{};
  double               m_Beyond = 0; ///< height of the axis' end
  int                  m_Stride = 1;
  std::vector<Sample>  m_Samples;
};

} // namespace

std::optional<Vector3>
FindEndByVolume(const VoxelShape & shape,
                const Vector3 &    spacing,
                const WayLine &    line,
                double             free,
                double             radius,
                bool               isBar)
{
  return EndOfBranch(shape, spacing, line, free, radius, isBar).Find();
}

} // namespace voxelcore
