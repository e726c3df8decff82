#pragma once
// Voxels that come by pieces: rows of a picture, pages, packed blocks.

#include "voxelcore/Formats/ByteStream.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>

namespace voxelcore
{

class PieceStream : public ByteStream
{
public:
  std::size_t
  ReadSome(std::byte * to, std::size_t count) final
  {
    std::size_t done = 0;
    while (done < count)
    {
      if (m_Left.empty())
      {
        m_Left = NextPiece();
      }
      const auto now = m_Left.first(std::min(count - done, m_Left.size()));
      if (now.empty())
      {
        break;
      }
      std::memcpy(to + done, now.data(), now.size());
      done += now.size();
      m_Left = m_Left.subspan(now.size());
    }
    return done;
  }

  bool
  Finish() override
  {
    return false;
  }

protected:
  using ByteStream::ByteStream;

  /** The next bytes, which stay until it is called again; none at the end. */
  virtual std::span<const std::byte>
  NextPiece() = 0;

  /** Whether all of the piece at hand has been read. */
  bool
  IsBetweenPieces() const
  {
    return m_Left.empty();
  }

private:
  std::span<const std::byte> m_Left;
};

} // namespace voxelcore
