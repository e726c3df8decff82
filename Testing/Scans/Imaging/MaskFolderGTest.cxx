// Folders of masks, one file a structure.

#include "NrrdFixtures.h"
#include "VoxelCoreTesting/Messages.h"
#include "voxelcore/Imaging/LabelVolume.h"

namespace voxelcore::testing
{
namespace
{

const std::vector<int> kLiver{ 0, 255, 255, 0, 0, 0, 255, 0, 0, 0, 0, 0 };
const std::vector<int> kSpleen{ 0, 0, 3, 3, 0, 0, 0, 0, 0, 0, 0, 3 };

class MaskFolders : public ::testing::Test
{
protected:
  MaskFolders()
  {
    m_Folder.Write("masks/spleen.nrrd", Nrrd(nrrd::Lines("int16"), RawAll<std::int16_t>(kSpleen)));
    m_Folder.Write("masks/liver.left.nrrd", Nrrd(nrrd::Lines("double"), RawAll<double>(kLiver)));
    m_Folder.Write("masks/empty.nrrd", Nrrd(nrrd::Lines(), RawAll<std::uint8_t>(std::vector<int>(12, 0))));
    m_Folder.Write("masks/.hidden.nrrd", "no mask");
    m_Folder.Write("masks/readme.txt", "no mask");
  }
  const TempFolder m_Folder;
};

void
ExpectVoxels(const LabelShape & label, const std::vector<int> & mask)
{
  std::uint64_t count = 0;
  for (int n = 0; n < 12; ++n)
  {
    const bool isIn = mask[static_cast<std::size_t>(n)] != 0;
    count += isIn ? 1 : 0;
    EXPECT_EQ(label.shape.Contains(n % 3, n / 3 % 2, n / 6), isIn) << label.name << ", voxel " << n;
  }
  EXPECT_EQ(label.voxels, count);
}

} // namespace

TEST_F(MaskFolders, AreOneLabelMapNamedAsTheFilesEvenWhereMasksOverlap)
{
  const LabelMap volume = ReadLabelVolume(m_Folder / "masks");
  ASSERT_EQ(volume.labels.size(), 2U) << "an empty mask is no label";
  EXPECT_EQ(volume.labels[0].name, "liver.left");
  EXPECT_EQ(volume.labels[1].name, "spleen");
  ExpectVoxels(volume.labels[0], kLiver);
  ExpectVoxels(volume.labels[1], kSpleen);
  EXPECT_TRUE(HasNote(volume.notes, "3 masks"));
  ReadOptions one;
  one.labels = "spleen";
  EXPECT_EQ(ReadLabelVolume(m_Folder / "masks", one).labels.size(), 1U);
  EXPECT_EQ(ScanFiles(m_Folder / "masks", {}).size(), 3U);
}

TEST_F(MaskFolders, WithLabelsOrAnotherGridAreRefused)
{
  m_Folder.Write("labels/a.nrrd", Nrrd(nrrd::Lines(), RawAll<std::uint8_t>(kLiver)));
  m_Folder.Write("labels/b.nrrd", Nrrd(nrrd::Lines(), RawAll<std::uint8_t>(nrrd::kValues)));
  const std::string message = MessageOf([&] { ReadLabelVolume(m_Folder / "labels"); });
  EXPECT_NE(message.find("b.nrrd: the values 1 and 2 in a folder of masks"), std::string::npos) << message;
  m_Folder.Write("masks/zoom.nrrd",
                 Nrrd(nrrd::With(nrrd::Lines(), "space directions", "(1,0,0) (0,1,0) (0,0,2)"), std::string(12, '\1')));
  ExpectRefused(m_Folder / "masks", { "'zoom.nrrd' has another grid than 'empty.nrrd'", "voxelcore batch" });
}

} // namespace voxelcore::testing
