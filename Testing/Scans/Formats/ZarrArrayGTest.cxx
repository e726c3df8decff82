// Arrays of Zarr: metadata that make no sense are refused with a word on what is wrong, chunks that are damaged too.
// What other programs write, zarr_test.py reads.

#include "ZarrStores.h"
#include "VoxelCoreTesting/ProcessUse.h"
#include "voxelcore/Formats/FormatOpeners.h"

#include <cmath>
#include <zstd.h>

namespace voxelcore::testing::zarr
{

namespace
{

class ZarrArrays : public Stores
{
protected:
  /** The bytes of all voxels as they are given out. */
  static std::string
  Voxels(const std::filesystem::path & path, std::size_t count = 12)
  {
    ScanFile    scan = OpenZarr(path, {});
    std::string bytes(count * PixelBytes(scan.type), '?');
    scan.voxels->Read(reinterpret_cast<std::byte *>(bytes.data()), bytes.size());
    return bytes;
  }

  /** Two chunks of a slice each in one file, the second in front. `index` replaces what stands in the index. */
  static std::string
  Shard(const std::string & index = {})
  {
    std::string table = RawAll<std::uint64_t>(std::vector<std::uint64_t>{ 38, 6, 32, 6 });
    return (index.empty() ? table : index) + kBytes.substr(6) + kBytes.substr(0, 6);
  }
};

/** CRC-32C of RFC 3720, bit by bit, as a file has it. */
std::string
Crc32c(const std::string & bytes)
{
  std::uint32_t sum = ~0U;
  for (const char byte : bytes)
  {
    sum ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit)
    {
      sum = (sum >> 1U) ^ ((sum & 1U) != 0 ? 0x82F63B78U : 0U);
    }
  }
  return Raw<std::uint32_t>(~sum);
}

constexpr const char * kSharded = R"({"codecs": [{"name": "sharding_indexed", "configuration": {
  "chunk_shape": [1, 2, 3], "codecs": [{"name": "bytes"}], "index_location": "start",
  "index_codecs": [{"name": "bytes", "configuration": {"endian": "little"}}]}}]})";

} // namespace

TEST_F(ZarrArrays, OfBothVersionsAreRead)
{
  ExpectRead(Array2("a.zarr"));
  ExpectRead(Array3("b.zarr"));
  ExpectRead(Array2("c.zarr", R"({"dtype": "|b1", "dimension_separator": "."})", kBytes));
  ExpectRead(Array3("d.zarr", R"({"codecs": [{"name": "endian"}], "storage_transformers": []})"));
}

TEST_F(ZarrArrays, OfVersion2WithMetadataWithoutSenseAreRefused)
{
  for (const Refusal & one : std::vector<Refusal>{
         { R"({"dtype": null})", "have no 'dtype'" },
         { R"({"dtype": [["a", "<u2"], ["b", "<u2"]]})", "structures or texts" },
         { R"({"dtype": "|u"})", "structures or texts" },
         { R"({"dtype": "<c8"})", "values of type 'c8'" },
         { R"({"order": "K"})", "neither C nor F" },
         { R"({"order": 1})", "a 'order' that is no text" },
         { R"({"filters": [{"id": "fixedscaleoffset"}]})", "'fixedscaleoffset'" },
         { R"({"filters": ["delta"]})", "'a filter'" },
         { R"({"compressor": {"id": "lzma"}})", "'lzma'" },
         { R"({"compressor": {"level": 3}})", "have no 'id'" },
         { R"({"compressor": "zstd"})", "have no 'id'" },
         { R"({"shape": 3})", "no list of sides" },
         { R"({"shape": []})", "no list of sides" },
         { R"({"shape": [1, 1, 1, 1, 1, 1, 2, 2, 3]})", "no list of sides" },
         { R"({"shape": [0, 2, 3]})", "a side in 'shape'" },
         { R"({"shape": [-2, 2, 3]})", "a side in 'shape'" },
         { R"({"shape": [2.5, 2, 3]})", "a side in 'shape'" },
         { R"({"shape": [1099511627777, 2, 3]})", "a side in 'shape'" },
         { R"({"chunks": [2, 6]})", "another number of axes" },
         { R"({"chunks": [2048, 2048, 2048]})", "chunks of 2 GB" },
         { R"({"dimension_separator": "-"})", "neither . nor /" },
         { R"({"dimension_separator": 7})", "that is no text" },
         { R"({"shape": [4, 3], "chunks": [4, 3]})", "2-D array" },
         { R"({"shape": [2, 1, 2, 3], "chunks": [2, 1, 2, 3]})", "says nothing of what they are" },
       })
  {
    SCOPED_TRACE(one.change);
    ExpectRefused(Array2("a.zarr", one.change), { one.text });
  }
  m_Folder.Write("b.zarr/0/0/0/0", kBytes);
  ExpectRead(Array2("b.zarr", R"({"shape": [1, 2, 2, 3], "chunks": [1, 2, 2, 3], "dimension_separator": "/"})"));
}

TEST_F(ZarrArrays, OfVersion3WithMetadataWithoutSenseAreRefused)
{
  const auto codecs = [](const std::string & list) { return R"({"codecs": )" + list + "}"; };
  const auto sharded = [&](const std::string & settings) {
    Json json = Json::parse(kSharded);
    json["codecs"][0]["configuration"].merge_patch(Json::parse(settings));
    return json.dump();
  };
  for (const auto & [change, text] : std::vector<std::pair<std::string, std::string>>{
         { R"({"data_type": "complex64"})", "values of type 'complex64'" },
         { R"({"data_type": {"name": "struct"}})", "that is no text" },
         { R"({"chunk_grid": null})", "have no 'chunk_grid'" },
         { R"({"chunk_grid": {"name": "rectilinear"}})", "no regular grid" },
         { R"({"chunk_grid": {"configuration": {"chunk_shape": [2, 6]}}})", "another number of axes" },
         { R"({"chunk_key_encoding": {"name": "hashed"}})", "in a way not known" },
         { R"({"chunk_key_encoding": {"configuration": {"separator": "-"}}})", "neither . nor /" },
         { R"({"chunk_key_encoding": {"configuration": {"separator": 7}}})", "of another type" },
         { R"({"storage_transformers": [{"name": "mine"}]})", "storage transformer" },
         { codecs(R"("bytes")"), "no list of codecs" },
         { codecs("[]"), "no codec that makes bytes" },
         { codecs(R"([{"name": "vlen-utf8"}])"), "'vlen-utf8'" },
         { codecs(R"([{"name": "bytes"}, {"name": "numcodecs.lz4"}])"), "'lz4'" },
         { codecs(R"([{"name": "bytes"}, {"name": "zstd"}, {"name": "gzip"}])"), "several packings" },
         { codecs(R"([{"name": "transpose", "configuration": {"order": "F"}}])"), "transpose by name" },
         { codecs(R"([{"name": "transpose", "configuration": {"order": [0, 0, 1]}}])"), "axes that are not there" },
         { codecs(R"([{"name": "transpose", "configuration": {"order": [0, 1, "x"]}}])"), "axes that are not there" },
         { codecs(R"([{"name": "transpose", "configuration": {"order": [0, 1, 2, 3]}}])"), "axes that are not there" },
         { sharded(R"({"chunk_shape": [1, 2, 2]})"), "do not fill them" },
         { sharded(R"({"chunk_shape": [2, 6]})"), "do not fill them" },
         { sharded(R"({"index_codecs": "bytes"})"), "an index of shards" },
         { sharded(R"({"index_codecs": []})"), "an index of shards" },
         { sharded(R"({"index_codecs": [{"name": "gzip"}]})"), "an index of shards" },
         { sharded(R"({"index_codecs": [{"name": "bytes", "configuration": {"endian": "big"}}]})"), "an index of" },
         { sharded(R"({"index_codecs": [{"name": "bytes"}, {"name": "gzip"}]})"), "an index of shards" },
         { sharded(R"({"index_codecs": [{"name": "bytes"}, {"name": "crc32c"}, {"name": "crc32c"}]})"), "an index of" },
         { sharded(R"({"codecs": [{"name": "sharding_indexed"}]})"), "'sharding_indexed'" },
         { codecs(R"([{"name": "sharding_indexed"}, {"name": "bytes"}])"), "'sharding_indexed'" },
         { codecs(R"([{"name": "transpose", "configuration": {"order": [2, 1, 0]}}, {"name": "sharding_indexed"}])"),
           "'sharding_indexed'" },
       })
  {
    SCOPED_TRACE(change);
    ExpectRefused(Array3("a.zarr", change.c_str()), { text });
  }
}

TEST_F(ZarrArrays, OfWhichNothingIsWrittenButTheirFolderAreRefused)
{
  m_Folder.Write("a.zarr/.zarray", "[1, 2]");
  ExpectRefused(m_Folder / "a.zarr", { "no JSON object" });
  m_Folder.Write("b.zarr/zarr.json", R"({"node_type": 3})");
  ExpectRefused(m_Folder / "b.zarr", { "of another type" });
  m_Folder.Write("c.zarr/zarr.json", R"({"node_type": "group")");
  ExpectRefused(m_Folder / "c.zarr", { "no JSON object" });
}

TEST_F(ZarrArrays, ChunksThatAreNotThereHoldTheFillValueAsItIsWritten)
{
  const auto filled = [&](const std::string & type, const std::string & value) {
    const auto path = Array2("a.zarr", (R"({"dtype": ")" + type + R"(", "fill_value": )" + value + "}").c_str());
    std::filesystem::remove(path / "0.0.0");
    return Voxels(path).substr(0, 8);
  };
  const auto twice = [](const std::string & four) { return four + four; };
  EXPECT_EQ(filled("|u1", "250"), std::string(8, '\xFA'));
  EXPECT_EQ(filled("|b1", "true"), std::string(8, '\1'));
  EXPECT_EQ(filled("|b1", "false"), std::string(8, '\0'));
  EXPECT_EQ(filled("|i1", "-2.0"), std::string(8, '\xFE'));
  EXPECT_EQ(filled(">u2", "258").substr(0, 2), "\1\2");
  EXPECT_EQ(filled("<i2", "-2").substr(0, 2), "\xFE\xFF");
  EXPECT_EQ(filled("<u4", "4294967295"), std::string(8, '\xFF'));
  EXPECT_EQ(filled("<i4", "-2147483648"), twice(std::string("\0\0\0\x80", 4)));
  EXPECT_EQ(filled("<u8", "18446744073709551615"), std::string(8, '\xFF'));
  EXPECT_EQ(filled("<i8", "-9223372036854775808"), std::string("\0\0\0\0\0\0\0\x80", 8));
  EXPECT_EQ(filled("<f4", "0.5"), twice(Raw<float>(0.5F)));
  EXPECT_EQ(filled("<f4", R"("Infinity")"), twice(Raw<float>(INFINITY)));
  EXPECT_EQ(filled(">f8", R"("-Infinity")"), Raw<double>(-INFINITY, true));
  EXPECT_EQ(filled("<f8", R"("NaN")").substr(6), "\xF8\x7F");
}

TEST_F(ZarrArrays, AFillValueThatIsNoneOfTheTypeIsRefused)
{
  for (const auto & [type, value] : std::vector<std::pair<std::string, std::string>>{
         { "|u1", "256" },
         { "|u1", "-1" },
         { "|u1", "0.5" },
         { "|u1", R"("red")" },
         { "|i1", "128" },
         { "<i8", "9223372036854775808" },
         { "<i8", "1e300" },
         { "<u8", "18446744073709551616" },
         { "<u8", "-1" },
         { "<f4", R"("zero")" },
         { "<f8", "[0]" },
       })
  {
    SCOPED_TRACE(type + " " + value);
    ExpectRefused(Array2("a.zarr", (R"({"dtype": ")" + type + R"(", "fill_value": )" + value + "}").c_str()),
                  { "a fill value that is none of its type" });
  }
}

TEST_F(ZarrArrays, ChunksThatAreDamagedAreRefusedWhateverPacksThem)
{
  const auto  gzip = R"({"compressor": {"id": "gzip"}})";
  const auto  zstd = R"({"compressor": {"id": "zstd"}})";
  const auto  blosc = R"({"compressor": {"id": "blosc"}})";
  const auto  bzip2 = R"({"compressor": {"id": "bz2"}})";
  std::string packed(ZSTD_compressBound(12), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), kBytes.data(), kBytes.size(), 1));
  ExpectRead(Array2("a.zarr", gzip, Gzip(kBytes)));
  ExpectRead(Array2("a.zarr", zstd, packed));
  for (const auto & [change, chunk, text] : std::vector<std::tuple<const char *, std::string, const char *>>{
         { "{}", kBytes.substr(1), "holds 11 bytes of values, where 12 belong" },
         { "{}", kBytes + "x", "holds 13 bytes" },
         { gzip, "", "has 0 bytes, which cannot stand for 12" },
         { gzip, Gzip(kBytes.substr(1)), "by gzip or zlib" },
         { gzip, Gzip(kBytes + "x"), "by gzip or zlib" },
         { gzip, Gzip(kBytes).substr(0, 20), "by gzip or zlib" },
         { zstd, packed.substr(1), "by zstd" },
         { zstd, "", "cannot stand for" },
         { blosc, "x", "by blosc" },
         { blosc, std::string("\2\1\1\1\7\0\0\0\7\0\0\0\x17\0\0\0", 16) + "1234567", "by blosc" }, // of 7 bytes
         { bzip2, "BZh9", "by bzip2" },
       })
  {
    SCOPED_TRACE(change);
    ExpectRefused(Array2("a.zarr", change, chunk), { text });
  }
  const auto summed = R"({"codecs": [{"name": "bytes"}, {"name": "crc32c"}]})";
  ExpectRefused(Array3("b.zarr", summed, kBytes + "abcd"), { "another checksum" });
  ExpectRefused(Array3("b.zarr", summed, "abc"), { "another checksum" });
}

TEST_F(ZarrArrays, AShardIsReadByItsIndexWhereverThatStands)
{
  ExpectRead(Array3("a.zarr", kSharded, Shard()));
  Json atEnd = Json::parse(kSharded);
  atEnd["codecs"][0]["configuration"].erase("index_location");
  ExpectRead(
    Array3("b.zarr", atEnd.dump().c_str(), kBytes + RawAll<std::uint64_t>(std::vector<std::uint64_t>{ 0, 6, 6, 6 })));
  // The second chunk is not there, and holds what is named for it.
  const auto path =
    Array3("c.zarr", kSharded, Shard(RawAll<std::uint64_t>(std::vector<std::uint64_t>{ 38, 6, ~0ULL, ~0ULL })));
  EXPECT_EQ(Voxels(path), kBytes.substr(0, 6) + std::string(6, '\0'));
}

TEST_F(ZarrArrays, TheIndexOfAShardIsNotReadAnewForEachOfItsChunks)
{
  // 13,824 chunks of a voxel each, of which one is there: with the whole index for each, 3 GB are read.
  constexpr std::uint64_t    side = 24;
  constexpr std::uint64_t    count = side * side * side;
  constexpr std::uint64_t    middle = count / 2 + side / 2;
  std::vector<std::uint64_t> index(2 * count, ~0ULL);
  index[2 * middle] = 0;
  index[2 * middle + 1] = 1;
  Json json = Json::parse(kSharded);
  json["shape"] = { side, side, side };
  json["chunk_grid"]["configuration"]["chunk_shape"] = { side, side, side };
  json["codecs"][0]["configuration"]["chunk_shape"] = { 1, 1, 1 };
  json["codecs"][0]["configuration"].erase("index_location");
  std::string expected(count, '\0');
  expected[middle] = '\1';
  const std::string table = RawAll<std::uint64_t>(index);
  for (const std::string & sum : { std::string(), Crc32c(table) })
  {
    const auto path = Array3("a.zarr", json.dump().c_str(), "\1" + table + sum);
    const auto before = BytesRead();
    ASSERT_GT(before, 0U) << "the system does not say";
    EXPECT_EQ(Voxels(path, count), expected);
    EXPECT_LT(BytesRead() - before, 4 * table.size());
    json["codecs"][0]["configuration"]["index_codecs"].push_back({ { "name", "crc32c" } });
  }
}

TEST_F(ZarrArrays, WhatFillsChunksUpBeyondTheVolumeTakesNoMemory)
{
  // A row of 65,536 voxels in 16 chunks of 16 MB each, which some 500 bytes of zstd stand for.
  const std::string values(std::size_t{ 1 } << 24U, '\3');
  std::string       packed(ZSTD_compressBound(values.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), values.data(), values.size(), 1));
  const auto path =
    Array2("a.zarr", R"({"shape": [1, 1, 65536], "chunks": [64, 64, 4096], "compressor": {"id": "zstd"}})", packed);
  for (int i = 1; i < 16; ++i)
  {
    m_Folder.Write("a.zarr/0.0." + std::to_string(i), packed);
  }
  const std::uint64_t before = PeakBytes();
  EXPECT_EQ(Voxels(path, 65536), std::string(65536, '\3'));
  EXPECT_LT(PeakBytes() - before, 8 * values.size());
}

TEST_F(ZarrArrays, AShardWhoseIndexLeadsNowhereIsRefused)
{
  using Numbers = std::vector<std::uint64_t>;
  for (const auto & index : { Numbers{ 40, 6, 32, 6 }, Numbers{ 38, 6, 1000, 6 }, Numbers{ 38, ~0ULL, 32, 6 } })
  {
    ExpectRefused(Array3("a.zarr", kSharded, Shard(RawAll<std::uint64_t>(index))), { "leads beyond its end" });
  }
  ExpectRefused(Array3("a.zarr", kSharded, Shard(RawAll<std::uint64_t>(Numbers{ 38, 5, 32, 6 }))),
                { "holds 5 bytes of values, where 6 belong" });
  ExpectRefused(Array3("a.zarr", kSharded, "short"), { "shorter than the index" });
  Json summed = Json::parse(kSharded);
  summed["codecs"][0]["configuration"]["index_codecs"].push_back({ { "name", "crc32c" } });
  ExpectRefused(Array3("b.zarr", summed.dump().c_str(), Shard().substr(0, 33)), { "shorter than the index" });
  ExpectRefused(Array3("b.zarr", summed.dump().c_str(), Shard()), { "another checksum" });
  // 2^40 * 2^24 chunks are none where numbers end at 2^64.
  Json endless = Json::parse(kSharded);
  endless["chunk_grid"]["configuration"]["chunk_shape"] = { std::uint64_t{ 1 } << 40, 1U << 25, 3 };
  ExpectRefused(Array3("d.zarr", endless.dump().c_str(), Shard()), { "shorter than the index" });
}

TEST_F(ZarrArrays, AGreatArrayIsOpenedOnlyWhereSomeOfItsChunksAreThere)
{
  const auto path = Array2("a.zarr", R"({"shape": [4096, 1024, 1024], "chunks": [1024, 1024, 1024]})");
  EXPECT_EQ(OpenZarr(path, {}).geometry.size[2], 4096);
  std::filesystem::remove(path / "0.0.0");
  ExpectRefused(path, { "should have 4 chunks, and nearly all of them are not there" });
  ExpectRefused(Array2("b.zarr", R"({"shape": [2, 1000, 1000], "chunks": [1, 1, 1]})"), { "2000000 chunks" });
}

} // namespace voxelcore::testing::zarr
