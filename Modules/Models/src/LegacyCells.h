#pragma once
// Looks over the cells of a legacy .vtk file before VTK reads them: where they end early its reader takes what happens to lie
// in memory for counts, and crashes.

#include "MeshText.h"

#include <vector>

namespace voxelcore
{

/** Whole numbers behind a keyword's line, as text or big-endian. */
inline std::vector<std::int64_t>
LegacyNumbers(std::string_view bytes, std::size_t at, std::uint64_t count, std::size_t width, bool isText)
{
  const std::string_view    rest = bytes.substr(std::min(at, bytes.size()));
  std::vector<std::int64_t> numbers;
  RequireFit(count <= rest.size(), "it promises more cells than it has room for");
  if (isText)
  {
    MeshText text(rest);
    while (numbers.size() < count)
    {
      RequireFit(text.NextLine('\0'), "it ends in the middle of its cells");
      for (std::string_view word = text.Word(); !word.empty() && numbers.size() < count; word = text.Word())
      {
        numbers.push_back(text.Whole(word));
      }
    }
    return numbers;
  }
  RequireFit(count * width <= rest.size(), "it ends in the middle of its cells");
  for (std::uint64_t i = 0; i < count; ++i)
  {
    std::uint64_t value = 0;
    for (std::size_t b = 0; b < width; ++b)
    {
      value = (value << 8U) | static_cast<unsigned char>(rest[i * width + b]);
    }
    numbers.push_back(width == 4 ? static_cast<std::int32_t>(value) : static_cast<std::int64_t>(value));
  }
  return numbers;
}

/** Throws UnfitFile unless the cells of a keyword, where there are some, are all there and hang together. */
inline void
CheckLegacyCells(std::string_view bytes, std::string_view keyword)
{
  const bool isText = bytes.substr(0, 1024).find("\nASCII") != std::string_view::npos;
  const auto after = [&](std::string_view word, std::size_t from) {
    const std::size_t at = bytes.find("\n" + std::string(word) + " ", from);
    return at == std::string_view::npos ? at : at + word.size() + 2;
  };
  const auto        lineEnd = [&](std::size_t at) { return std::min(bytes.find('\n', at), bytes.size() - 1) + 1; };
  const std::size_t at = after(keyword, 0);
  if (at == std::string_view::npos)
  {
    return;
  }
  MeshText line(bytes.substr(at, lineEnd(at) - at));
  RequireFit(line.NextLine('\0'), "it ends before its cells");
  const std::int64_t first = line.Whole(line.Word());
  const std::int64_t second = line.Whole(line.Word());
  RequireFit(first >= 0 && second >= 0, "counts that cannot be");
  const std::size_t body = lineEnd(at);
  if (bytes.substr(body, 8) != "OFFSETS ")
  {
    const auto    numbers = LegacyNumbers(bytes, body, static_cast<std::uint64_t>(second), 4, isText);
    std::uint64_t next = 0;
    for (std::int64_t cell = 0; cell < first; ++cell)
    {
      RequireFit(next < numbers.size() && numbers[next] >= 0, "it has fewer cells than it promises");
      next += 1 + static_cast<std::uint64_t>(numbers[next]);
    }
    RequireFit(next == numbers.size(), "its cells are not as many numbers as it promises");
    return;
  }
  const auto read = [&](std::string_view word, std::int64_t count) {
    const std::size_t place = after(word, body - 1);
    RequireFit(place != std::string_view::npos, "it ends in the middle of its cells");
    const std::size_t width = bytes.substr(place, lineEnd(place) - place).find("64") != std::string_view::npos ? 8 : 4;
    return LegacyNumbers(bytes, lineEnd(place), static_cast<std::uint64_t>(count), width, isText);
  };
  const auto offsets = read("OFFSETS", first);
  read("CONNECTIVITY", second);
  for (std::size_t i = 0; i < offsets.size(); ++i)
  {
    RequireFit(offsets[i] >= (i > 0 ? offsets[i - 1] : 0) && offsets[i] <= second, "its cells do not hang together");
  }
}

} // namespace voxelcore
