#pragma once
// .vtp files with their arrays as they are, whose bytes a test can look for and change. Unpacked by zlib itself.

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace voxelcore::testing
{

/** A .vtp with appended data in zlib's streams, as VTK writes it without a compressor. */
inline std::string
UnpackedVtp(const std::string & file)
{
  constexpr std::string_view compressor = " compressor=\"vtkZLibDataCompressor\"";
  const std::size_t          named = file.find(compressor);
  const std::size_t          begin = file.find('_', file.find("<AppendedData")) + 1;
  const std::size_t          end = file.rfind("\n  </AppendedData>");
  if (named >= begin || end == std::string::npos)
  {
    ADD_FAILURE() << "it is not packed";
    return file;
  }
  std::string head = file.substr(0, begin);
  std::string data;
  for (std::size_t at = head.find(" offset=\""); at != std::string::npos; at = head.find(" offset=\"", at + 1))
  {
    const std::size_t from = at + 9;
    const std::size_t quote = head.find('"', from);
    std::size_t       place = begin + std::stoul(head.substr(from, quote - from));
    const auto        number = [&] {
      std::uint64_t value = 0;
      std::memcpy(&value, file.data() + place, sizeof value);
      place += sizeof value;
      return value;
    };
    const std::uint64_t        blocks = number();
    const std::uint64_t        size = number();
    const std::uint64_t        last = number();
    std::vector<std::uint64_t> packed(blocks);
    for (std::uint64_t & one : packed)
    {
      one = number();
    }
    std::string values;
    for (std::size_t block = 0; block < blocks; ++block)
    {
      uLongf      room = block + 1 == blocks && last > 0 ? last : size;
      std::string part(room, '\0');
      EXPECT_EQ(uncompress(reinterpret_cast<Bytef *>(part.data()),
                           &room,
                           reinterpret_cast<const Bytef *>(file.data() + place),
                           packed[block]),
                Z_OK);
      EXPECT_EQ(room, part.size());
      values += part;
      place += packed[block];
    }
    // Blanks may follow, as many as keep the length.
    std::string offset = std::to_string(data.size()) + '"';
    std::size_t until = quote + 1;
    while (head[until] == ' ')
    {
      ++until;
    }
    offset += std::string(until > quote + 1 ? until - from - std::min(until - from, offset.size()) : 0, ' ');
    head.replace(from, until - from, offset);
    const std::uint64_t length = values.size();
    data.append(reinterpret_cast<const char *>(&length), sizeof length);
    data += values;
  }
  head.erase(named, compressor.size());
  return head + data + file.substr(end);
}

} // namespace voxelcore::testing
