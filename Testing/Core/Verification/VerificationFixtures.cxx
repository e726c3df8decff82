#include "Core/Verification/VerificationFixtures.h"

#include "voxelcore/VoxelCore/LambdaPruning.h"
#include "voxelcore/VoxelCore/VoxelCore.h"

#include <random>
#include <sstream>

namespace voxelcore::testing
{

VoxelShape
MakeShape(const std::array<std::int32_t, 3> &                                   size,
          const std::function<bool(std::int32_t, std::int32_t, std::int32_t)> & isIn,
          const std::array<std::int32_t, 3> &                                   lower)
{
  VoxelShape shape({ lower, size });
  for (std::int32_t z = 0; z < size[2]; ++z)
  {
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      for (std::int32_t x = 0; x < size[0]; ++x)
      {
        if (isIn(x, y, z))
        {
          shape.Insert(lower[0] + x, lower[1] + y, lower[2] + z);
        }
      }
    }
  }
  return shape;
}

VoxelShape
SolidBox(const std::array<std::int32_t, 3> & size)
{
  return MakeShape(size, [](std::int32_t, std::int32_t, std::int32_t) { return true; });
}

VoxelShape
RandomShape(std::uint32_t seed, const std::array<std::int32_t, 3> & size, unsigned percent)
{
  std::mt19937                      generator(seed);
  const auto                        low = [&] { return static_cast<std::int32_t>(generator() % 41) - 20; };
  const std::array<std::int32_t, 3> lower{ low(), low(), low() };
  return MakeShape(
    size,
    [&](std::int32_t, std::int32_t, std::int32_t) { return generator() % 100 < percent; },
    lower);
}

VoxelShape
EllipsoidWithRod()
{
  return MakeShape({ 24, 12, 9 }, [](std::int32_t x, std::int32_t y, std::int32_t z) {
    const double a = (x + 0.5 - 8) / 7.2;
    const double b = (y + 0.5 - 6) / 5.4;
    const double c = (z + 0.5 - 4.5) / 3.6;
    return a * a + b * b + c * c <= 1 || (x > 8 && y == 6 && z == 4);
  });
}

VerificationCase
MakeCase(VoxelShape shape, const std::array<double, 3> & spacing, double threshold)
{
  VerificationCase subject{ std::move(shape), ComputeSpacingWeights(spacing), {}, std::nullopt };
  subject.spacing = spacing;
  subject.core = ComputeVoxelCore(subject.shape, subject.weights);
  if (threshold > 0)
  {
    subject.core = PruneByLambda(subject.core, { threshold }).front();
    subject.threshold = threshold;
  }
  return subject;
}

VerificationInput
InputOf(const VerificationCase & subject)
{
  VerificationInput input;
  input.shape = &subject.shape;
  input.weights = subject.weights;
  input.spacing = subject.spacing;
  input.cells = &subject.core.cells;
  input.positions = subject.core.positions;
  input.radius = subject.core.radius;
  input.vertexLambda = subject.core.vertexLambda;
  input.edgeLambda = subject.core.edgeLambda;
  input.faceLambda = subject.core.faceLambda;
  input.positionTolerance = subject.positionTolerance;
  input.polygonsReversed = subject.polygonsReversed;
  input.threshold = subject.threshold;
  return input;
}

VerificationReport
Verify(const VerificationCase & subject)
{
  return VerifyComplex(InputOf(subject));
}

std::vector<std::string>
FailedChecks(const VerificationReport & report)
{
  std::vector<std::string> failed;
  for (const VerificationCheck & check : report.checks)
  {
    if (!check.passed)
    {
      failed.push_back(check.name);
    }
  }
  return failed;
}

std::string
Summary(const VerificationReport & report)
{
  std::ostringstream text;
  for (const VerificationCheck & check : report.checks)
  {
    if (!check.passed)
    {
      text << "  " << check.name << ": " << check.offenders << " offenders. " << check.firstOffender << "\n";
    }
  }
  return text.str();
}

} // namespace voxelcore::testing
