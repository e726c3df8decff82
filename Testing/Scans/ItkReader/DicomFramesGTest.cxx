// DICOM files of many frames: enhanced images and segmentations.

#include "DicomSources.h"

namespace voxelcore::testing::dicom
{

namespace
{

/** Groups of a frame: its place, the segment it is of, and more. */
std::string
Frame(double height, int segment = 0, const std::string & more = {})
{
  return DicomSequence(0x0020, 0x9113, { DicomElement(0x0020, 0x0032, "DS", "-1\\2\\" + std::to_string(height)) }) +
         more +
         (segment == 0 ? std::string()
                       : DicomSequence(0x0062, 0x000a, { DicomElement(0x0062, 0x000b, "US", Short(segment)) }));
}

std::string
SegmentItem(int number, const std::string & name, const std::string & more = {})
{
  return DicomElement(0x0062, 0x0004, "US", Short(number)) + DicomElement(0x0062, 0x0005, "LO", name) + more;
}

std::string
Sequence(const std::vector<std::string> & items)
{
  return DicomSequence(0, 0, items).substr(12);
}

/** A file of frames of 6 x 5 pixels with these groups each. */
std::string
Frames(const std::vector<std::string> & groups, const std::vector<Change> & changes = {})
{
  return With(
    With(DicomSegmentationBytes(),
         { { 0x0028, 0x0008, "IS", std::to_string(groups.size()) }, { 0x5200, 0x9230, "SQ", Sequence(groups) } }),
    changes);
}

const std::vector<Change> kEnhanced{ { 0x0008, 0x0016, "UI", "1.2.840.10008.5.1.4.1.1.2.1" },
                                     { 0x0028, 0x0100, "US", Short(16) },
                                     { 0x0028, 0x0101, "US", Short(16) },
                                     { 0x0028, 0x0102, "US", Short(15) },
                                     { 0x7fe0, 0x0010, "OW", RawAll<std::uint16_t>(ForeignValues()) } };
const std::vector<Change> kBytes{ { 0x0028, 0x0100, "US", Short(8) },
                                  { 0x0028, 0x0101, "US", Short(8) },
                                  { 0x0028, 0x0102, "US", Short(7) } };

class DicomFrames : public ::testing::Test
{
protected:
  std::unique_ptr<itkreader::ScanSource>
  Open(const std::string & bytes) const
  {
    return itkreader::OpenDicom(m_Folder.Write("a.dcm", bytes));
  }
  void
  Refuse(const std::string & bytes, const std::string & text) const
  {
    SCOPED_TRACE(text);
    ExpectRefusedBy(m_Folder.Write("a.dcm", bytes), text);
  }
  static std::vector<Change>
  Both(std::vector<Change> changes, const std::vector<Change> & more)
  {
    changes.insert(changes.end(), more.begin(), more.end());
    return changes;
  }

  const TempFolder m_Folder;
};

using DicomSegmentation = DicomFrames;

} // namespace

TEST_F(DicomFrames, OfAnEnhancedImageAreSlicesInTheOrderOfTheirPlaces)
{
  const auto source = Open(Frames({ Frame(6), Frame(4), Frame(2), Frame(0) }, kEnhanced));
  EXPECT_EQ(source->scan.format, "DICOM");
  ExpectNear(source->scan.spacing, { 0.5, 0.75, 2 });
  ExpectNear(source->scan.origin, { -1, 2, 0 });
  const std::string values = RawAll<std::uint16_t>(ForeignValues());
  EXPECT_EQ(Sent(*source), values.substr(180) + values.substr(120, 60) + values.substr(60, 60) + values.substr(0, 60));
}

TEST_F(DicomFrames, OfSlopesOfTheirOwnAreScaledEachByItself)
{
  const auto scale = [](const char * slope) {
    return DicomSequence(0x0028,
                         0x9145,
                         { DicomElement(0x0028, 0x1052, "DS", "1") + DicomElement(0x0028, 0x1053, "DS", slope) });
  };
  const auto same =
    Open(Frames({ Frame(0, 0, scale("2")), Frame(2, 0, scale("2")), Frame(4, 0, scale("2")), Frame(6, 0, scale("2")) },
                kEnhanced));
  EXPECT_EQ(same->scan.slope, 2);
  EXPECT_EQ(same->scan.intercept, 1);
  EXPECT_EQ(same->scan.type, PixelType::UInt16);
  const auto own = Open(Frames({ Frame(0), Frame(2), Frame(4), Frame(6, 0, scale("0.5")) }, kEnhanced));
  EXPECT_EQ(own->scan.type, PixelType::Float64);
  EXPECT_TRUE(HasNote(own->scan.notes, "slopes of their own"));
  std::string expected;
  for (std::size_t n = 0; n < ForeignValues().size(); ++n)
  {
    expected += Raw<double>(n < 90 ? ForeignValues()[n] : 1 + 0.5 * ForeignValues()[n]);
  }
  EXPECT_EQ(Sent(*own), expected);
}

TEST_F(DicomFrames, AtOnePlaceAreVolumesWhereAllPlacesHaveAsMany)
{
  const auto source = Open(Frames({ Frame(0), Frame(2), Frame(0), Frame(2) }, kEnhanced));
  EXPECT_EQ(source->scan.volumes, 2U);
  EXPECT_EQ(Sent(*source, 1), RawAll<std::uint16_t>(ForeignValues()).substr(120));
  Refuse(Frames({ Frame(0), Frame(2), Frame(0), Frame(4) }, kEnhanced), "not as many frames at each place");
}

TEST_F(DicomFrames, OneIsAsThickAsItSays)
{
  const auto source = Open(Frames({ Frame(0) }, kEnhanced));
  EXPECT_EQ(source->scan.size[2], 1);
  EXPECT_EQ(source->scan.spacing[2], 2);
  EXPECT_TRUE(HasNote(source->scan.notes, "one slice"));
  EXPECT_EQ(Sent(*source), RawAll<std::uint16_t>(ForeignValues()).substr(0, 60));
}

TEST_F(DicomFrames, WithoutAPlaceOrOfBitsAreRefused)
{
  Refuse(Frames({ Frame(0), Frame(2) }, Both(kEnhanced, { { 0x0028, 0x0008, "IS", "4" } })),
         "4 frames without a place");
  Refuse(Frames({ Frame(0), Frame(2) }, Both(kEnhanced, { { 0x5200, 0x9230, "" } })), "2 frames without a place");
  Refuse(Frames({ Frame(0), Frame(2) }, Both(kEnhanced, { { 0x0028, 0x0008, "IS", "1" } })), "1 frame without a place");
  Refuse(Frames({ Frame(0), Frame(2) }, { kEnhanced.front() }), "image of bits that is no segmentation");
  Refuse(Frames({ Frame(0), Frame(2) }, Both(kEnhanced, { { 0x5200, 0x9229, "" } })), "without a place in space");
}

TEST_F(DicomSegmentation, WithoutSenseAreRefused)
{
  const std::string whole = DicomSegmentationBytes();
  Refuse(With(whole, { { 0x0062, 0x0001, "CS", "BOOLEAN" } }), "of type 'BOOLEAN'");
  Refuse(With(whole, { { 0x0062, 0x0001, "CS", "FRACTIONAL" } }), "FRACTIONAL segmentation with pixels of 1 bits");
  Refuse(With(whole, kBytes), "BINARY segmentation with pixels of 8 bits");
  const std::vector<Change> labelMap{ { 0x0062, 0x0001, "CS", "LABELMAP" } };
  Refuse(With(whole, Both(Both(labelMap, kBytes), { { 0x0028, 0x0103, "US", Short(1) } })), "LABELMAP segmentation");
  Refuse(With(whole, Both({ { 0x0062, 0x0001, "CS", "FRACTIONAL" } }, { kEnhanced.begin() + 1, kEnhanced.end() })),
         "with pixels of 16 bits");
  Refuse(With(whole, { { 0x0062, 0x0002, "SQ" } }), "without segments");
  Refuse(With(whole, { { 0x0062, 0x0002, "" } }), "without segments");
  for (const int twin : { 0, 1 })
  {
    Refuse(With(whole, { { 0x0062, 0x0002, "SQ", Sequence({ SegmentItem(1, "a"), SegmentItem(twin, "b") }) } }),
           "two segments or none have the number " + std::to_string(twin));
  }
  Refuse(Frames({ Frame(0, 1), Frame(2, 9) }), "frame 2 is of segment 9, which is not there");
  Refuse(Frames({ Frame(0, 1), Frame(2) }), "frame 2 is of segment 0");
  Refuse(Frames({ Frame(0, 1), Frame(2, 1), Frame(0, 1) }), "frames 1 and 3 are of one segment at one place");
  Refuse(Frames({ Frame(0, 1), Frame(20000, 1) }), "too far apart");
  Refuse(Frames({ Frame(0, 1), Frame(2, 1), Frame(4.7, 1) }), "not equally far apart");
}

TEST_F(DicomSegmentation, OfPackedBitsIsRefused)
{
  using namespace std::string_literals;
  const std::string rle = With(DicomSegmentationBytes(), { { 0x0002, 0x0010, "UI", "1.2.840.10008.1.2.5" } });
  const std::string packed = "\xe0\x7f\x10\0OB\0\0\xff\xff\xff\xff"s + "\xfe\xff\0\xe0\0\0\0\0"s +
                             "\xfe\xff\0\xe0\4\0\0\0abcd"s + "\xfe\xff\xdd\xe0\0\0\0\0"s;
  Refuse(WithDicomElement(rle, 0x7fe0, 0x0010, packed), "compressed pixels of one bit");
}

TEST_F(DicomSegmentation, PlacesWithoutAFrameAreBackground)
{
  const auto source = Open(Frames({ Frame(0, 1), Frame(6, 2) }));
  EXPECT_EQ(source->scan.size[2], 4);
  EXPECT_TRUE(HasNote(source->scan.notes, "2 slices without a frame are background"));
  const std::string sent = Sent(*source);
  ASSERT_EQ(sent.size(), 120U);
  EXPECT_EQ(sent.substr(30, 60), std::string(60, '\0'));
  EXPECT_NE(sent.substr(0, 30).find('\1'), std::string::npos);
}

TEST_F(DicomSegmentation, SegmentsThatOverlapGetLayersWhateverTheSizeOfAFrame)
{
  for (const int rows : { 4, 5 }) // 24 pixels are whole bytes, 30 are not
  {
    SCOPED_TRACE(rows);
    const std::size_t pixels = static_cast<std::size_t>(6 * rows);
    const auto        open = [&](std::size_t bitOfSecond) {
      std::string bits(pixels / 4 + 1, '\0');
      const auto  set = [&bits](std::size_t bit) { bits[bit / 8] = static_cast<char>(bits[bit / 8] | 1 << (bit % 8)); };
      set(5);
      set(pixels + bitOfSecond);
      return Open(Frames(
        { Frame(0, 1), Frame(0, 2) },
        { { 0x0028, 0x0010, "US", Short(rows) }, { 0x0018, 0x0050, "DS", "2" }, { 0x7fe0, 0x0010, "OB", bits } }));
    };
    const auto apart = open(6);
    EXPECT_EQ(apart->scan.components, 1U);
    std::string expected(pixels, '\0');
    expected[5] = '\1';
    expected[6] = '\2';
    EXPECT_EQ(Sent(*apart), expected);
    const auto both = open(5);
    EXPECT_EQ(both->scan.components, 2U);
    EXPECT_TRUE(HasNote(both->scan.notes, "read in 2 layers"));
    EXPECT_EQ(both->scan.segments[1].layer, 1U);
    expected.assign(2 * pixels, '\0');
    expected[10] = '\1';
    expected[11] = '\2';
    EXPECT_EQ(Sent(*both), expected);
  }
}

TEST_F(DicomSegmentation, NumbersBeyondAByteGetTwo)
{
  const auto source =
    Open(Frames({ Frame(0, 300), Frame(2, 7) },
                { { 0x0062, 0x0002, "SQ", Sequence({ SegmentItem(300, "a"), SegmentItem(7, "b") }) } }));
  EXPECT_EQ(source->scan.type, PixelType::UInt16);
  const std::string sent = Sent(*source);
  EXPECT_NE(sent.substr(0, 60).find(Raw<std::uint16_t>(300)), std::string::npos);
}

TEST_F(DicomSegmentation, FractionsAreGivenASegmentAtATime)
{
  std::string bytes(60, '\0');
  bytes[3] = '\x64';
  bytes[34] = '\x32';
  const auto fractions = [&](int most, const std::string & what) {
    return Frames({ Frame(0, 1), Frame(0, 2) },
                  Both(kBytes,
                       { { 0x0062, 0x0001, "CS", "FRACTIONAL" },
                         { 0x0062, 0x000e, "US", Short(most) },
                         { 0x0062, 0x0010, what.empty() ? "" : "CS", what },
                         { 0x7fe0, 0x0010, "OB", bytes } }));
  };
  const auto source = Open(fractions(100, "PROBABILITY"));
  EXPECT_TRUE(source->scan.separate);
  EXPECT_EQ(source->scan.components, 6U);
  EXPECT_DOUBLE_EQ(source->scan.slope, 0.01);
  EXPECT_TRUE(HasNote(source->scan.notes, "(probability)"));
  EXPECT_TRUE(HasNote(source->scan.notes, "0 segment 1, 1 segment 2"));
  EXPECT_EQ(Sent(*source, 0, 0), bytes.substr(0, 30));
  EXPECT_EQ(Sent(*source, 0, 1), bytes.substr(30));
  EXPECT_EQ(Sent(*source, 0, 5), std::string(30, '\0'));
  EXPECT_FALSE(HasNote(Open(fractions(255, ""))->scan.notes, "1 ("));
  Refuse(fractions(0, ""), "fractions of 0");
  Refuse(fractions(256, ""), "fractions of 256");
}

TEST_F(DicomSegmentation, OfLabelsMayDescribeTheBackground)
{
  const std::string values = RawAll<std::uint8_t>(ForeignValues());
  const auto        source =
    Open(Frames({ Frame(0), Frame(2), Frame(4), Frame(6) },
                Both(kBytes,
                     { { 0x0008, 0x0016, "UI", "1.2.840.10008.5.1.4.1.1.66.7" },
                       { 0x0028, 0x0004, "CS", "PALETTE COLOR" },
                       { 0x0062, 0x0001, "CS", "LABELMAP" },
                       { 0x0062, 0x0002, "SQ", Sequence({ SegmentItem(0, "nothing"), SegmentItem(3, "three") }) },
                       { 0x7fe0, 0x0010, "OB", values } })));
  ASSERT_EQ(source->scan.segments.size(), 1U);
  EXPECT_EQ(source->scan.segments[0].name, "three");
  EXPECT_EQ(Sent(*source), values);
}

TEST_F(DicomSegmentation, NamesAndColoursAreThoseOfTheFile)
{
  const auto named = [&](const std::string & set, const std::string & name, const std::string & color = {}) {
    const std::string more = color.empty() ? "" : DicomElement(0x0062, 0x000d, "US", color);
    const auto        source = Open(Frames({ Frame(0, 1), Frame(2, 1) },
                                    { { 0x0008, 0x0005, set.empty() ? "" : "CS", set },
                                             { 0x0062, 0x0002, "SQ", Sequence({ SegmentItem(1, name, more) }) } }));
    return source->scan.segments.at(0);
  };
  EXPECT_EQ(named("", "M\xE4rz").name, "M\xC3\xA4rz");
  EXPECT_EQ(named("ISO_IR 100", "M\xE4rz").name, "M\xC3\xA4rz");
  EXPECT_EQ(named("ISO_IR 192", "M\xC3\xA4rz").name, "M\xC3\xA4rz");
  EXPECT_EQ(named("ISO_IR 144", "\xB0").name, "\xD0\x90"); // Cyrillic
  EXPECT_EQ(named("ISO_IR 192", "M\xE4rz").name, "M?rz");
  EXPECT_EQ(named("ISO 2022 IR 87", "M\xE4rz").name, "M?rz");
  EXPECT_FALSE(named("", "a").color);
  EXPECT_FALSE(named("", "a", Short(1) + Short(2)).color);
  const auto white = named("", "a", Short(65535) + Short(32896) + Short(32896)).color;
  ASSERT_TRUE(white);
  ExpectNear({ (*white)[0], (*white)[1], (*white)[2] }, { 1, 1, 1 }, 2e-3);
  const auto black = named("", "a", Short(0) + Short(32896) + Short(32896)).color;
  ASSERT_TRUE(black);
  ExpectNear({ (*black)[0], (*black)[1], (*black)[2] }, { 0, 0, 0 }, 2e-3);
}

} // namespace voxelcore::testing::dicom
