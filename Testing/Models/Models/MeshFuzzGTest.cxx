// Meshes of text with bits flipped: each is refused in one line or read as a mesh that fits together.

#include "Models/Models/ModelFixtures.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Models/ReadMesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

/** A prism of `sides`: triangles at its ends, quads around. */
struct Prism
{
  std::vector<std::array<double, 3>> points;
  std::vector<std::vector<int>>      faces;

  explicit Prism(int sides)
  {
    for (int i = 0; i < 2 * sides; ++i)
    {
      const double turn = 2 * M_PI * (i % sides) / sides;
      points.push_back({ std::cos(turn), std::sin(turn), i < sides ? 0.0 : 1.5 });
    }
    for (int i = 0; i < sides; ++i)
    {
      const int next = (i + 1) % sides;
      faces.push_back({ i, next, sides + next, sides + i });
    }
    for (int i = 2; i < sides; ++i)
    {
      faces.push_back({ 0, i, i - 1 });
      faces.push_back({ sides, sides + i - 1, sides + i });
    }
  }

  std::string
  AsOff() const
  {
    std::ostringstream text;
    text << "OFF\n" << points.size() << ' ' << faces.size() << " 0\n";
    for (const auto & p : points)
    {
      text << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    }
    for (const auto & face : faces)
    {
      text << face.size();
      for (const int corner : face)
      {
        text << ' ' << corner;
      }
      text << '\n';
    }
    return text.str();
  }

  std::string
  AsObj() const
  {
    std::ostringstream text;
    for (const auto & p : points)
    {
      text << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    }
    for (const auto & face : faces)
    {
      text << 'f';
      for (const int corner : face)
      {
        text << ' ' << corner + 1;
      }
      text << '\n';
    }
    return text.str();
  }
};

/** Reads `bytes` with 1 to 3 bits flipped, again and again; returns how often that was refused. */
int
Fuzz(const TemporaryFolder & folder, const std::string & name, const std::string & bytes, int runs)
{
  constexpr std::uint64_t seed = 8;
  std::mt19937_64         random(seed);
  std::cout << name << ": seed " << seed << "\n";
  int refused = 0;
  ::testing::internal::CaptureStderr();
  for (int run = 0; run < runs; ++run)
  {
    std::string damaged = bytes;
    for (std::uint64_t flips = 1 + random() % 3; flips > 0; --flips)
    {
      damaged[random() % damaged.size()] ^= static_cast<char>(1U << (random() % 8));
    }
    {
      std::ofstream(folder / name, std::ios::binary) << damaged;
    }
    try
    {
      const MeshFile read = ReadMesh(folder / name);
      for (const auto & point : read.mesh.points)
      {
        EXPECT_TRUE(std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]))
          << name << " " << run;
      }
      for (const auto & triangle : read.mesh.triangles)
      {
        for (const std::uint32_t corner : triangle)
        {
          EXPECT_LT(corner, read.mesh.points.size()) << name << " " << run;
        }
      }
    }
    catch (const InputError & error)
    {
      ++refused;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << name;
  return refused;
}

TEST(MeshFuzz, FlippedBitsInTextsNeverCrashNorPrint)
{
  const TemporaryFolder folder;
  const Prism           prism(9);
  EXPECT_GT(Fuzz(folder, "bad.off", prism.AsOff(), 400), 40);
  EXPECT_GT(Fuzz(folder, "bad.obj", prism.AsObj(), 400), 40);
}

} // namespace
