// What the helper program says of a scan is understood as it was meant, and what it cannot have said is refused.

#include "ItkScan.h"

#include "VoxelCoreTesting/Messages.h"

#include <cmath>

using namespace voxelcore;
using namespace voxelcore::testing;

TEST(ItkScan, ComesBackBitByBitWhateverItHolds)
{
  ItkScan scan;
  scan.format = "DICOM-SEG";
  scan.storedType = "uint1";
  scan.type = PixelType::Float64;
  scan.size = { 512, 1, std::int64_t{ 1 } << 40 };
  scan.components = 3;
  scan.volumes = UINT64_MAX;
  scan.separate = true;
  scan.axes = { { { 0.1, -0.0, 1.0 / 3 }, { 1e-300, 2, -3 }, { 0, 0, 1 } } };
  scan.spacing = { 0.1, 0, 5e-324 };
  scan.origin = { -1e300, 1.0000000000000002, 7 };
  scan.slope = 1.0 / 255;
  scan.intercept = -1024.5;
  Segment plain{};
  plain.name = "a name of words ";
  plain.value = -7;
  Segment coloured{};
  coloured.layer = 2;
  coloured.value = 65535;
  coloured.color = Color{ 0.1, 0.2, 1.0 / 3 };
  scan.segments = { plain, coloured };
  scan.notes = { "one", "note two" };
  scan.warnings = { "warning" };
  scan.files = { "/a b/c", "d" };
  const std::string text = ItkScanText(scan);
  EXPECT_TRUE(text.ends_with("\n\n"));
  EXPECT_EQ(text.find("\n\n"), text.size() - 2);
  for (const std::string & sent : { text, text.substr(0, text.size() - 2) })
  {
    const ItkScan got = ParseItkScan("a.dcm", sent);
    EXPECT_EQ(ItkScanText(got), text);
    EXPECT_EQ(got.format, scan.format);
    EXPECT_EQ(got.storedType, scan.storedType);
    EXPECT_EQ(got.type, scan.type);
    EXPECT_EQ(got.size, scan.size);
    EXPECT_EQ(got.components, scan.components);
    EXPECT_EQ(got.volumes, scan.volumes);
    EXPECT_TRUE(got.separate);
    EXPECT_EQ(got.axes, scan.axes);
    EXPECT_TRUE(std::signbit(got.axes[0][1]));
    EXPECT_EQ(got.spacing, scan.spacing);
    EXPECT_EQ(got.origin, scan.origin);
    EXPECT_EQ(got.slope, scan.slope);
    EXPECT_EQ(got.intercept, scan.intercept);
    ASSERT_EQ(got.segments.size(), 2U);
    EXPECT_EQ(got.segments[0].name, plain.name);
    EXPECT_EQ(got.segments[0].value, -7);
    EXPECT_FALSE(got.segments[0].color);
    EXPECT_EQ(got.segments[1].layer, 2U);
    EXPECT_EQ(got.segments[1].color, coloured.color);
    EXPECT_EQ(got.notes, scan.notes);
    EXPECT_EQ(got.warnings, scan.warnings);
    EXPECT_EQ(got.files, scan.files);
  }
}

TEST(ItkScan, NothingThatAFileHoldsMakesALineMore)
{
  ItkScan scan;
  scan.format = "a\nb";
  Segment segment{};
  segment.name = "size 1 1 1\nsize 2 2 2\r\t\x1B";
  scan.segments = { segment };
  scan.notes = { "line\nspacing 9 9 9" };
  scan.files = { "a\nsize 3 3 3", "b" };
  const ItkScan got = ParseItkScan("a.dcm", ItkScanText(scan));
  EXPECT_EQ(got.format, "a b");
  EXPECT_EQ(got.segments.at(0).name, "size 1 1 1 size 2 2 2   ");
  EXPECT_EQ(got.notes.at(0), "line spacing 9 9 9");
  EXPECT_EQ(got.spacing, scan.spacing);
  EXPECT_EQ(got.size, scan.size);
  EXPECT_EQ(got.files, std::vector<std::filesystem::path>{ "b" });
}

TEST(ItkScan, LinesThatAreNoneAreRefused)
{
  for (const auto & [line, text] : std::vector<std::pair<std::string, std::string>>{
         { "type 10", "an unknown type" },
         { "type four", "'four' for a number" },
         { "type", "'' for a number" },
         { "size 1 2", "'' for a number" },
         { "size 1 2 3x", "'3x' for a number" },
         { "size 1 2 99999999999999999999", "for a number" },
         { "values -1 1 0", "'-1' for a number" },
         { "spacing 1 2 three", "'three' for a number" },
         { "segment 0 1 1 0.5 0.5", "'' for a number" },
         { "a3 1 0 0", "sent 'a3'" },
         { "b0 1 0 0", "sent 'b0'" },
         { "a/ 1 0 0", "sent 'a/'" },
         { "a 1 0 0", "sent 'a'" },
         { " note", "sent ''" },
         { "Segmentation fault", "sent 'Segmentation'" },
       })
  {
    const std::string message = MessageOf([&] { ParseItkScan("a.dcm", "format DICOM\n" + line + "\n\n"); });
    EXPECT_NE(message.find(text), std::string::npos) << line << ": " << message;
    EXPECT_NE(message.find("a.dcm"), std::string::npos) << message;
  }
}
