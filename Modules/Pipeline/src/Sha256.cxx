#include "voxelcore/Sha256.h"

#include "voxelcore/Error.h"
#include "voxelcore/LabelVolume.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace voxelcore
{

namespace
{

constexpr std::array<std::uint32_t, 64> kRound{
  0x428a2f98U, 0x71374491U, 0xb5c0fbcfU, 0xe9b5dba5U, 0x3956c25bU, 0x59f111f1U, 0x923f82a4U, 0xab1c5ed5U,
  0xd807aa98U, 0x12835b01U, 0x243185beU, 0x550c7dc3U, 0x72be5d74U, 0x80deb1feU, 0x9bdc06a7U, 0xc19bf174U,
  0xe49b69c1U, 0xefbe4786U, 0x0fc19dc6U, 0x240ca1ccU, 0x2de92c6fU, 0x4a7484aaU, 0x5cb0a9dcU, 0x76f988daU,
  0x983e5152U, 0xa831c66dU, 0xb00327c8U, 0xbf597fc7U, 0xc6e00bf3U, 0xd5a79147U, 0x06ca6351U, 0x14292967U,
  0x27b70a85U, 0x2e1b2138U, 0x4d2c6dfcU, 0x53380d13U, 0x650a7354U, 0x766a0abbU, 0x81c2c92eU, 0x92722c85U,
  0xa2bfe8a1U, 0xa81a664bU, 0xc24b8b70U, 0xc76c51a3U, 0xd192e819U, 0xd6990624U, 0xf40e3585U, 0x106aa070U,
  0x19a4c116U, 0x1e376c08U, 0x2748774cU, 0x34b0bcb5U, 0x391c0cb3U, 0x4ed8aa4aU, 0x5b9cca4fU, 0x682e6ff3U,
  0x748f82eeU, 0x78a5636fU, 0x84c87814U, 0x8cc70208U, 0x90befffaU, 0xa4506cebU, 0xbef9a3f7U, 0xc67178f2U
};

std::uint32_t
BigEndian(const std::byte * bytes)
{
  return (std::to_integer<std::uint32_t>(bytes[0]) << 24U) | (std::to_integer<std::uint32_t>(bytes[1]) << 16U) |
         (std::to_integer<std::uint32_t>(bytes[2]) << 8U) | std::to_integer<std::uint32_t>(bytes[3]);
}

std::span<const std::byte>
AsBytes(const std::string & text)
{
  return std::as_bytes(std::span(text.data(), text.size()));
}

} // namespace

void
Sha256::Block(const std::byte * block)
{
  std::array<std::uint32_t, 64> w;
  for (std::size_t t = 0; t < 16; ++t)
  {
    w[t] = BigEndian(block + 4 * t);
  }
  for (std::size_t t = 16; t < 64; ++t)
  {
    const std::uint32_t s0 = std::rotr(w[t - 15], 7) ^ std::rotr(w[t - 15], 18) ^ (w[t - 15] >> 3U);
    const std::uint32_t s1 = std::rotr(w[t - 2], 17) ^ std::rotr(w[t - 2], 19) ^ (w[t - 2] >> 10U);
    w[t] = w[t - 16] + s0 + w[t - 7] + s1;
  }
  auto [a, b, c, d, e, f, g, h] = m_State;
  for (std::size_t t = 0; t < 64; ++t)
  {
    const std::uint32_t sum1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
    const std::uint32_t t1 = h + sum1 + ((e & f) ^ (~e & g)) + kRound[t] + w[t];
    const std::uint32_t sum0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
    const std::uint32_t t2 = sum0 + ((a & b) ^ (a & c) ^ (b & c));
    h = g;
    g = f;
    f = e;
    e = d + t1;
    d = c;
    c = b;
    b = a;
    a = t1 + t2;
  }
  const std::array<std::uint32_t, 8> add{ a, b, c, d, e, f, g, h };
  for (std::size_t i = 0; i < 8; ++i)
  {
    m_State[i] += add[i];
  }
}

void
Sha256::Update(std::span<const std::byte> bytes)
{
  m_Length += bytes.size();
  while (!bytes.empty())
  {
    if (m_Buffered == 0 && bytes.size() >= m_Buffer.size())
    {
      Block(bytes.data());
      bytes = bytes.subspan(m_Buffer.size());
      continue;
    }
    const std::size_t take = std::min(bytes.size(), m_Buffer.size() - m_Buffered);
    std::copy_n(bytes.data(), take, m_Buffer.data() + m_Buffered);
    bytes = bytes.subspan(take);
    m_Buffered += take;
    if (m_Buffered == m_Buffer.size())
    {
      Block(m_Buffer.data());
      m_Buffered = 0;
    }
  }
}

std::string
Sha256::Finish()
{
  const std::uint64_t    bits = m_Length * 8;
  std::vector<std::byte> tail{ std::byte{ 0x80 } };
  while ((m_Buffered + tail.size()) % 64 != 56)
  {
    tail.push_back(std::byte{ 0 });
  }
  for (int shift = 56; shift >= 0; shift -= 8)
  {
    tail.push_back(static_cast<std::byte>(bits >> static_cast<unsigned>(shift)));
  }
  Update(tail);
  static constexpr char digits[] = "0123456789abcdef";
  std::string           text;
  for (const std::uint32_t word : m_State)
  {
    for (int shift = 28; shift >= 0; shift -= 4)
    {
      text += digits[(word >> static_cast<unsigned>(shift)) & 15U];
    }
  }
  return text;
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
ScanSha256(const std::filesystem::path & scan)
{
  const auto files = ScanFiles(scan);
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

} // namespace voxelcore
