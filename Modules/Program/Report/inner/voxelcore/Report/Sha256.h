#pragma once
// SHA-256 (FIPS 180-4), and the digest that names a scan in a report.

#include "voxelcore/Imaging/LabelVolume.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

struct evp_md_ctx_st; // of OpenSSL

namespace voxelcore
{

/** Digest of a stream of bytes, by libcrypto. \throws Error when that refuses. */
class Sha256
{
public:
  Sha256();

  void
  Update(std::span<const std::byte> bytes);

  /** 64 lower-case hexadecimal digits. Ends the stream. */
  std::string
  Finish();

private:
  std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st *)> m_Context;
};

std::string
TextSha256(std::string_view text);

/** \throws InputError when the file cannot be read. */
std::string
FileSha256(const std::filesystem::path & path);

/** FileSha256 of a scan in one file; of several, the digest of the lines "<digest>  <file name>\n". So the folder's
 *  place does not matter, its content does. Of a Zarr store, of what `reading` reads of it. */
std::string
ScanSha256(const std::filesystem::path & scan, const ReadOptions & reading);
std::string
ScanSha256(const std::filesystem::path & scan);

} // namespace voxelcore
