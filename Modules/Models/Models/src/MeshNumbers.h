#pragma once
// Numbers of VTK's files: of any type, as text or as bytes of either order.

#include "MeshText.h"
#include "voxelcore/Base/Library.h"

#include <array>
#include <bit>
#include <concepts>
#include <cstring>
#include <limits>

namespace voxelcore
{

/** How a number is stored. */
struct NumberType
{
  char        kind = 'f'; ///< 'i'nteger, 'u'nsigned, 'f'loating
  std::size_t bytes = 0;  ///< 0: not a number type
};

/** Reads a stored number as double or std::int64_t. Values that the result cannot hold are refused, and with `finite`
 *  what is no finite number. */
template <typename Value>
Value
LoadNumber(const char * bytes, NumberType type, bool isBigEndian, bool finite = true)
{
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < type.bytes; ++i)
  {
    bits = (bits << 8U) | static_cast<unsigned char>(bytes[isBigEndian ? i : type.bytes - 1 - i]);
  }
  if (type.kind == 'f')
  {
    const double real =
      type.bytes == 4 ? static_cast<double>(bit_cast<float>(static_cast<std::uint32_t>(bits))) : bit_cast<double>(bits);
    RequireFit(std::floating_point<Value>, "an index is not stored as a whole number");
    RequireFit(!finite || std::isfinite(real), "a coordinate is not a finite number");
    return static_cast<Value>(real);
  }
  if (type.kind == 'u')
  {
    RequireFit(std::floating_point<Value> || bits <= std::uint64_t{ std::numeric_limits<std::int64_t>::max() },
               "an index is too large");
    return static_cast<Value>(bits);
  }
  const auto unused = static_cast<unsigned>(64 - 8 * type.bytes);
  // NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): arrays of no numbers are refused before
  return static_cast<Value>(static_cast<std::int64_t>(bits << unused) >> unused);
}

/** Reads a number from a word. Type float is rounded to float first, as it would be when stored. */
template <typename Value>
Value
ParseNumber(std::string_view word, NumberType type, bool finite = true)
{
  const auto fail = [&] { throw UnfitFile{ "'" + MeshText::Shown(word) + "' where a number is expected" }; };
  const auto parse = [&](auto value) {
    word.remove_prefix(word.starts_with('+') ? 1 : 0);
    const auto [end, error] = from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || word.empty())
    {
      fail();
    }
    // Too small to be told from 0 is 0.
    const bool isTiny = std::floating_point<decltype(value)> && error == std::errc::result_out_of_range &&
                        (word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos);
    if (error != std::errc() && !isTiny)
    {
      fail();
    }
    return isTiny ? 0 : value;
  };
  if (type.kind != 'f')
  {
    return static_cast<Value>(parse(std::int64_t{}));
  }
  RequireFit(std::floating_point<Value>, "an index is not stored as a whole number");
  const double real = type.bytes == 4 ? static_cast<double>(parse(float{})) : parse(double{});
  RequireFit(!finite || std::isfinite(real), "a coordinate is not a finite number");
  return static_cast<Value>(real);
}

/** Adds points to a mesh, three numbers each. */
inline void
AddPoints(MeshFile & file, const std::vector<double> & numbers)
{
  RequireFit(file.mesh.points.size() + numbers.size() / 3 <= std::numeric_limits<std::uint32_t>::max(),
             "it has too many points");
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
  {
    file.mesh.points.push_back({ numbers[i], numbers[i + 1], numbers[i + 2] });
  }
}

/** Adds cells of the points from `first` on: cell c has the corners up to ends[c].
 *  Throws UnfitFile unless every end and corner fits. */
inline void
AddCells(MeshFile &                        file,
         const std::vector<std::int64_t> & corners,
         const std::vector<std::int64_t> & ends,
         std::size_t                       first,
         bool                              areStrips)
{
  const std::size_t          points = file.mesh.points.size() - first;
  std::vector<std::uint32_t> cell;
  std::int64_t               begin = 0;
  for (const std::int64_t end : ends)
  {
    RequireFit(end >= begin && end <= static_cast<std::int64_t>(corners.size()), "its cells' offsets are damaged");
    cell.clear();
    for (; begin < end; ++begin)
    {
      const std::int64_t corner = corners[static_cast<std::size_t>(begin)];
      RequireFit(corner >= 0 && static_cast<std::size_t>(corner) < points, "a polygon has a corner that is no point");
      cell.push_back(static_cast<std::uint32_t>(first + static_cast<std::size_t>(corner)));
    }
    if (!areStrips)
    {
      AddPolygon(file, cell);
      continue;
    }
    for (std::size_t i = 2; i < cell.size(); ++i)
    {
      const std::size_t odd = i % 2; // every other triangle of a strip is turned over
      file.mesh.triangles.push_back({ cell[i - 2 + odd], cell[i - 1 - odd], cell[i] });
    }
  }
  RequireFit(begin == static_cast<std::int64_t>(corners.size()), "it has more corners than its polygons take");
}

} // namespace voxelcore
