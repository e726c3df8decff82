// Series of DICOM slices: what is no volume is refused with the reason, and slices lie where they say.

#include "DicomSources.h"

#include <cmath>

namespace voxelcore::testing::dicom
{

namespace
{

class DicomSeries : public ::testing::Test
{
protected:
  /** Writes the series anew with changes of one slice, or of all (k < 0). */
  std::filesystem::path
  Write(int k, const std::vector<Change> & changes) const
  {
    std::filesystem::remove_all(m_Folder / "s");
    for (const auto & [name, bytes] : DicomSeriesBytes())
    {
      m_Folder.Write("s/" + name, k < 0 || name == "IM" + std::to_string(k) ? With(bytes, changes) : bytes);
    }
    return m_Folder / "s";
  }
  void
  Refuse(int k, const std::vector<Change> & changes, const std::string & text) const
  {
    SCOPED_TRACE(text);
    ExpectRefusedBy(Write(k, changes), text);
  }
  static Change
  Position(const std::string & text)
  {
    return { 0x0020, 0x0032, "DS", text };
  }
  static Change
  Orientation(const std::string & text)
  {
    return { 0x0020, 0x0037, "DS", text };
  }
  static std::string
  Name(int k)
  {
    return "s/IM" + std::to_string(k);
  }

  const TempFolder  m_Folder;
  const std::string m_Values = RawAll<std::uint16_t>(ForeignValues());
};

} // namespace

TEST_F(DicomSeries, FilesThatAreNoGreySlicesAreRefused)
{
  Refuse(1, { { 0x0028, 0x0010, "US", Short(0) } }, "without an image");
  Refuse(1, { { 0x0028, 0x0011, "" } }, "without an image");
  for (const char * frames : { "0", "-3", "x", "2000000000" })
  {
    Refuse(1, { { 0x0028, 0x0008, "IS", frames } }, "without an image");
  }
  Refuse(-1, { { 0x0028, 0x0002, "US", Short(3) } }, "colour image");
  Refuse(-1, { { 0x0028, 0x0004, "CS", "YBR_FULL" } }, "colour image (YBR_FULL)");
  Refuse(-1, { { 0x0028, 0x0100, "US", Short(12) } }, "pixels of 16 bits in 12");
  Refuse(-1, { { 0x0028, 0x0100, "US", Short(64) } }, "in 64");
  Refuse(-1, { { 0x0028, 0x0101, "US", Short(17) } }, "pixels of 17 bits in 16");
  Refuse(-1, { { 0x0028, 0x0101, "US", Short(0) } }, "pixels of 0 bits in 16");
  Refuse(-1, { { 0x0028, 0x0102, "US", Short(14) } }, "do not begin with the lowest");
  Refuse(-1, { { 0x0028, 0x3000, "SQ", "" } }, "values of a table");
  Refuse(-1, { { 0x7fe0, 0x0010, "OW", m_Values.substr(0, 40) } }, "its pixels are truncated");
  Refuse(-1, { { 0x7fe0, 0x0010, "" } }, "its pixels are truncated");
}

TEST_F(DicomSeries, SlicesThatAreNotLikeTheFirstAreRefused)
{
  Refuse(2, { { 0x0028, 0x0010, "US", Short(6) } }, "this slice (6 x 6, uint16) is not like the first (6 x 5, uint16)");
  Refuse(2, { { 0x0028, 0x0011, "US", Short(7) } }, "(7 x 5, uint16)");
  Refuse(2, { { 0x0028, 0x0103, "US", Short(1) } }, "(6 x 5, int16)");
  Refuse(2, { { 0x0028, 0x0008, "IS", "2" } }, "many frames among slices");
  Refuse(2,
         { { 0x0028, 0x0100, "US", Short(1) }, { 0x0028, 0x0101, "US", Short(1) }, { 0x0028, 0x0102, "US", Short(0) } },
         "many frames among slices");
  Refuse(2, { Orientation("0\\1\\0\\1\\0\\0") }, "1 of its 4 slices have another direction");
  Refuse(2, { Orientation("1\\0\\0\\0\\0.9\\0") }, "1 of its 4 slices have another direction");
  Refuse(2, { { 0x0028, 0x0030, "DS", "0.75\\0.6" } }, "pixels of different sizes");
  Refuse(2, { { 0x0028, 0x0030, "DS", "0.8\\0.5" } }, "pixels of different sizes");
  Refuse(2, { { 0x0028, 0x0030, "" } }, "pixels of different sizes");
}

TEST_F(DicomSeries, SlicesWithoutAPlaceAreRefused)
{
  Refuse(2, { { 0x0020, 0x0032, "" } }, "without a place in space");
  Refuse(2, { Position("1\\2") }, "without a place in space");
  Refuse(2, { Orientation("1\\0\\0") }, "without a place in space");
  Refuse(2, { Position("0\\0\\inf") }, "no finite position");
  Refuse(-1, { Orientation("1\\0\\0\\1\\0\\0") }, "run in one direction");
  Refuse(-1, { Position("0\\0\\0") }, "only one slice, without a thickness");
  Refuse(-1, { Position("0\\0\\0"), { 0x0018, 0x0050, "DS", "-1" } }, "only one slice, without a thickness");
  Refuse(-1, { Position("0\\0\\0"), { 0x0018, 0x0050, "DS", "2" } }, "4 slices at one place");
}

TEST_F(DicomSeries, SlicesThatAreMissingDoubledOrApartAreRefused)
{
  std::filesystem::remove(Write(-1, {}) / "IM1");
  ExpectRefusedBy(m_Folder / "s", "slices are missing: they are 2 to 4 mm apart");
  Refuse(1, { Position("-1\\2\\2.5") }, "not equally far apart: 1.5 to 2.5 mm");
  Refuse(2, { Position("-0.5\\2\\4") }, "one straight line");
  Refuse(2, { Position("-1\\2\\2") }, "slices are missing");
  m_Folder.Write("s/more", DicomSeriesBytes().at("IM1"));
  Write(-1, {});
  m_Folder.Write("s/more", DicomSeriesBytes().at("IM1"));
  ExpectRefusedBy(m_Folder / "s", "not as many slices at each place");
  std::filesystem::remove_all(m_Folder / "s");
  m_Folder.Write("s/IM0", DicomSeriesBytes().at("IM0"));
  ExpectRefusedBy(m_Folder / "s", "only one slice");
  ExpectRefusedBy(m_Folder / "s/IM0", "only one slice");
}

TEST_F(DicomSeries, SlicesMayLeanAndRunDownwards)
{
  Write(-1, {});
  for (int k = 0; k < 4; ++k)
  {
    const std::string place = std::to_string(0.5 * k) + "\\0\\" + std::to_string(-2 * k);
    m_Folder.Write(Name(k), With(DicomSeriesBytes().at("IM" + std::to_string(k)), { Position(place) }));
  }
  const auto source = itkreader::OpenDicom(m_Folder / "s");
  const auto length = std::sqrt(4.25);
  ExpectNear(source->scan.axes[2], { -0.5 / length, 0, 2 / length });
  EXPECT_NEAR(source->scan.spacing[2], length, 1e-9);
  ExpectNear(source->scan.origin, { 1.5, 0, -6 });
  EXPECT_EQ(Sent(*source).substr(0, 60), m_Values.substr(180));
}

TEST_F(DicomSeries, SlicesAtOnePlaceAreVolumesByTheirNumbers)
{
  Write(-1, {});
  for (int k = 0; k < 4; ++k)
  {
    const auto bytes = DicomSeriesBytes().at("IM" + std::to_string(k));
    m_Folder.Write(
      "s/A" + std::to_string(k),
      With(bytes,
           { { 0x0020, 0x0013, "IS", std::to_string(10 + k) }, { 0x7fe0, 0x0010, "OW", std::string(60, '\1') } }));
  }
  const auto source = itkreader::OpenDicom(m_Folder / "s");
  EXPECT_EQ(source->scan.volumes, 2U);
  EXPECT_EQ(Sent(*source, 0), m_Values);
  EXPECT_EQ(Sent(*source, 1), std::string(240, '\1'));
}

TEST_F(DicomSeries, SlopesOfTheirOwnMakeNumbersOfDoublePrecision)
{
  const auto one = itkreader::OpenDicom(Write(-1, { { 0x0028, 0x1052, "DS", "-5" }, { 0x0028, 0x1053, "DS", "2" } }));
  EXPECT_EQ(one->scan.type, PixelType::UInt16);
  EXPECT_EQ(one->scan.slope, 2);
  EXPECT_EQ(one->scan.intercept, -5);
  EXPECT_EQ(Sent(*one), m_Values);
  for (const Change & change : { Change{ 0x0028, 0x1053, "DS", "0.5" }, Change{ 0x0028, 0x1052, "DS", "0.5" } })
  {
    const auto own = itkreader::OpenDicom(Write(2, { change }));
    EXPECT_EQ(own->scan.type, PixelType::Float64);
    EXPECT_TRUE(HasNote(own->scan.notes, "slopes of their own"));
    std::string expected;
    for (std::size_t n = 0; n < ForeignValues().size(); ++n)
    {
      const double value = ForeignValues()[n];
      expected += Raw<double>(n / 30 != 2 ? value : change.element == 0x1053 ? value / 2 : value + 0.5);
    }
    EXPECT_EQ(Sent(*own), expected);
  }
}

TEST_F(DicomSeries, PixelsOfEveryWidthAreReadWithoutTheBitsThatAreNotStored)
{
  for (const int bits : { 8, 16, 32 })
  {
    for (const bool isSigned : { false, true })
    {
      for (const int stored : { bits, bits - 1 })
      {
        SCOPED_TRACE(std::to_string(stored) + " of " + std::to_string(bits) + (isSigned ? " signed" : ""));
        const auto bytesOf = [bits](std::int64_t value) {
          return Raw<std::int64_t>(value).substr(0, static_cast<std::size_t>(bits / 8));
        };
        std::filesystem::remove_all(m_Folder / "s");
        std::string expected;
        for (std::size_t k = 0; k < 4; ++k)
        {
          std::string wide;
          for (std::size_t n = 30 * k; n < 30 * k + 30; ++n)
          {
            const std::int64_t value = isSigned && n % 2 != 0 ? -ForeignValues()[n] - 1 : ForeignValues()[n];
            // The bit above those stored is turned over.
            wide += bytesOf(value ^ (std::int64_t{ 1 } << stored));
            expected += bytesOf(value);
          }
          m_Folder.Write(Name(static_cast<int>(k)),
                         With(DicomSeriesBytes().at("IM" + std::to_string(k)),
                              { { 0x0028, 0x0100, "US", Short(bits) },
                                { 0x0028, 0x0101, "US", Short(stored) },
                                { 0x0028, 0x0102, "US", Short(stored - 1) },
                                { 0x0028, 0x0103, "US", Short(isSigned ? 1 : 0) },
                                { 0x7fe0, 0x0010, bits == 8 ? "OB" : "OW", wide } }));
        }
        const auto source = itkreader::OpenDicom(m_Folder / "s");
        EXPECT_EQ(PixelName(source->scan.type), (isSigned ? "int" : "uint") + std::to_string(bits));
        EXPECT_TRUE(Sent(*source) == expected);
      }
    }
  }
}

TEST_F(DicomSeries, SeveralInAFolderAreNamedAndOneIsReadByAFileOfIt)
{
  Write(-1, {});
  for (int n = 0; n < 7; ++n)
  {
    std::vector<Change> changes{ { 0x0020, 0x000e, "UI", "1.9." + std::to_string(n) } };
    if (n == 0)
    {
      changes.push_back({ 0x0008, 0x103e, "LO", "thin slices" });
    }
    m_Folder.Write("s/other" + std::to_string(n), With(DicomSeriesBytes().at("IM0"), changes));
  }
  m_Folder.Write("s/.hidden", With(DicomSeriesBytes().at("IM0"), { { 0x0020, 0x000e, "UI", "1.10" } }));
  m_Folder.Write("s/DICOMDIR", With(DicomSeriesBytes().at("IM0"), { { 0x0020, 0x000e, "UI", "1.11" } }));
  m_Folder.Write("s/notes.txt", "no DICOM");
  std::filesystem::create_directories(m_Folder / "s/deeper");
  ExpectRefusedBy(m_Folder / "s", "8 series, beginning with 'IM0' (4 files), 'other0' (thin slices, 1 file)");
  ExpectRefusedBy(m_Folder / "s", ", ...");
  EXPECT_EQ(Sent(*itkreader::OpenDicom(m_Folder / "s/IM2")), m_Values);
  std::filesystem::create_directories(m_Folder / "none");
  ExpectRefusedBy(m_Folder / "none", "no DICOM file in this folder");
  ExpectRefusedBy(m_Folder / "s/notes.txt", "GDCM cannot read it");
  ExpectRefusedBy(
    m_Folder.Write("c",
                   With(DicomSeriesBytes().at("IM0"), { { 0x0008, 0x0016, "UI", "1.2.840.10008.5.1.4.1.1.481.3" } })),
    "RTSTRUCT");
}

} // namespace voxelcore::testing::dicom
