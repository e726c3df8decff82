// A scan's plan as bytes, written as a share is (BlockShareFile.cxx):
//   "VoxelPln", version; source; number of labels; for each value, name, weights, boundary vertices and squares,
//   digest, number of blocks, and of each block its corners and its region's box, voxels and digest; checksum of all

#include "voxelcore/Blocks/BlockRegions.h"

#include "ShareCoding.h"

#include <limits>

namespace voxelcore
{
namespace
{

constexpr std::string_view kPlanMagic = "VoxelPln";
constexpr std::uint64_t    kPlanVersion = 1;
constexpr std::uint64_t    kMostBlocks = std::uint64_t{ 1 } << 20;
constexpr std::int64_t     kLeastPlace = std::numeric_limits<std::int32_t>::min();
constexpr std::int64_t     kGreatestPlace = std::numeric_limits<std::int32_t>::max();

void
WriteText(const std::string & text, Encoder & to)
{
  to.Number(text.size());
  for (const char c : text)
  {
    to.Byte(static_cast<std::uint8_t>(c));
  }
}

/** It grows as bytes come: a damaged length takes no memory. */
std::string
ReadText(Decoder & from)
{
  std::string text;
  for (std::uint64_t left = from.Number(); left > 0; --left)
  {
    text += static_cast<char>(from.Byte());
  }
  return text;
}

void
WriteCoordinates(std::initializer_list<std::int32_t> numbers, Encoder & to)
{
  for (const std::int32_t number : numbers)
  {
    to.Step(0, number);
  }
}

std::int32_t
ReadCoordinate(Decoder & from)
{
  return static_cast<std::int32_t>(from.Step(0, kLeastPlace, kGreatestPlace));
}

LatticePoint
ReadPoint(Decoder & from)
{
  LatticePoint point;
  point.x = ReadCoordinate(from);
  point.y = ReadCoordinate(from);
  point.z = ReadCoordinate(from);
  return point;
}

void
WriteLabel(const PlannedLabel & label, Encoder & to)
{
  const BlockPlan & plan = label.plan;
  to.Number(Fold(label.value));
  WriteText(label.name, to);
  for (const std::int64_t weight : plan.weight)
  {
    to.Number(static_cast<std::uint64_t>(weight));
  }
  for (const std::uint64_t number : { plan.boundaryVertices,
                                      plan.boundarySquares,
                                      plan.digest[0],
                                      plan.digest[1],
                                      std::uint64_t{ plan.blocks.size() } })
  {
    to.Number(number);
  }
  for (std::size_t i = 0; i < plan.blocks.size(); ++i)
  {
    const auto & [lower, upper] = plan.blocks[i];
    const BlockRegion & region = label.regions.at(i);
    WriteCoordinates({ lower.x, lower.y, lower.z, upper.x, upper.y, upper.z }, to);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      WriteCoordinates({ region.box.lower[axis], region.box.size[axis] }, to);
    }
    to.Number(region.voxels);
    to.Number(region.digest[0]);
    to.Number(region.digest[1]);
  }
}

PlannedLabel
ReadLabel(Decoder & from)
{
  PlannedLabel label;
  label.value = Unfold(from.Number());
  label.name = ReadText(from);
  for (std::int64_t & weight : label.plan.weight)
  {
    weight = static_cast<std::int64_t>(from.Number());
  }
  label.plan.boundaryVertices = from.Number();
  label.plan.boundarySquares = from.Number();
  label.plan.digest = { from.Number(), from.Number() };
  for (std::uint64_t left = from.Number(1, kMostBlocks); left > 0; --left)
  {
    HaloBlock block;
    block.lower = ReadPoint(from);
    block.upper = ReadPoint(from);
    label.plan.blocks.push_back(block);
    BlockRegion region;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      region.box.lower[axis] = ReadCoordinate(from);
      region.box.size[axis] = ReadCoordinate(from);
    }
    region.voxels = from.Number();
    region.digest = { from.Number(), from.Number() };
    label.regions.push_back(region);
  }
  return label;
}

} // namespace

void
WriteScanPlan(const ScanPlan & plan, std::ostream & stream)
{
  Encoder to(stream);
  for (const char c : kPlanMagic)
  {
    to.Byte(static_cast<std::uint8_t>(c));
  }
  to.Number(kPlanVersion);
  WriteText(plan.source, to);
  to.Number(plan.labels.size());
  for (const PlannedLabel & label : plan.labels)
  {
    WriteLabel(label, to);
  }
  to.Sum();
  to.Flush();
}

ScanPlan
ReadScanPlan(std::istream & stream, const std::string & name)
{
  Decoder from(stream, name);
  for (const char c : kPlanMagic)
  {
    if (from.AtEnd() || from.Byte() != static_cast<std::uint8_t>(c))
    {
      from.Fail("is not a plan of blocks as 'core --block' writes it");
    }
  }
  if (from.Number() != kPlanVersion)
  {
    from.Fail("is a plan of blocks of another version; remove it");
  }
  ScanPlan plan;
  plan.source = ReadText(from);
  for (std::uint64_t left = from.Number(); left > 0; --left)
  {
    plan.labels.push_back(ReadLabel(from));
  }
  from.Sum();
  if (!from.AtEnd())
  {
    from.Fail("goes on after its end; remove it");
  }
  return plan;
}

} // namespace voxelcore
