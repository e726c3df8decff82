// FreeSurfer's volumes byte by byte, as mri.c reads them. What nibabel writes, mgh_test.py reads.

#include "NrrdFixtures.h"

namespace voxelcore::testing::mgh
{

namespace
{

struct MghFields
{
  int                version = 1;
  std::array<int, 3> size{ 3, 2, 2 };
  int                frames = 1;
  int                type = 0;
  int                isPlaced = 1;
};

std::string
Mgh(const MghFields & fields, const std::string & data)
{
  std::string bytes = Raw<std::int32_t>(fields.version, true);
  for (const int side : fields.size)
  {
    bytes += Raw<std::int32_t>(side, true);
  }
  bytes += Raw<std::int32_t>(fields.frames, true) + Raw<std::int32_t>(fields.type, true) + std::string(4, '\0');
  bytes += Raw<std::int16_t>(static_cast<std::int16_t>(fields.isPlaced), true);
  // Spacing, axes in RAS, and the middle.
  bytes += RawAll<float>(std::vector<double>{ 0.5, 2, 4, 1, 0, 0, 0, 1, 0, 0, 0, 1, 10, 20, 30 }, true);
  bytes.resize(284, '\0');
  return bytes + data;
}

class MghFiles : public ::testing::Test
{
protected:
  std::filesystem::path
  Write(const MghFields & fields, const std::string & data = RawAll<std::uint8_t>(nrrd::kValues)) const
  {
    return m_Folder.Write("a.mgh", Mgh(fields, data));
  }
  const TempFolder m_Folder;
};

} // namespace

TEST_F(MghFiles, OfEveryTypeAreReadPackedOrNot)
{
  auto values = nrrd::kValues;
  for (const auto & [type, data] :
       std::vector<std::pair<int, std::string>>{ { 0, RawAll<std::uint8_t>(values) },
                                                 { 1, RawAll<std::int32_t>(values, true) },
                                                 { 3, RawAll<float>(values, true) },
                                                 { 4, RawAll<std::int16_t>(values, true) },
                                                 { 10, RawAll<std::uint16_t>(values, true) } })
  {
    SCOPED_TRACE(type);
    nrrd::ExpectValues(ReadLabelVolume(Write({ .type = type }, data)));
    nrrd::ExpectValues(ReadLabelVolume(m_Folder.Write("a.mgz", Gzip(Mgh({ .type = type }, data)))));
  }
}

TEST_F(MghFiles, TheMiddleIsWhereTheHeaderSays)
{
  const LabelMap volume = ReadLabelVolume(Write({}));
  // Half of 3 x 2 x 2 voxels before (10, 20, 30) in RAS.
  ExpectNear(volume.geometry.origin, { -9.25, -18, 26 });
  ExpectNear(volume.geometry.spacing, { 0.5, 2, 4 });
  const LabelMap nowhere = ReadLabelVolume(Write({ .isPlaced = 0 }));
  EXPECT_EQ(nowhere.geometry.unit, SpatialUnit::Voxels);
  EXPECT_TRUE(HasNote(nowhere.notes, "coronal"));
  ReadOptions options;
  options.spacing = Vector3{ 1, 1, 1 };
  ExpectNear(ReadLabelVolume(Write({}), options).geometry.origin, { -8.5, -19, 29 });
}

TEST_F(MghFiles, OfSeveralFramesOneIsChosen)
{
  const auto path = Write({ .frames = 2 }, std::string(12, '\5') + RawAll<std::uint8_t>(nrrd::kValues));
  ExpectRefused(path, { "2 volumes" });
  ReadOptions options;
  options.volume = 1;
  nrrd::ExpectValues(ReadLabelVolume(path, options));
}

TEST_F(MghFiles, DamagedOnesAreRefused)
{
  ExpectRefused(Write({ .version = 2 }), { "version is not 1" });
  ExpectRefused(Write({ .type = 2 }), { "voxel type 2" });
  ExpectRefused(Write({ .type = -1 }), { "voxel type -1" });
  for (const int frames : { 0, -1 })
  {
    ExpectRefused(Write({ .frames = frames }), { " frames", "damaged" });
  }
  ReadOptions first;
  first.volume = 0;
  ExpectRefused(Write({ .frames = 3 }), { "3 frames, more than its data can hold" }, first);
  for (const std::array<int, 3> & size : { std::array{ 0, 2, 2 }, { -3, 2, 2 }, { 1 << 30, 1 << 30, 4 }, { 3, 2, 3 } })
  {
    ExpectRefused(Write({ .size = size }), {});
  }
  const std::string whole = Mgh({}, RawAll<std::uint8_t>(nrrd::kValues));
  ExpectRefused(m_Folder.Write("a.mgh", whole.substr(0, 283)), { "too short for the header" });
  ExpectRefused(m_Folder.Write("a.mgh", whole.substr(0, whole.size() - 1)), { "truncated" });
  ExpectRefused(m_Folder.Write("a.mgz", Gzip(whole).substr(0, 60)), { "truncated" });
}

} // namespace voxelcore::testing::mgh
