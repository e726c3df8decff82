#pragma once
// SHA-256 (FIPS 180-4), and the digest that names a scan in a report.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace voxelcore
{

/** Digest of a stream of bytes. */
class Sha256
{
public:
  void
  Update(std::span<const std::byte> bytes);

  /** 64 lower-case hexadecimal digits. Ends the stream. */
  std::string
  Finish();

private:
  void
  Block(const std::byte * block);

  std::array<std::uint32_t, 8> m_State{ 0x6a09e667U, 0xbb67ae85U, 0x3c6ef372U, 0xa54ff53aU,
                                        0x510e527fU, 0x9b05688cU, 0x1f83d9abU, 0x5be0cd19U };
  std::array<std::byte, 64>    m_Buffer{};
  std::size_t                  m_Buffered = 0;
  std::uint64_t                m_Length = 0; ///< bytes
};

/** \throws InputError when the file cannot be read. */
std::string
FileSha256(const std::filesystem::path & path);

/** FileSha256 of a scan in one file; of several, the digest of the lines "<digest>  <file name>\n". So the folder's
 *  place does not matter, its content does. */
std::string
ScanSha256(const std::filesystem::path & scan);

} // namespace voxelcore
