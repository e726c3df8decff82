#include "ScanBytes.h"

namespace voxelcore::testing::meta
{

namespace
{

const std::vector<int> kValues{ 0, 1, 2, 3, 0, 7, 0, 0, 0, 2, 2, 120 }; // 3 x 2 x 2
const std::string      kData = RawAll<std::uint8_t>(kValues);

std::vector<std::string>
Lines(const std::string & type = "MET_UCHAR")
{
  return { "ObjectType = Image",
           "NDims = 3",
           "BinaryData = True",
           "BinaryDataByteOrderMSB = False",
           "CompressedData = False",
           "Offset = 0 0 0",
           "DimSize = 3 2 2",
           "ElementSpacing = 1 1 1",
           "TransformMatrix = 1 0 0 0 1 0 0 0 1",
           "ElementType = " + type };
}

std::vector<std::string>
With(std::vector<std::string> lines, const std::string & field, const std::string & value)
{
  std::erase_if(lines, [&](const std::string & line) { return line.starts_with(field + " ="); });
  lines.push_back(field + " = " + value);
  return lines;
}

void
ExpectValues(const LabelMap & volume)
{
  EXPECT_EQ(AllValues(volume), std::vector<std::int64_t>(kValues.begin(), kValues.end()));
}

} // namespace

TEST(MetaImage, TypesAndByteOrders)
{
  const TempFolder folder;
  const auto       check = [&](const std::string & type, bool big, const std::string & data) {
    const auto lines = With(Lines(type), "BinaryDataByteOrderMSB", big ? "True" : "False");
    ExpectValues(ReadLabelVolume(folder.Write("a.mha", Meta(lines, data))));
  };
  for (const bool big : { false, true })
  {
    check("MET_UCHAR", big, kData);
    check("MET_CHAR", big, RawAll<std::int8_t>(kValues, big));
    check("MET_SHORT", big, RawAll<std::int16_t>(kValues, big));
    check("MET_USHORT", big, RawAll<std::uint16_t>(kValues, big));
    check("MET_INT", big, RawAll<std::int32_t>(kValues, big));
    check("MET_UINT", big, RawAll<std::uint32_t>(kValues, big));
    check("MET_LONG_LONG", big, RawAll<std::int64_t>(kValues, big));
    check("MET_ULONG_LONG", big, RawAll<std::uint64_t>(kValues, big));
    check("MET_FLOAT", big, RawAll<float>(kValues, big));
    check("MET_DOUBLE", big, RawAll<double>(kValues, big));
  }
}

TEST(MetaImage, CompressedTextAndDetachedData)
{
  const TempFolder folder;
  ExpectValues(ReadLabelVolume(folder.Write("z.mha", Meta(With(Lines(), "CompressedData", "True"), Zlib(kData)))));
  ExpectValues(
    ReadLabelVolume(folder.Write("t.mha", Meta(With(Lines(), "BinaryData", "False"), "0 1 2 3 0 7 0 0 0 2 2 120"))));
  const auto detached = [](std::vector<std::string> lines, const std::string & file) {
    std::string text;
    for (const auto & line : lines)
    {
      text += line + "\n";
    }
    return text + "ElementDataFile = " + file + "\n";
  };
  folder.Write("all.raw", "xyz" + kData);
  folder.Write("s1.raw", kData.substr(0, 6));
  folder.Write("s2.raw", kData.substr(6));
  ExpectValues(ReadLabelVolume(folder.Write("a.mhd", detached(With(Lines(), "HeaderSize", "3"), "all.raw"))));
  ExpectValues(ReadLabelVolume(folder.Write("b.mhd", detached(With(Lines(), "HeaderSize", "-1"), "all.raw"))));
  ExpectValues(ReadLabelVolume(folder.Write("c.mhd", detached(Lines(), "LIST\ns1.raw\ns2.raw"))));
  ExpectValues(ReadLabelVolume(folder.Write("d.mhd", detached(Lines(), "s%01d.raw 1 2 1"))));
  EXPECT_THROW(ReadLabelVolume(folder.Write("e.mhd", detached(Lines(), "nowhere.raw"))), InputError);
}

TEST(MetaImage, GeometryIsLpsAndTheMatrixHoldsOneAxisAfterTheOther)
{
  const TempFolder folder;
  auto             lines = With(Lines(), "ElementSpacing", "2 3 0.5");
  lines = With(lines, "Offset", "1 2 3");
  lines = With(lines, "TransformMatrix", "0.6 0.8 0 -0.8 0.6 0 0 0 -1");
  const LabelMap volume = ReadLabelVolume(folder.Write("a.mha", Meta(lines, kData)));
  ExpectNear(CentreOf(volume, 2, 1, 1), { 1 + 2.4 - 2.4, 2 + 3.2 + 1.8, 2.5 }, 1e-12);
  EXPECT_TRUE(IsLeftHanded(volume.geometry));
  const LabelMap micro = ReadLabelVolume(folder.Write("b.mha", Meta(With(lines, "DistanceUnits", "um"), kData)));
  ExpectNear(micro.geometry.spacing, { 0.002, 0.003, 0.0005 }, 1e-15);
  ExpectNear(micro.geometry.origin, { 0.001, 0.002, 0.003 }, 1e-15);
  ExpectRefused(folder.Write("e.mha", Meta(With(lines, "DistanceUnits", "furlong"), kData)), { "furlong" });
  ExpectNear(ReadLabelVolume(folder.Write("f.mha", Meta(With(lines, "DistanceUnits", "?"), kData))).geometry.spacing,
             { 2, 3, 0.5 });
  ExpectRefused(folder.Write("c.mha", Meta(With(lines, "TransformMatrix", "1 0 0 0.1 1 0 0 0 1"), kData)),
                { "5.71", "--orthonormalize" });
  ExpectRefused(folder.Write("d.mha", Meta(With(lines, "ElementSpacing", "2 0 1"), kData)), { "axis j" });
}

TEST(MetaImage, SeriesColoursAndPictures)
{
  const TempFolder folder;
  auto             lines = With(With(Lines(), "NDims", "4"), "DimSize", "3 2 2 2");
  lines = With(With(lines, "Offset", "10 20 30 0"), "ElementSpacing", "2 3 4 1");
  lines = With(lines, "TransformMatrix", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1");
  const auto path = folder.Write("a.mha", Meta(lines, std::string(12, '\5') + kData));
  ExpectRefused(path, { "4-D", "--volume" });
  ReadOptions options;
  options.volume = 1;
  const LabelMap volume = ReadLabelVolume(path, options);
  ExpectValues(volume);
  ExpectNear(CentreOf(volume, 2, 1, 1), { 14, 23, 34 });
  ExpectRefused(folder.Write("b.mha", Meta(With(Lines(), "ElementNumberOfChannels", "3"), kData + kData + kData)),
                { "colour", "3 values" });
  const auto flat = With(With(Lines(), "NDims", "2"), "DimSize", "6 2");
  ExpectRefused(folder.Write("c.mha", Meta(flat, kData)), { "2-D" });
}

TEST(MetaImage, DamagedFilesAreRefused)
{
  const TempFolder folder;
  ExpectRefused(folder.Write("a.mha", Meta(Lines(), kData.substr(1))), { "truncated" });
  const std::string packed = Meta(With(Lines(), "CompressedData", "True"), Zlib(kData));
  ExpectRefused(folder.Write("b.mha", packed.substr(0, packed.size() - 2)), { "truncated" });
  ExpectRefused(folder.Write("c.mha", "hello, I am a text\n"), { "not a MetaImage" });
  for (const char * size : { "16384 16384 4096", "-3 2 2", "3 2", "9999999999999999999999 1 1", "0 0 0" })
  {
    ExpectRefused(folder.Write("d.mha", Meta(With(Lines(), "DimSize", size), kData)), {});
  }
  ExpectRefused(folder.Write("e.mha", Meta(With(Lines(), "NDims", "1000000"), kData)), { "NDims" });
  ExpectRefused(folder.Write("f.mha", Meta(With(Lines(), "ElementType", "MET_NONE"), kData)), { "MET_NONE" });
}

TEST(MetaImage, FieldsWithoutSenseAreRefused)
{
  const TempFolder folder;
  const auto       refuse = [&](const std::string & field, const std::string & value, const std::string & text) {
    SCOPED_TRACE(field + " = " + value);
    ExpectRefused(folder.Write("a.mha", Meta(With(Lines(), field, value), kData)), { text });
  };
  refuse("NDims", "three", "NDims = three");
  refuse("NDims", "0", "NDims = 0");
  refuse("DimSize", "3 2 two", "");
  refuse("ElementNumberOfChannels", "x", "ElementNumberOfChannels");
  refuse("ElementNumberOfChannels", "0", "ElementNumberOfChannels");
  refuse("ElementNumberOfChannels", "5000", "ElementNumberOfChannels");
  refuse("ElementType", "MET_UCHAR_ARRAY", "several values a voxel");
  refuse("ElementSpacing", "1 1", "ElementSpacing should have 3 numbers");
  refuse("ElementSpacing", "1 1 x", "ElementSpacing should have 3 numbers");
  refuse("Offset", "0 0 0 0", "Offset should have 3 numbers");
  refuse("TransformMatrix", "1 0 0 0 1 0 0 0", "TransformMatrix should have 9 numbers");
  refuse("HeaderSize", "x", "HeaderSize = x");
  refuse("HeaderSize", "-2", "HeaderSize = -2");
  refuse("HeaderSize", "9999999999999999", "HeaderSize");
  for (const char * last : { "0", "-1", "2000000000", "x" })
  {
    ExpectRefused(
      folder.Write("b.mha", Meta(With(With(Lines(), "NDims", "4"), "DimSize", std::string("3 2 2 ") + last), kData)),
      { "DimSize" });
  }
  ReadOptions first;
  first.volume = 0;
  auto many = With(With(Lines(), "NDims", "6"), "DimSize", "3 2 2 1000000000 1000000000 1000000000");
  ExpectRefused(folder.Write("c.mha", Meta(many, kData)), { "DimSize" }, first);
  many = With(With(Lines(), "NDims", "4"), "DimSize", "3 2 2 1000");
  ExpectRefused(folder.Write("c.mha", Meta(many, kData)), { "more volumes than its data can hold" }, first);
  ExpectRefused(folder.Write("d.mha", "NDims = 3\nDimSize = 3 2 2\nElementType = MET_UCHAR\n"),
                { "no ElementDataFile" });
  ExpectRefused(folder.Write("e.mha", std::string("NDims = 3\0\n", 11)), { "not a MetaImage header" });
  ExpectRefused(folder.Write("e.mha", "Comment = " + std::string(70000, 'x') + "\n"), { "not a MetaImage header" });
}

TEST(MetaImage, SpellingsThatProgramsWriteMeanTheSame)
{
  const TempFolder folder;
  const auto       read = [&](const std::vector<std::string> & lines, const std::string & data = kData) {
    return ReadLabelVolume(folder.Write("a.mha", Meta(lines, data)));
  };
  for (const char * yes : { "True", "true", "T", "1" })
  {
    ExpectValues(read(With(Lines(), "CompressedData", yes), Zlib(kData)));
  }
  for (const char * no : { "False", "0", "no", "" })
  {
    ExpectValues(read(With(Lines(), "CompressedData", no)));
  }
  auto lines = Lines();
  lines.insert(lines.begin() + 2, { "", "  " });
  ExpectValues(read(With(lines, "HeaderSize", "5"))); // behind a header there is none to be passed over
  EXPECT_EQ(read(With(Lines(), "DistanceUnits", "voxel")).geometry.unit, SpatialUnit::Voxels);
  ReadOptions given;
  given.spacing = Vector3{ 1, 2, 3 };
  for (const char * unit : { "voxel", "ell", "cm" })
  {
    const LabelMap volume =
      ReadLabelVolume(folder.Write("b.mha", Meta(With(Lines(), "DistanceUnits", unit), kData)), given);
    ExpectNear(volume.geometry.spacing, { 1, 2, 3 });
    EXPECT_EQ(volume.geometry.unit, SpatialUnit::Millimetres);
  }
  lines = Lines();
  std::erase_if(lines, [](const std::string & line) { return line.starts_with("ElementSpacing"); });
  EXPECT_EQ(read(lines).geometry.unit, SpatialUnit::Voxels);
  EXPECT_EQ(read(With(lines, "DistanceUnits", "voxel")).warnings.size(), 1U); // said once
  ExpectNear(read(With(lines, "ElementSize", "2 3 4")).geometry.spacing, { 2, 3, 4 });
}

TEST(MetaImage, OfSeveralValuesTheOneThatIsChosenIsRead)
{
  const TempFolder folder;
  std::string      mixed;
  for (const char value : kData)
  {
    mixed += { '\5', value };
  }
  ReadOptions options;
  options.component = 1;
  ExpectValues(
    ReadLabelVolume(folder.Write("a.mha", Meta(With(Lines(), "ElementNumberOfChannels", "2"), mixed)), options));
}

} // namespace voxelcore::testing::meta
