#include "VoxelCoreTesting/TemporaryFolder.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Report/Sha256.h"

#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

using testing::TemporaryFolder;
using testing::WriteAll;

std::string
Digest(const std::string & text, std::size_t piece = 1000)
{
  Sha256 digest;
  for (std::size_t at = 0; at < text.size(); at += piece)
  {
    digest.Update(std::as_bytes(std::span(text).subspan(at, std::min(piece, text.size() - at))));
  }
  return digest.Finish();
}

// The examples of FIPS 180-4.
TEST(Sha256, GivesTheStandardsExamples)
{
  EXPECT_EQ(Digest(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(Digest("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(Digest("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(Digest(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, DoesNotDependOnHowTheStreamIsCut)
{
  std::string text;
  for (int i = 0; i < 300; ++i)
  {
    text += static_cast<char>(i * 7);
  }
  for (const std::size_t piece : { 1U, 3U, 55U, 56U, 63U, 64U, 65U, 128U, 299U })
  {
    EXPECT_EQ(Digest(text, piece), Digest(text)) << piece;
  }
}

TEST(ScanDigest, OfAFolderIsThatOfItsSlicesWhereverItLies)
{
  const TemporaryFolder one;
  const TemporaryFolder two;
  for (const TemporaryFolder * folder : { &one, &two })
  {
    WriteAll(*folder / "b.tif", "bee");
    WriteAll(*folder / "a.TIFF", "ay");
    WriteAll(*folder / "notes.txt", folder == &one ? "1" : "2");
  }
  EXPECT_EQ(ScanFiles(one.Path()), (std::vector{ one / "a.TIFF", one / "b.tif" }));
  EXPECT_EQ(ScanSha256(one.Path()), ScanSha256(two.Path()));
  EXPECT_EQ(ScanFiles(one / "*.tif"), (std::vector{ one / "b.tif" }));
  for (const char * pattern : { "?.tif", "a#.tif" })
  {
    EXPECT_THROW(ScanSha256(one / pattern), InputError) << pattern;
  }
  std::filesystem::create_directory(one / "p");
  WriteAll(one / "p/s_9.png", "nine");
  WriteAll(one / "p/s_10.png", "ten");
  for (const char * pattern : { "p", "p/s_%d.png", "p/s_*" })
  {
    EXPECT_EQ(ScanFiles(one / pattern), (std::vector{ one / "p/s_10.png", one / "p/s_9.png" })) << pattern;
  }
  EXPECT_EQ(ScanFiles(one / "p/s_##.png"), (std::vector{ one / "p/s_10.png" }));
  WriteAll(two / "b.tif", "bea");
  EXPECT_NE(ScanSha256(one.Path()), ScanSha256(two.Path()));
}

TEST(ScanDigest, OfADetachedHeaderCoversItsData)
{
  const TemporaryFolder folder;
  WriteAll(folder / "a.raw", "data");
  WriteAll(folder / "s02.raw", "2");
  WriteAll(folder / "s03.raw", "3");
  WriteAll(folder / "one.nhdr", "NRRD0004\ndata file: a.raw\n");
  WriteAll(folder / "many.nhdr", "NRRD0004\ndata file: s%02d.raw 2 3 1\n");
  WriteAll(folder / "list.nhdr", "NRRD0004\ndata file: LIST\ns03.raw\na.raw\n");
  WriteAll(folder / "meta.mhd", "ObjectType = Image\nElementDataFile = a.raw\n");
  WriteAll(folder / "local.mha", "ObjectType = Image\nElementDataFile = LOCAL\n");
  EXPECT_EQ(ScanFiles(folder / "one.nhdr"), (std::vector{ folder / "one.nhdr", folder / "a.raw" }));
  EXPECT_EQ(ScanFiles(folder / "many.nhdr"),
            (std::vector{ folder / "many.nhdr", folder / "s02.raw", folder / "s03.raw" }));
  EXPECT_EQ(ScanFiles(folder / "list.nhdr"),
            (std::vector{ folder / "list.nhdr", folder / "a.raw", folder / "s03.raw" }));
  EXPECT_EQ(ScanFiles(folder / "meta.mhd"), (std::vector{ folder / "meta.mhd", folder / "a.raw" }));
  EXPECT_EQ(ScanFiles(folder / "local.mha"), (std::vector{ folder / "local.mha" }));
  const std::string before = ScanSha256(folder / "one.nhdr");
  WriteAll(folder / "a.raw", "dada");
  EXPECT_NE(ScanSha256(folder / "one.nhdr"), before);
}

TEST(ScanDigest, RefusesAMissingFile)
{
  const TemporaryFolder folder;
  EXPECT_THROW(ScanSha256(folder / "none.nrrd"), InputError);
}

} // namespace
} // namespace voxelcore
