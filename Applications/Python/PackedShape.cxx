#include "PackedShape.h"

#include <limits>
#include <stdexcept>

namespace voxelcore
{

namespace
{

template <typename TShape, typename TUse>
void
ForWords(TShape & shape, TUse use)
{
  for (std::int32_t z = 0; z < shape.Box().size[2]; ++z)
  {
    for (std::int32_t y = 0; y < shape.Box().size[1]; ++y)
    {
      for (auto && word : shape.Row(y, z))
      {
        use(word);
      }
    }
  }
}

} // namespace

PackedShape
Pack(const VoxelShape & shape)
{
  PackedShape packed;
  packed.box = shape.Box();
  ForWords(shape, [&](std::uint64_t word) {
    if (packed.words.empty() || packed.words.back() != word ||
        packed.counts.back() == std::numeric_limits<std::uint32_t>::max())
    {
      packed.words.push_back(word);
      packed.counts.push_back(0);
    }
    ++packed.counts.back();
  });
  packed.words.shrink_to_fit();
  packed.counts.shrink_to_fit();
  return packed;
}

VoxelShape
Unpack(const PackedShape & packed)
{
  const auto    fail = [] { throw std::length_error("a packed shape does not fit its box"); };
  VoxelShape    shape(packed.box);
  std::size_t   run = 0;
  std::uint32_t used = 0;
  ForWords(shape, [&](const ShapeWord & word) {
    if (run >= packed.words.size() || run >= packed.counts.size())
    {
      fail();
    }
    word = packed.words[run];
    if (++used >= packed.counts[run])
    {
      used = 0;
      ++run;
    }
  });
  if (run != packed.words.size() || run != packed.counts.size())
  {
    fail();
  }
  shape.Compact();
  return shape;
}

} // namespace voxelcore
