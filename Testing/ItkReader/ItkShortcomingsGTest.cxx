// Formats that ITK 5.2.1 knows and that are not read through it: what it does with them, and what is done here.

#include "ForeignBytes.h"
#include "ScanBytes.h"

#include <itkBruker2dseqImageIO.h>
#include <itkImage.h>
#include <itkImageFileWriter.h>
#include <itkJPEG2000ImageIO.h>
#include <itkLSMImageIO.h>

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

} // namespace

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
