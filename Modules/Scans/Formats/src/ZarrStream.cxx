#include "ZarrStream.h"

#include "voxelcore/Base/TextFields.h"

#include <algorithm>
#include <cstring>

namespace voxelcore
{
namespace
{

using Bytes = std::vector<std::byte>;

/** As many chunks side by side are kept as fit into this; beyond it, they are unpacked anew for each of their slices.
 *  */
constexpr std::uint64_t kLargestLayer = std::uint64_t{ 1 } << 30;

} // namespace

ZarrStream::ZarrStream(const std::filesystem::path & path,
                       ZarrVolume                    volume,
                       const ZarrTriple &            size,
                       const CropRange &             part)
  : ByteStream(path)
  , m_Volume(std::move(volume))
  , m_Size(size)
  , m_Part(part)
  , m_Grid(m_Volume.image, part)
  , m_Width(PixelBytes(m_Volume.image.array.type))
  , m_Offset(m_Volume.OffsetInChunk())
  , m_Row(static_cast<std::size_t>(size[2]) * m_Width)
{}

std::size_t
ZarrStream::ReadSome(std::byte * to, std::size_t count)
{
  std::size_t done = 0;
  while (done < count && m_At < m_Row.size() * m_Size[0] * m_Size[1])
  {
    const std::uint64_t row = m_At / m_Row.size();
    const auto          within = static_cast<std::size_t>(m_At % m_Row.size());
    const std::size_t   now = std::min(count - done, m_Row.size() - within);
    if (row != m_Filled)
    {
      FillRow(row / m_Size[1], row % m_Size[1]);
      m_Filled = row;
    }
    std::memcpy(to + done, m_Row.data() + within, now);
    done += now;
    m_At += now;
  }
  return done;
}

void
ZarrStream::Skip(std::uint64_t count)
{
  m_At += count;
}

bool
ZarrStream::Finish()
{
  return false;
}

void
ZarrStream::FillRow(std::uint64_t k, std::uint64_t j)
{
  const auto isIn = [&](std::uint64_t at, std::size_t axis) {
    return at >= static_cast<std::uint64_t>(m_Part.first[axis]) && at < static_cast<std::uint64_t>(m_Part.end[axis]);
  };
  std::memset(m_Row.data(), 0, m_Row.size());
  if (!isIn(k, 2) || !isIn(j, 1))
  {
    return;
  }
  for (std::uint64_t i = m_Grid.first[2]; i < m_Grid.end[2]; ++i)
  {
    const ZarrTriple at{ k / m_Grid.side[0], j / m_Grid.side[1], i };
    const ZarrTriple sides = SidesOf(at);
    const Bytes &    chunk = Chunk(at);
    std::byte *      to = m_Row.data() + i * m_Grid.side[2] * m_Width;
    if (chunk.empty())
    {
      FillValues(to, sides[2]);
      continue;
    }
    const std::uint64_t row = k % m_Grid.side[0] * sides[1] + j % m_Grid.side[1];
    std::memcpy(to, chunk.data() + row * sides[2] * m_Width, sides[2] * m_Width);
  }
}

void
ZarrStream::FillValues(std::byte * to, std::uint64_t count) const
{
  const auto & fill = m_Volume.image.array.fill;
  if (!fill)
  {
    RefuseInput(m_Path,
                "a chunk is not there, and no value is named for what is missing",
                "the store is not whole: copy it anew");
  }
  for (std::uint64_t x = 0; x < count; ++x, to += m_Width)
  {
    std::memcpy(to, fill->data(), m_Width);
  }
}

ZarrTriple
ZarrStream::SidesOf(const ZarrTriple & at) const
{
  ZarrTriple sides{};
  for (std::size_t n = 0; n < 3; ++n)
  {
    sides[n] = std::min(m_Grid.side[n], m_Size[n] - at[n] * m_Grid.side[n]);
  }
  return sides;
}

Bytes
ZarrStream::VoxelsOf(Bytes chunk, const ZarrTriple & sides) const
{
  const auto &      strides = m_Volume.image.array.strides;
  const auto &      spatial = m_Volume.image.spatial;
  const ZarrTriple  step{ strides[spatial[0]], strides[spatial[1]], strides[spatial[2]] };
  const std::size_t size = sides[0] * sides[1] * sides[2] * m_Width;
  if (size == chunk.size() && step == ZarrTriple{ sides[1] * sides[2], sides[2], 1 })
  {
    return chunk;
  }
  Bytes       voxels(size);
  std::byte * to = voxels.data();
  for (std::uint64_t k = 0; k < sides[0]; ++k)
  {
    for (std::uint64_t j = 0; j < sides[1]; ++j)
    {
      const std::byte * from = chunk.data() + (m_Offset + k * step[0] + j * step[1]) * m_Width;
      if (step[2] == 1)
      {
        std::memcpy(to, from, sides[2] * m_Width);
        to += sides[2] * m_Width;
        continue;
      }
      for (std::uint64_t i = 0; i < sides[2]; ++i, to += m_Width, from += step[2] * m_Width)
      {
        std::memcpy(to, from, m_Width);
      }
    }
  }
  return voxels;
}

const Bytes &
ZarrStream::Chunk(const ZarrTriple & at)
{
  if (const auto found = m_Chunks.find(at); found != m_Chunks.end())
  {
    return found->second;
  }
  const ZarrTriple    sides = SidesOf(at);
  const std::uint64_t bytes = sides[0] * sides[1] * sides[2] * m_Width;
  if (at[0] != m_Layer)
  {
    m_Chunks.clear();
    m_Held = 0;
    m_Layer = at[0];
  }
  if (m_Held + bytes > kLargestLayer)
  {
    std::erase_if(m_Chunks, [&](const auto & one) { return one.first[1] != at[1]; });
    m_Held = 0;
    for (const auto & one : m_Chunks)
    {
      m_Held += one.second.size();
    }
  }
  auto chunk = ReadZarrChunk(m_Volume.image.array, m_Volume.ChunkIndex(at), m_CheckedShards);
  m_Held += chunk ? bytes : 0;
  return m_Chunks.emplace(at, chunk ? VoxelsOf(std::move(*chunk), sides) : Bytes()).first->second;
}

} // namespace voxelcore
