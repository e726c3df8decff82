// Colours and names of labels from the lists that other programs lay beside a scan.

#include "NrrdFixtures.h"

#include <cmath>
#include <map>
#include <optional>

using namespace voxelcore;
using namespace voxelcore::testing;
using namespace voxelcore::testing::nrrd;

namespace
{

using Bytes = std::array<int, 3>;

/** Of labels 1, 2, 3, 7 and 250: the name, and the colour in bytes. */
using Found = std::map<std::int64_t, std::pair<std::string, std::optional<Bytes>>>;

class LabelColors : public ::testing::Test
{
protected:
  Found
  Read() const
  {
    const LabelMap volume = ReadLabelVolume(m_Folder.Write("scan.nrrd", Nrrd(Lines(), RawAll<std::uint8_t>(kValues))));
    Found          found;
    for (const LabelShape & label : volume.labels)
    {
      std::optional<Bytes> color;
      if (label.color)
      {
        color.emplace();
        for (std::size_t k = 0; k < 3; ++k)
        {
          const double byte = (*label.color)[k] * 255;
          (*color)[k] = static_cast<int>(std::lround(byte));
          EXPECT_NEAR(byte, (*color)[k], 1e-9);
        }
      }
      found[label.value] = { label.name, color };
    }
    return found;
  }

  /** MRIcron's table of 768 bytes, label i in colour (i, 255 - i, 7 i). */
  static std::string
  ByteTable()
  {
    std::string bytes(768, '\0');
    for (std::size_t i = 0; i < 256; ++i)
    {
      bytes[i] = static_cast<char>(i);
      bytes[256 + i] = static_cast<char>(255 - i);
      bytes[512 + i] = static_cast<char>(7 * i);
    }
    return bytes;
  }

  TempFolder m_Folder;
};

TEST_F(LabelColors, OfAFreeSurferColorTable)
{
  // As in FreeSurferColorLUT.txt: comments, columns aligned by blanks, a transparency that says nothing.
  m_Folder.Write("scan.ctab",
                 "#$Id: FreeSurferColorLUT.txt,v 1.70 Exp $\n\n"
                 "#No. Label Name:                            R   G   B   A\n\n"
                 "0   Unknown                                 0   0   0   0\n"
                 "1   Left-Cerebral-Exterior                  70  130 180 0\n"
                 "2   Left-Cerebral-White-Matter              245 245 245 0\n"
                 "3   Left-Cerebral-Cortex                    205 62  78  0\n"
                 "7   Left-Cerebellum-White-Matter            220 248 164 255\n");
  const Found expected{ { 1, { "Left-Cerebral-Exterior", Bytes{ 70, 130, 180 } } },
                        { 2, { "Left-Cerebral-White-Matter", Bytes{ 245, 245, 245 } } },
                        { 3, { "Left-Cerebral-Cortex", Bytes{ 205, 62, 78 } } },
                        { 7, { "Left-Cerebellum-White-Matter", Bytes{ 220, 248, 164 } } },
                        { 250, { "label-250", std::nullopt } } };
  EXPECT_EQ(Read(), expected);
}

TEST_F(LabelColors, OfItkSnapsLabelDescriptions)
{
  m_Folder.Write("scan.label",
                 "################################################\n# ITK-SnAP Label Description File\n"
                 "# IDX:   Zero-based index\n################################################\n"
                 "    0     0    0    0        0  0  0    \"Clear Label\"\n"
                 "    1   255    0    0        1  1  1    \"Left ventricle 2\"\n"
                 "    2     0  255    0      0.5  1  0    \"A \"\"B\"\" 3\"\n"
                 "  250    12   34   56        1  0  1    \"Label 250\"\n");
  const Found found = Read();
  EXPECT_EQ(found.at(1), (std::pair<std::string, std::optional<Bytes>>("Left ventricle 2", Bytes{ 255, 0, 0 })));
  EXPECT_EQ(found.at(2).second, (Bytes{ 0, 255, 0 }));
  EXPECT_EQ(found.at(3), (std::pair<std::string, std::optional<Bytes>>("label-3", std::nullopt)));
  EXPECT_EQ(found.at(250), (std::pair<std::string, std::optional<Bytes>>("Label 250", Bytes{ 12, 34, 56 })));
}

TEST_F(LabelColors, OfMRIcronsTableBesideAListOfNames)
{
  m_Folder.Write("scan.lut", ByteTable());
  m_Folder.Write("scan.nrrd.txt", "1 Precentral_L 2001\n7 Frontal_L 2101\n");
  const Found expected{ { 1, { "Precentral_L", Bytes{ 1, 254, 7 } } },
                        { 2, { "label-2", Bytes{ 2, 253, 14 } } },
                        { 3, { "label-3", Bytes{ 3, 252, 21 } } },
                        { 7, { "Frontal_L", Bytes{ 7, 248, 49 } } },
                        { 250, { "label-250", Bytes{ 250, 5, 7 * 250 % 256 } } } };
  EXPECT_EQ(Read(), expected);
}

TEST_F(LabelColors, AreNoneWhereMRIcronsTableIsBlack)
{
  std::string bytes = ByteTable();
  bytes[7] = bytes[256 + 7] = bytes[512 + 7] = 0;
  m_Folder.Write("scan.lut", bytes);
  const Found found = Read();
  EXPECT_FALSE(found.at(7).second);
  EXPECT_TRUE(found.at(3).second);
}

TEST_F(LabelColors, OfATextListGoBeforeThoseOfATable)
{
  m_Folder.Write("scan.lut", ByteTable());
  m_Folder.Write("scan.txt", "1 One 10 20 30 0\n2 Two 40 50 60 0\n");
  const Found found = Read();
  EXPECT_EQ(found.at(1).second, (Bytes{ 10, 20, 30 }));
  EXPECT_EQ(found.at(2).second, (Bytes{ 40, 50, 60 }));
}

TEST_F(LabelColors, AreNoneWhereTheNumbersAreNoColors)
{
  // Codes, too few or too many columns, too large: the labels then have the palette's colours.
  for (const char * const list : { "1 A 10 20 300 0\n2 B 10 20 300 0\n",
                                   "1 A 10 20 30\n2 B 10 20 30\n",
                                   "1 A 1.5 2 3 0\n2 B 1 2 3.5 0\n",
                                   "1 A -1 2 3 0\n2 B 1 2 -3 0\n" })
  {
    m_Folder.Write("scan.txt", list);
    const Found found = Read();
    EXPECT_FALSE(found.at(1).second) << list;
    EXPECT_FALSE(found.at(2).second) << list;
  }
  // A table cut off is none.
  m_Folder.Write("scan.txt", "1 A\n");
  m_Folder.Write("scan.lut", ByteTable().substr(0, 700));
  EXPECT_FALSE(Read().at(1).second);
}

} // namespace
