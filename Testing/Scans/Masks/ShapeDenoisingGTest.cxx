// Denoising against its definition, and what it leaves of thin rods.

#include "voxelcore/Base/Error.h"
#include "voxelcore/Masks/ShapeDenoising.h"
#include "voxelcore/Masks/ShapeMedian.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace voxelcore::testing
{
namespace
{

using At = std::array<std::int32_t, 3>;

void
ForEach(const VoxelBox & box, const std::function<void(const At &)> & visit)
{
  for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
  {
    for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
    {
      for (std::int32_t x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
      {
        visit({ x, y, z });
      }
    }
  }
}

/** A field with room around it, blurred by a Gaussian along each axis. */
class BlurredField
{
public:
  explicit BlurredField(const VoxelShape & shape)
    : m_Lower(shape.Box().lower)
    , m_Size(shape.Box().size)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      m_Lower[axis] -= kRoom;
      m_Size[axis] += 2 * kRoom;
    }
    ForEach({ m_Lower, m_Size },
            [&](const At & at) { m_Values.push_back(shape.Contains(at[0], at[1], at[2]) ? 1 : 0); });
  }

  double
  Value(const At & at) const
  {
    return m_Values[Number({ at[0] - m_Lower[0], at[1] - m_Lower[1], at[2] - m_Lower[2] })];
  }

  /** f becomes f + G (whole - f). */
  void
  AddBlurOfWhatIsLeft(const BlurredField & whole, const Vector3 & deviation)
  {
    std::vector<double> left(m_Values.size());
    for (std::size_t i = 0; i < left.size(); ++i)
    {
      left[i] = whole.m_Values[i] - m_Values[i];
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      left = Blurred(left, axis, deviation[axis]);
    }
    for (std::size_t i = 0; i < left.size(); ++i)
    {
      m_Values[i] += left[i];
    }
  }

  void
  Clear()
  {
    std::fill(m_Values.begin(), m_Values.end(), 0.0);
  }

private:
  static constexpr std::int32_t kRoom = 12;

  std::size_t
  Number(const At & at) const
  {
    return static_cast<std::size_t>((at[2] * m_Size[1] + at[1]) * m_Size[0] + at[0]);
  }

  std::vector<double>
  Blurred(const std::vector<double> & values, std::size_t axis, double deviation) const
  {
    std::vector<double> blurred(values.size(), 0);
    double              sum = 0;
    for (int i = -4; i <= 4; ++i)
    {
      sum += std::exp(-0.5 * i * i / (deviation * deviation));
    }
    ForEach({ { 0, 0, 0 }, m_Size }, [&](const At & at) {
      for (int i = -4; i <= 4; ++i)
      {
        At from = at;
        from[axis] += i;
        if (from[axis] >= 0 && from[axis] < m_Size[axis])
        {
          blurred[Number(at)] += std::exp(-0.5 * i * i / (deviation * deviation)) / sum * values[Number(from)];
        }
      }
    });
    return blurred;
  }

  At                  m_Lower;
  At                  m_Size;
  std::vector<double> m_Values;
};

VoxelShape
Noise(std::mt19937_64 & generator, const VoxelBox & box)
{
  VoxelShape shape(box);
  const At   middle{ box.lower[0] + box.size[0] / 2, box.lower[1] + box.size[1] / 2, 0 };
  ForEach(box, [&](const At & at) {
    // A rod along z, and noise all over.
    const bool inRod = std::hypot(at[0] - middle[0], at[1] - middle[1]) < 4;
    if (std::bernoulli_distribution(inRod ? 0.8 : 0.2)(generator))
    {
      shape.Insert(at[0], at[1], at[2]);
    }
  });
  return shape;
}

TEST(DenoiseShape, IsTheMajorityByTheGaussianTwiceTwiced)
{
  const std::uint64_t seed = std::random_device{}();
  std::mt19937_64     generator(seed);
  std::size_t         compared = 0;
  for (const Vector3 & spacing : { Vector3{ 1, 1, 1 }, Vector3{ 0.5, 0.5, 1 }, Vector3{ 3, 1, 1.5 } })
  {
    const VoxelBox     box{ { -3, 70, 5 }, { 70, 21, 19 } };
    const VoxelShape   shape = Noise(generator, box);
    const VoxelShape   denoised = DenoiseShape(shape, spacing).shape;
    const double       side = std::min(std::cbrt(spacing[0] * spacing[1] * spacing[2]),
                                 1.3 * *std::min_element(spacing.begin(), spacing.end()));
    const Vector3      deviation{ side / spacing[0], side / spacing[1], side / spacing[2] };
    const BlurredField whole(shape);
    BlurredField       field(shape);
    field.Clear();
    for (int round = 0; round < 3; ++round)
    {
      field.AddBlurOfWhatIsLeft(whole, deviation);
    }
    ForEach(box, [&](const At & at) {
      // Weights are rounded.
      const double value = field.Value(at);
      if (std::abs(value - 0.5) > 0.03)
      {
        ++compared;
        ASSERT_EQ(denoised.Contains(at[0], at[1], at[2]), value > 0.5)
          << "seed " << seed << ", at " << at[0] << " " << at[1] << " " << at[2] << ", " << value;
      }
    });
  }
  EXPECT_GT(compared, 60000U);
}

/** Rods of a radius of 2.5 mm in slices 2 mm thick, a quarter of the voxels at their boundary flipped. */
struct Rod
{
  VoxelShape clean{ VoxelBox{ { 0, 0, 0 }, { 90, 40, 20 } } };
  VoxelShape noisy = clean;

  Rod(std::mt19937_64 & generator, double turn)
  {
    std::bernoulli_distribution flips(0.25);
    const Vector3               way{ std::cos(turn), std::sin(turn), 0 };
    const auto                  isIn = [&](const At & at) {
      const Vector3 from{ at[0] - 15.0, at[1] - 12.0, 2 * at[2] - 20.0 };
      const double  along = std::clamp(Dot(from, way), 0.0, 55.0);
      return Length(AddScaled(from, -along, way)) <= 2.5;
    };
    ForEach(clean.Box(), [&](const At & at) {
      const bool here = isIn(at);
      bool       isAtBoundary = false;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        for (const int step : { -1, 1 })
        {
          At next = at;
          next[axis] += step;
          isAtBoundary = isAtBoundary || isIn(next) != here;
        }
      }
      if (here)
      {
        clean.Insert(at[0], at[1], at[2]);
      }
      if (here != (isAtBoundary && flips(generator)))
      {
        noisy.Insert(at[0], at[1], at[2]);
      }
    });
  }
};

TEST(DenoiseShape, LeavesThinRodsInThickSlicesTheirVolumeWhereAMedianTakesATenth)
{
  const std::uint64_t seed = std::random_device{}();
  std::mt19937_64     generator(seed);
  double              kept = 0;
  double              keptByMedian = 0;
  double              wrong = 0;
  double              wrongBefore = 0;
  constexpr int       rods = 12;
  for (int run = 0; run < rods; ++run)
  {
    const Rod        rod(generator, 0.4 * run / rods);
    const VoxelShape denoised = DenoiseShape(rod.noisy, { 1, 1, 2 }).shape;
    const auto       all = static_cast<double>(rod.clean.CountVoxels());
    kept += static_cast<double>(denoised.CountVoxels()) / all / rods;
    keptByMedian += static_cast<double>(MedianShape(rod.noisy, { 3 }).shape.CountVoxels()) / all / rods;
    ForEach(rod.clean.Box(), [&](const At & at) {
      const bool truth = rod.clean.Contains(at[0], at[1], at[2]);
      wrong += denoised.Contains(at[0], at[1], at[2]) != truth;
      wrongBefore += rod.noisy.Contains(at[0], at[1], at[2]) != truth;
    });
  }
  EXPECT_NEAR(kept, 0.96, 0.04) << "seed " << seed;
  EXPECT_LT(keptByMedian, 0.9) << "seed " << seed;
  EXPECT_LT(wrong, 0.6 * wrongBefore) << "seed " << seed;
}

TEST(DenoiseShape, TurnsWithTheShape)
{
  const std::uint64_t seed = std::random_device{}();
  std::mt19937_64     generator(seed);
  const VoxelBox      box{ { 0, 0, 0 }, { 33, 20, 17 } };
  const VoxelShape    shape = Noise(generator, box);
  const VoxelBox      turnedBox{ { 5, 6, 7 }, { 17, 33, 20 } };
  const auto          turned = [](const At & at) { return At{ 5 + at[2], 6 + 32 - at[0], 7 + at[1] }; };
  VoxelShape          other(turnedBox);
  ForEach(box, [&](const At & at) {
    if (shape.Contains(at[0], at[1], at[2]))
    {
      const At to = turned(at);
      other.Insert(to[0], to[1], to[2]);
    }
  });
  const EditedShape a = DenoiseShape(shape, { 1, 1, 2 });
  const EditedShape b = DenoiseShape(other, { 2, 1, 1 });
  EXPECT_EQ(a.voxelsAdded, b.voxelsAdded);
  EXPECT_EQ(a.voxelsRemoved, b.voxelsRemoved);
  ForEach(box, [&](const At & at) {
    const At to = turned(at);
    ASSERT_EQ(a.shape.Contains(at[0], at[1], at[2]), b.shape.Contains(to[0], to[1], to[2])) << "seed " << seed;
  });
}

TEST(DenoiseShape, LeavesFlatWallsAndNothing)
{
  VoxelShape slab({ { 0, 0, 0 }, { 64, 40, 40 } });
  ForEach({ { 0, 0, 10 }, { 64, 40, 3 } }, [&](const At & at) { slab.Insert(at[0], at[1], at[2]); });
  const EditedShape denoised = DenoiseShape(slab, { 1, 1, 1 });
  EXPECT_EQ(denoised.voxelsAdded, 0U);
  // Its sharp corners go, nothing of its sides.
  EXPECT_LT(denoised.voxelsRemoved, 24U);
  EXPECT_EQ(DenoiseShape(VoxelShape(), { 1, 1, 1 }).shape.CountVoxels(), 0U);
  EXPECT_THROW(DenoiseShape(slab, { 1, 1, 1 }, [](std::string_view, double) { return false; }), Cancelled);
}

} // namespace
} // namespace voxelcore::testing
