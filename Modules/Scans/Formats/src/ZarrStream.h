#pragma once
// The voxels of one volume of a Zarr image, as a stream that reads the chunks it passes.

#include "voxelcore/Formats/ByteStream.h"
#include "ZarrImage.h"
#include "voxelcore/Labels/CropRange.h"

#include <array>
#include <map>
#include <set>

namespace voxelcore
{

using ZarrTriple = std::array<std::uint64_t, 3>; ///< along k, j, i

/** The chunks that a part of a volume lies in. */
struct ZarrGrid
{
  ZarrTriple first{}; ///< chunk
  ZarrTriple end{};
  ZarrTriple side{}; ///< of a chunk, voxels

  ZarrGrid(const ZarrImage & image, const CropRange & part)
  {
    for (std::size_t n = 0; n < 3; ++n)
    {
      side[n] = image.array.chunk[image.spatial[n]];
      first[n] = static_cast<std::uint64_t>(part.first[2 - n]) / side[n];
      end[n] = (static_cast<std::uint64_t>(part.end[2 - n]) + side[n] - 1) / side[n];
    }
  }
  double
  Count() const
  {
    double count = 1;
    for (std::size_t n = 0; n < 3; ++n)
    {
      count *= static_cast<double>(end[n] - first[n]);
    }
    return count;
  }
  template <typename Visit>
  void
  Each(Visit && visit) const
  {
    ZarrTriple at{};
    for (at[0] = first[0]; at[0] < end[0]; ++at[0])
    {
      for (at[1] = first[1]; at[1] < end[1]; ++at[1])
      {
        for (at[2] = first[2]; at[2] < end[2]; ++at[2])
        {
          if (!visit(at))
          {
            return;
          }
        }
      }
    }
  }
};

/** One volume of an image: channel and time point are chosen. */
struct ZarrVolume
{
  ZarrImage                  image;
  std::vector<std::uint64_t> place; ///< in the array, of the first voxel

  /** The chunk at a place of the grid of chunks. */
  std::vector<std::uint64_t>
  ChunkIndex(const ZarrTriple & at) const
  {
    std::vector<std::uint64_t> index(place.size());
    for (std::size_t a = 0; a < place.size(); ++a)
    {
      index[a] = place[a] / image.array.chunk[a];
    }
    for (std::size_t n = 0; n < 3; ++n)
    {
      index[image.spatial[n]] = at[n];
    }
    return index;
  }

  /** Values in a chunk before the first one of this volume. */
  std::uint64_t
  OffsetInChunk() const
  {
    std::uint64_t offset = 0;
    for (std::size_t a = 0; a < place.size(); ++a)
    {
      offset += place[a] % image.array.chunk[a] * image.array.strides[a];
    }
    return offset;
  }
};

/** Where a part is so large that chunks that are missing would take long, some must be there.
 *  \throws InputError when nearly none is */
void
RequireSomeZarrChunks(const std::filesystem::path & path, const ZarrVolume & volume, const CropRange & part);

class ZarrStream : public ByteStream
{
public:
  /** Beyond `part` nobody looks: what is given there is 0. */
  ZarrStream(const std::filesystem::path & path, ZarrVolume volume, const ZarrTriple & size, const CropRange & part);

  std::size_t
  ReadSome(std::byte * to, std::size_t count) override;
  void
  Skip(std::uint64_t count) override;
  bool
  Finish() override;

private:
  void
  FillRow(std::uint64_t k, std::uint64_t j);
  void
  FillValues(std::byte * to, std::uint64_t count) const;
  /** The voxels of a chunk. Empty when it is not there. */
  const std::vector<std::byte> &
  Chunk(const ZarrTriple & at);
  /** Of what lies of a chunk in the volume. */
  ZarrTriple
  SidesOf(const ZarrTriple & at) const;
  /** What lies of it in the volume, row by row. The rest, which fills it up or belongs to other volumes, may take any
   *  amount of memory: 64 KB of zstd stand for 2 GB. */
  std::vector<std::byte>
  VoxelsOf(std::vector<std::byte> chunk, const ZarrTriple & sides) const;

  ZarrVolume                                   m_Volume;
  ZarrTriple                                   m_Size;
  CropRange                                    m_Part;
  ZarrGrid                                     m_Grid;
  std::size_t                                  m_Width; ///< bytes a value
  std::uint64_t                                m_Offset;
  std::vector<std::byte>                       m_Row;
  std::uint64_t                                m_Filled = UINT64_MAX; ///< the row that lies in m_Row
  std::uint64_t                                m_At = 0;
  std::uint64_t                                m_Layer = UINT64_MAX; ///< of the chunks held, along k
  std::map<ZarrTriple, std::vector<std::byte>> m_Chunks;
  std::uint64_t                                m_Held = 0; ///< bytes in m_Chunks
  std::set<std::filesystem::path>              m_CheckedShards;
};

} // namespace voxelcore
