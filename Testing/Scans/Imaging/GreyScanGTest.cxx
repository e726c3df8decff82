// Grey scans told from label volumes.

#include "ScanBytes.h"
#include "voxelcore/Labels/GreyScan.h"

#include <cmath>
#include <cstdlib>
#include <random>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

constexpr int kSide = 48;

/** A volume of kSide^3 voxels, each given by its place. */
template <typename T, typename Value>
std::string
Volume(const std::string & type, const Value & value)
{
  std::vector<T> voxels;
  for (int z = 0; z < kSide; ++z)
  {
    for (int y = 0; y < kSide; ++y)
    {
      for (int x = 0; x < kSide; ++x)
      {
        voxels.push_back(static_cast<T>(value(x, y, z)));
      }
    }
  }
  return Nrrd(NrrdLines(type, { kSide, kSide, kSide }), RawAll<T>(voxels));
}

double
FromCentre(double x, double y, double z)
{
  constexpr double middle = (kSide - 1) / 2.0;
  return std::hypot(x - middle, y - middle, z - middle);
}

class GreyScans : public ::testing::Test
{
protected:
  GreyScans()
  {
    m_Options.refuseGrey = true;
  }

  /** What was found; nothing where it passes as labels. */
  std::optional<GreyScan>
  Look(const std::string & bytes, const ReadOptions & options) const
  {
    return LookAt(m_Folder.Write("a.nrrd", bytes), options);
  }
  static std::optional<GreyScan>
  LookAt(const std::filesystem::path & path, const ReadOptions & options)
  {
    try
    {
      ReadLabelVolume(path, options);
      return std::nullopt;
    }
    catch (const GreyScanError & error)
    {
      EXPECT_NE(std::string(error.what()).find("looks like a grey scan"), std::string::npos);
      EXPECT_EQ(error.scan.geometry.spacing[0] > 0, true);
      return error.grey;
    }
  }

  const TempFolder m_Folder;
  ReadOptions      m_Options;
  std::mt19937     m_Random{ 20 };
};

} // namespace

TEST_F(GreyScans, OfABallInNoiseAreFoundWithAThresholdThatCutsItOut)
{
  std::normal_distribution<double> noise(0, 8);
  const auto                       ball = [&](int x, int y, int z) { return FromCentre(x, y, z) < 14 ? 160.0 : 60.0; };
  const auto                       check = [&](const std::string & bytes, double scale, double base) {
    const auto grey = Look(bytes, m_Options);
    ASSERT_TRUE(grey.has_value());
    EXPECT_GT(grey->otsu, base + scale * 85);
    EXPECT_LT(grey->otsu, base + scale * 135);
    EXPECT_GE(grey->distinct, 24U);
    EXPECT_LT(grey->equal, 0.3);
    ASSERT_EQ(grey->edges.size(), grey->counts.size() + 1);
    // What is proposed is the ball.
    ReadOptions       chosen;
    const std::string range = ProposedRange(*grey);
    EXPECT_TRUE(range.ends_with(":inf")) << range;
    chosen.threshold = { std::stod(range), INFINITY };
    const double expected = 4.0 / 3.0 * 3.14159265 * 14 * 14 * 14;
    EXPECT_NEAR(
      static_cast<double>(Look(bytes, chosen) ? 0 : ReadLabelVolume(m_Folder / "a.nrrd", chosen).labels[0].voxels),
      expected,
      0.03 * expected);
  };
  check(
    Volume<std::uint8_t>("uint8", [&](int x, int y, int z) { return std::lround(ball(x, y, z) + noise(m_Random)); }),
    1,
    0);
  check(
    Volume<std::uint16_t>("uint16",
                          [&](int x, int y, int z) { return std::lround(200 * (ball(x, y, z) + noise(m_Random))); }),
    200,
    0);
  // In Hounsfield units, below 0 where there is air; and fractions, which are no labels either.
  check(Volume<std::int16_t>(
          "int16",
          [&](int x, int y, int z) { return std::lround(10 * (ball(x, y, z) + noise(m_Random)) - 1024); }),
        10,
        -1024);
  check(Volume<float>("float", [&](int x, int y, int z) { return (ball(x, y, z) + noise(m_Random)) / 1000; }),
        0.001,
        0);
}

TEST_F(GreyScans, WithoutNoiseOrClippedOrCutOutAreFoundToo)
{
  std::normal_distribution<double> noise(0, 12);
  EXPECT_TRUE(
    Look(Volume<std::uint8_t>("uint8", [](int x, int y, int z) { return 3 * FromCentre(x, y, z); }), m_Options));
  EXPECT_TRUE(Look(Volume<std::uint16_t>("uint16", [](int x, int y, int z) { return 9 * x + 5 * y + z; }), m_Options));
  // A brain cut out of its skull: nothing around it; and clipped at both ends.
  EXPECT_TRUE(Look(Volume<std::uint8_t>("uint8",
                                        [&](int x, int y, int z) {
                                          return FromCentre(x, y, z) > 16 ? 0 : std::lround(120 + noise(m_Random));
                                        }),
                   m_Options));
  EXPECT_TRUE(Look(Volume<std::uint8_t>("uint8",
                                        [&](int x, int y, int z) {
                                          const double value = FromCentre(x, y, z) < 16 ? 250 : 20;
                                          return std::clamp(value + 2 * noise(m_Random), 1.0, 255.0);
                                        }),
                   m_Options));
}

TEST_F(GreyScans, LabelsOfManyKindsAreNone)
{
  const auto cell = [](int x, int y, int z, int side) { return 1 + x / side + 16 * (y / side) + 256 * (z / side); };
  // Blocks numbered in order and at random, down to two voxels a side; layers; a handful of labels in pure noise; a
  // mask with salt and pepper; two bodies among thousands of specks, as watersheds leave them.
  for (const int side : { 12, 6, 4, 3 })
  {
    EXPECT_FALSE(
      Look(Volume<std::uint16_t>("uint16", [&](int x, int y, int z) { return cell(x, y, z, side); }), m_Options));
  }
  for (const int side : { 12, 6, 4, 3, 2 })
  {
    EXPECT_FALSE(Look(Volume<std::uint32_t>("uint32",
                                            [&](int x, int y, int z) {
                                              return 2654435761U * static_cast<unsigned>(cell(x, y, z, side)) >> 8;
                                            }),
                      m_Options))
      << side;
  }
  EXPECT_FALSE(Look(Volume<std::uint8_t>("uint8", [](int, int, int z) { return 1 + z; }), m_Options));
  EXPECT_FALSE(Look(Volume<std::uint8_t>("uint8", [&](int, int, int) { return m_Random() % 20; }), m_Options));
  EXPECT_FALSE(Look(Volume<std::uint8_t>("uint8", [&](int, int, int) { return m_Random() % 2; }), m_Options));
  EXPECT_FALSE(Look(Volume<std::uint16_t>("uint16",
                                          [&](int x, int, int) {
                                            return m_Random() % 100 == 0 ? m_Random() % 5000 : 6000 + (x > 20 ? 1 : 0);
                                          }),
                    m_Options));
  // Spheres packed side by side, each of its own number, with a wall between.
  EXPECT_FALSE(Look(Volume<std::uint16_t>("uint16",
                                          [&](int x, int y, int z) {
                                            const auto off = [](int v) { return v % 6 - 2.5; };
                                            return std::hypot(off(x), off(y), off(z)) < 2.6 ? cell(x, y, z, 6) : 0;
                                          }),
                    m_Options));
}

TEST_F(GreyScans, AreReadWhereTheUserSaysWhatTheyAre)
{
  const std::string bytes = Volume<std::uint8_t>("uint8", [&](int, int, int) { return 1 + m_Random() % 200; });
  EXPECT_TRUE(Look(bytes, m_Options));
  ReadOptions said;
  EXPECT_FALSE(Look(bytes, said)); // as --labels all says
  said = m_Options;
  said.binary = true;
  EXPECT_FALSE(Look(bytes, said));
  said = m_Options;
  said.labels = "7";
  EXPECT_FALSE(Look(bytes, said));
  said = m_Options;
  said.threshold = { 100, 255 };
  EXPECT_FALSE(Look(bytes, said));
}

TEST_F(GreyScans, WhatIsNoLabelAndNoGreyScanIsRefusedForItsValue)
{
  ExpectRefused(
    m_Folder.Write("b.nrrd", Volume<std::int16_t>("int16", [](int x, int y, int) { return x > 9 ? 3 : -y / 40; })),
    { "value -1", "is negative" },
    m_Options);
}

TEST_F(GreyScans, AmongRealScansAreToldFromAtlases)
{
  const char * const                                        data = std::getenv("VOXELCORE_TEST_DATA");
  const std::filesystem::path                               shared = data == nullptr ? "/nowhere" : data;
  const std::filesystem::path                               mricron = "/usr/share/mricron/templates";
  const std::vector<std::pair<std::filesystem::path, bool>> scans{
    { shared / "CIBC-Internal+Seg3DData/tooth.nhdr", true },
    { shared / "Enet4+nifti-rs/resources/avg152T1_LR_nifti.nii.gz", true },
    { shared / "niivue+niivue/nifti_space/ASL.nii.gz", true },
    { mricron / "ch2bet.nii.gz", true },
    { mricron / "inia19-t1-brain.nii.gz", true },
    { mricron / "inia19-NeuroMaps.nii.gz", false },
    { mricron / "aal.nii.gz", false },
    { mricron / "AICHAmc.nii.gz", false },
    { mricron / "natbrainlab.nii.gz", false },
    { mricron / "JHU-WhiteMatter-labels-2mm.nii.gz", false },
    { shared / "niivue+niivue-demo-images/AllenAtlas.nii.gz", false },
    { shared / "mhalle+spl-knee-atlas/seg.nrrd", false },
    { shared / "mhalle+spl-abdominal-atlas/seg.nrrd", false },
    { shared / "wasserth+TotalSegmentator/T710_renal.nii.gz", false },
    { shared / "wasserth+TotalSegmentator/example_seg_fast_force_split.nii.gz", false },
    { shared / "stardist+stardist/mask3d.tif", false },
  };
  int read = 0;
  for (const auto & [path, isGrey] : scans)
  {
    if (std::filesystem::exists(path))
    {
      ++read;
      EXPECT_EQ(LookAt(path, m_Options).has_value(), isGrey) << path;
    }
  }
  if (read == 0)
  {
    GTEST_SKIP() << "neither VOXELCORE_TEST_DATA nor " << mricron << " is there";
  }
}
