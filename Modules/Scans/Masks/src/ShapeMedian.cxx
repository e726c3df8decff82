#include "voxelcore/Masks/ShapeMedian.h"

#include "FilteredShape.h"

#include "voxelcore/Base/CountBits.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

using Word = std::uint64_t;

/** The rows of a cube's height and depth about a row, of which each has this word, and the ones before and after it. */
class RowsAround
{
public:
  RowsAround(const VoxelShape & shape, std::int32_t y, std::int32_t z, std::int32_t reach)
    : m_Reach(reach)
    , m_Words(shape.WordsPerRow())
    , m_Half(static_cast<int>((2 * reach + 1) * (2 * reach + 1) * (2 * reach + 1) / 2))
  {
    const auto & size = shape.Box().size;
    for (std::int32_t nz = std::max(0, z - reach); nz <= std::min(size[2] - 1, z + reach); ++nz)
    {
      for (std::int32_t ny = std::max(0, y - reach); ny <= std::min(size[1] - 1, y + reach); ++ny)
      {
        m_Rows.push_back(shape.Row(ny, nz));
      }
    }
    m_IsWhole = m_Rows.size() == static_cast<std::size_t>((2 * reach + 1) * (2 * reach + 1));
  }

  Word
  Median(std::size_t word) const
  {
    Word any = 0;
    Word all = ~Word{ 0 };
    for (const ConstShapeRow & row : m_Rows)
    {
      for (const Word part : { At(row, word, -1), row[word], At(row, word, 1) })
      {
        any |= part;
        all &= part;
      }
    }
    return any == 0 ? 0 : m_IsWhole && all == ~Word{ 0 } ? all : Count(word);
  }

private:
  Word
  At(const ConstShapeRow & row, std::size_t word, int beside) const
  {
    const std::size_t at = word + static_cast<std::size_t>(beside);
    return at < m_Words ? row[at] : 0; // before the first, it is the greatest number
  }

  Word
  Count(std::size_t word) const
  {
    const auto          reach = static_cast<unsigned>(m_Reach);
    const Word          window = (Word{ 1 } << (2 * reach + 1)) - 1;
    std::array<int, 64> counts{};
    for (const ConstShapeRow & row : m_Rows)
    {
      const Word before = At(row, word, -1);
      const Word here = row[word];
      const Word after = At(row, word, 1);
      if ((before | here | after) == 0)
      {
        continue;
      }
      // Bits 0 to 2 reach are the window of the first voxel, and so on; what is shifted out is no longer needed.
      Word low = here << reach | before >> (64 - reach);
      Word high = here >> (64 - reach) | after << reach;
      for (int & count : counts)
      {
        count += CountBits(low & window);
        low = low >> 1 | high << 63;
        high >>= 1;
      }
    }
    Word median = 0;
    for (unsigned bit = 0; bit < 64; ++bit)
    {
      median |= static_cast<Word>(counts[bit] > m_Half) << bit;
    }
    return median;
  }

  std::int32_t               m_Reach;
  std::size_t                m_Words;
  int                        m_Half;
  bool                       m_IsWhole = false;
  std::vector<ConstShapeRow> m_Rows;
};

constexpr std::int32_t kWidest = 15;

void
RequireOdd(MedianWidth width)
{
  if (width.voxels % 2 == 0 || width.voxels < 3 || width.voxels > kWidest)
  {
    throw UsageError("expected an odd number from 3 to " + std::to_string(kWidest));
  }
}

} // namespace

MedianWidth
ParseMedianWidth(const std::string & text)
{
  MedianWidth width{ 0 };
  const auto [end, error] = from_chars(text.data(), text.data() + text.size(), width.voxels);
  if (error != std::errc() || end != text.data() + text.size())
  {
    width.voxels = 0;
  }
  RequireOdd(width);
  return width;
}

EditedShape
MedianShape(const VoxelShape & shape, MedianWidth width, const ProgressCallback & progress)
{
  RequireOdd(width);
  VoxelShape             result(shape.Box());
  const auto             reach = width.voxels / 2;
  const auto             size = shape.Box().size;
  constexpr std::int32_t slab = 32;
  for (std::int32_t first = 0; first < size[2]; first += slab)
  {
    ReportProgress(progress, "median", static_cast<double>(first) / size[2]);
    const std::int32_t last = std::min(size[2], first + slab);
    RunEach(static_cast<std::size_t>(last - first), [&](std::size_t i) {
      const std::int32_t z = first + static_cast<std::int32_t>(i);
      for (std::int32_t y = 0; y < size[1]; ++y)
      {
        const RowsAround around(shape, y, z, reach);
        const auto       to = result.Row(y, z);
        for (std::size_t word = 0; word < to.size(); ++word)
        {
          to[word] = around.Median(word);
        }
      }
    });
  }
  return FilteredShape(shape, std::move(result));
}

} // namespace voxelcore
