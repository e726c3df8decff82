#include "ItkShapeFixtures.h"
#include "ScanBytes.h"
#include "voxelcore/Shape/ShapeConnectivity.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include "itkOutputWindow.h"

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

/** A box of label 1 in an image that is otherwise 0. */
double
Bar(int x, int y, int z)
{
  return x >= 2 && x < 6 && y == 1 && z >= 1 && z < 3 ? 1 : 0;
}

} // namespace

TEST(ItkShapeFilter, SlabsComeOneByOneAndMakeTheSameShapes)
{
  const std::vector<std::pair<unsigned, std::size_t>> divisions{ { 0, 1 }, { 1, 1 }, { 2, 2 }, { 7, 6 }, { 500, 16 } };
  for (const auto & [asked, expected] : divisions) // 7: six slabs of 3 slices, the last of 1
  {
    SCOPED_TRACE(asked);
    const auto spy = ScatteredSpy();
    auto       filter = ByteFilter::New();
    filter->SetInput(spy->GetOutput());
    filter->SetNumberOfStreamDivisions(asked);
    filter->Update();
    ASSERT_EQ(spy->regions.size(), expected);
    itk::IndexValueType z = 0;
    for (const ImageRegion & region : spy->regions)
    {
      EXPECT_EQ(region.GetIndex(), (ImageIndex{ { 0, 0, z } }));
      EXPECT_EQ(region.GetSize(0), kShapeSize[0]);
      EXPECT_EQ(region.GetSize(1), kShapeSize[1]);
      z += static_cast<itk::IndexValueType>(region.GetSize(2));
    }
    EXPECT_EQ(z, 16);
    EXPECT_LE(spy->mostPixels, 70U * 9U * ((16 + expected - 1) / expected));
    ExpectShapes(*filter->GetOutput(), kShapeSize, Scattered, { 1, 2, 7 });
  }
}

TEST(ItkShapeFilter, AnUpstreamThatMakesAllAtOnceRunsOnce)
{
  const auto spy = ScatteredSpy();
  spy->allAtOnce = true;
  spy->placement.start = { { 3, -2, 11 } };
  auto filter = ByteFilter::New();
  filter->SetInput(spy->GetOutput());
  filter->SetNumberOfStreamDivisions(7);
  filter->Update();
  EXPECT_EQ(spy->regions.size(), 1U);
  ExpectShapes(*filter->GetOutput(), kShapeSize, Scattered, { 1, 2, 7 });
}

TEST(ItkShapeFilter, ThinImagesAreDividedAlongTheAxisTheyHave)
{
  const std::vector<std::pair<itk::Size<3>, std::size_t>> thin{ { { { 30, 12, 1 } }, 4 },
                                                                { { { 30, 1, 1 } }, 1 },
                                                                { { { 30, 1, 12 } }, 4 },
                                                                { { { 1, 1, 12 } }, 4 } };
  for (const auto & [size, expected] : thin)
  {
    SCOPED_TRACE(size);
    const auto spy = ScatteredSpy();
    spy->size = size;
    spy->value = [](int x, int y, int z) { return (x + y + z) % 3 == 0 ? 5.0 : 0.0; };
    auto filter = ByteFilter::New();
    filter->SetInput(spy->GetOutput());
    filter->SetNumberOfStreamDivisions(4);
    filter->Update();
    EXPECT_EQ(spy->regions.size(), expected);
    ExpectShapes(*filter->GetOutput(), size, spy->value, { 5 });
  }
}

template <typename TPixel>
class ItkShapeFilterOfPixel : public ::testing::Test
{};
using PixelTypes = ::testing::Types<char,
                                    signed char,
                                    unsigned char,
                                    short,
                                    unsigned short,
                                    int,
                                    unsigned int,
                                    long,
                                    unsigned long,
                                    long long,
                                    unsigned long long,
                                    float,
                                    double>;
TYPED_TEST_SUITE(ItkShapeFilterOfPixel, PixelTypes);

TYPED_TEST(ItkShapeFilterOfPixel, EveryTypeHasTheSameShapesAndItsLargestLabel)
{
  const auto large = static_cast<std::int64_t>(
    std::min<double>(static_cast<double>(std::numeric_limits<TypeParam>::max()), 9007199254740992.0));
  const itk::Size<3> size{ { 11, 5, 4 } };
  const auto         value = [large](int x, int y, int z) {
    return x == 3 && y == 2 && z == 1 ? static_cast<double>(large) : Scattered(x, y, z);
  };
  auto filter = itk::LabelImageToVoxelShapeFilter<itk::Image<TypeParam, 3>>::New();
  filter->SetInput(MakeImage<TypeParam>(size, value));
  filter->Update();
  const auto & labels = filter->GetOutput()->GetLabels();
  ASSERT_EQ(labels.size(), 4U);
  EXPECT_EQ(labels[3].value, large);
  EXPECT_EQ(labels[3].voxels, 1U);
  EXPECT_TRUE(labels[3].shape.Contains(3, 2, 1));
  filter->SetLabels("1,7");
  filter->Update();
  ExpectShapes(*filter->GetOutput(), size, value, { 1, 7 });
  if constexpr (std::is_signed_v<TypeParam>)
  {
    filter->SetInput(
      MakeImage<TypeParam>(size, [](int x, int y, int z) { return x == 3 && y == 2 && z == 1 ? -5 : 1; }));
    filter->SetLabels("all");
    EXPECT_EQ(ThrownBy([&] { filter->Update(); }),
              "the input image: value -5 at voxel (3,2,1) is negative; labels are whole numbers from 0 up; name those "
              "to take, such as --labels 1; for a grey scan give --threshold LO:HI");
  }
}

TEST(ItkShapeFilter, GeometryIsThatOfTheFirstVoxelWhereverItsIndex)
{
  const double    c = 0.8;
  const double    s = 0.6;
  const Placement places[] = {
    {},
    { { { 5, -3, 2 } }, { 0.5, 0.75, 2 }, { -10, 20.25, 3 }, { c, -s, 0, s, c, 0, 0, 0, 1 } },
    { { { -100, 7, 0 } }, { 2, 1, 1 }, { 1, 2, 3 }, { c, -s, 0, s, c, 0, 0, 0, -1 } }, // left-handed
    { { { 0, 0, -1 } }, { 1, 1, 3 }, { 0, 0, 0 }, { 0, 0, -1, 0, 1, 0, -1, 0, 0 } },
  };
  for (const Placement & place : places)
  {
    const auto image = MakeImage<std::uint8_t>({ { 8, 4, 5 } }, Bar, place);
    auto       filter = ByteFilter::New();
    filter->SetInput(image);
    filter->SetNumberOfStreamDivisions(3);
    filter->Update();
    const itk::VoxelShapeObject & shapes = *filter->GetOutput();
    EXPECT_EQ(shapes.GetStartIndex(), place.start);
    EXPECT_EQ(shapes.GetGeometry().size, (std::array<std::int64_t, 3>{ 8, 4, 5 }));
    EXPECT_EQ(shapes.GetGeometry().spacing, place.spacing);
    EXPECT_EQ(IsLeftHanded(shapes.GetGeometry()),
              image->GetDirection().GetVnlMatrix().get_row(2)[2] < 0 || IsLeftHanded({ {}, {}, {}, place.direction }));
    const VoxelBox & box = shapes.GetLabel(1).shape.Box();
    EXPECT_EQ(box.lower, (std::array<std::int32_t, 3>{ 2, 1, 1 }));
    EXPECT_EQ(box.size, (std::array<std::int32_t, 3>{ 4, 1, 2 }));
    // ITK's own word on where each voxel's centre is: lattice place = voxel + 1/2.
    for (const ImageIndex & voxel : { ImageIndex{ { 0, 0, 0 } }, ImageIndex{ { 2, 1, 1 } }, ImageIndex{ { 7, 3, 4 } } })
    {
      ImageIndex           index;
      voxelcore::Vector3   lattice{};
      ByteImage::PointType expected;
      for (unsigned axis = 0; axis < 3; ++axis)
      {
        index[axis] = voxel[axis] + place.start[axis];
        lattice[axis] = static_cast<double>(voxel[axis]) + 0.5;
      }
      image->TransformIndexToPhysicalPoint(index, expected);
      EXPECT_LT(expected.EuclideanDistanceTo(shapes.TransformLatticeToPhysicalPoint(lattice)), 1e-12) << voxel;
    }
  }
}

TEST(ItkShapeFilter, ParametersChooseTheShapes)
{
  auto filter = ByteFilter::New();
  filter->SetInput(MakeImage<std::uint8_t>(kShapeSize, Scattered));
  filter->SetLabel(7);
  filter->Update();
  ExpectShapes(*filter->GetOutput(), kShapeSize, Scattered, { 7 });
  filter->SetLabels("1,2");
  filter->BinaryOn();
  filter->Update();
  ExpectShapes(*filter->GetOutput(),
               kShapeSize,
               [](int x, int y, int z) {
                 const double value = Scattered(x, y, z);
                 return value == 1 || value == 2 ? 1.0 : 0.0;
               },
               { 1 });
  filter->SetLabels("all");
  filter->BinaryOff();
  filter->SetThreshold(2, 250);
  filter->Update();
  ExpectShapes(*filter->GetOutput(),
               kShapeSize,
               [](int x, int y, int z) { return Scattered(x, y, z) >= 2 ? 1.0 : 0.0; },
               { 1 });
  filter->RemoveThreshold();
  filter->Update();
  ExpectShapes(*filter->GetOutput(), kShapeSize, Scattered, { 1, 2, 7 });
}

TEST(ItkShapeFilter, RefusesInOneLineWhatTheReaderRefuses)
{
  const auto refuse = [](const itk::Image<float, 3>::Pointer & image, auto prepare) {
    auto filter = itk::LabelImageToVoxelShapeFilter<itk::Image<float, 3>>::New();
    filter->SetInput(image);
    prepare(*filter);
    return ThrownBy([&] { filter->Update(); });
  };
  const auto bar = MakeImage<float>({ { 8, 4, 5 } }, Bar);
  const auto nothing = [](auto &) {};
  EXPECT_EQ(refuse(MakeImage<float>({ { 8, 4, 5 } }, [](int x, int, int) { return 0.5 * x; }), nothing),
            "the input image: value 0.5 at voxel (1,0,0) is a fraction; labels are whole numbers from 0 up; for a mask "
            "of 0 and 1 give --threshold 0.5:inf, for a grey scan give --threshold LO:HI");
  EXPECT_EQ(refuse(MakeImage<float>({ { 8, 4, 5 } }, [](int, int, int) { return 0; }), nothing),
            "the input image: nothing but background: every voxel is 0; name a scan with labels");
  EXPECT_EQ(refuse(bar, [](auto & filter) { filter.SetLabel(3); }), "the input image: there is no label '3'; it has 1");
  EXPECT_NE(refuse(bar, [](auto & filter) { filter.SetLabels("1,,2"); }).find("--labels '1,,2'"), std::string::npos);
  EXPECT_NE(refuse(bar, [](auto & filter) { filter.SetLabel(0); }).find("0 is background"), std::string::npos);
  EXPECT_NE(refuse(bar, [](auto & filter) { filter.SetThreshold(2, 1); }).find("put the lower bound first"),
            std::string::npos);
  EXPECT_NE(refuse(bar,
                   [](auto & filter) {
                     filter.SetThreshold(1, 2);
                     filter.SetLabel(1);
                   })
              .find("--threshold makes one shape"),
            std::string::npos);
  EXPECT_NE(refuse(bar, [](auto & filter) { filter.SetThreshold(5, 6); }).find("no voxel lies within the threshold"),
            std::string::npos);
}

TEST(ItkShapeFilter, RefusesADirectionThatIsNotOrthonormalBeforeAnyVoxelIsMade)
{
  for (const auto & [direction, words] :
       { std::pair(std::array<double, 9>{ 1, 0.1, 0, 0, 1, 0, 0, 0, 1 }, "its axes are skewed, 5.7"),
         std::pair(std::array<double, 9>{ 1, 0, 0, 0, 1.5, 0, 0, 0, 1 }, "axis j of its direction has length 1.5") })
  {
    const auto spy = ScatteredSpy();
    spy->placement.direction = direction;
    auto filter = ByteFilter::New();
    filter->SetInput(spy->GetOutput());
    const std::string message = ThrownBy([&] { filter->Update(); });
    EXPECT_EQ(message.find("the input image: "), 0U);
    EXPECT_NE(message.find(words), std::string::npos) << message;
    EXPECT_NE(message.find("--orthonormalize"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
    EXPECT_TRUE(spy->regions.empty());
    // As it says.
    filter->OrthonormalizeOn();
    filter->Update();
    EXPECT_LT(OrthonormalityDeviationDegrees(filter->GetOutput()->GetGeometry()), 1e-10);
    ExpectShapes(*filter->GetOutput(), kShapeSize, Scattered, { 1, 2, 7 });
  }
}

TEST(ItkShapeFilter, NoFileBesideNamesTheLabels)
{
  const TempFolder folder;
  for (const char * name : { "the input image.txt", ".txt" })
  {
    folder.Write(name, "1 Nonsense\n");
  }
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.Path());
  auto filter = ByteFilter::New();
  filter->SetInput(MakeImage<std::uint8_t>({ { 8, 4, 5 } }, Bar));
  filter->Update();
  std::filesystem::current_path(before);
  EXPECT_EQ(filter->GetOutput()->GetLabel(1).name, "label-1");
}

TEST(ItkShapeFilter, PrintsItsParameters)
{
  auto filter = ByteFilter::New();
  filter->SetLabels("1,2");
  EXPECT_NE(Printed(*filter).find("Threshold: none"), std::string::npos);
  filter->SetThreshold(-0.5, 8);
  filter->SetNumberOfStreamDivisions(3);
  const std::string text = Printed(*filter);
  for (const char * words : { "LabelImageToVoxelShapeFilter",
                              "Labels: 1,2",
                              "Binary: Off",
                              "Threshold: -0.5 to 8",
                              "Connectivity: 6",
                              "Orthonormalize: Off",
                              "NumberOfStreamDivisions: 3" })
  {
    EXPECT_NE(text.find(words), std::string::npos) << words;
  }
}

TEST(ItkShapeFilter, JoinsPiecesThatTouchWhenAskedAndSaysElseThatTheyTouch)
{
  class Heard : public itk::OutputWindow
  {
  public:
    using Self = Heard;
    using Pointer = itk::SmartPointer<Self>;
    itkFactorylessNewMacro(Heard);
    void
    DisplayWarningText(const char * text) override
    {
      said += text;
    }
    std::string said;
  };
  const auto heard = Heard::New();
  const auto before = itk::OutputWindow::GetInstance();
  itk::OutputWindow::SetInstance(heard);
  const auto spy = Spy::New();
  spy->size = kShapeSize;
  spy->value = [](int x, int y, int z) { // two blocks of 3 x 3 x 3 that share a corner
    return (x < 3 && y < 3 && z < 3) || (x >= 3 && x < 6 && y >= 3 && y < 6 && z >= 3 && z < 6) ? 4.0 : 0.0;
  };
  auto filter = ByteFilter::New();
  filter->SetInput(spy->GetOutput());
  const auto label = [&](const char * connectivity) {
    filter->SetConnectivity(connectivity);
    filter->Update();
    return filter->GetOutput()->GetLabel(4);
  };
  EXPECT_EQ(ComputeShapeTopology(label("6").shape).betti[0], 2);
  EXPECT_NE(heard->said.find("label 4 (label-4): 1 piece touches others over edges or corners alone (50 % of the "
                             "voxels); join them with --connectivity joined"),
            std::string::npos)
    << heard->said;
  heard->said.clear();
  for (const char * connectivity : { "joined", "26" })
  {
    const LabelShape joined = label(connectivity);
    EXPECT_EQ(ComputeShapeTopology(joined.shape), (TopologyNumbers{ 1, { 1, 0, 0 } }));
    EXPECT_EQ(joined.voxels, joined.shape.CountVoxels());
    EXPECT_EQ(ConnectivityName(joined.connectivity), connectivity);
  }
  EXPECT_EQ(heard->said, "");
  itk::OutputWindow::SetInstance(before);
  EXPECT_NE(ThrownBy([&] { label("18"); }).find("--connectivity: '18' is none; give 6, 26 or joined"),
            std::string::npos);
}

TEST(ItkShapeFilter, RefusesASourceThatBringsLessThanItWasAskedFor)
{
  const auto spy = ScatteredSpy();
  spy->oneSliceLess = true;
  auto filter = ByteFilter::New();
  filter->SetInput(spy->GetOutput());
  filter->SetNumberOfStreamDivisions(2);
  EXPECT_NE(ThrownBy([&] { filter->Update(); }).find("did not bring the region"), std::string::npos);
  EXPECT_TRUE(filter->GetOutput()->GetLabels().empty());
}

TEST(ItkShapeFilter, RefusesAnImageThatWasNotAllocated)
{
  using ImageType = ByteFilter::InputImageType;
  const auto image = ImageType::New();
  image->SetRegions(ImageType::SizeType{ { 4, 5, 6 } });
  auto filter = ByteFilter::New();
  filter->SetInput(image);
  EXPECT_NE(ThrownBy([&] { filter->Update(); }).find("the input has no pixels"), std::string::npos);
  EXPECT_TRUE(filter->GetOutput()->GetLabels().empty());
  // Nor one whose memory is for another region.
  image->Allocate();
  image->FillBuffer(1);
  image->SetRegions(ImageType::SizeType{ { 40, 50, 60 } });
  EXPECT_NE(ThrownBy([&] { filter->Update(); }).find("the input has no pixels"), std::string::npos);
  image->SetRegions(ImageType::SizeType{ { 4, 5, 6 } });
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetLabels().size(), 1U);
}
