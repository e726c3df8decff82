#include "LabelsInMemory.h"

#include "VoxelCoreTesting/Random.h"

#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Labels/GreyScan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <random>
#include <utility>

namespace voxelcore::testing
{
namespace
{

constexpr std::int64_t kSide = 40;

/** What is found in a volume of kSide^3 values. */
template <typename T>
GreyScan
Look(const std::vector<T> & values)
{
  LabelChoice choice;
  choice.refuseGrey = true;
  try
  {
    LabelsOf(values, SizedGeometry(kSide, kSide, kSide), choice);
  }
  catch (const GreyScanError & error)
  {
    return error.grey;
  }
  ADD_FAILURE() << "passes as labels";
  return {};
}

TEST(GreyScan, TheProposalFindsAHundredthOfTheVoxelsThatOtsuMisses)
{
  std::mt19937                     random(5);
  std::normal_distribution<double> noise(0, 80);
  std::vector<double>              values;
  for (int i = 0; i < 200000; ++i)
  {
    values.push_back((i % 100 == 0 ? 3000 : 1000) + noise(random));
  }
  std::sort(values.begin(), values.end());
  EXPECT_NEAR(ProposedThreshold(values), 2000, 60);
  // Air around a pot, soil that is brighter, and roots: what is half of the voxels is background itself.
  values.clear();
  for (int i = 0; i < 200000; ++i)
  {
    values.push_back((i % 100 == 0 ? 3000 : i % 5 < 3 ? 0 : 1000) + noise(random));
  }
  std::sort(values.begin(), values.end());
  EXPECT_NEAR(ProposedThreshold(values), 2000, 60);
  EXPECT_EQ(ProposedThreshold(std::vector<double>{ 7, 7, 7 }), 7);
}

/** Values of a scan, those of the object apart. */
struct KnownScan
{
  std::vector<double> others;
  std::vector<double> object;
};

/** Dice overlap of what is at or above a threshold with the object. */
double
DiceAt(const KnownScan & scan, double threshold)
{
  const auto above = [&](const std::vector<double> & values) {
    return static_cast<double>(std::ranges::count_if(values, [&](double value) { return value >= threshold; }));
  };
  const double right = above(scan.object);
  return 2 * right / (right + above(scan.others) + static_cast<double>(scan.object.size()));
}

/** The proposal, and how far its Dice is below that of the best of 400 thresholds. */
std::pair<double, double>
OffBest(const KnownScan & scan)
{
  std::vector<double> values = scan.others;
  values.insert(values.end(), scan.object.begin(), scan.object.end());
  std::sort(values.begin(), values.end());
  const double proposed = ProposedThreshold(values);
  double       best = 0;
  for (int i = 0; i <= 400; ++i)
  {
    best = std::max(best, DiceAt(scan, values.front() + i * (values.back() - values.front()) / 400));
  }
  return { proposed, best - DiceAt(scan, proposed) };
}

TEST(GreyScan, TheProposalIsNearTheBestWhateverTheObjectsShareAndTheNoise)
{
  constexpr unsigned firstSeed = 7;
  std::cout << "seeds from " << firstSeed << '\n';
  unsigned seed = firstSeed;
  for (const double share : { 0.002, 0.02, 0.2, 0.5, 0.7 })
  {
    for (const double contrast : { 4.5, 6.0, 20.0 }) // in deviations of the noise
    {
      std::mt19937                           random(seed++);
      std::normal_distribution<double>       noise(0, 2000 / contrast);
      std::uniform_real_distribution<double> unit(0, 1);
      KnownScan                              scan;
      for (int i = 0; i < 400000; ++i)
      {
        // A tenth of the object's voxels are at its boundary, and as many others.
        const bool   isObject = unit(random) < share;
        const bool   isPartial = unit(random) < 0.1 * (isObject ? 1 : share / (1 - share));
        const double part = 0.5 * unit(random);
        const double level = isObject ? (isPartial ? 0.5 + part : 1) : isPartial ? part : 0;
        (isObject ? scan.object : scan.others).push_back(std::round(8000 + 2000 * level + noise(random)));
      }
      const auto [proposed, off] = OffBest(scan);
      EXPECT_LT(off, 0.02) << "share " << share << ", contrast " << contrast << ", seed " << seed - 1 << ": "
                           << proposed;
    }
  }
}

TEST(GreyScan, PaddingAirAndClippedNoiseAreNoBackground)
{
  std::mt19937                     random(11);
  std::normal_distribution<double> noise(0, 30);
  KnownScan                        pot;
  KnownScan                        clipped;
  for (int i = 0; i < 300000; ++i)
  {
    const bool isRoot = i % 150 == 0;
    // A third padding, a quarter air, the rest soil.
    const double level = isRoot ? 1500 : i % 3 == 0 ? 0 : i % 4 == 0 ? 200 : 900;
    (isRoot ? pot.object : pot.others).push_back(level == 0 ? 0 : std::round(level + noise(random)));
    (isRoot ? clipped.object : clipped.others)
      .push_back(std::max(0.0, std::round((isRoot ? 250 : 20) + noise(random))));
  }
  EXPECT_LT(OffBest(pot).second, 0.02) << OffBest(pot).first;
  EXPECT_NEAR(OffBest(pot).first, 1200, 150);
  EXPECT_LT(OffBest(clipped).second, 0.02) << OffBest(clipped).first;
}

/** A dark and a bright class, both noisy. */
std::vector<std::uint8_t>
TwoClasses(std::uint64_t seed)
{
  Random                    random(seed);
  const auto                dark = random.Between(10, 80);
  const auto                bright = dark + random.Between(50, 120);
  const double              share = 0.1 + 0.8 * random.Unit();
  std::vector<std::uint8_t> values(kSide * kSide * kSide);
  for (auto & value : values)
  {
    value = static_cast<std::uint8_t>((random.Chance(share) ? bright : dark) + random.Between(-9, 9) +
                                      random.Between(-9, 9) % 3);
  }
  return values;
}

/** Otsu's threshold by trying each, in whole numbers: the first value of the brighter class. */
int
OtsuByTrial(const std::vector<std::uint8_t> & values)
{
  long double best = -1;
  int         found = 0;
  for (int threshold = 1; threshold < 256; ++threshold)
  {
    std::int64_t count[2] = { 0, 0 };
    std::int64_t sum[2] = { 0, 0 };
    for (const std::uint8_t value : values)
    {
      const std::size_t side = value >= threshold ? 1 : 0;
      ++count[side];
      sum[side] += value;
    }
    if (count[0] == 0 || count[1] == 0)
    {
      continue;
    }
    const auto        difference = static_cast<long double>(sum[1] * count[0] - sum[0] * count[1]);
    const long double between = difference * difference / static_cast<long double>(count[0] * count[1]);
    // A threshold between the same two values is the same: the lowest stays.
    if (between > best * (1 + 1e-15L))
    {
      best = between;
      found = threshold;
    }
  }
  return found;
}

TEST(GreyScan, NumbersAreThoseOfAPlainCount)
{
  constexpr std::uint64_t firstSeed = 20261122;
  std::cout << "seeds from " << firstSeed << '\n';
  for (std::uint64_t seed = firstSeed; seed < firstSeed + 6; ++seed)
  {
    const auto     values = TwoClasses(seed);
    const GreyScan grey = Look(values);
    EXPECT_EQ(grey.otsu, OtsuByTrial(values)) << "seed " << seed;
    EXPECT_EQ(grey.lowest, *std::ranges::min_element(values)) << "seed " << seed;
    EXPECT_EQ(grey.highest, *std::ranges::max_element(values)) << "seed " << seed;
    std::array<bool, 256> seen{};
    for (const std::uint8_t value : values)
    {
      seen[value] = true;
    }
    EXPECT_EQ(grey.distinct, static_cast<std::uint64_t>(std::count(seen.begin() + 1, seen.end(), true)))
      << "seed " << seed;
    ASSERT_EQ(grey.edges.size(), grey.counts.size() + 1) << "seed " << seed;
    for (std::size_t bin = 0; bin < grey.counts.size(); ++bin)
    {
      const bool last = bin + 1 == grey.counts.size();
      EXPECT_EQ(grey.counts[bin],
                static_cast<std::uint64_t>(std::ranges::count_if(
                  values,
                  [&](double value) { return value >= grey.edges[bin] && (last || value < grey.edges[bin + 1]); })))
        << "seed " << seed << ", bin " << bin;
    }
  }
}

TEST(GreyScan, FractionsAreCutWhereTheirClassesAre)
{
  // The same classes a thousandth as large: the threshold has few digits, and leaves as many voxels.
  const auto         values = TwoClasses(7);
  std::vector<float> small(values.size());
  std::ranges::transform(values, small.begin(), [](int value) { return static_cast<float>(value) / 1024; });
  const double threshold = Look(small).otsu;
  const int    expected = OtsuByTrial(values);
  EXPECT_LE(Number(threshold).size(), 7U);
  LabelChoice choice;
  choice.threshold = { threshold, INFINITY };
  EXPECT_EQ(LabelsOf(small, SizedGeometry(kSide, kSide, kSide), choice).at(0).voxels,
            static_cast<std::uint64_t>(std::ranges::count_if(values, [&](int value) { return value >= expected; })));
}

TEST(GreyScan, NumbersThatAreNoneDoNotCount)
{
  const auto         values = TwoClasses(8);
  std::vector<float> some(values.begin(), values.end());
  const GreyScan     all = Look(some);
  some[77] = INFINITY;
  some[7777] = -INFINITY;
  some[17777] = NAN;
  const GreyScan grey = Look(some);
  EXPECT_EQ(grey.lowest, all.lowest);
  EXPECT_EQ(grey.highest, all.highest);
  EXPECT_EQ(grey.otsu, all.otsu);
}

TEST(GreyScan, TextsNameValuesAndRange)
{
  GreyScan grey;
  grey.distinct = 1290;
  grey.lowest = -1024;
  grey.highest = 0.1;
  grey.proposed = 15;
  EXPECT_EQ(GreyScanText(grey),
            "looks like a grey scan (1290 values from -1024 to 0.1, neighbouring voxels are rarely equal)");
  EXPECT_EQ(ProposedRange(grey), "15:inf");
  grey.proposed = -0.0625;
  EXPECT_EQ(ProposedRange(grey), "-0.0625:inf");
  grey.distinct = 65536; // as far as they are counted
  EXPECT_NE(GreyScanText(grey).find("(more than 65536 values"), std::string::npos);
}

TEST(GreyScan, ImagesAreRefusedWhenAsked)
{
  std::mt19937              random(20261122);
  const ImageGeometry       geometry = SizedGeometry(40, 40, 40);
  std::vector<std::uint8_t> values(40 * 40 * 40);
  for (auto & value : values)
  {
    value = static_cast<std::uint8_t>(50 + random() % 100);
  }
  LabelChoice choice;
  EXPECT_GT(LabelsOf(values, geometry, choice).size(), 90U);
  choice.refuseGrey = true;
  EXPECT_NE(MessageOf<GreyScanError>([&] { LabelsOf(values, geometry, choice); }).find("--threshold"),
            std::string::npos);
  choice.binary = true;
  EXPECT_EQ(LabelsOf(values, geometry, choice).size(), 1U);
}

} // namespace
} // namespace voxelcore::testing
