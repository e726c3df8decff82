// Headers of NRRD: spellings that the format allows, and fields without sense, which are refused by name.

#include "NrrdFixtures.h"
#include "voxelcore/Formats/FormatOpeners.h"

namespace voxelcore::testing::nrrd
{

namespace
{

class NrrdHeaders : public ::testing::Test
{
protected:
  std::filesystem::path
  Write(const std::vector<std::string> & lines, std::string_view data = RawAll<std::uint8_t>(kValues)) const
  {
    return m_Folder.Write("a.nrrd", Nrrd(lines, data));
  }
  /** A line of one field more, where the header is whole. */
  void
  Refuse(const std::string & field, const std::string & value, const std::string & text) const
  {
    SCOPED_TRACE(field + ": " + value);
    ExpectRefused(Write(With(Lines(), field, value)), { text });
  }
  /** Of four axes: sizes, kinds and directions. */
  static std::vector<std::string>
  Four(const std::string & sizes, const std::string & kinds, const std::string & directions)
  {
    auto lines = With(With(Lines(), "dimension", std::to_string(Words(sizes).size())), "sizes", sizes);
    return With(With(lines, "kinds", kinds), "space directions", directions);
  }

  const TempFolder m_Folder;
};

} // namespace

TEST_F(NrrdHeaders, FieldsWithoutSenseAreRefused)
{
  Refuse("dimension", "three", "contradict");
  Refuse("dimension", "4", "contradict");
  Refuse("type", "", "no field 'type'");
  Refuse("encoding", "", "no field 'encoding'");
  Refuse("line skip", "-1", "lineskip");
  Refuse("line skip", "x", "lineskip");
  Refuse("byte skip", "9999999999999999", "byteskip");
  Refuse("space directions", "(1,0,0) (0,1,0)", "2 space directions for 3 axes");
  Refuse("space directions", "(1,0,0) (0,1,0) nothing", "space directions");
  Refuse("space directions", "(1,0,0) (0,1,0) (0,0,1", "space directions");
  Refuse("space directions", "(1,0,0) (0,1,x) (0,0,1)", "space directions");
  Refuse("space directions", "(1,0) (0,1) (0,0)", "2-D space");
  Refuse("space origin", "0 0 0", "space origin");
  Refuse("space units", R"("ell" "ell" "ell")", "'ell'");
  ExpectRefused(Write(With(Lines(), "sizes", "3 2 2 1 1 1 1 1 1 1 1 1 1 1 1 1 1")), { "contradict" });
  ExpectRefused(Write({ "type: uint8", "a line without meaning" }), { "without meaning" });
  ExpectRefused(Write({ "type: uint8", "type: uint16" }), { "'type' stands there twice" });
  for (const char * first : { "NRRD0006\n\n", "NRRD0000\n\n", "NRRDx001\n\n", "NRRD00041\n\n", "NRRD4\n\n" })
  {
    ExpectRefused(m_Folder.Write("b.nrrd", first), { "known version" });
  }
  std::string open = Nrrd(Lines(), {});
  ExpectRefused(m_Folder.Write("c.nrrd", open.substr(0, open.size() - 1)), { "without a blank line" });
}

TEST_F(NrrdHeaders, SpellingsThatTheFormatAllowsMeanTheSame)
{
  for (const char * type : { "unsigned char", "uchar", "UINT8", "uint8_t" })
  {
    ExpectValues(ReadLabelVolume(Write(With(Lines(), "type", type))));
  }
  auto values = kValues;
  values.back() = 120;
  for (const char * type : { "signed char",
                             "signed short",
                             "short int",
                             "signed short int",
                             "unsigned short int",
                             "unsigned int",
                             "signed int",
                             "long long int",
                             "unsigned long long int",
                             "signed long long" })
  {
    SCOPED_TRACE(type);
    const ScanFile scan = OpenNrrd(Write(With(Lines(), "type", type), RawAll<std::uint64_t>(values)), {});
    EXPECT_EQ(PixelBytes(scan.type),
              std::string_view(type).find("char") != std::string_view::npos    ? 1U
              : std::string_view(type).find("short") != std::string_view::npos ? 2U
              : std::string_view(type).find("long") != std::string_view::npos  ? 8U
                                                                               : 4U);
    EXPECT_EQ(PixelName(scan.type)[0] == 'u', std::string_view(type).starts_with("un"));
  }
  // Line ends of Windows, and blanks wherever.
  std::string text = Nrrd(With(With(Lines(), "space", ""), "Space", "LPS"), RawAll<std::uint8_t>(kValues));
  for (std::size_t at = 0; text.compare(at, 2, "\n\n") != 0; ++at)
  {
    if (text[at] == '\n')
    {
      text.insert(at++, "\r");
    }
  }
  ExpectValues(ReadLabelVolume(m_Folder.Write("b.nrrd", text.insert(text.find("\n\n"), "\r"))));
  m_Folder.Write("c.raw", RawAll<std::uint8_t>(kValues));
  ExpectValues(ReadLabelVolume(Write(With(Lines(), "data file", "LIST \n \nc.raw"), {})));
}

TEST_F(NrrdHeaders, KeysMayHoldEscapedLetters)
{
  auto lines = Lines();
  lines.insert(lines.end(),
               { "Segment0_ID:=a",
                 "Segment0_LabelValue:=1",
                 R"(Segment0_Name:=a\\b)",
                 R"(more\n:=lines\nof text\)",
                 "Segment1_ID:=b",
                 "Segment1_LabelValue:=2",
                 "Segment1_Color:=0.5 0.5",
                 "Segment2_LabelValue:=3",
                 "Segment2_Color:=0.5 0.5 -1" });
  const LabelMap volume = ReadLabelVolume(Write(lines));
  EXPECT_EQ(volume.labels[0].name, "a\\b");
  EXPECT_FALSE(volume.labels[1].color);
  EXPECT_FALSE(volume.labels[2].color);
}

TEST_F(NrrdHeaders, SegmentsWhoseValueOrLayerIsNoneAreRefused)
{
  for (const char * key :
       { "Segment0_LabelValue:=one", "Segment0_Layer:=x", "Segment0_Layer:=-1", "Segment0_Layer:=1" })
  {
    auto lines = Lines();
    lines.insert(lines.end(), { "Segment0_ID:=a", key });
    ExpectRefused(Write(lines), { "segment 0", "makes no sense" });
  }
  ReadOptions options;
  options.component = 0;
  const auto path = Write(LayerLines(), std::string(24, '\1'));
  EXPECT_THROW(ReadLabelVolume(path, options), UsageError);
}

TEST_F(NrrdHeaders, ValuesOfAVoxelMayLieBeforeOrBehindItsPlaceInSpace)
{
  const std::string data = RawAll<std::uint8_t>(kValues);
  std::string       mixed;
  for (const char value : data)
  {
    mixed += { '\5', value };
  }
  ReadOptions second;
  second.component = 1;
  const char * const before = "none (1,0,0) (0,1,0) (0,0,1)";
  const char * const behind = "(1,0,0) (0,1,0) (0,0,1) none";
  ExpectValues(ReadLabelVolume(Write(Four("2 3 2 2", "vector space space space", before), mixed), second));
  ExpectValues(
    ReadLabelVolume(Write(Four("3 2 2 2", "??? none domain RGB-color", behind), std::string(12, '\5') + data), second));
  second.component.reset();
  second.volume = 1;
  ExpectValues(ReadLabelVolume(Write(Four("2 3 2 2", "list domain domain domain", before), mixed), second));
  ExpectValues(
    ReadLabelVolume(Write(Four("3 2 2 2", "", "(1,0,0) (0,1,0) (0,0,1) (0,0,2)"), std::string(12, '\5') + data),
                    second));
  ExpectValues(ReadLabelVolume(Write(Four("3 2 2 1", "", behind))));
}

TEST_F(NrrdHeaders, AxesThatNobodyCanTellApartAreRefused)
{
  const std::string data(48, '\1');
  const auto        refuse = [&](const std::vector<std::string> & lines, const std::string & text) {
    ExpectRefused(Write(lines, data), { text });
  };
  refuse(Four("2 3 2 2 2", "vector domain domain domain vector", "none (1,0,0) (0,1,0) (0,0,1) none"), "both before");
  refuse(Four("2 3 2 2 2", "list domain domain domain time", "none (1,0,0) (0,1,0) (0,0,1) none"), "both before");
  refuse(Four("2 2 3 2 2", "vector list domain domain domain", "none none (1,0,0) (0,1,0) (0,0,1)"),
         "neighbouring axes");
  refuse(Four("3 2 2 2 2", "domain domain domain time vector", "(1,0,0) (0,1,0) (0,0,1) none none"),
         "neighbouring axes");
  refuse(Four("3 2 2 2", "domain domain time domain", "(1,0,0) (0,1,0) none (0,0,1)"), "interrupted");
  refuse(Four("5000 3 2 2", "list domain domain domain", "none (1,0,0) (0,1,0) (0,0,1)"), "an axis of 5000 values");
  refuse(Four("3 2 2 2000000000", "domain domain domain time", "(1,0,0) (0,1,0) (0,0,1) none"), "2000000000 values");
  ReadOptions first;
  first.volume = 0;
  ExpectRefused(Write(Four("3 2 2 500", "domain domain domain time", "(1,0,0) (0,1,0) (0,0,1) none"), data),
                { "more volumes than its data can hold" },
                first);
}

TEST_F(NrrdHeaders, SpacesWithTimeAndUnknownOnesAreTold)
{
  const auto x = [&](const std::string & space) {
    const LabelMap volume = ReadLabelVolume(Write(With(With(Lines(), "space", space), "space origin", "(1,2,3)")));
    return std::pair(volume.geometry.origin, HasNote(volume.notes, "taken as LPS"));
  };
  EXPECT_EQ(x("left-posterior-superior-time"), std::pair(Vector3{ 1, 2, 3 }, false));
  EXPECT_EQ(x("LPST"), std::pair(Vector3{ 1, 2, 3 }, false));
  EXPECT_EQ(x("right-anterior-superior-time"), std::pair(Vector3{ -1, -2, 3 }, false));
  EXPECT_EQ(x("rast"), std::pair(Vector3{ -1, -2, 3 }, false));
  EXPECT_EQ(x("LAS"), std::pair(Vector3{ 1, -2, 3 }, false));
  EXPECT_EQ(x("last"), std::pair(Vector3{ 1, -2, 3 }, false));
  EXPECT_EQ(x("scanner-xyz"), std::pair(Vector3{ 1, 2, 3 }, true));
  EXPECT_TRUE(HasNote(ReadLabelVolume(Write(With(Lines(), "space origin", ""))).notes, "no origin"));
  EXPECT_TRUE(HasNote(ReadLabelVolume(Write(With(Lines(), "space origin", "none"))).notes, "no origin"));
  EXPECT_TRUE(HasNote(ReadLabelVolume(Write(With(Lines(), "space origin", "(1,2)"))).notes, "no origin"));
}

TEST_F(NrrdHeaders, UnitsAreThoseOfEachAxisAndAVoxelIsOne)
{
  const auto mixed = ReadLabelVolume(Write(With(Lines(), "space units", R"("mm" "" "cm")")));
  ExpectNear(mixed.geometry.spacing, { 1, 1, 10 });
  const auto voxels = ReadLabelVolume(Write(With(Lines(), "space units", R"("voxel" "voxel" "voxel")")));
  EXPECT_EQ(voxels.geometry.unit, SpatialUnit::Voxels);
  // Only where all of them are.
  ExpectRefused(Write(With(Lines(), "space units", R"("mm" "mm" "voxel")")), { "'voxel'" });
  ReadOptions given;
  given.spacing = Vector3{ 1, 2, 3 };
  for (const char * units : { R"("voxel" "voxel" "voxel")", R"("ell" "ell" "ell")" })
  {
    const auto volume = ReadLabelVolume(Write(With(Lines(), "space units", units)), given);
    ExpectNear(volume.geometry.spacing, { 1, 2, 3 });
    EXPECT_EQ(volume.geometry.unit, SpatialUnit::Millimetres);
  }
  ExpectNear(ReadLabelVolume(Write(With(Lines(), "space units", R"("cm" "cm)"))).geometry.spacing, { 10, 1, 1 });
}

TEST_F(NrrdHeaders, WithoutDirectionsThePlaceIsThatOfMinimaOrTheOrigin)
{
  const auto bare = With(With(With(Lines(), "space directions", ""), "space origin", ""), "spacings", "2 3 4");
  const auto origin = [&](const std::vector<std::string> & lines) {
    return ReadLabelVolume(Write(lines)).geometry.origin;
  };
  ExpectNear(origin(With(bare, "axis mins", "10 20 30")), { 11, 21.5, 32 }); // middles of cells
  ExpectNear(origin(With(With(bare, "axis mins", "10 20 nan"), "centers", "node cell")), { 10, 21.5, 0 });
  ExpectNear(origin(With(With(bare, "axis mins", "10 20 30"), "centerings", "node node node")), { 10, 20, 30 });
  ExpectNear(origin(With(bare, "space origin", "(7,8,9)")), { 7, 8, 9 });
  ExpectNear(origin(With(With(bare, "space", "RAS"), "space origin", "(7,8,9)")), { -7, -8, 9 });
  for (const char * none : { "(nan,nan,nan)", "(7,8)", "none", "(1,2,3) (4,5,6)" })
  {
    ExpectNear(origin(With(bare, "space origin", none)), { 0, 0, 0 });
  }
  ExpectNear(ReadLabelVolume(Write(With(bare, "units", R"("um" "um" "mm")"))).geometry.spacing, { 0.002, 0.003, 4 });
  ExpectRefused(Write(With(bare, "spacings", "2 3")), { "'spacings' should have 3 numbers" });
  ExpectRefused(Write(With(bare, "axis mins", "a b c")), { "'axis mins' should have 3 numbers" });
}

} // namespace voxelcore::testing::nrrd
