#include "voxelcore/Report/Sha256.h"

#include "voxelcore/Base/Error.h"

#include <openssl/evp.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

namespace voxelcore
{

namespace
{

std::span<const std::byte>
AsBytes(std::string_view text)
{
  return std::as_bytes(std::span(text.data(), text.size()));
}

} // namespace

Sha256::Sha256()
  : m_Context(EVP_MD_CTX_new(), EVP_MD_CTX_free)
{
  if (m_Context == nullptr || EVP_DigestInit_ex(m_Context.get(), EVP_sha256(), nullptr) != 1)
  {
    throw Error("libcrypto refuses SHA-256 here");
  }
}

void
Sha256::Update(std::span<const std::byte> bytes)
{
  if (EVP_DigestUpdate(m_Context.get(), bytes.data(), bytes.size()) != 1)
  {
    throw Error("libcrypto failed in SHA-256");
  }
}

std::string
Sha256::Finish()
{
  std::array<unsigned char, 32> digest{};
  if (EVP_DigestFinal_ex(m_Context.get(), digest.data(), nullptr) != 1)
  {
    throw Error("libcrypto failed in SHA-256");
  }
  static constexpr char digits[] = "0123456789abcdef";
  std::string           text;
  for (const unsigned char byte : digest)
  {
    text += digits[byte >> 4U];
    text += digits[byte & 15U];
  }
  return text;
}

std::string
TextSha256(std::string_view text)
{
  Sha256 digest;
  digest.Update(AsBytes(text));
  return digest.Finish();
}

std::string
FileSha256(const std::filesystem::path & path)
{
  std::ifstream          file(path, std::ios::binary);
  std::vector<std::byte> buffer(std::size_t{ 1 } << 18U);
  Sha256                 digest;
  while (file)
  {
    file.read(reinterpret_cast<char *>(buffer.data()), static_cast<std::streamsize>(buffer.size()));
    digest.Update({ buffer.data(), static_cast<std::size_t>(file.gcount()) });
  }
  if (!file.eof())
  {
    throw InputError(path.string() + ": cannot read: " + std::strerror(errno));
  }
  return digest.Finish();
}

std::string
ScanSha256(const std::filesystem::path & scan, const ReadOptions & reading)
{
  const auto files = ScanFiles(scan, reading);
  if (files.size() == 1)
  {
    return FileSha256(files.front());
  }
  Sha256 digest;
  for (const auto & file : files)
  {
    digest.Update(AsBytes(FileSha256(file) + "  " + file.filename().string() + "\n"));
  }
  return digest.Finish();
}

std::string
ScanSha256(const std::filesystem::path & scan)
{
  return ScanSha256(scan, ReadOptions());
}

} // namespace voxelcore
