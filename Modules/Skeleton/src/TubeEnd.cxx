#include "TubeEnd.h"

#include "HeightRegression.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace voxelcore
{

namespace
{

// A section whose radius is by so much larger than that of its balls is not round.
constexpr double kRound = 1.3;

// How far the number of voxels in a body is off its volume, per square root of the voxels at its surface.
constexpr double kCountNoise = 0.3;

// A slope of three standard deviations counts half: rough walls vary along the way, not from bin to bin alone.
constexpr double kSlopePrior = 9;

// The tube is measured up to so many voxels below where its cap begins.
constexpr double kBelowCap = 0.5;

constexpr double kStubInVoxels = 1.5; ///< below the cap that was found, from which on a stub's tube is measured

constexpr double kBarBegins = 0.25; ///< of a short bar's line: where it is measured

constexpr double kPointed = 0.3; ///< growth of the radius along the way, from which on an end is no tube's

/** The height of the cap's centre where a tube with this radius at each height, and the cap on it, have a content above
 *  the top. */
template <class RadiusAt>
double
HeightOfCap(const BodyAtEnd & body, double top, double content, const RadiusAt & radiusAt)
{
  const auto contentWith = [&](double z) {
    const double a = radiusAt(top);
    const double b = radiusAt(z);
    return std::numbers::pi / 3 * (z - top) * (a * a + a * b + b * b) + 2 * std::numbers::pi / 3 * b * b * b;
  };
  double low = top - 2 * radiusAt(top);
  double high = body.Highest();
  for (int step = 0; step < 60; ++step)
  {
    const double middle = 0.5 * (low + high);
    (contentWith(middle) < content ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/** The height of the cap's centre by a tube measured from the bottom to a top. */
std::optional<double>
HeightAbove(const BodyAtEnd & body, const EndLengths & end, double top, double bottom)
{
  constexpr int    kBins = 8;
  const double     bin = (top - bottom) / kBins;
  const double     content = body.VolumeAbove(top);
  double           areas[kBins];
  HeightRegression heights;
  double           mean = 0;
  double           product = 0;
  double           above = content;
  for (int k = 0; k < kBins; ++k)
  {
    const double below = body.VolumeAbove(top - (k + 1) * bin);
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
  if (radius > kRound * end.radius + 0.25 * end.voxel)
  {
    return std::nullopt;
  }
  // A slope that noise may have made counts little: that of the bins, at least that of voxels.
  const double voxels = kCountNoise * std::sqrt(2 * std::numbers::pi * radius * bin) * end.voxel * end.voxel / bin;
  const double noise = std::max(residual / (kBins - 2), voxels * voxels) / heights.Spread();
  slope *= slope * slope / (slope * slope + kSlopePrior * noise);
  const double growth = slope / (2 * std::numbers::pi * radius);
  if (!(std::abs(growth) < kPointed))
  {
    return std::nullopt;
  }
  return HeightOfCap(body, top, content, [&](double z) {
    return std::max(0.0, radius + growth * (z - heights.MeanZ()));
  });
}

std::optional<double>
HeightOfTube(const BodyAtEnd & body, const EndLengths & end)
{
  // What lies above where the tube is measured is all that may tell where it ends, and bumps of the wall there count
  // as those of the cap do. So the tube is measured again, up to the cap that was found.
  const double bottom = end.skip - end.total;
  const double deep = end.skip - end.deep;
  const auto   first = HeightAbove(body, end, deep, bottom);
  const double top = first ? *first - kBelowCap * end.voxel : deep;
  return top > deep ? HeightAbove(body, end, top, bottom) : first;
}

/** Of a bar with an end on either side: it is a tube in its middle at most. */
std::optional<double>
HeightOfBar(const BodyAtEnd & body, const EndLengths & end)
{
  return HeightAbove(body, end, end.skip - kBarBegins * end.way, end.skip - (1 - kBarBegins) * end.way);
}

/** Of a tube as thick as its balls, and then as what was found to lie below its cap. */
std::optional<double>
HeightOfStub(const BodyAtEnd & body, const EndLengths & end)
{
  const double top = end.skip - std::min(end.deep, end.total);
  const double content = body.VolumeAbove(top);
  const auto   radiusUpTo = [&](double height) {
    return std::sqrt((content - body.VolumeAbove(height)) / (std::numbers::pi * (height - top)));
  };
  if (radiusUpTo(top + end.voxel) > kRound * end.radius + 0.25 * end.voxel)
  {
    return std::nullopt;
  }
  const double first = HeightOfCap(body, top, content, [&](double) { return end.radius; });
  const double tube = first - kBelowCap * end.voxel;
  if (tube - top < kStubInVoxels * end.voxel)
  {
    return first;
  }
  return HeightOfCap(body, top, content, [radius = radiusUpTo(tube)](double) { return radius; });
}

} // namespace

std::optional<double>
HeightOfHalfBall(const BodyAtEnd & body, const EndLengths & end)
{
  return end.isBar ? HeightOfBar(body, end) : end.isStub ? HeightOfStub(body, end) : HeightOfTube(body, end);
}

} // namespace voxelcore
