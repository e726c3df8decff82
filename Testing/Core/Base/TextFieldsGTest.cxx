#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/TextFields.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace voxelcore::testing
{
namespace
{

TEST(TextFields, NumbersAreWrittenAsAPersonWould)
{
  EXPECT_EQ(Number(3), "3");
  EXPECT_EQ(Number(-1024), "-1024");
  EXPECT_EQ(Number(0.1), "0.1");
  EXPECT_EQ(Number(2.0 / 3), "0.666667");
  EXPECT_EQ(Number(0.9999999), "0.99999990000000005"); // six digits would make it 1
}

TEST(TextFields, OnlyWholeWordsAreNumbers)
{
  EXPECT_EQ(ParseInteger("-12"), -12);
  EXPECT_EQ(ParseInteger("+12"), 12);
  for (const char * text : { "", "+", "+-1", "1.0", "1 ", "0x1", "9223372036854775808" })
  {
    EXPECT_FALSE(ParseInteger(text)) << text;
  }
  EXPECT_EQ(ParseReals(" 1 2.5\t-3e2 "), (std::vector<double>{ 1, 2.5, -300 }));
  EXPECT_FALSE(ParseReals("1 2,5"));
}

TEST(TextFields, VoxelSizesAreOneNumberOrThreeWithUnits)
{
  using Size = std::array<double, 3>;
  EXPECT_EQ(ParseVoxelSize("0.05"), (Size{ 0.05, 0.05, 0.05 }));
  EXPECT_EQ(ParseVoxelSize("50um"), (Size{ 0.05, 0.05, 0.05 }));
  EXPECT_EQ(ParseVoxelSize("50 \xC2\xB5m"), (Size{ 0.05, 0.05, 0.05 }));
  EXPECT_EQ(ParseVoxelSize("0.5, 0.5, 2"), (Size{ 0.5, 0.5, 2 }));
  EXPECT_EQ(ParseVoxelSize("0.5,0.5,2cm"), (Size{ 5, 5, 20 }));
  EXPECT_EQ(ParseVoxelSize("4nm,4nm,0.04um"), (Size{ 4e-6, 4e-6, 4e-5 }));
  EXPECT_EQ(ParseVoxelSize("1,2um,3mm"), (Size{ 0.001, 0.002, 3 }));
  EXPECT_EQ(ParseVoxelSize("5e-2"), (Size{ 0.05, 0.05, 0.05 }));
  for (const char * text : { "",
                             ",",
                             "1,1",
                             "1,1,1,1",
                             "0",
                             "-1",
                             "1,1,0",
                             "inf",
                             "nan",
                             "mm",
                             "1mm,1,1",
                             "1,1um,1",
                             "5 parsecs",
                             "1;1;1",
                             "1um 2um 3um",
                             "1.2.3",
                             "1e400" })
  {
    EXPECT_FALSE(ParseVoxelSize(text)) << text;
  }
}

TEST(TextFields, ForeignTextStaysOnOneLine)
{
  EXPECT_EQ(Printable("a\nb\x7F"), "a?b?");
  EXPECT_EQ(Printable("\xC2\x9B"
                      "2J \xC2\xB5m \xE2\x82\xAC"),
            "?2J \xC2\xB5m \xE2\x82\xAC"); // a terminal's command; micro and euro signs
  EXPECT_EQ(Printable("abcdef", 3), "abc...");
  EXPECT_EQ(Trim(" \ta b\r\n"), "a b");
  EXPECT_EQ(Words(" a\tb  c "), (std::vector<std::string_view>{ "a", "b", "c" }));
}

TEST(TextFields, ARefusalSaysFileFaultAndRemedy)
{
  try
  {
    RefuseInput("some\nwhere/a.nrrd", "it is empty", "fetch it anew");
    ADD_FAILURE();
  }
  catch (const InputError & error)
  {
    EXPECT_STREQ(error.what(), "some?where/a.nrrd: it is empty; fetch it anew");
  }
}

TEST(TextFields, UnitsOfLengthAreKnown)
{
  EXPECT_EQ(MillimetresIn(" Microns "), 1e-3);
  const std::vector<std::pair<double, std::vector<std::string>>> known{
    { 1.0, { "mm", "millimeter", "millimeters", "millimetre", "millimetres", "MM" } },
    { 1e-3, { "um", "micron", "microns", "micrometer", "micrometers", "micrometre", "micrometres" } },
    { 1e-3, { "\xC2\xB5m", "\xCE\xBCm", "\xB5m" } },
    { 1e-6, { "nm", "nanometer", "nanometers", "nanometre", "nanometres" } },
    { 10.0, { "cm", "centimeter", "centimeters", "centimetre", "centimetres" } },
    { 100.0, { "dm" } },
    { 1000.0, { "m", "meter", "meters", "metre", "metres" } },
    { 25.4, { "inch", "inches", "in" } },
    { 1e-7, { "angstrom", "\xC3\x85", "\xC3\xA5" } },
    { 1e-9, { "pm" } },
  };
  for (const auto & [millimetres, units] : known)
  {
    for (const std::string & unit : units)
    {
      EXPECT_EQ(MillimetresIn(unit), millimetres) << unit;
    }
  }
  for (const char * unit : { "furlong", "", "mmm", "km", "voxel" })
  {
    EXPECT_FALSE(MillimetresIn(unit)) << unit;
  }
  EXPECT_EQ(Counted(1, "voxel", "voxels"), "1 voxel");
  EXPECT_EQ(Counted(0, "voxel", "voxels"), "0 voxels");
}

} // namespace
} // namespace voxelcore::testing
