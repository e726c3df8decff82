#include "voxelcore/Formats/ByteStream.h"
#include "ScanBytes.h"

#include <random>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

std::string
RandomBytes(std::size_t count, unsigned seed)
{
  std::mt19937 random(seed);
  std::string  bytes(count, '\0');
  for (char & byte : bytes)
  {
    byte = static_cast<char>(random() % 7); // so that it can be packed
  }
  return bytes;
}

/** Reads and skips by turns, in random steps; `whole` is what the stream must give. */
void
ExpectBytes(ByteStream & stream, const std::string & whole, unsigned seed)
{
  std::mt19937 random(seed);
  std::size_t  at = 0;
  while (at < whole.size())
  {
    const std::size_t count = std::min<std::size_t>(whole.size() - at, 1 + random() % 40000);
    if (random() % 3 == 0)
    {
      stream.Skip(count);
    }
    else
    {
      std::string got(count, '?');
      stream.Read(reinterpret_cast<std::byte *>(got.data()), count);
      ASSERT_EQ(got, whole.substr(at, count)) << "at " << at;
    }
    at += count;
  }
}

std::string
Hex(const std::string & bytes)
{
  std::string text;
  for (const char byte : bytes)
  {
    constexpr const char * kDigits = "0123456789abcdef";
    text += kDigits[static_cast<unsigned char>(byte) / 16];
    text += kDigits[static_cast<unsigned char>(byte) % 16];
    text += text.size() % 62 == 0 ? "\n" : "";
  }
  return text;
}

class ByteStreams : public ::testing::Test
{
protected:
  const TempFolder  m_Folder;
  const std::string m_Bytes = RandomBytes(300000, 11);
};

} // namespace

TEST_F(ByteStreams, GiveTheSameBytesHoweverTheyArePackedReadOrSkipped)
{
  const struct
  {
    Packing     packing;
    std::string stored;
  } cases[] = { { Packing::Plain, m_Bytes },
                { Packing::Deflate, Gzip(m_Bytes) },
                { Packing::Deflate, Zlib(m_Bytes) },
                { Packing::Deflate, Gzip(m_Bytes.substr(0, 1000)) + Gzip(m_Bytes.substr(1000)) },
                { Packing::Hex, Hex(m_Bytes) } };
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  for (const auto & one : cases)
  {
    SCOPED_TRACE(static_cast<int>(one.packing));
    const auto path = m_Folder.Write("a", "head" + one.stored);
    const auto stream = OpenBytes(path, 4, one.packing);
    ExpectBytes(*stream, m_Bytes, seed);
    EXPECT_FALSE(stream->Finish());
    std::byte more;
    EXPECT_EQ(stream->ReadSome(&more, 1), 0U);
  }
}

TEST_F(ByteStreams, TellThatDataAreLeftOver)
{
  for (const Packing packing : { Packing::Plain, Packing::Deflate })
  {
    const auto path = m_Folder.Write("a", packing == Packing::Plain ? m_Bytes : Gzip(m_Bytes));
    const auto stream = OpenBytes(path, 0, packing);
    stream->Skip(m_Bytes.size() - 1);
    EXPECT_TRUE(stream->Finish());
  }
}

TEST_F(ByteStreams, RefuseWhatIsCutOffOrDamaged)
{
  std::vector<std::byte> got(m_Bytes.size());
  const auto             plain = OpenBytes(m_Folder.Write("a", m_Bytes.substr(1)), 0, Packing::Plain);
  EXPECT_THROW(plain->Read(got.data(), got.size()), InputError);
  const std::string packed = Gzip(m_Bytes);
  const auto        cut = OpenBytes(m_Folder.Write("b", packed.substr(0, packed.size() / 2)), 0, Packing::Deflate);
  EXPECT_THROW(cut->Read(got.data(), got.size()), InputError);
  // A wrong checksum: all bytes come, and Finish() finds it.
  std::string wrong = packed;
  wrong[wrong.size() - 6] = static_cast<char>(wrong[wrong.size() - 6] ^ 1);
  EXPECT_THROW(
    {
      const auto stream = OpenBytes(m_Folder.Write("c", wrong), 0, Packing::Deflate);
      stream->Read(got.data(), got.size());
      stream->Finish();
    },
    InputError);
  EXPECT_THROW(OpenBytes(m_Folder.Write("d", "0x"), 0, Packing::Hex)->Read(got.data(), 1), InputError);
  EXPECT_THROW(FileSize(m_Folder / "nowhere"), InputError);
  EXPECT_THROW(FileSize(m_Folder.Path()), InputError);
}

TEST_F(ByteStreams, OfSeveralFilesAreOneWhichOpensEachInItsTurn)
{
  std::vector<std::filesystem::path> paths;
  for (std::size_t part = 0; part < 3; ++part)
  {
    paths.push_back(m_Folder.Write(std::to_string(part), m_Bytes.substr(part * 100000, 100000)));
  }
  int        opened = 0;
  const auto stream = OpenParts(paths, 100000, [&](const std::filesystem::path & path) {
    EXPECT_EQ(path, paths[static_cast<std::size_t>(opened)]);
    ++opened;
    return OpenBytes(path, 0, Packing::Plain);
  });
  EXPECT_LE(opened, 1);
  ExpectBytes(*stream, m_Bytes, 5);
  EXPECT_EQ(opened, 3);
  EXPECT_FALSE(stream->Finish());
}

TEST_F(ByteStreams, PackingIsToldByTheFirstBytesNotByTheName)
{
  EXPECT_EQ(DetectGzip(m_Folder.Write("a.nii", Gzip("x"))), Packing::Deflate);
  EXPECT_EQ(DetectGzip(m_Folder.Write("a.nii.gz", "x")), Packing::Plain);
}

TEST_F(ByteStreams, NoPackingStandsForMoreThanItsLargestExpansion)
{
  const std::string zeros(10000000, '\0');
  EXPECT_LE(zeros.size(), LargestExpansion(Packing::Deflate) * Gzip(zeros).size());
  EXPECT_GT(zeros.size(), 500 * Gzip(zeros).size()); // so the bound is met by something that comes near it
  EXPECT_EQ(LargestExpansion(Packing::Plain), 1U);
  EXPECT_EQ(LargestExpansion(Packing::Hex), 1U);
}

TEST_F(ByteStreams, OfSeveralFilesPassOverWholeOnesWithoutOpeningThem)
{
  std::vector<std::filesystem::path> paths;
  for (std::size_t part = 0; part < 4; ++part)
  {
    paths.push_back(m_Folder.Write(std::to_string(part), m_Bytes.substr(part * 1000, 1000)));
  }
  std::string opened;
  const auto  stream = OpenParts(paths, 1000, [&](const std::filesystem::path & path) {
    opened += path.filename().string();
    return OpenBytes(path, 0, Packing::Plain);
  });
  std::byte   one{};
  const auto  next = [&](std::size_t at) {
    stream->Announce(0, 100); // changes nothing
    stream->Read(&one, 1);
    EXPECT_EQ(one, static_cast<std::byte>(m_Bytes[at]));
  };
  next(0);
  stream->Skip(10);
  next(11);
  stream->Skip(2500);
  next(2512);
  EXPECT_EQ(opened, "02");
  stream->Announce(2000, 5); // beyond the file that is open
  stream->Skip(487);
  EXPECT_FALSE(stream->Finish());
  next(3000);
  EXPECT_FALSE(stream->Finish()); // not at the end of a file
  stream->Skip(999);
  EXPECT_EQ(stream->ReadSome(&one, 1), 0U);
  EXPECT_EQ(opened, "023");
  EXPECT_THROW(stream->Skip(1), InputError);
}

TEST_F(ByteStreams, WhatHasNoNameOrIsNoFileIsRefused)
{
  EXPECT_THROW(OpenBytes(m_Folder / "nowhere", 0, Packing::Plain), InputError);
  EXPECT_THROW(FileSize(std::string(5000, 'x')), InputError);
  EXPECT_THROW(FileSize(m_Folder.Write("file", "x") / "below"), InputError);
  EXPECT_THROW(FileSize("/dev/null"), InputError);
}
