#include "LabelsInMemory.h"

#include "VoxelCoreTesting/Random.h"

#include "voxelcore/Labels/LabelNaming.h"

#include <iostream>
#include <set>
#include <utility>

namespace voxelcore::testing
{
namespace
{

StoredVoxels
WithSegments(std::vector<Segment> segments)
{
  StoredVoxels scan;
  scan.path = "a.seg.nrrd";
  scan.segments = std::move(segments);
  return scan;
}

LabelChoice
Asking(const std::string & labels)
{
  LabelChoice choice;
  choice.labels = labels;
  return choice;
}

TEST(LabelNaming, SegmentsKeepTheirValuesWhereLayersShareNone)
{
  LabelNaming naming(WithSegments({ { "bone", 0, 9, Color{ 1, 0, 0 } }, { "", 1, 2, {} } }), {});
  const auto  bone = naming.Identify(0, 9);
  EXPECT_EQ(bone.value, 9);
  EXPECT_EQ(bone.name, "bone");
  EXPECT_EQ(bone.color, (Color{ 1, 0, 0 }));
  const auto nameless = naming.Identify(1, 2);
  EXPECT_EQ(nameless.value, 2);
  EXPECT_EQ(nameless.name, "label-2");
  EXPECT_EQ(naming.Identify(0, 4).value, 4); // which no segment names
  EXPECT_FALSE(naming.IsRenumbered());
  EXPECT_EQ(naming.Identify(0, 2).value, 10); // 2 is that of layer 1
  EXPECT_TRUE(naming.IsRenumbered());
}

TEST(LabelNaming, NoTwoValuesOfLayersHaveOneNumber)
{
  constexpr std::uint64_t firstSeed = 20261122;
  std::cout << "seeds from " << firstSeed << '\n';
  for (std::uint64_t seed = firstSeed; seed < firstSeed + 300; ++seed)
  {
    Random                                         random(seed);
    std::set<std::pair<std::size_t, std::int64_t>> taken;
    std::vector<Segment>                           segments;
    std::set<std::int64_t>                         values;
    bool                                           shared = false;
    for (int i = 0; i < 6; ++i)
    {
      const auto layer = static_cast<std::size_t>(random.Between(0, 2));
      const auto value = random.Between(1, 9);
      if (taken.insert({ layer, value }).second)
      {
        shared = !values.insert(value).second || shared;
        segments.push_back({ "s" + std::to_string(i), layer, value, {} });
      }
    }
    LabelNaming            naming(WithSegments(segments), {});
    std::set<std::int64_t> numbers;
    EXPECT_EQ(naming.IsRenumbered(), shared) << "seed " << seed;
    // Values come in the order of the voxels, that of the file or any other.
    std::vector<std::pair<std::size_t, std::int64_t>> order;
    for (std::size_t layer = 0; layer < 3; ++layer)
    {
      for (std::int64_t value = 1; value <= 12; ++value)
      {
        order.insert(order.begin() + random.Between(0, static_cast<std::int64_t>(order.size())), { layer, value });
      }
    }
    for (const auto & one : order)
    {
      const auto layer = one.first;
      const auto value = one.second;
      const auto label = naming.Identify(layer, value);
      EXPECT_TRUE(numbers.insert(label.value).second) << "seed " << seed << ": " << label.value << " twice";
      const auto segment = std::find_if(segments.begin(), segments.end(), [&](const Segment & s) {
        return s.layer == layer && s.value == value;
      });
      if (segment != segments.end())
      {
        EXPECT_EQ(label.name, segment->name);
        EXPECT_EQ(label.value, shared ? segment - segments.begin() + 1 : segment->value) << "seed " << seed;
      }
      else if (shared)
      {
        EXPECT_GT(label.value, static_cast<std::int64_t>(segments.size())) << "seed " << seed;
        EXPECT_EQ(label.name, "label-" + std::to_string(label.value));
      }
    }
  }
}

TEST(LabelNaming, ListsGiveNamesAndColorsOrOneOfThem)
{
  StoredVoxels scan = WithSegments({});
  scan.listed = { { 3, { "skin", Color{ 0, 1, 0 } } }, { 4, { "", Color{ 0, 0, 1 } } }, { 5, { "fat", {} } } };
  LabelNaming naming(scan, {});
  EXPECT_EQ(naming.Identify(0, 3).name, "skin");
  EXPECT_EQ(naming.Identify(0, 3 + 1).name, "label-4");
  EXPECT_EQ(naming.Identify(0, 5).name, "fat");
  LabelNaming again(scan, {});
  EXPECT_EQ(again.Identify(0, 4).color, (Color{ 0, 0, 1 }));
  EXPECT_FALSE(again.Identify(0, 5).color);
  EXPECT_EQ(again.Identify(0, 6).name, "label-6");
}

TEST(LabelNaming, ACaseMattersOnlyWhereALabelIsCalledExactlySo)
{
  const auto        scan = WithSegments({ { "Bone", 0, 1, {} }, { "bone", 0, 2, {} }, { "Skin", 0, 3, {} } });
  const LabelNaming exactly(scan, Asking("bone"));
  EXPECT_FALSE(exactly.IsWanted({ 1, "Bone" }));
  EXPECT_TRUE(exactly.IsWanted({ 2, "bone" }));
  const LabelNaming anyhow(scan, Asking(" 3 ,BONE"));
  EXPECT_TRUE(anyhow.IsWanted({ 1, "Bone" }));
  EXPECT_TRUE(anyhow.IsWanted({ 2, "bone" }));
  EXPECT_TRUE(anyhow.IsWanted({ 3, "Skin" }));
  EXPECT_FALSE(anyhow.IsWanted({ 33, "label-33" }));
  EXPECT_TRUE(LabelNaming(scan, {}).IsWanted({ 33, "label-33" }));
}

TEST(LabelNaming, RequestsWithoutSenseAreRefused)
{
  for (const char * labels : { "", " ", "1,,2", ",1", "1,", "0", "1,-3", "bone,0" })
  {
    EXPECT_NE(MessageOf<UsageError>([&] { LabelNaming(StoredVoxels{}, Asking(labels)); }).find("give all, or values"),
              std::string::npos)
      << labels;
  }
}

TEST(LabelNaming, WhatIsMissingIsNamedWithADozenOfWhatIsThere)
{
  std::vector<LabelNaming::Label> present{ { 1, "label-1" }, { 2, "bone\n" } };
  const auto                      missing = [&](const std::string & labels) {
    return MessageOf([&] { LabelNaming(StoredVoxels{}, Asking(labels)).RefuseMissing("a.nrrd", present, " here"); });
  };
  EXPECT_EQ(missing("1,7"), "a.nrrd: there is no label '7' here; it has 1, 2 bone?");
  EXPECT_NE(missing("bona").find("bone"), std::string::npos); // which may be meant
  for (std::int64_t value = 3; value <= 40; ++value)
  {
    present.push_back({ value, "label-" + std::to_string(value) });
  }
  const std::string many = missing("50");
  EXPECT_NE(many.find("12 and 28 more"), std::string::npos) << many;
  EXPECT_EQ(many.find("13"), std::string::npos) << many;
  EXPECT_NO_THROW(LabelNaming(StoredVoxels{}, Asking("label-40,3")).RefuseMissing("a.nrrd", present, ""));
  EXPECT_NO_THROW(LabelNaming(StoredVoxels{}, {}).RefuseMissing("a.nrrd", {}, ""));
}

} // namespace
} // namespace voxelcore::testing
