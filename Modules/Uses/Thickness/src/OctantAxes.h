#pragma once
// Along which axes a boundary vertex bounds inscribed balls.

#include <array>
#include <cstdint>

namespace voxelcore
{

/** Of each set of octants at a boundary vertex (bit o: voxel at (o & 1, o >> 1 & 1, o >> 2) is in) the axes A, as bits:
 *  as few as will do. */
inline std::array<std::uint8_t, 256>
OctantAxes()
{
  std::array<std::uint8_t, 256>     table{};
  constexpr std::array<unsigned, 7> fewestFirst{ 1, 2, 4, 3, 5, 6, 7 };
  for (unsigned octants = 0; octants < 256; ++octants)
  {
    for (const unsigned axes : fewestFirst)
    {
      bool allHave = true;
      for (unsigned octant = 0; octant < 8; ++octant)
      {
        bool has = (octants >> octant & 1U) == 0;
        for (unsigned other = 0; other < 8; ++other)
        {
          has = has || ((octants >> other & 1U) == 0 && ((octant ^ other) & ~axes) == 0);
        }
        allHave = allHave && has;
      }
      if (allHave)
      {
        table[octants] = static_cast<std::uint8_t>(axes);
        break;
      }
    }
  }
  return table;
}

} // namespace voxelcore
