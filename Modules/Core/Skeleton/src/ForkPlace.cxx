#include "ForkPlace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace voxelcore
{

namespace
{

// Bodies are apart where so many voxels of background are between them.
constexpr double kApartInVoxels = 1;

// Bodies so far apart are one in the voxels.
constexpr double kJoinedInVoxels = 0.6;

// Axes are fitted over so many radii, at least so many voxels, and are not looked at over less than a part of that.
constexpr double kAxisInRadii = 4;
constexpr double kAxisInVoxels = 8;
constexpr double kLeastPart = 0.5;

// Axes pass each other by no more than so much of the sum of radii.
constexpr double kPassInRadii = 0.25;

// From no to yes: how much the ways from the third branch into both differ in how much they bend, in degrees.
constexpr std::array<double, 2> kAlikeBends{ 20, 10 };

// From no to yes: by how many degrees an arm that bends leaves its junction off its axis. Those of rings do by 19 and
// more, those of straight forks by less than 2.
constexpr std::array<double, 2> kStraight{ 18, 9 };

// From no to yes, in degrees: arms whose axes part slowly enough to run in one body, and fast enough to tell where.
constexpr std::array<double, 2> kNotWide{ 90, 70 };
constexpr std::array<double, 2> kNotNarrow{ 8, 15 };

/** The first way on which two arms are as far apart as their bodies are thick. */
std::optional<double>
WayApart(const Arm & a, const Arm & b, double voxel)
{
  const double apart = a.radius + b.radius + kApartInVoxels * voxel;
  const double last = std::min(a.free, b.free);
  // NOLINTNEXTLINE(clang-analyzer-security.FloatLoopCounter,cert-flp30-c): a length, not a count
  for (double way = 0; way <= last; way += 0.5 * voxel)
  {
    if (Distance(a.line.At(way), b.line.At(way)) >= apart)
    {
      return way;
    }
  }
  return std::nullopt;
}

/** The mean along an arm's axis. */
double
RadiusOf(const Arm & arm)
{
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < arm.radii.size(); ++i)
  {
    if (arm.line.way[i] >= arm.from && arm.line.way[i] <= arm.to)
    {
      sum += arm.radii[i];
      ++count;
    }
  }
  return count > 0 ? sum / count : arm.radius;
}

/** The axes of the first arm and of two that fork, from where their bodies are apart; false where one is too short. */
bool
PlaceAxes(std::vector<Arm> & arms, double voxel, std::array<Axis, 3> & axes)
{
  const auto apart = WayApart(arms[1], arms[2], voxel);
  if (!apart)
  {
    return false;
  }
  for (std::size_t k = 0; k < 3; ++k)
  {
    Arm &        arm = arms[k];
    const double length = std::max(kAxisInRadii * arm.radius, kAxisInVoxels * voxel);
    arm.from = k == 0 ? arm.leaves : *apart;
    arm.to = std::min(arm.from + length, arm.free);
    if (arm.to - arm.from < kLeastPart * length)
    {
      return false;
    }
    axes[k] = AxisOf(arm);
  }
  return true;
}

} // namespace

std::optional<ForkPlace>
PlaceFork(std::vector<Arm> & arms, double voxel)
{
  if (arms.size() != 3)
  {
    return std::nullopt;
  }
  // Near the junction itself directions tell little: the two arms that fork are those whose axes part least.
  std::array<Axis, 3> axes;
  double              least = 180;
  std::vector<Arm>    ordered;
  for (std::size_t stem = 0; stem < 3; ++stem)
  {
    std::vector<Arm> tried = arms;
    std::swap(tried[0], tried[stem]);
    std::array<Axis, 3> placed;
    if (PlaceAxes(tried, voxel, placed) && AngleDegrees(placed[1].direction, placed[2].direction) < least)
    {
      least = AngleDegrees(placed[1].direction, placed[2].direction);
      axes = placed;
      ordered = std::move(tried);
    }
  }
  if (ordered.empty())
  {
    return std::nullopt;
  }
  arms = std::move(ordered);
  const auto   bend = [&](std::size_t k) { return AngleDegrees(axes[0].direction, axes[k].direction); };
  const double tangent = std::tan(least * std::numbers::pi / 360);
  ForkPlace    fork;
  const auto crooked = [&](std::size_t k) { return AngleDegrees(BendOf(arms[k], voxel).direction, axes[k].direction); };
  fork.isSo = FromNoToYes(kStraight, std::max(crooked(1), crooked(2))) * FromNoToYes(kNotWide, least) *
              FromNoToYes(kNotNarrow, least) * FromNoToYes(kAlikeBends, std::abs(bend(1) - bend(2)));
  if (!(fork.isSo > 0))
  {
    return std::nullopt;
  }
  // Both axes by the height along the line that halves their angle.
  const Vector3 middle = Unit(AddScaled(axes[1].direction, 1, axes[2].direction));
  const Vector3 junction = arms[0].line.places[0];
  Vector3       at[2];
  Vector3       slope[2];
  for (std::size_t k = 0; k < 2; ++k)
  {
    const Axis & axis = axes[k + 1];
    slope[k] = AddScaled({}, 1 / Dot(axis.direction, middle), axis.direction);
    at[k] = AddScaled(axis.middle, -Dot(Minus(axis.middle, junction), middle), slope[k]);
  }
  const Vector3 gap = Minus(at[1], at[0]);
  const Vector3 opening = Minus(slope[1], slope[0]);
  // Balls right behind the junction tell less: some lie in the web between the arms, to one side of both.
  const double radius[2]{ RadiusOf(arms[1]), RadiusOf(arms[2]) };
  const double radii = radius[0] + radius[1] + kJoinedInVoxels * voxel;
  const double wanted = radii * std::max(0.0, 1 - 1.5 * tangent);
  const double closest = -Dot(gap, opening) / Dot(opening, opening);
  const double passing = Length(AddScaled(gap, closest, opening));
  if (passing > kPassInRadii * radii)
  {
    return std::nullopt;
  }
  const double height = closest + std::sqrt(std::max(0.0, wanted * wanted - passing * passing) / Dot(opening, opening));
  const double apart = std::max(wanted, passing);
  const double part = apart > 0 ? std::clamp(0.5 + 0.5 * (radius[1] - radius[0]) / apart, 0.0, 1.0) : 0.5;
  fork.place = AddScaled(AddScaled(at[0], part, gap), height, AddScaled(slope[0], part, opening));
  return fork;
}

} // namespace voxelcore
