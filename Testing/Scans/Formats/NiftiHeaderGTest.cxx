// Headers of NIfTI: halves of a pair, axes behind the third, units and scalings, and headers without sense.

#include "NrrdFixtures.h"
#include "voxelcore/Formats/FormatOpeners.h"
#include "voxelcore/Formats/VolumeWriters.h"

#include <cmath>

namespace voxelcore::testing::nifti
{

namespace
{

const std::string kVoxels = RawAll<std::uint8_t>(nrrd::kValues);

class NiftiHeaders : public ::testing::Test
{
protected:
  std::filesystem::path
  Write(const NiftiFields & fields, const std::string & data = kVoxels) const
  {
    return m_Folder.Write("a.nii", Nifti(fields, data));
  }
  const TempFolder m_Folder;
};

} // namespace

TEST_F(NiftiHeaders, OfAnotherKindAreRefused)
{
  std::string bytes = Nifti({ .dim = { 3, 2, 2 } }, kVoxels);
  bytes.replace(344, 4, std::string(4, '\0'));
  ExpectRefused(m_Folder.Write("a.nii", bytes), { "ANALYZE 7.5" });
  bytes = Nifti({ .version = 2, .dim = { 3, 2, 2 } }, kVoxels);
  ExpectRefused(m_Folder.Write("a.nii", bytes.substr(0, 400)), { "no NIfTI file" });
  bytes[4] = 'm';
  ExpectRefused(m_Folder.Write("a.nii", bytes), { "its mark is missing" });
  bytes[0] = 7;
  ExpectRefused(m_Folder.Write("a.nii", bytes), { "no NIfTI file" });
  ExpectRefused(Write({ .dim = {} }), { "gives 0 dimensions" });
  bytes = Nifti({ .dim = { 3, 2, 2 } }, kVoxels);
  bytes[40] = 8;
  ExpectRefused(m_Folder.Write("a.nii", bytes), { "gives 8 dimensions" });
  ExpectRefused(Write({ .dim = { 3, 2, 2 }, .datatype = 1792 }), { "complex" });
}

TEST_F(NiftiHeaders, EitherHalfOfAPairNamesTheOther)
{
  using Paths = std::vector<std::filesystem::path>;
  NiftiFields fields{ .pair = true, .dim = { 3, 2, 2 } };
  for (const auto & [header, image] : std::vector<std::pair<std::string, std::string>>{ { "a.hdr", "a.img" },
                                                                                        { "B.HDR", "B.IMG" },
                                                                                        { "c.hdr.gz", "c.img.gz" } })
  {
    SCOPED_TRACE(header);
    const bool packed = header.ends_with(".gz");
    m_Folder.Write(header, packed ? Gzip(NiftiHeaderBytes(fields)) : NiftiHeaderBytes(fields));
    m_Folder.Write(image, packed ? Gzip(kVoxels) : kVoxels);
    EXPECT_EQ(NiftiPartner(m_Folder / header), Paths{ m_Folder / image });
    EXPECT_EQ(NiftiPartner(m_Folder / image), Paths{ m_Folder / header });
    nrrd::ExpectValues(ReadLabelVolume(m_Folder / image));
  }
  EXPECT_TRUE(NiftiPartner(Write({ .dim = { 3, 2, 2 } })).empty());
  ExpectRefused(m_Folder.Write("d.img", kVoxels), { "d.hdr is not there" });
}

TEST_F(NiftiHeaders, AxesBehindTheFourthHoldTheValuesOfAVoxel)
{
  // Two time points of two values each, the values slowest.
  const std::string five(12, '\5');
  const auto        path = Write({ .dim = { 3, 2, 2, 2, 2 } }, five + five + five + kVoxels);
  ReadOptions       options;
  options.volume = 1;
  ExpectRefused(path, { "vectors on the fifth axis (2 values" }, options);
  options.component = 1;
  nrrd::ExpectValues(ReadLabelVolume(path, options));
  options.component = 0;
  EXPECT_EQ(ReadLabelVolume(path, options).labels.size(), 1U);
  // A side of 0 behind the third is one of 1.
  nrrd::ExpectValues(ReadLabelVolume(Write({ .dim = { 3, 2, 2, 0, 0 } })));
}

TEST_F(NiftiHeaders, AColourIsChosenAndVectorsOfThemAreRefused)
{
  std::string rgb;
  for (const char value : kVoxels)
  {
    rgb += { '\5', value, '\6' };
  }
  ReadOptions options;
  options.component = 1;
  nrrd::ExpectValues(ReadLabelVolume(Write({ .dim = { 3, 2, 2 }, .datatype = 128, .bitpix = 24 }, rgb), options));
  ExpectRefused(Write({ .dim = { 3, 2, 2, 1, 2 }, .datatype = 128, .bitpix = 24 }, rgb + rgb),
                { "vectors of colours" },
                options);
}

TEST_F(NiftiHeaders, DataThatDoNotHoldAllVolumesAreRefused)
{
  ReadOptions first;
  first.volume = 0;
  ExpectRefused(Write({ .dim = { 3, 2, 2, 2 } }), { "12 in each of 2 volumes are needed" }, first);
  const auto packed = m_Folder.Write("a.nii.gz", Gzip(Nifti({ .version = 2, .dim = { 3, 2, 2, 1 << 29 } }, kVoxels)));
  ExpectRefused(packed, { "536870912 volumes" }, first);
}

TEST_F(NiftiHeaders, WithoutAUnitMillimetresAreTakenAndTold)
{
  const LabelMap volume = ReadLabelVolume(Write({ .dim = { 3, 2, 2 }, .units = 0 }));
  EXPECT_TRUE(HasNote(volume.notes, "states no unit of length"));
  EXPECT_EQ(volume.geometry.unit, SpatialUnit::Millimetres);
}

TEST_F(NiftiHeaders, AScalingThatIsNoNumberIsNone)
{
  for (const auto & [slope, intercept] : { std::pair(std::nan(""), 0.0),
                                           std::pair(1.0, std::nan("")),
                                           std::pair(static_cast<double>(INFINITY), 1.0),
                                           std::pair(0.0, 5.0) })
  {
    const LabelMap volume = ReadLabelVolume(Write({ .dim = { 3, 2, 2 }, .slope = slope, .intercept = intercept }));
    nrrd::ExpectValues(volume);
    EXPECT_FALSE(HasNote(volume.notes, "scaled"));
  }
}

TEST_F(NiftiHeaders, ASformWhoseAxesFallTogetherIsRefused)
{
  ExpectRefused(Write({ .dim = { 3, 2, 2 }, .sformCode = 1, .srow = { 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0 } }), {});
  // With a qform beside it, that is taken.
  const LabelMap volume = ReadLabelVolume(
    Write({ .dim = { 3, 2, 2 }, .qformCode = 1, .sformCode = 1, .srow = { 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0 } }));
  EXPECT_TRUE(HasNote(volume.notes, "the sform is skewed (90 degrees), the qform is taken"));
}

TEST_F(NiftiHeaders, LengthsInVoxelsAreSaidInTheDescription)
{
  VolumeToWrite volume;
  volume.geometry.size = { 3, 2, 2 };
  volume.geometry.unit = SpatialUnit::Voxels;
  const auto bytes = std::as_bytes(std::span(kVoxels));
  volume.slice = [&](std::int64_t k) { return bytes.subspan(static_cast<std::size_t>(6 * k), 6); };
  WriteNifti(m_Folder / "a.nii", volume);
  EXPECT_EQ(ReadLabelVolume(m_Folder / "a.nii").geometry.unit, SpatialUnit::Voxels);
  ReadOptions given;
  given.spacing = Vector3{ 1, 2, 3 };
  EXPECT_EQ(ReadLabelVolume(m_Folder / "a.nii", given).geometry.unit, SpatialUnit::Millimetres);
}

} // namespace voxelcore::testing::nifti
