#include "VoxelCoreTesting/Shapes.h"
#include "VoxelCoreTesting/Threads.h"

#include "voxelcore/FittedBalls.h"
#include "voxelcore/Vectors.h"

#include <gtest/gtest.h>

#include <functional>

namespace voxelcore
{
namespace
{

using testing::ShapeWhere;
using testing::Spacing3;

constexpr double kLong = 40; ///< mm along each axis

/** What is within a body, given in mm from the middle of the scan, made voxels. */
struct Body
{
  Body(const Spacing3 & spacing, const std::function<bool(const Vector3 &)> & inside)
    : weights(ComputeSpacingWeights(spacing))
  {
    std::array<std::int32_t, 3> size{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      sides[axis] = static_cast<double>(weights.weight[axis]) * weights.unit;
      size[axis] = static_cast<std::int32_t>(std::ceil(kLong / sides[axis]));
      middle[axis] = 0.5 * size[axis] + 0.1 * static_cast<double>(axis);
    }
    shape = ShapeWhere(size, [&](int x, int y, int z) {
      return inside(Times(Minus({ x + 0.5, y + 0.5, z + 0.5 }, middle), sides));
    });
  }
  void
  AddBall(const Vector3 & place, double radius)
  {
    balls.Add(AddScaled(middle, 1, Over(place, sides)), radius, radius);
    cells.vertexCount = balls.Count();
  }
  void
  Fit()
  {
    FitBalls(shape, weights, cells, balls);
  }

  SpacingWeights weights;
  Vector3        sides{};
  Vector3        middle{};
  VoxelShape     shape;
  CellComplex    cells;
  PaintingBalls  balls;
};

const Vector3 kAlong{ 2.0 / 3, 1.0 / 3, 2.0 / 3 };
const Vector3 kAcross{ -1 / std::sqrt(5.0), 2 / std::sqrt(5.0), 0 };

const std::array<Spacing3, 3> kSpacings{ { { 1, 1, 1 }, { 1, 1, 2.5 }, { 0.7, 1.1, 0.9 } } };

/** Balls 1 mm apart on a line, the ends of which lie in the body's ends. */
Body
Rod(const Spacing3 & spacing, double thick, double radius)
{
  Body body(spacing, [&](const Vector3 & p) {
    const double along = Dot(p, kAlong);
    return std::abs(along) < 16 && Length(AddScaled(p, -along, kAlong)) < thick;
  });
  for (int i = -15; i <= 15; ++i)
  {
    body.AddBall(AddScaled({ 0, 0, 0 }, i, kAlong), radius);
    if (i > -15)
    {
      body.cells.edges.push_back({ static_cast<ElementIndex>(i + 14), static_cast<ElementIndex>(i + 15) });
    }
  }
  return body;
}

/** The same without the voxels, in another body. */
void
AddLine(Body & body, const Vector3 & aside, const std::function<double(int)> & radius)
{
  for (int i = -15; i <= 15; ++i)
  {
    body.AddBall(AddScaled(aside, i, kAlong), radius(i));
    if (i > -15)
    {
      const auto last = static_cast<ElementIndex>(body.balls.Count() - 1);
      body.cells.edges.push_back({ last - 1, last });
    }
  }
}

/** A disc of triangles 1.5 mm apart, as far off the middle of a disc that is flat at its rim. */
Body
Disc(const Spacing3 & spacing, double half, double radius, double off)
{
  const Vector3                              other = Cross(kAlong, kAcross);
  Body                                       body(spacing, [&](const Vector3 & p) {
    return std::abs(Dot(p, kAlong)) < half && std::hypot(Dot(p, kAcross), Dot(p, other)) < 15;
  });
  constexpr int                              count = 8;
  std::map<std::array<int, 2>, ElementIndex> numbers;
  for (int j = -count; j <= count; ++j)
  {
    for (int i = -count; i <= count; ++i)
    {
      if (i * i + j * j <= count * count)
      {
        numbers[{ i, j }] = static_cast<ElementIndex>(body.balls.Count());
        body.AddBall(AddScaled(AddScaled(AddScaled({ 0, 0, 0 }, 1.5 * i, kAcross), 1.5 * j, other), off, kAlong),
                     radius);
      }
    }
  }
  std::map<std::array<ElementIndex, 2>, ElementIndex> edges;
  const auto                                          edge = [&](ElementIndex a, ElementIndex b) {
    const auto [at, isNew] =
      edges.emplace(std::array{ std::min(a, b), std::max(a, b) }, static_cast<ElementIndex>(edges.size()));
    if (isNew)
    {
      body.cells.edges.push_back(at->first);
    }
    return at->second;
  };
  const auto face = [&](const std::array<std::array<int, 2>, 3> & corners) {
    std::array<ElementIndex, 3> at{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      const auto found = numbers.find(corners[i]);
      if (found == numbers.end())
      {
        return;
      }
      at[i] = found->second;
    }
    for (std::size_t i = 0; i < 3; ++i)
    {
      body.cells.faceVertices.push_back(at[i]);
      body.cells.faceEdges.push_back(edge(at[i], at[(i + 1) % 3]));
    }
    body.cells.faceOffsets.push_back(body.cells.faceVertices.size());
  };
  for (const auto & [at, number] : numbers)
  {
    const auto [i, j] = at;
    face({ { { i, j }, { i + 1, j }, { i + 1, j + 1 } } });
    face({ { { i, j }, { i + 1, j + 1 }, { i, j + 1 } } });
  }
  return body;
}

TEST(FittedBalls, OneBallHoldsWhatItsVoxelsDo)
{
  for (const Spacing3 & spacing : kSpacings)
  {
    for (const double radius : { 2.0, 3.0, 6.0, 10.0 })
    {
      for (const double off : { -1.0, 0.0, 0.5 })
      {
        Body body(spacing, [&](const Vector3 & p) { return Length(p) < radius; });
        body.AddBall({ 0.3, 0, off / 2 }, radius + off);
        body.Fit();
        const double volume =
          static_cast<double>(body.shape.CountVoxels()) * body.sides[0] * body.sides[1] * body.sides[2];
        EXPECT_NEAR(body.balls.radius[0], std::cbrt(volume * 3 / 4 / 3.14159265358979), 0.1)
          << spacing[2] << ' ' << radius << ' ' << off;
        EXPECT_EQ(body.balls.value, body.balls.radius);
      }
    }
  }
}

TEST(FittedBalls, RodsGetTheirThicknessAndTheirEndsHaveNoSay)
{
  for (const Spacing3 & spacing : kSpacings)
  {
    for (const double off : { -0.7, 0.0, 0.4 })
    {
      Body body = Rod(spacing, 3.2, 3.2 + off);
      body.Fit();
      for (const double radius : body.balls.radius)
      {
        EXPECT_NEAR(radius, 3.2, 0.1) << spacing[2] << ' ' << off;
      }
    }
  }
}

TEST(FittedBalls, ThinRodsGetTheirThicknessThoughTheirBallsAreUneven)
{
  for (const Spacing3 & spacing : kSpacings)
  {
    const double thick = 0.6 * (spacing[2] + spacing[0]);
    Body         body(spacing, [&](const Vector3 & p) {
      const double along = Dot(p, kAlong);
      return std::abs(along) < 16 && Length(AddScaled(p, -along, kAlong)) < thick;
    });
    AddLine(body, { 0, 0, 0 }, [&](int i) { return thick - 0.3 + (i % 4 < 2 ? 0.2 : -0.2) * spacing[2]; });
    body.Fit();
    for (const double radius : body.balls.radius)
    {
      EXPECT_NEAR(radius, thick, 0.16 * spacing[2]) << spacing[2];
    }
  }
}

TEST(FittedBalls, RodsBesideEachOtherKeepTheirOwnThickness)
{
  const std::array<double, 2> thick{ 2, 3.5 };
  for (const Spacing3 & spacing : kSpacings)
  {
    const auto aside = [&](std::size_t which) { return AddScaled({ 0, 0, 0 }, which == 0 ? 4 : -4, kAcross); };
    Body       body(spacing, [&](const Vector3 & p) {
      const double along = Dot(p, kAlong);
      const auto   away = AddScaled(p, -along, kAlong);
      return std::abs(along) < 16 && (Distance(away, aside(0)) < thick[0] || Distance(away, aside(1)) < thick[1]);
    });
    AddLine(body, aside(0), [](int) { return 2.8; });
    AddLine(body, aside(1), [](int) { return 2.8; });
    body.Fit();
    for (std::size_t i = 0; i < body.balls.Count(); ++i)
    {
      EXPECT_NEAR(body.balls.radius[i], thick[i < 31 ? 0 : 1], 0.15) << spacing[2] << ' ' << i;
    }
  }
}

/** A line of balls 1 mm apart. */
void
AddStraight(Body & body, const Vector3 & from, const Vector3 & to, double radius)
{
  const int count = static_cast<int>(Distance(from, to));
  for (int i = 0; i <= count; ++i)
  {
    body.AddBall(AddScaled(from, static_cast<double>(i) / count, Minus(to, from)), radius);
    if (i > 0)
    {
      const auto last = static_cast<ElementIndex>(body.balls.Count() - 1);
      body.cells.edges.push_back({ last - 1, last });
    }
  }
}

TEST(FittedBalls, APlateThatThickSlicesCutIntoStripsIsAsThickAsItsVolumeByItsArea)
{
  for (const double tilt : { 0.4, 0.7 })
  {
    const Vector3 normal{ 0.6 * std::sin(tilt), 0.8 * std::sin(tilt), std::cos(tilt) };
    Body          body({ 1, 1, 2.5 }, [&](const Vector3 & p) {
      return std::abs(Dot(p, normal)) < 1 && Length(AddScaled(p, -Dot(p, normal), normal)) < 15;
    });
    const Vector3 level{ 0.8, -0.6, 0 };
    const Vector3 steep = Cross(normal, level);
    for (int slice = -2; slice <= 2; ++slice)
    {
      const double  height = (slice - body.middle[2] + std::floor(body.middle[2]) + 0.5) * body.sides[2];
      const Vector3 place = AddScaled({ 0, 0, 0 }, height / steep[2], steep);
      if (Length(place) < 13)
      {
        const double half = std::sqrt(169 - Dot(place, place));
        AddStraight(body, AddScaled(place, -half, level), AddScaled(place, half, level), 1.6);
      }
    }
    body.Fit();
    double sum = 0;
    for (const double radius : body.balls.radius)
    {
      EXPECT_NEAR(radius, 1, 0.2) << tilt;
      sum += radius;
    }
    EXPECT_NEAR(sum / static_cast<double>(body.balls.Count()), 1, 0.1) << tilt;
  }
}

TEST(FittedBalls, AKnobOnAThinPlateStaysThickerThanThePlate)
{
  Body body({ 1, 1, 2.5 },
            [&](const Vector3 & p) { return (std::abs(p[0]) < 1 && std::hypot(p[1], p[2]) < 15) || Length(p) < 3; });
  for (int i = -4; i <= 4; ++i)
  {
    AddStraight(body, { 0, 3.0 * i, -12 }, { 0, 3.0 * i, 12 }, 1.2);
  }
  const std::size_t knob = 4 * 25 + 12;
  body.balls.radius[knob] = 3;
  body.Fit();
  EXPECT_GT(body.balls.radius[knob], 2.5);
  EXPECT_NEAR(body.balls.radius.front(), 1, 0.1);
}

TEST(FittedBalls, ThinRodsThatMeetInThickSlicesAreNoPlate)
{
  const Vector3 x{ 1, 0, 0 };
  const Vector3 y{ 0, 1, 0 };
  const Vector3 z{ 0, 0, 1 };
  const Vector3 other = Cross(kAlong, kAcross);
  const auto    back = [](const Vector3 & way) { return AddScaled({ 0, 0, 0 }, -1, way); };
  const auto    aslant = [&](double part) { return AddScaled(AddScaled({ 0, 0, 0 }, -0.5, x), part, y); };
  const std::array<std::vector<Vector3>, 7> bodies{ {
    { x, back(x) },
    { kAcross, back(kAcross) },
    { x, back(x), y, back(y) },
    { kAcross, back(kAcross), other, back(other) },
    { x, aslant(std::sqrt(0.75)), aslant(-std::sqrt(0.75)) },
    { x, y, z },
    { kAlong, back(kAlong), kAcross, back(kAcross), other, back(other) },
  } };
  for (const auto & rods : bodies)
  {
    const Vector3 between{ 0, 0, -0.5 }; // two slices
    Body          body({ 1, 1, 2.5 }, [&](const Vector3 & p) {
      const Vector3 from = Minus(p, between);
      return std::any_of(rods.begin(), rods.end(), [&](const Vector3 & rod) {
        const double along = Dot(from, rod);
        return along > -1 && along < 16 && Length(AddScaled(from, -along, rod)) < 1.5;
      });
    });
    for (const Vector3 & rod : rods)
    {
      AddStraight(body, between, AddScaled(between, 15, rod), 1.5);
    }
    body.Fit();
    for (const double radius : body.balls.radius)
    {
      EXPECT_GT(radius, 1.2) << (&rods - bodies.data());
    }
  }
}

TEST(FittedBalls, LinesOnTheRimOfAWallAreAsThickAsTheWall)
{
  for (const Spacing3 & spacing : kSpacings)
  {
    Body       body = Disc(spacing, 3, 2.8, 0);
    const auto count = static_cast<ElementIndex>(body.balls.Count());
    const auto hang =
      static_cast<ElementIndex>(std::max_element(body.balls.centres.begin(),
                                                 body.balls.centres.end(),
                                                 [&](const Vector3 & a, const Vector3 & b) {
                                                   const auto out = [&](const Vector3 & p) {
                                                     return Dot(Times(Minus(p, body.middle), body.sides), kAcross);
                                                   };
                                                   return out(a) < out(b);
                                                 }) -
                                body.balls.centres.begin());
    for (ElementIndex i = 0; i < 2; ++i)
    {
      const Vector3 step = AddScaled({ 0, 0, 0 }, 12.2 + 0.2 * i, kAcross);
      body.AddBall(step, 3.5);
      body.cells.edges.push_back({ i == 0 ? hang : count + i - 1, count + i });
    }
    body.Fit();
    for (std::size_t i = 0; i < body.balls.Count(); ++i)
    {
      EXPECT_NEAR(body.balls.radius[i], 3, 0.25) << spacing[2] << ' ' << i;
    }
  }
}

TEST(FittedBalls, WallsGetTheirThicknessThoughTheirCoreLiesAside)
{
  for (const Spacing3 & spacing : kSpacings)
  {
    for (const double off : { -0.4, 0.0, 0.4 })
    {
      for (const double aside : { 0.0, 0.3 })
      {
        Body body = Disc(spacing, 3, 3 + off, aside);
        body.Fit();
        double sum = 0;
        for (const double radius : body.balls.radius)
        {
          EXPECT_NEAR(radius, 3, 0.25) << spacing[2] << ' ' << off << ' ' << aside;
          sum += radius;
        }
        EXPECT_NEAR(sum / static_cast<double>(body.balls.Count()), 3, 0.1) << spacing[2] << ' ' << off << ' ' << aside;
      }
    }
  }
}

TEST(FittedBalls, ShrinkByHalfAndGrowByAVoxelAtMost)
{
  Body small({ 1, 1, 1 }, [](const Vector3 & p) { return Length(p) < 2; });
  small.AddBall({ 0, 0, 0 }, 8);
  small.Fit();
  EXPECT_EQ(small.balls.radius[0], 4);
  Body large({ 1, 1, 1 }, [](const Vector3 & p) { return Length(p) < 8; });
  large.AddBall({ 0, 0, 0 }, 2);
  large.Fit();
  EXPECT_EQ(large.balls.radius[0], 3);
  Body none({ 1, 1, 1 }, [](const Vector3 & p) { return Length(p) < 8; });
  none.Fit();
  EXPECT_EQ(none.balls.Count(), 0U);
}

TEST(FittedBalls, AreTheSameForEveryNumberOfThreads)
{
  Body one = Disc({ 1, 1, 2.5 }, 3, 2.7, 0.2);
  Body four = one;
  {
    const testing::Threads threads(1);
    one.Fit();
  }
  const testing::Threads threads(4);
  four.Fit();
  EXPECT_EQ(one.balls.radius, four.balls.radius);
}

TEST(FittedBalls, StopWhenAsked)
{
  Body body = Rod({ 1, 1, 1 }, 3, 3);
  EXPECT_THROW(
    FitBalls(body.shape, body.weights, body.cells, body.balls, [](std::string_view, double) { return false; }),
    Cancelled);
}

} // namespace
} // namespace voxelcore
