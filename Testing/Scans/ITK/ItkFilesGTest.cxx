// ITK's reader, our filters, our reader: one result.

#include "ItkFixtures.h"
#include "ScanBytes.h"
#include "VoxelCoreTesting/Cores.h"

#include "itkImageFileReader.h"
#include "itkImageFileWriter.h"
#include "itkLabelImageToVoxelShapeFilter.h"
#include "itkMetaImageIO.h"
#include "itkNrrdImageIO.h"

#include "voxelcore/Models/MedialModel.h"
#include "voxelcore/VoxelCore/LambdaPruning.h"

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

using ImageType = itk::Image<unsigned short, 3>;
using Filter = itk::LabelImageToVoxelShapeFilter<ImageType>;

constexpr itk::Size<3> kFileSize{ { 20, 12, 10 } };

double
TwoLabels(int x, int y, int z)
{
  return z < 2 || y < 3 ? 0 : x < 9 ? 3 : x > 11 && (x - 15) * (x - 15) + (y - 7) * (y - 7) < 20 ? 500 : 0;
}

void
ExpectSameVolume(const LabelMap & file, const itk::VoxelShapeObject & shapes)
{
  EXPECT_EQ(file.geometry.size, shapes.GetGeometry().size);
  ExpectNear(file.geometry.spacing, shapes.GetGeometry().spacing, 1e-12);
  ExpectNear(file.geometry.origin, shapes.GetGeometry().origin, 1e-12);
  for (std::size_t i = 0; i < 9; ++i)
  {
    EXPECT_NEAR(file.geometry.direction[i], shapes.GetGeometry().direction[i], 1e-12) << i;
  }
  ASSERT_EQ(file.labels.size(), shapes.GetLabels().size());
  for (std::size_t n = 0; n < file.labels.size(); ++n)
  {
    const LabelShape & a = file.labels[n];
    const LabelShape & b = shapes.GetLabels()[n];
    EXPECT_EQ(a.value, b.value);
    EXPECT_EQ(a.voxels, b.voxels);
    ASSERT_EQ(a.shape.Box().lower, b.shape.Box().lower);
    ASSERT_EQ(a.shape.Box().size, b.shape.Box().size);
    for (std::int32_t z = 0; z < a.shape.Box().size[2]; ++z)
    {
      for (std::int32_t y = 0; y < a.shape.Box().size[1]; ++y)
      {
        ASSERT_TRUE(std::ranges::equal(a.shape.Row(y, z), b.shape.Row(y, z)));
      }
    }
  }
}

} // namespace

TEST(ItkFiles, AnImageWrittenByItkIsReadAsTheFilterSeesIt)
{
  const TempFolder folder;
  const Placement  places[] = {
     {},
     { { { 5, -3, 2 } }, { 0.5, 0.75, 2 }, { -10, 20.25, 3 }, { 0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1 } },
     { { { -40, 0, 9 } }, { 0.5, 0.5, 1.25 }, { 1, 2, 3 }, { 0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, -1 } },
  };
  for (const Placement & place : places)
  {
    const auto image = MakeImage<unsigned short>(kFileSize, TwoLabels, place);
    auto       filter = Filter::New();
    filter->SetInput(image);
    filter->Update();
    for (const bool nrrd : { true, false })
    {
      auto       writer = itk::ImageFileWriter<ImageType>::New();
      const auto path = folder / (nrrd ? "a.nrrd" : "a.mha");
      writer->SetImageIO(nrrd ? itk::ImageIOBase::Pointer(itk::NrrdImageIO::New())
                              : itk::ImageIOBase::Pointer(itk::MetaImageIO::New()));
      writer->SetFileName(path.string());
      writer->SetInput(image);
      writer->Update();
      const LabelMap file = ReadLabelVolume(path);
      ASSERT_EQ(file.labels.size(), 2U);
      ExpectSameVolume(file, *filter->GetOutput());
    }
  }
}

TEST(ItkFiles, ARawFileStreamsThroughItksReader)
{
  const TempFolder folder;
  const auto       path = folder / "a.mha";
  auto             whole = Filter::New();
  whole->SetInput(MakeImage<unsigned short>(kFileSize, TwoLabels));
  whole->Update();
  WriteLabelVolume(path, whole->GetOutput()->GetGeometry(), whole->GetOutput()->GetLabels(), false);
  auto reader = itk::ImageFileReader<ImageType>::New();
  reader->SetImageIO(itk::MetaImageIO::New());
  reader->SetFileName(path.string());
  std::size_t most = 0;
  Watcher     watcher(reader);
  auto        filter = Filter::New();
  filter->SetInput(reader->GetOutput());
  filter->SetNumberOfStreamDivisions(5);
  filter->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
    most = std::max<std::size_t>(most, reader->GetOutput()->GetBufferedRegion().GetNumberOfPixels());
  });
  filter->Update();
  EXPECT_EQ(watcher.starts, 5);
  EXPECT_EQ(most, 20U * 12U * 2U);
  ExpectSameVolume(ReadLabelVolume(path), *filter->GetOutput());
}

TEST(ItkFiles, TheExampleWritesTheLibrarysBytes)
{
  const TempFolder folder;
  const auto       path = folder / "scan.nrrd";
  Placement        place;
  place.spacing = { 0.5, 0.5, 1.25 };
  place.direction = { 0, 1, 0, 1, 0, 0, 0, 0, 1 }; // left-handed
  auto filter = Filter::New();
  filter->SetInput(MakeImage<unsigned short>(kFileSize, TwoLabels, place));
  filter->Update();
  WriteLabelVolume(path, filter->GetOutput()->GetGeometry(), filter->GetOutput()->GetLabels());

  const auto run = [&](const std::string & scan, const std::string & lambda, const std::string & out) {
    const std::string command = std::string("\"") + VOXELCORE_ITK_EXAMPLE + "\" \"" + (folder / scan).string() + "\" " +
                                lambda + " \"" + (folder / out).string() + "\" 2> \"" + (folder / "err").string() +
                                "\"";
    return std::system(command.c_str());
  };
  ASSERT_EQ(run("scan.nrrd", "2vox", "itk.vtp"), 0) << ReadAll(folder / "err");

  const LabelMap scan = ReadLabelVolume(path);
  const auto     weights = ComputeSpacingWeights(scan.geometry.spacing);
  MedialModel    model;
  for (const LabelShape & label : scan.labels)
  {
    const auto pruned = PruneByLambda(ComputeVoxelCore(label.shape, weights), { 1.0 });
    model.parts.push_back(ToPhysical(pruned.front(), scan.geometry, label.value));
  }
  ASSERT_EQ(model.parts.size(), 2U);
  ASSERT_GT(model.parts[0].core.cells.FaceCount(), 0U);
  model.provenance = ReadModel(folder / "itk.vtp").provenance;
  EXPECT_NE(model.provenance, "");
  WriteModel(folder / "library.vtp", folder / "library.vtp", model, { .keepEdges = true });
  EXPECT_EQ(ReadAll(folder / "itk.vtp"), ReadAll(folder / "library.vtp"));

#ifdef VOXELCORE_PROGRAM
  // The program takes the file: the scan is left-handed, too.
  const auto program = [&](const std::string & arguments) {
    const std::string command = "cd \"" + folder.Path().string() + "\" && \"" VOXELCORE_PROGRAM "\" " + arguments;
    return std::system((command + " -q > out 2>&1").c_str());
  };
  EXPECT_EQ(program("verify scan.nrrd itk.vtp"), 0) << ReadAll(folder / "out");
  ASSERT_EQ(run("scan.nrrd", "0", "whole.vtp"), 0) << ReadAll(folder / "err");
  EXPECT_EQ(program("verify scan.nrrd whole.vtp"), 0) << ReadAll(folder / "out");
  EXPECT_EQ(program("prune whole.vtp --lambda 2vox --keep-edges -o pruned.vtp"), 0) << ReadAll(folder / "out");
  EXPECT_TRUE(SameBits(ReadModel(folder / "pruned.vtp"), ReadModel(folder / "itk.vtp")));
  EXPECT_EQ(program("skeleton whole.vtp -o skeleton.vtp"), 0) << ReadAll(folder / "out");
  if (std::system("command -v Xvfb > /dev/null") == 0)
  {
    EXPECT_EQ(program("render itk.vtp -o itk.png"), 0) << ReadAll(folder / "out");
  }
#endif

  EXPECT_NE(run("scan.nrrd", "2ells", "bad.vtp"), 0);
  EXPECT_NE(ReadAll(folder / "err").find("2ells"), std::string::npos);
  EXPECT_NE(run("none.nrrd", "2vox", "bad.vtp"), 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "bad.vtp"));
}
