// Why a format is not read through ITK 5.2.1, one test for each that VoxelCore reads itself, and for those that ITK
// knows and VoxelCore refuses: what ITK does with a file, and what is done here.

#include "ForeignBytes.h"
#include "NrrdFixtures.h"
#include "ScanBytes.h"

#include <itkBruker2dseqImageIO.h>
#include <itkGiplImageIO.h>
#include <itkImage.h>
#include <itkImageFileWriter.h>
#include <itkJPEG2000ImageIO.h>
#include <itkLSMImageIO.h>
#include <itkMINCImageIO.h>
#include <itkMRCImageIO.h>
#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>
#include <itkTIFFImageIO.h>
#include <itkVTKImageIO.h>

#include <cmath>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

/** All voxels as ITK gives them, and the voxel size. */
template <typename TValue>
std::vector<TValue>
ReadWith(itk::ImageIOBase & io, const std::filesystem::path & path)
{
  io.SetFileName(path.string());
  io.ReadImageInformation();
  itk::ImageIORegion  region(io.GetNumberOfDimensions());
  std::vector<TValue> values(1);
  for (unsigned int axis = 0; axis < io.GetNumberOfDimensions(); ++axis)
  {
    region.SetIndex(axis, 0);
    region.SetSize(axis, io.GetDimensions(axis));
    values.resize(values.size() * io.GetDimensions(axis));
  }
  if (io.GetComponentSize() * io.GetNumberOfComponents() != sizeof(TValue))
  {
    return {};
  }
  io.SetIORegion(region);
  io.Read(values.data());
  return values;
}

/** Whether ITK reads the LSM file of ForeignBytes.h as it is: by a process of its own, for it may crash. */
bool
ItkReadsLsm(const std::filesystem::path & path)
{
  const pid_t child = fork();
  if (child == 0)
  {
    dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
    const auto io = itk::LSMImageIO::New();
    const auto values = ReadWith<unsigned char>(*io, path);
    const auto right = ForeignValues();
    const bool same = std::equal(values.begin(), values.end(), right.begin(), right.end());
    _exit(same && std::abs(io->GetSpacing(0) - 2e-4) < 1e-9 ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/** 3 x 2 x 2 bytes. */
std::string
SmallBytes()
{
  return RawAll<std::uint8_t>(nrrd::kValues);
}

/** Whether one of ITK's readers takes a file, or a folder. */
bool
IsKnownToItk(const std::filesystem::path & path)
{
  const std::vector<itk::ImageIOBase::Pointer> readers{
    itk::Bruker2dseqImageIO::New().GetPointer(), itk::GiplImageIO::New().GetPointer(),
    itk::JPEG2000ImageIO::New().GetPointer(),    itk::LSMImageIO::New().GetPointer(),
    itk::MINCImageIO::New().GetPointer(),        itk::MRCImageIO::New().GetPointer(),
    itk::MetaImageIO::New().GetPointer(),        itk::NiftiImageIO::New().GetPointer(),
    itk::NrrdImageIO::New().GetPointer(),        itk::TIFFImageIO::New().GetPointer(),
    itk::VTKImageIO::New().GetPointer()
  };
  return std::ranges::any_of(readers, [&](const auto & reader) { return reader->CanReadFile(path.c_str()); });
}

} // namespace

TEST(ItkShortcomings, NrrdIsReadWholeAndItsUnitIsDropped)
{
  const TempFolder folder;
  auto             lines = nrrd::With(nrrd::Lines(), "space units", "\"um\" \"um\" \"um\"");
  lines = nrrd::With(lines, "space directions", "(5,0,0) (0,5,0) (0,0,5)");
  const auto path = folder.Write("a.nrrd", Nrrd(lines, SmallBytes()));
  const auto io = itk::NrrdImageIO::New();
  EXPECT_EQ(ReadWith<unsigned char>(*io, path).size(), 12U);
  EXPECT_EQ(io->GetSpacing(0), 5) << "micrometres, as millimetres";
  EXPECT_FALSE(io->CanStreamRead());
  ExpectNear(ReadLabelVolume(path).geometry.spacing, { 5e-3, 5e-3, 5e-3 });
}

TEST(ItkShortcomings, NiftiWithoutASpacingHasOne)
{
  const TempFolder folder;
  NiftiFields      fields;
  fields.dim = { 3, 2, 2 };
  fields.datatype = 2;
  fields.bitpix = 8;
  fields.pixdim = { 1, 0.5, 0, 2 };
  const auto path = folder.Write("a.nii", Nifti(fields, SmallBytes()));
  const auto io = itk::NiftiImageIO::New();
  EXPECT_EQ(ReadWith<unsigned char>(*io, path).size(), 12U);
  EXPECT_EQ(io->GetSpacing(1), 1);
  EXPECT_FALSE(io->CanStreamRead());
  ExpectRefused(path, { "spacing along axis j is 0" });
}

TEST(ItkShortcomings, MetaImageWithoutASpacingIsInMillimetresAndPackedIsReadWhole)
{
  const TempFolder               folder;
  const std::vector<std::string> lines{ "ObjectType = Image",
                                        "NDims = 3",
                                        "DimSize = 3 2 2",
                                        "ElementType = MET_UCHAR" };
  const auto                     path = folder.Write("a.mha", Meta(lines, SmallBytes()));
  const auto                     io = itk::MetaImageIO::New();
  EXPECT_EQ(ReadWith<unsigned char>(*io, path).size(), 12U);
  EXPECT_EQ(io->GetSpacing(0), 1);
  const LabelMap volume = ReadLabelVolume(path);
  EXPECT_EQ(volume.geometry.unit, SpatialUnit::Voxels);
  EXPECT_EQ(volume.warnings.size(), 1U);
  auto packed = lines;
  packed.emplace_back("CompressedData = True");
  const auto packedIO = itk::MetaImageIO::New();
  packedIO->SetFileName(folder.Write("b.mha", Meta(packed, Zlib(SmallBytes()))).string());
  packedIO->ReadImageInformation();
  EXPECT_FALSE(packedIO->CanStreamRead());
}

TEST(ItkShortcomings, TiffHasNoDistanceBetweenSlicesAndTilesAreColours)
{
  const TempFolder      folder;
  std::vector<TiffPage> pages(2);
  for (TiffPage & page : pages)
  {
    page.width = 3;
    page.height = 2;
    page.tileWidth = 16;
    page.tileHeight = 16;
    page.parts = { std::string(256, '\1') };
  }
  pages[0].description = "ImageJ=1.53t\nimages=2\nslices=2\nunit=mm\nspacing=2.5\n";
  const auto path = folder.Write("a.tif", Tiff(pages));
  const auto io = itk::TIFFImageIO::New();
  io->SetFileName(path.string());
  io->ReadImageInformation();
  EXPECT_EQ(io->GetSpacing(2), 1);
  EXPECT_EQ(io->GetNumberOfComponents(), 4U) << "of one grey value";
  const LabelMap volume = ReadLabelVolume(path);
  ExpectNear(volume.geometry.spacing, { 1, 1, 2.5 });
  EXPECT_EQ(volume.labels.at(0).voxels, 12U);
}

TEST(ItkShortcomings, FreeSurferZarrBareVoxelsAndFoldersOfSlicesAreUnknown)
{
  const TempFolder folder;
  folder.Write("slices/1.tif", SmallBytes());
  folder.Write("a.zarr/.zarray", "{}");
  for (const char * name : { "a.mgh", "a.mgz", "a.raw", "a.dat" })
  {
    folder.Write(name, SmallBytes());
  }
  for (const char * name : { "a.mgh", "a.mgz", "a.raw", "a.dat", "a.zarr", "slices" })
  {
    EXPECT_FALSE(IsKnownToItk(folder / name)) << name;
  }
  EXPECT_TRUE(IsKnownToItk(folder.Write("a.nii", Nifti({}, std::string(64, '\0'))))) << "what it knows";
}

TEST(ItkShortcomings, LsmIsReadWithThumbnailsForSlicesAndMetresForMillimetres)
{
  const TempFolder folder;
  const auto       path = folder.Write("a.lsm", LsmBytes());
  EXPECT_FALSE(ItkReadsLsm(path)) << "this ITK can be asked";
  const auto     values = ForeignValues();
  const LabelMap volume = ReadLabelVolume(path);
  EXPECT_EQ(AllValues(volume), std::vector<std::int64_t>(values.begin(), values.end()));
  ExpectNear(volume.geometry.spacing, { 2e-4, 3e-4, 5e-4 });
}

TEST(ItkShortcomings, Jpeg2000IsOnePicture)
{
  using Picture = itk::Image<unsigned char, 2>;
  const TempFolder folder;
  auto             picture = Picture::New();
  picture->SetRegions(Picture::SizeType{ { 64, 48 } });
  picture->Allocate(true);
  auto writer = itk::ImageFileWriter<Picture>::New();
  writer->SetImageIO(itk::JPEG2000ImageIO::New());
  writer->SetFileName((folder / "a.jp2").string());
  writer->SetInput(picture);
  writer->Update();
  const auto io = itk::JPEG2000ImageIO::New();
  EXPECT_EQ(ReadWith<unsigned char>(*io, folder / "a.jp2").size(), 64U * 48U);
  EXPECT_EQ(io->GetNumberOfDimensions(), 2U);
  ExpectRefused(folder / "a.jp2", { "JPEG 2000 picture", "opj_decompress", "lossless" });
  const std::string bytes = ReadAll(folder / "a.jp2");
  ExpectRefused(folder.Write("b.any", bytes), { "JPEG 2000 picture" });
  ExpectRefused(folder.Write("c.j2k", bytes.substr(bytes.find("\xFF\x4F\xFF\x51"))), { "JPEG 2000 picture" });
}

TEST(ItkShortcomings, WholeNumbersOfBrukerAreRounded)
{
  const TempFolder folder;
  folder.Write("pdata/1/visu_pars",
               "##TITLE=Parameter List\n##JCAMPDX=4.24\n##DATATYPE=Parameter Values\n##ORIGIN=Bruker\n##OWNER=nmr\n"
               "$$ a date\n$$ a place\n$$ a process\n"
               "##$VisuCoreFrameCount=1\n##$VisuCoreDim=3\n##$VisuCoreSize=( 3 )\n2 2 2\n"
               "##$VisuCoreExtent=( 3 )\n1 1 1\n##$VisuCoreUnits=( 3, 65 )\n<mm> <mm> <mm>\n"
               "##$VisuCoreOrientation=( 1, 9 )\n1 0 0 0 1 0 0 0 1\n##$VisuCorePosition=( 1, 3 )\n0 0 0\n"
               "##$VisuCoreDataOffs=( 1 )\n0\n##$VisuCoreDataSlope=( 1 )\n1\n"
               "##$VisuCoreWordType=_32BIT_SGN_INT\n##$VisuCoreByteOrder=littleEndian\n##END=\n$$ File finished\n");
  const auto path = folder.Write("pdata/1/2dseq", RawAll<std::int32_t>(std::vector<int>(8, 16777217)));
  const auto io = itk::Bruker2dseqImageIO::New();
  EXPECT_EQ(ReadWith<float>(*io, path), std::vector<float>(8, 16777216.0F)) << "this ITK can be asked";
  ExpectRefused(path, { "2dseq", "brkraw" });
  ExpectRefused(folder / "pdata/1", { "2dseq", "brkraw" });
}
