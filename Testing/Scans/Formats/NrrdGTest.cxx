#include "NrrdFixtures.h"

#include <algorithm>
#include <random>

using namespace voxelcore;
using namespace voxelcore::testing;
using namespace voxelcore::testing::nrrd;

template <typename T>
struct NrrdTypes : ::testing::Test
{};
using AllTypes = ::testing::Types<std::int8_t,
                                  std::uint8_t,
                                  std::int16_t,
                                  std::uint16_t,
                                  std::int32_t,
                                  std::uint32_t,
                                  std::int64_t,
                                  std::uint64_t,
                                  float,
                                  double>;

template <typename T>
std::string
TypeName()
{
  return std::is_same_v<T, float>    ? "float"
         : std::is_same_v<T, double> ? "double"
                                     : (std::is_signed_v<T> ? "int" : "uint") + std::to_string(8 * sizeof(T));
}
TYPED_TEST_SUITE(NrrdTypes, AllTypes);

TYPED_TEST(NrrdTypes, ValuesComeAsStoredInBothByteOrders)
{
  const TempFolder folder;
  std::vector<int> values = kValues;
  values.back() = 120; // fits int8
  for (const bool big : { false, true })
  {
    const auto     lines = With(Lines(TypeName<TypeParam>()), "endian", big ? "big" : "little");
    const LabelMap volume = ReadLabelVolume(folder.Write("a.nrrd", Nrrd(lines, RawAll<TypeParam>(values, big))));
    ExpectValues(volume, values);
    EXPECT_EQ(volume.format, "NRRD");
    ASSERT_EQ(volume.labels.size(), 5U);
    EXPECT_EQ(volume.labels[1].value, 2);
    EXPECT_EQ(volume.labels[1].voxels, 3U);
    EXPECT_EQ(volume.labels[1].name, "label-2");
    EXPECT_EQ(volume.labels[1].shape.Box().lower, (std::array<std::int32_t, 3>{ 0, 0, 0 }));
    EXPECT_EQ(volume.labels[1].shape.Box().size, (std::array<std::int32_t, 3>{ 3, 2, 2 }));
  }
}

TEST(Nrrd, EveryEncodingGivesTheSameValues)
{
  const TempFolder  folder;
  const std::string data = RawAll<std::uint8_t>(kValues);
  ExpectValues(ReadLabelVolume(folder.Write("raw.nrrd", Nrrd(Lines(), data))));
  ExpectValues(ReadLabelVolume(folder.Write("gz.nrrd", Nrrd(With(Lines(), "encoding", "gzip"), Gzip(data)))));
  ExpectValues(
    ReadLabelVolume(folder.Write("a.nrrd", Nrrd(With(Lines(), "encoding", "ascii"), "0 1 2\n3 0 7\n0 0 0 2 2 250\n"))));
  ExpectValues(
    ReadLabelVolume(folder.Write("hex.nrrd", Nrrd(With(Lines(), "encoding", "hex"), "000102030007 0000000202FA"))));
  // Written by bzip2 itself.
  const std::string bzip2(
    "\x42\x5A\x68\x39\x31\x41\x59\x26\x53\x59\xF5\xFB\x7B\x4A\x00\x00\x01\x40\x00\xF8\x80\x00\x10"
    "\x20\x00\x21\xA7\xA8\xDA\x83\x00\xA2\x24\xAC\xD3\xC5\xDC\x91\x4E\x14\x24\x3D\x7E\xDE\xD2\x80",
    46);
  const auto squeezed = With(Lines(), "encoding", "bzip2");
  ExpectValues(ReadLabelVolume(folder.Write("bz2.nrrd", Nrrd(squeezed, bzip2))));
  ExpectRefused(folder.Write("cut.nrrd", Nrrd(squeezed, bzip2.substr(0, 40))), { "truncated" });
  // Two members, as parallel compressors write them.
  ExpectValues(ReadLabelVolume(
    folder.Write("two.nrrd", Nrrd(With(Lines(), "encoding", "gz"), Gzip(data.substr(0, 5)) + Gzip(data.substr(5))))));
}

TEST(Nrrd, DetachedDataInOneFileAListAndAPattern)
{
  const TempFolder  folder;
  const std::string data = RawAll<std::uint8_t>(kValues);
  folder.Write("d/all.raw", "12345" + data);
  folder.Write("d/s1.raw", data.substr(0, 6));
  folder.Write("d/s2.raw", data.substr(6));
  const auto header = [](std::vector<std::string> lines) {
    std::string text = "NRRD0004\n";
    for (const auto & line : lines)
    {
      text += line + "\n";
    }
    return text;
  };
  const auto one = With(With(Lines(), "byte skip", "5"), "data file", "d/all.raw");
  ExpectValues(ReadLabelVolume(folder.Write("one.nhdr", header(one))));
  const auto end = With(With(Lines(), "byte skip", "-1"), "data file", "d/all.raw");
  ExpectValues(ReadLabelVolume(folder.Write("end.nhdr", header(end))));
  const auto list = With(Lines(), "data file", "LIST\nd/s1.raw\nd/s2.raw");
  ExpectValues(ReadLabelVolume(folder.Write("list.nhdr", header(list))));
  const auto pattern = With(Lines(), "datafile", "d/s%d.raw 1 2 1");
  ExpectValues(ReadLabelVolume(folder.Write("pattern.nhdr", header(pattern))));

  folder.Write("d/s1.raw", data.substr(0, 7));
  folder.Write("d/s2.raw", data.substr(7));
  try
  {
    ReadLabelVolume(folder / "list.nhdr");
    FAIL();
  }
  catch (const InputError & error)
  {
    EXPECT_NE(std::string(error.what()).find("s2.raw: it holds 5 bytes"), std::string::npos) << error.what();
  }
}

TEST(Nrrd, MissingDetachedDataIsRefusedWithItsName)
{
  const TempFolder folder;
  const auto       path = folder.Write("scan.nhdr", Nrrd(With(Lines(), "data file", "../../nowhere/scan.raw"), ""));
  try
  {
    ReadLabelVolume(path);
    FAIL();
  }
  catch (const InputError & error)
  {
    EXPECT_NE(std::string(error.what()).find("scan.raw: no such file"), std::string::npos) << error.what();
  }
}

TEST(Nrrd, TruncatedDataIsRefused)
{
  const TempFolder  folder;
  const std::string data = RawAll<std::uint8_t>(kValues);
  ExpectRefused(folder.Write("raw.nrrd", Nrrd(Lines(), data.substr(0, 11))), { "truncated" });
  const std::string packed = Nrrd(With(Lines(), "encoding", "gzip"), Gzip(data));
  for (std::size_t cut = 1; cut < 20; ++cut)
  {
    ExpectRefused(folder.Write("gz.nrrd", packed.substr(0, packed.size() - cut)), { "truncated" });
  }
  std::string wrongSum = packed;
  wrongSum[packed.size() - 6] ^= 1;
  ExpectRefused(folder.Write("sum.nrrd", wrongSum), { "damaged" });
  // Damage far behind the voxels that are worked on when it is met.
  std::string  noise(std::size_t{ 160 } * 160 * 160, '\0');
  std::mt19937 random(3);
  std::generate(noise.begin(), noise.end(), [&random] { return static_cast<char>(random() % 3); });
  auto large = With(NrrdLines("uint8", { 160, 160, 160 }), "encoding", "gzip");
  auto much = Nrrd(large, Gzip(noise));
  ExpectRefused(folder.Write("large.nrrd", much.substr(0, much.size() * 3 / 4)), { "truncated" });
  much[much.size() * 3 / 4] ^= 0x55;
  ExpectRefused(folder.Write("large.nrrd", much), { "damaged" });
  ExpectRefused(folder.Write("ascii.nrrd", Nrrd(With(Lines(), "encoding", "ascii"), "0 1 2 3 0 7 0 0 0 2 2")),
                { "truncated" });
}

TEST(Nrrd, DataLeftOverAreReported)
{
  const TempFolder folder;
  const LabelMap   volume = ReadLabelVolume(folder.Write("a.nrrd", Nrrd(Lines(), RawAll<std::uint8_t>(kValues) + "x")));
  EXPECT_TRUE(HasNote(volume.warnings, "longer than its header says"));
}

TEST(NrrdVolumes, ASeriesNeedsAChoiceAndKeepsItsGeometry)
{
  const TempFolder folder;
  std::vector<int> both = kValues;
  std::vector<int> second(12, 9);
  both.insert(both.end(), second.begin(), second.end());
  auto lines = With(Lines(), "dimension", "4");
  lines = With(lines, "sizes", "3 2 2 2");
  lines = With(lines, "kinds", "domain domain domain time");
  lines = With(lines, "space directions", "(2,0,0) (0,3,0) (0,0,4) none");
  lines = With(lines, "space origin", "(10,20,30)");
  const auto path = folder.Write("a.nrrd", Nrrd(lines, RawAll<std::uint8_t>(both)));
  ExpectRefused(path, { "4-D", "2 volumes", "--volume" });
  ReadOptions options;
  options.volume = 0;
  ExpectValues(ReadLabelVolume(path, options));
  options.volume = 1;
  const LabelMap volume = ReadLabelVolume(path, options);
  ExpectValues(volume, second);
  ExpectNear(CentreOf(volume, 2, 1, 1), { 14, 23, 34 });
  EXPECT_TRUE(volume.warnings.empty());
  options.volume = 2;
  ExpectRefused(path, { "no volume 2" }, options);
}

TEST(NrrdVolumes, ColoursAndPicturesAreRefused)
{
  const TempFolder folder;
  auto             lines = With(Lines(), "dimension", "4");
  lines = With(lines, "sizes", "3 3 2 2");
  lines = With(lines, "space directions", "none (1,0,0) (0,1,0) (0,0,1)");
  const std::string data(36, '\1');
  ExpectRefused(folder.Write("a.nrrd", Nrrd(With(lines, "kinds", "RGB-color domain domain domain"), data)),
                { "colour" });
  ExpectRefused(folder.Write("b.nrrd", Nrrd(With(lines, "kinds", "vector domain domain domain"), data)),
                { "vectors", "3 values a voxel" });
  auto flat = With(With(Lines(), "dimension", "2"), "sizes", "6 2");
  flat = With(With(With(flat, "kinds", ""), "space directions", "(1,0) (0,1)"), "space", "");
  ExpectRefused(folder.Write("c.nrrd", Nrrd(flat, data.substr(0, 12))), { "2-D" });
}

namespace
{

std::vector<std::string>
SegmentLines(const std::vector<std::string> & keys)
{
  auto lines = With(Lines(), "dimension", "4");
  lines = With(lines, "sizes", "2 3 2 2");
  lines = With(lines, "kinds", "list domain domain domain");
  lines = With(lines, "space directions", "none (1,0,0) (0,1,0) (0,0,1)");
  lines.insert(lines.end(), keys.begin(), keys.end());
  return lines;
}

} // namespace

TEST(NrrdSegments, OverlappingLayersAreReadByLayerAndLabelValue)
{
  const TempFolder folder;
  std::vector<int> data;
  for (int voxel = 0; voxel < 12; ++voxel)
  {
    data.push_back(voxel < 6 ? 1 : 0);                    // layer 0: liver in the lower slice
    data.push_back(voxel == 2 ? 3 : voxel == 11 ? 4 : 0); // layer 1: tumour in the liver, vessel above
  }
  const auto     path = folder.Write("a.seg.nrrd",
                                 Nrrd(SegmentLines({ "Segment0_ID:=S0",
                                                         "Segment0_Name:=Liver",
                                                         "Segment0_LabelValue:=1",
                                                         "Segment0_Layer:=0",
                                                         "Segment1_ID:=S1",
                                                         "Segment1_Name:=Tumour",
                                                         "Segment1_LabelValue:=3",
                                                         "Segment1_Layer:=1",
                                                         "Segment2_ID:=S2",
                                                         "Segment2_Name:=Vessel",
                                                         "Segment2_LabelValue:=4",
                                                         "Segment2_Layer:=1" }),
                                      RawAll<std::uint8_t>(data)));
  const LabelMap volume = ReadLabelVolume(path);
  ASSERT_EQ(volume.labels.size(), 3U);
  EXPECT_EQ(volume.labels[0].name, "Liver");
  EXPECT_EQ(volume.labels[0].voxels, 6U);
  EXPECT_TRUE(volume.labels[0].shape.Contains(2, 0, 0));
  EXPECT_EQ(volume.labels[1].name, "Tumour");
  EXPECT_EQ(volume.labels[1].value, 3);
  EXPECT_EQ(volume.labels[1].voxels, 1U);
  EXPECT_TRUE(volume.labels[1].shape.Contains(2, 0, 0));
  EXPECT_EQ(volume.labels[2].value, 4);
  EXPECT_TRUE(volume.labels[2].shape.Contains(2, 1, 1));

  ReadOptions byName;
  byName.labels = "Tumour";
  EXPECT_EQ(ReadLabelVolume(path, byName).labels.size(), 1U);
  ReadOptions binary;
  binary.binary = true;
  const LabelMap all = ReadLabelVolume(path, binary);
  ASSERT_EQ(all.labels.size(), 1U);
  EXPECT_EQ(all.labels[0].voxels, 7U); // the tumour lies in the liver
}

TEST(NrrdSegments, LayersThatShareAValueAreNumberedAnew)
{
  const TempFolder folder;
  std::vector<int> data;
  for (int voxel = 0; voxel < 12; ++voxel)
  {
    data.push_back(voxel < 6 ? 1 : 0);
    data.push_back(voxel == 2 ? 1 : 0);
  }
  const LabelMap volume = ReadLabelVolume(folder.Write("a.seg.nrrd",
                                                       Nrrd(SegmentLines({ "Segment0_Name:=Tumour",
                                                                           "Segment0_LabelValue:=1",
                                                                           "Segment0_Layer:=1",
                                                                           "Segment1_Name:=Liver",
                                                                           "Segment1_LabelValue:=1",
                                                                           "Segment1_Layer:=0" }),
                                                            RawAll<std::uint8_t>(data))));
  ASSERT_EQ(volume.labels.size(), 2U);
  EXPECT_EQ(volume.labels[0].value, 1);
  EXPECT_EQ(volume.labels[0].name, "Tumour");
  EXPECT_EQ(volume.labels[0].voxels, 1U);
  EXPECT_EQ(volume.labels[1].value, 2);
  EXPECT_EQ(volume.labels[1].name, "Liver");
  EXPECT_EQ(volume.labels[1].voxels, 6U);
  EXPECT_TRUE(HasNote(volume.notes, "numbered"));
}

TEST(NrrdSegments, OldFilesHaveALayerOfOnesForEachSegment)
{
  const TempFolder folder;
  std::vector<int> data;
  for (int voxel = 0; voxel < 12; ++voxel)
  {
    data.push_back(voxel < 6 ? 1 : 0);
    data.push_back(voxel == 2 ? 1 : 0);
  }
  const LabelMap volume = ReadLabelVolume(folder.Write(
    "a.seg.nrrd",
    Nrrd(SegmentLines({ "Segment0_ID:=S0", "Segment0_Name:=Liver", "Segment1_ID:=S1", "Segment1_Name:=Tumour" }),
         RawAll<std::uint8_t>(data))));
  ASSERT_EQ(volume.labels.size(), 2U);
  EXPECT_EQ(volume.labels[0].name, "Liver");
  EXPECT_EQ(volume.labels[0].voxels, 6U);
  EXPECT_EQ(volume.labels[1].name, "Tumour");
  EXPECT_EQ(volume.labels[1].voxels, 1U);
}

TEST(NrrdSegments, ValuesThatNoSegmentNamesStayApart)
{
  const TempFolder folder;
  std::vector<int> data(24, 0);
  data[0] = 1; // layer 0
  data[3] = 1; // layer 1, not named
  data[5] = 8; // layer 1, not named
  const LabelMap volume = ReadLabelVolume(
    folder.Write("a.seg.nrrd",
                 Nrrd(SegmentLines({ "Segment0_Name:=Liver", "Segment0_LabelValue:=1", "Segment0_Layer:=0" }),
                      RawAll<std::uint8_t>(data))));
  ASSERT_EQ(volume.labels.size(), 3U);
  EXPECT_EQ(volume.labels[0].value, 1);
  EXPECT_EQ(volume.labels[0].name, "Liver");
  EXPECT_EQ(volume.labels[1].value, 2); // the 1 of the other layer
  EXPECT_TRUE(volume.labels[1].shape.Contains(1, 0, 0));
  EXPECT_EQ(volume.labels[2].value, 8);
}

TEST(NrrdSegments, NamesComeFromTheKeysOfOneLayer)
{
  const TempFolder folder;
  auto             lines = Lines();
  lines.insert(lines.end(),
               { "Segment0_Name:=Left kidney",
                 "Segment0_LabelValue:=7",
                 "Segment0_Layer:=0",
                 "Segment0_Color:=0.72 0.25 0.1",
                 "Segment1_Name:=Spleen",
                 "Segment1_LabelValue:=2",
                 "Segment1_Color:=0.5 2 red" });
  const LabelMap volume = ReadLabelVolume(folder.Write("a.seg.nrrd", Nrrd(lines, RawAll<std::uint8_t>(kValues))));
  EXPECT_EQ(volume.labels[1].name, "Spleen");
  EXPECT_EQ(volume.labels[3].name, "Left kidney");
  EXPECT_EQ(volume.labels[3].color, (std::array<double, 3>{ 0.72, 0.25, 0.1 }));
  EXPECT_FALSE(volume.labels[1].color) << "no colour";
  EXPECT_EQ(volume.labels[0].name, "label-1");
}

TEST(NrrdHostile, HeadersThatClaimTooMuchAreRefusedBeforeAnythingIsAllocated)
{
  const TempFolder  folder;
  const std::string data = RawAll<std::uint8_t>(kValues);
  for (const char * sizes : { "16384 16384 4096",
                              "1000000000 1000000000 1000000000",
                              "-3 2 2",
                              "0 2 2",
                              "99999999999999999999 2 2",
                              "3 2",
                              "3 2 x",
                              "4294967296 2 2",
                              "1073741824 1073741824 4" })
  {
    ExpectRefused(folder.Write("a.nrrd", Nrrd(With(Lines(), "sizes", sizes), data)), {});
    ExpectRefused(folder.Write("b.nrrd", Nrrd(With(With(Lines(), "sizes", sizes), "encoding", "gzip"), Gzip(data))),
                  {});
  }
  // Axes that are not in space, whose sizes multiply to 0 or 4 where numbers end at 2^64.
  for (const char * size : { "4611686018427387904", "4611686018427387905" })
  {
    for (const bool isBefore : { true, false })
    {
      auto lines = With(With(With(Lines(), "dimension", "5"), "space", ""), "space origin", "");
      lines = With(With(lines, "space directions", ""), "kinds", isBefore ? "list list domain domain domain" : "");
      lines = With(lines, "sizes", isBefore ? std::string("4 ") + size + " 3 2 2" : std::string("3 2 2 4 ") + size);
      ExpectRefused(folder.Write("a.nrrd", Nrrd(lines, data)), { size });
    }
  }
  ExpectRefused(folder.Write("c.nrrd", Nrrd(With(Lines(), "type", "block"), data)), { "block" });
  ExpectRefused(folder.Write("d.nrrd", Nrrd(With(Lines(), "encoding", "zrl"), data)), { "zrl" });
  ExpectRefused(folder.Write("e.nrrd", Nrrd(With(Lines("int16"), "endian", ""), data + data)), { "endian" });
  ExpectRefused(folder.Write("f.nrrd", Nrrd(With(Lines(), "byte skip", "-7"), data)), { "byteskip" });
  ExpectRefused(folder.Write("g.nrrd", "NRRD0004\n"), {});
  ExpectRefused(folder.Write("h.nrrd", "NRRD"), {});
  ExpectRefused(folder.Write("i.nhdr", Nrrd(With(Lines(), "data file", "%s%n%d.raw 1 9 1"), "")), { "pattern" });
  ExpectRefused(folder.Write("j.nhdr", Nrrd(With(Lines(), "data file", "s%d.raw 1 999999999 1"), "")), { "pattern" });
}
