#pragma once
// Numbers as bytes on a stream, with a checksum of all bytes so far.

#include "Checksum.h"

#include "voxelcore/Base/Error.h"

#include <istream>
#include <ostream>
#include <string>
#include <vector>

namespace voxelcore
{

/** The checksum of bytes, eight at a time. */
class ByteSum
{
public:
  void
  Add(std::uint8_t byte)
  {
    m_Word |= std::uint64_t{ byte } << (8 * (m_Bytes & 7U));
    if ((++m_Bytes & 7U) == 0)
    {
      m_Sum.Add(m_Word);
      m_Word = 0;
    }
  }

  std::uint64_t
  Value() const
  {
    Checksum sum = m_Sum;
    sum.Add(m_Word);
    sum.Add(m_Bytes);
    return sum.Value();
  }

private:
  Checksum      m_Sum;
  std::uint64_t m_Word = 0;
  std::uint64_t m_Bytes = 0;
};

/** A signed number as an unsigned one: 0, -1, 1, -2, ... become 0, 1, 2, 3, ... */
inline std::uint64_t
Fold(std::int64_t value)
{
  return static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63);
}

inline std::int64_t
Unfold(std::uint64_t value)
{
  return static_cast<std::int64_t>(value >> 1 ^ (~(value & 1U) + 1));
}

/** Little-endian base 128: seven bits a byte, the highest bit says that more follow. */
class Encoder
{
public:
  explicit Encoder(std::ostream & stream)
    : m_Stream(stream)
  {
    m_Buffer.reserve(bufferSize);
  }

  void
  Byte(std::uint8_t byte)
  {
    m_Sum.Add(byte);
    m_Buffer.push_back(static_cast<char>(byte));
    if (m_Buffer.size() == bufferSize)
    {
      Flush();
    }
  }

  void
  Number(std::uint64_t value)
  {
    for (; value > 127; value >>= 7)
    {
      Byte(static_cast<std::uint8_t>((value & 127U) | 128U));
    }
    Byte(static_cast<std::uint8_t>(value));
  }

  void
  Step(std::int64_t from, std::int64_t to)
  {
    Number(Fold(to - from));
  }

  void
  Sum()
  {
    const std::uint64_t sum = m_Sum.Value();
    for (unsigned shift = 0; shift < 64; shift += 8)
    {
      Byte(static_cast<std::uint8_t>(sum >> shift));
    }
  }

  void
  Flush()
  {
    m_Stream.write(m_Buffer.data(), static_cast<std::streamsize>(m_Buffer.size()));
    m_Buffer.clear();
    if (!m_Stream)
    {
      throw OutputError("cannot write a block's part; is the disk full?");
    }
  }

private:
  static constexpr std::size_t bufferSize = std::size_t{ 1 } << 16;

  std::ostream &    m_Stream;
  std::vector<char> m_Buffer;
  ByteSum           m_Sum;
};

/** Reads what Encoder wrote; every complaint is an InputError that begins with the name. */
class Decoder
{
public:
  Decoder(std::istream & stream, const std::string & name)
    : m_Stream(stream)
    , m_Name(name)
    , m_Buffer(std::size_t{ 1 } << 16)
  {}

  [[noreturn]] void
  Fail(const std::string & what) const
  {
    throw InputError(m_Name + " " + what);
  }

  [[noreturn]] void
  FailDamaged() const
  {
    Fail("is damaged; compute this block again");
  }

  [[noreturn]] void
  FailCutOff() const
  {
    Fail("is cut off; compute this block again");
  }

  std::uint8_t
  Byte()
  {
    if (m_At == m_End && !Fill())
    {
      FailCutOff();
    }
    const auto byte = static_cast<std::uint8_t>(m_Buffer[m_At++]);
    m_Sum.Add(byte);
    return byte;
  }

  std::uint64_t
  Number()
  {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7)
    {
      const std::uint8_t byte = Byte();
      value |= std::uint64_t{ byte & 127U } << shift;
      if (byte < 128)
      {
        return value;
      }
    }
    FailDamaged();
  }

  /** A number from least to greatest. */
  std::uint64_t
  Number(std::uint64_t least, std::uint64_t greatest)
  {
    const std::uint64_t value = Number();
    if (value < least || value > greatest)
    {
      FailDamaged();
    }
    return value;
  }

  /** A signed step from a number of 32 bits; the result lies in least to greatest. */
  std::int64_t
  Step(std::int64_t from, std::int64_t least, std::int64_t greatest)
  {
    const std::int64_t step = Unfold(Number(0, std::uint64_t{ 1 } << 34));
    if (from + step < least || from + step > greatest)
    {
      FailDamaged();
    }
    return from + step;
  }

  void
  Sum()
  {
    const std::uint64_t expected = m_Sum.Value();
    std::uint64_t       sum = 0;
    for (unsigned shift = 0; shift < 64; shift += 8)
    {
      sum |= std::uint64_t{ Byte() } << shift;
    }
    if (sum != expected)
    {
      FailDamaged();
    }
  }

  bool
  AtEnd()
  {
    return m_At == m_End && !Fill();
  }

private:
  bool
  Fill()
  {
    m_Stream.read(m_Buffer.data(), static_cast<std::streamsize>(m_Buffer.size()));
    m_At = 0;
    m_End = static_cast<std::size_t>(m_Stream.gcount());
    if (m_Stream.bad())
    {
      Fail("cannot be read; compute this block again");
    }
    return m_End > 0;
  }

  std::istream &      m_Stream;
  const std::string & m_Name;
  std::vector<char>   m_Buffer;
  std::size_t         m_At = 0;
  std::size_t         m_End = 0;
  ByteSum             m_Sum;
};

} // namespace voxelcore
