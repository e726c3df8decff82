#include "TubeEnd.h"

#include "HeightRegression.h"
#include "JointAxes.h"

#include <algorithm>
#include <array>
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

constexpr double kPointed = 0.4; ///< growth of the radius along the way, from which on an end is no tube's

// A tube that widens or narrows towards its end alone is measured over half the way, again and again, while that leaves
// no more than this part of what areas are off a straight course, and at least so many radii and voxels.
constexpr double kStraighter = 0.25;
constexpr double kShortestInRadii = 0.75;
constexpr double kShortestInVoxels = 4;

// A flat end lies two thirds of a radius beyond the centre of the half ball that holds as much. In voxels it reaches
// half a voxel further, and a half ball beyond that: from no to yes, what part of that is missing. It must be so many
// times what the number of voxels may be off.
constexpr double                kFlatBeyond = 2.0 / 3;
constexpr double                kInVoxels = 0.5;
constexpr double                kSure = 3;
constexpr std::array<double, 2> kIsFlat{ 0.5, 0.8 };

/** The cap where a tube with this radius at each height, and the cap on it, have a content above
 *  the top. */
template <class RadiusAt>
HalfBall
CapOf(const BodyAtEnd & body, double top, double content, const RadiusAt & radiusAt)
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
  const double height = 0.5 * (low + high);
  return { height, radiusAt(height) };
}

/** A tube between two heights: its radius runs straight from one end to the other, as a cone's. */
struct TubeFit
{
  double radius = 0; ///< in its middle
  double middle = 0; ///< height
  double slope = 0;  ///< of the radius
  double noise = 0;  ///< variance of the slope: that of the bins, at least that of voxels
  double off = 0;    ///< variance of the bins' radii about the straight course
};

TubeFit
FitTube(const BodyAtEnd & body, const EndLengths & end, double top, double bottom)
{
  constexpr int    kBins = 8;
  const double     bin = (top - bottom) / kBins;
  double           radii[kBins];
  HeightRegression heights;
  TubeFit          fit;
  double           product = 0;
  double           above = body.VolumeAbove(top);
  for (int k = 0; k < kBins; ++k)
  {
    const double below = body.VolumeAbove(top - (k + 1) * bin);
    radii[k] = std::sqrt((below - above) / bin / std::numbers::pi);
    above = below;
    const double z = top - (k + 0.5) * bin;
    heights.Add(z);
    fit.radius += radii[k] / kBins;
    product += radii[k] * z;
  }
  fit.middle = heights.MeanZ();
  fit.slope = (product - kBins * fit.radius * fit.middle) / heights.Spread();
  for (int k = 0; k < kBins; ++k)
  {
    const double off = radii[k] - fit.radius - fit.slope * (top - (k + 0.5) * bin - fit.middle);
    fit.off += off * off / (kBins - 2);
  }
  const double surface = 2 * std::numbers::pi * fit.radius * bin; // of a bin
  const double voxels = kCountNoise * std::sqrt(surface) * end.voxel * end.voxel / surface;
  fit.noise = std::max(fit.off, voxels * voxels) / heights.Spread();
  return fit;
}

/** The cap of a tube measured from the bottom to a top. `isRound`: that has been looked at before; the tube may be
 *  wider than the balls of the branch towards its end. */
std::optional<HalfBall>
CapAbove(const BodyAtEnd & body, const EndLengths & end, double top, double bottom, bool isRound = false)
{
  TubeFit tube = FitTube(body, end, top, bottom);
  for (double length = 0.5 * (top - bottom);
       length >= std::max(kShortestInRadii * end.radius, kShortestInVoxels * end.voxel);
       length *= 0.5)
  {
    const TubeFit shorter = FitTube(body, end, top, top - length);
    if (shorter.off < kStraighter * tube.off)
    {
      tube = shorter;
    }
  }
  if (!(tube.radius > 0) || (!isRound && tube.radius > kRound * end.radius + 0.25 * end.voxel))
  {
    return std::nullopt;
  }
  // A slope that noise may have made counts little.
  const double growth = tube.slope * tube.slope * tube.slope / (tube.slope * tube.slope + kSlopePrior * tube.noise);
  if (!(std::abs(growth) < kPointed))
  {
    return std::nullopt;
  }
  return CapOf(body, top, body.VolumeAbove(top), [&](double z) {
    return std::max(0.0, tube.radius + growth * (z - tube.middle));
  });
}

std::optional<HalfBall>
CapOfTube(const BodyAtEnd & body, const EndLengths & end)
{
  // What lies above where the tube is measured is all that may tell where it ends, and bumps of the wall there count
  // as those of the cap do. So the tube is measured again, up to the cap that was found, while that rises.
  constexpr int           kTimes = 4;
  const double            bottom = end.skip - end.total;
  double                  top = end.skip - end.deep;
  std::optional<HalfBall> cap = CapAbove(body, end, top, bottom);
  for (int time = 0; time < kTimes && cap && cap->height - kBelowCap * end.voxel > top; ++time)
  {
    top = cap->height - kBelowCap * end.voxel;
    cap = CapAbove(body, end, top, bottom, true);
  }
  return cap;
}

/** Of a bar with an end on either side: it is a tube in its middle at most. */
std::optional<HalfBall>
CapOfBar(const BodyAtEnd & body, const EndLengths & end)
{
  return CapAbove(body, end, end.skip - kBarBegins * end.way, end.skip - (1 - kBarBegins) * end.way);
}

/** Of a tube as thick as its balls, and then as what was found to lie below its cap. */
std::optional<HalfBall>
CapOfStub(const BodyAtEnd & body, const EndLengths & end)
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
  const HalfBall first = CapOf(body, top, content, [&](double) { return end.radius; });
  const double   tube = first.height - kBelowCap * end.voxel;
  if (tube - top < kStubInVoxels * end.voxel)
  {
    return first;
  }
  return CapOf(body, top, content, [radius = radiusUpTo(tube)](double) { return radius; });
}

} // namespace

std::optional<HalfBall>
FindHalfBall(const BodyAtEnd & body, const EndLengths & end)
{
  return end.isBar ? CapOfBar(body, end) : end.isStub ? CapOfStub(body, end) : CapOfTube(body, end);
}

double
FlatEndAbove(const BodyAtEnd & body, const EndLengths & end, const HalfBall & cap)
{
  const double flat = kFlatBeyond * cap.radius;
  const double beyond = flat + kInVoxels * end.voxel;
  const double height = cap.radius - beyond; // of the rest of the half ball
  if (height <= 0)
  {
    return 0;
  }
  const double rest = std::numbers::pi * height * height * (cap.radius - height / 3);
  const double surface = 2 * std::numbers::pi * cap.radius * height;
  return rest > kSure * kCountNoise * std::sqrt(surface) * end.voxel * end.voxel
           ? (flat - kInVoxels * end.voxel) * FromNoToYes(kIsFlat, 1 - body.VolumeAbove(cap.height + beyond) / rest)
           : 0;
}

} // namespace voxelcore
