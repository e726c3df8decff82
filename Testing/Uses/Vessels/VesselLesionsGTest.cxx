#include "VesselFixtures.h"

#include "voxelcore/Vessels/VesselLesions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <limits>
#include <numbers>

namespace voxelcore::testing
{

namespace
{

std::vector<VesselLesion>
Lesions(const MeasuredBody & body)
{
  return FindLesions(body.graph, body.Sections(), { &body.shape, nullptr, body.geometry, {} });
}

/** A tube along the first axis of a turn, of a radius that changes along it, with flat ends. */
template <typename RadiusAt>
MeasuredBody
Tube(const std::array<Vector3, 3> & turn, double length, double widest, const Vector3 & spacing, RadiusAt radiusAt)
{
  Vector3 half{};
  for (std::size_t k = 0; k < 3; ++k)
  {
    half[k] = 0.5 * length * std::abs(turn[0][k]) + widest;
  }
  VoxelShape          shape = VoxelsAround(half, spacing, { 0.1, 0.2, 0.3 }, [&](const Vector3 & p) {
    const double along = Dot(p, turn[0]);
    return std::abs(along) <= 0.5 * length && Length(AddScaled(p, -along, turn[0])) <= radiusAt(along);
  });
  const ImageGeometry geometry = GridOf(shape, spacing);
  return MeasureBody(std::move(shape), geometry);
}

/** Half-way between a body's ends along an axis. */
double
MiddleOf(const MeasuredBody & body, const Vector3 & axis)
{
  double           least = std::numeric_limits<double>::infinity();
  double           greatest = -least;
  const VoxelBox & box = body.shape.Box();
  for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
  {
    for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
    {
      for (std::int32_t x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
      {
        if (body.shape.Contains(x, y, z))
        {
          const double along = Dot(LatticeToPhysical(body.geometry, { x + 0.5, y + 0.5, z + 0.5 }), axis);
          least = std::min(least, along);
          greatest = std::max(greatest, along);
        }
      }
    }
  }
  return 0.5 * (least + greatest);
}

} // namespace

TEST(VesselLesions, StenosesHaveTheirDegreePlaceAndLength)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  const auto      within = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int body = 0; body < 3; ++body)
  {
    const double radius = within(5, 8);
    const double depth = within(0.3, 0.7);
    const double sigma = within(3, 6);
    // So that two thirds of the branch are healthy: where half is ill, the reference may follow that.
    const double       length = 20 * sigma + 2 * radius;
    const double       at = within(-2, 2) * sigma;
    const auto         turn = AnyTurn(random);
    const MeasuredBody measured = Tube(turn, length, radius, { 1, 1, 1 }, [&](double along) {
      return radius * (1 - depth * std::exp(-0.5 * (along - at) * (along - at) / (sigma * sigma)));
    });
    const auto         lesions = Lesions(measured);
    ASSERT_EQ(lesions.size(), 1U) << radius << ", " << depth << ", " << sigma;
    const VesselLesion & one = lesions.front();
    EXPECT_EQ(one.kind, LesionKind::Stenosis);
    EXPECT_NEAR(one.DegreeByDiameter(), depth, 0.03);
    EXPECT_NEAR(one.DegreeByArea(), 1 - (1 - depth) * (1 - depth), 0.05);
    EXPECT_NEAR(one.reference, 2 * radius, 0.04 * radius);
    // From where it is a tenth to where it is a tenth again.
    EXPECT_NEAR(one.end - one.begin, 2 * sigma * std::sqrt(2 * std::log(depth / 0.1)), 0.5 * sigma + 2);
    EXPECT_NEAR(Dot(one.place, turn[0]) - MiddleOf(measured, turn[0]), at, 2.5);
  }
}

TEST(VesselLesions, HealthyVesselsHaveNoneThoughTheyTaperOrBend)
{
  const auto turn = std::array<Vector3, 3>{ Unit({ 3, 1, 2 }), Unit({ 1, -3, 0 }), Unit({ 6, 2, -10 }) };
  EXPECT_TRUE(Lesions(Tube(turn, 80, 8, { 1, 1, 1 }, [](double along) { return 6 - along / 20; })).empty());
  EXPECT_TRUE(Lesions(Tube(turn, 80, 4, { 1, 1, 2 }, [](double) { return 4; })).empty());
  // Half a ring.
  VoxelShape          shape = VoxelsAround({ 36, 36, 8 }, { 1, 1, 1 }, { .2, .1, .3 }, [](const Vector3 & p) {
    return p[1] >= 0 && std::hypot(std::hypot(p[0], p[1]) - 30, p[2]) <= 5;
  });
  const ImageGeometry geometry = GridOf(shape, { 1, 1, 1 });
  EXPECT_TRUE(Lesions(MeasureBody(std::move(shape), geometry)).empty());
}

TEST(VesselLesions, NeedHealthyVesselBeyondBothEnds)
{
  const auto turn = std::array<Vector3, 3>{ Unit({ 3, 1, 2 }), Unit({ 1, -3, 0 }), Unit({ 6, 2, -10 }) };
  // A step is no lesion: nobody knows which side is ill. Nor is a tube that narrows to its end.
  EXPECT_TRUE(Lesions(Tube(turn, 80, 7, { 1, 1, 1 }, [](double along) { return along < 10 ? 7 : 4; })).empty());
  EXPECT_TRUE(
    Lesions(Tube(turn, 80, 7, { 1, 1, 1 }, [](double along) { return along < 20 ? 7.0 : 7 - 0.25 * (along - 20); }))
      .empty());
}

TEST(VesselLesions, BulgesHaveTheirDegree)
{
  const auto turn = std::array<Vector3, 3>{ Unit({ 3, 1, 2 }), Unit({ 1, -3, 0 }), Unit({ 6, 2, -10 }) };
  const auto lesions = Lesions(
    Tube(turn, 90, 9, { 1, 1, 1 }, [](double along) { return 5 * (1 + 0.6 * std::exp(-along * along / (2 * 36))); }));
  ASSERT_EQ(lesions.size(), 1U);
  EXPECT_EQ(lesions[0].kind, LesionKind::Bulge);
  EXPECT_NEAR(lesions[0].DegreeByDiameter(), 0.6, 0.03);
  EXPECT_NEAR(lesions[0].DegreeByArea(), 1.6 * 1.6 - 1, 0.1);
  EXPECT_NEAR(lesions[0].diameter, 16, 0.4);
}

TEST(VesselLesions, DomesHaveTheirNeckHeightAndVolume)
{
  // Of 40 random ones two are off, where the vessel's line bends into the dome, and one has no branch.
  std::mt19937_64 random(1);
  const auto      within = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int body = 0; body < 3; ++body)
  {
    const auto          turn = AnyTurn(random);
    const double        radius = within(4, 5);
    const double        ball = within(7, 9);
    const double        away = radius + within(0.6, 0.85) * ball; // of its middle from the vessel's axis
    const Vector3       middle = AddScaled({}, away - 8, turn[1]);
    VoxelShape          shape = VoxelsAround({ 48, 48, 48 }, { 1, 1, 1 }, { .2, .1, .3 }, [&](const Vector3 & p) {
      const double  along = Dot(p, turn[0]);
      const Vector3 aside = AddScaled(AddScaled(p, -along, turn[0]), 8, turn[1]);
      return (std::abs(along) <= 40 && Length(aside) <= radius) || Distance(p, middle) <= ball;
    });
    const ImageGeometry geometry = GridOf(shape, { 1, 1, 1 });
    const MeasuredBody  measured = MeasureBody(std::move(shape), geometry);
    const auto          lesions = Lesions(measured);
    ASSERT_EQ(lesions.size(), 1U) << radius << ", " << ball << ", " << away;
    const VesselLesion & one = lesions.front();
    EXPECT_EQ(one.kind, LesionKind::Dome);
    // The plane through the neck touches the vessel: below it sections run along the vessel, above it the ball widens.
    const double below = away - radius;
    const double height = ball + below;
    EXPECT_NEAR(one.neckWidth, 2 * std::sqrt(ball * ball - below * below), 1);
    EXPECT_NEAR(one.height, height, 1);
    EXPECT_NEAR(one.volume / (std::numbers::pi * height * height * (ball - height / 3)), 1, 0.05);
    EXPECT_NEAR(one.diameter, 2 * ball, 0.6);
    EXPECT_NEAR(one.reference, 2 * radius, 0.3);
    EXPECT_DOUBLE_EQ(one.AspectRatio(), one.height / one.neckWidth);
    EXPECT_TRUE(std::isnan(one.DegreeByDiameter()));
  }
}

} // namespace voxelcore::testing
