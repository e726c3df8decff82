#include "CertifiedFixtures.h"
#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Certified/CertifiedNetwork.h"
#include "voxelcore/Shape/LabelContacts.h"

#include <gtest/gtest.h>

#include <iostream>
#include <limits>

namespace voxelcore::testing
{
namespace
{

/** Random labels: each voxel of a random shape is of the label whose seed is nearest, or of any by chance. */
std::vector<LabelShape>
RandomLabels(const RandomVolume & volume, Random & random)
{
  const VoxelBox &                         box = volume.shape.Box();
  std::vector<std::array<std::int32_t, 3>> seeds;
  std::vector<LabelShape>                  labels;
  for (std::int64_t value = 1; value <= 4; ++value)
  {
    seeds.push_back({});
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      seeds.back()[axis] = box.lower[axis] + static_cast<std::int32_t>(random.Between(0, box.size[axis] - 1));
    }
    labels.push_back({ 3 * value, "label", 0, VoxelShape(box) });
  }
  const bool isMixed = random.Chance(0.3);
  for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
  {
    for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
    {
      for (std::int32_t x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
      {
        if (!volume.shape.Contains(x, y, z))
        {
          continue;
        }
        std::size_t  nearest = 0;
        std::int32_t least = std::numeric_limits<std::int32_t>::max();
        for (std::size_t i = 0; i < seeds.size(); ++i)
        {
          const std::int32_t away = std::abs(x - seeds[i][0]) + std::abs(y - seeds[i][1]) + std::abs(z - seeds[i][2]);
          nearest = away < least ? i : nearest;
          least = std::min(least, away);
        }
        if (isMixed && random.Chance(0.2))
        {
          nearest = static_cast<std::size_t>(random.Between(0, 3));
        }
        labels[nearest].shape.Insert(x, y, z);
        ++labels[nearest].voxels;
      }
    }
  }
  std::erase_if(labels, [](const LabelShape & label) { return label.voxels == 0; });
  for (LabelShape & label : labels)
  {
    label.shape = CropToVoxels(std::move(label.shape));
  }
  return labels;
}

TEST(CertifiedNetwork, OfRandomLabelsIsCertifiedAndEveryContactIsPlacedOrNamed)
{
  constexpr std::uint64_t firstSeed = 8100;
  std::cout << "seeds from " << firstSeed << '\n';
  std::size_t contacts = 0;
  std::size_t placed = 0;
  for (std::uint64_t seed = firstSeed; seed < firstSeed + 60; ++seed)
  {
    const RandomVolume volume = MakeRandomVolume(seed, 4, 14);
    SCOPED_TRACE(volume.Describe());
    Random                        random(seed);
    const std::vector<LabelShape> labels = RandomLabels(volume, random);
    if (labels.empty())
    {
      continue;
    }
    ImageGeometry geometry;
    geometry.spacing = volume.spacing;
    CertifiedRequest request = Lambdas({ "0" });
    request.name = "labels";
    request.skeleton = Skeleton();
    CertifiedSkeleton skeleton = *ComputeCertified(UnionOfLabels(labels), geometry, request).skeleton;
    ASSERT_NO_THROW(MakeNetwork(skeleton, labels, UnionOfLabels(labels), geometry, "labels"));
    const MeasuredSkeleton & network = skeleton.skeleton;
    std::size_t              unsaid = 0;
    for (const NetworkContact & contact : network.network->contacts)
    {
      ++contacts;
      placed += contact.places.size() == 1 ? 1 : 0;
      unsaid += contact.places.size() == 1 ? 0 : 1;
    }
    ASSERT_GE(NetworkInWords(network, SpatialUnit::Millimetres).size(), unsaid);
  }
  std::cout << placed << " of " << contacts << " contacts have one node\n";
  EXPECT_GT(contacts, 500U);
}

TEST(CertifiedNetwork, WhatLabelsDoNotHaveIsNoNetworkOfThem)
{
  std::vector<LabelShape> labels;
  for (std::int64_t value = 1; value <= 2; ++value)
  {
    labels.push_back({ value, "half", 0, VoxelShape(VoxelBox{ { value == 1 ? 0 : 12, 0, 0 }, { 12, 5, 5 } }) });
    for (std::int32_t i = 0; i < 12 * 25; ++i)
    {
      labels.back().shape.Insert((value == 1 ? 0 : 12) + i % 12, i / 12 % 5, i / 60);
    }
    labels.back().voxels = 300;
  }
  CertifiedRequest request = Lambdas({ "0" });
  request.name = "halves";
  request.skeleton = Skeleton();
  const CertifiedSkeleton skeleton = *ComputeCertified(UnionOfLabels(labels), {}, request).skeleton;
  CertifiedSkeleton       good = skeleton;
  EXPECT_NO_THROW(MakeNetwork(good, labels, UnionOfLabels(labels), {}, "halves"));
  EXPECT_EQ(good.skeleton.network->contacts.at(0).faces, 25U);
  CertifiedSkeleton bad = skeleton;
  bad.topology.euler = 0;
  EXPECT_THROW(MakeNetwork(bad, labels, UnionOfLabels(labels), {}, "halves"), CertificateError);
}

} // namespace
} // namespace voxelcore::testing
