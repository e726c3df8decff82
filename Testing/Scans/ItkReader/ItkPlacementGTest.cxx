// Where ITK itself, and so 3D Slicer, puts the voxels: our own reading of headers must agree wherever ITK is right.

#include "ScanBytes.h"

#include <itkImageIOBase.h>
#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <cmath>
#include <iostream>
#include <random>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

template <typename TImageIO>
ImageGeometry
ItkGeometry(const std::filesystem::path & path)
{
  const auto io = TImageIO::New();
  io->SetFileName(path.string());
  io->ReadImageInformation();
  ImageGeometry geometry;
  for (unsigned a = 0; a < 3; ++a)
  {
    geometry.size[a] = static_cast<std::int64_t>(io->GetDimensions(a));
    geometry.spacing[a] = io->GetSpacing(a);
    geometry.origin[a] = io->GetOrigin(a);
    for (unsigned c = 0; c < 3; ++c)
    {
      geometry.direction[3 * c + a] = io->GetDirection(a)[c];
    }
  }
  return geometry;
}

void
ExpectSame(const ImageGeometry & ours, const ImageGeometry & itk, double tolerance)
{
  EXPECT_EQ(ours.size, itk.size);
  ExpectNear(ours.spacing, itk.spacing, tolerance);
  ExpectNear(ours.origin, itk.origin, tolerance * 100);
  for (std::size_t i = 0; i < 9; ++i)
  {
    EXPECT_NEAR(ours.direction[i], itk.direction[i], tolerance) << i;
  }
}

} // namespace

TEST(ItkPlacement, NiftiFormsAtRandomAreChosenAndPlacedAsItkDoes)
{
  const TempFolder folder;
  const unsigned   seed = std::random_device()();
  std::cout << "seed " << seed << "\n";
  ::testing::Test::RecordProperty("seed", std::to_string(seed));
  std::mt19937                           random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  itk::Object::SetGlobalWarningDisplay(false);
  int skewed = 0;
  for (int round = 0; round < 400; ++round)
  {
    NiftiFields fields;
    fields.dim = { 3, 2, 2 };
    fields.version = 1;
    fields.qformCode = static_cast<int>(random() % 3);
    fields.sformCode = static_cast<int>(random() % 4);
    fields.pixdim = { random() % 2 == 0 ? 1.0 : -1.0, 1 + std::abs(unit(random)), 2, 0.5 + std::abs(unit(random)) };
    fields.qoffset = { 100 * unit(random), 100 * unit(random), 100 * unit(random) };
    // Two random turns: one as a quaternion, one (sometimes the same) as a matrix.
    const auto turn = [&]() {
      std::array<double, 4> q{ unit(random), unit(random), unit(random), unit(random) };
      const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]) * (q[0] < 0 ? -1 : 1);
      for (double & value : q)
      {
        value /= length;
      }
      return q;
    };
    const auto q = turn();
    fields.quaternion = { q[1], q[2], q[3] };
    const bool                  same = random() % 3 == 0;
    const std::array<double, 4> s = same ? q : turn();
    const double                w = s[0];
    const double                x = s[1];
    const double                y = s[2];
    const double                z = s[3];
    const std::array<double, 9> m{ 1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
                                   2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                                   2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y) };
    const bool                  skew = random() % 4 == 0;
    for (std::size_t row = 0; row < 3; ++row)
    {
      for (std::size_t column = 0; column < 3; ++column)
      {
        fields.srow[4 * row + column] =
          m[3 * row + column] * fields.pixdim[column + 1] * (column == 2 ? fields.pixdim[0] : 1.0);
      }
      fields.srow[4 * row + 1] += skew ? 0.2 * fields.srow[4 * row] : 0.0;
      fields.srow[4 * row + 3] = same ? fields.qoffset[row] : 100 * unit(random);
    }
    const auto path = folder.Write("a.nii", Nifti(fields, std::string(12, '\1')));
    SCOPED_TRACE("round " + std::to_string(round));
    if (skew && fields.sformCode > 0 && fields.qformCode == 0)
    {
      EXPECT_THROW(ItkGeometry<itk::NiftiImageIO>(path), itk::ExceptionObject);
      EXPECT_THROW(ReadLabelVolume(path), InputError);
      ++skewed;
      continue;
    }
    ExpectSame(ReadLabelVolume(path).geometry, ItkGeometry<itk::NiftiImageIO>(path), 1e-5);
  }
  EXPECT_GT(skewed, 0);
}

TEST(ItkPlacement, NrrdAndMetaImageAreReadAsItkDoes)
{
  const TempFolder folder;
  for (const char * space : { "left-posterior-superior", "right-anterior-superior" })
  {
    auto lines = NrrdLines("uint8", { 3, 2, 2 });
    lines[2] = std::string("space: ") + space;
    lines[4] = "space directions: (1.2,1.6,0) (-2.4,1.8,0) (0,0,-0.5)";
    lines[8] = "space origin: (10.5,20,-30)";
    const auto path = folder.Write("a.nrrd", Nrrd(lines, std::string(12, '\1')));
    ExpectSame(ReadLabelVolume(path).geometry, ItkGeometry<itk::NrrdImageIO>(path), 1e-12);
  }
  const auto spacings = folder.Write(
    "b.nrrd",
    Nrrd({ "type: uint8", "dimension: 3", "sizes: 3 2 2", "spacings: 0.5 0.25 2", "axis mins: 1 2 3", "encoding: raw" },
         std::string(12, '\1')));
  ExpectSame(ReadLabelVolume(spacings).geometry, ItkGeometry<itk::NrrdImageIO>(spacings), 1e-12);
  const auto meta = folder.Write("a.mha",
                                 Meta({ "ObjectType = Image",
                                        "NDims = 3",
                                        "BinaryData = True",
                                        "BinaryDataByteOrderMSB = False",
                                        "TransformMatrix = 0.6 0.8 0 -0.8 0.6 0 0 0 -1",
                                        "Offset = 1 2 3",
                                        "ElementSpacing = 2 3 0.5",
                                        "DimSize = 3 2 2",
                                        "ElementType = MET_UCHAR" },
                                      std::string(12, '\1')));
  ExpectSame(ReadLabelVolume(meta).geometry, ItkGeometry<itk::MetaImageIO>(meta), 1e-12);
}

TEST(ItkPlacement, ItkTurnsTheSpaceLasHalfAroundAndWeSaySo)
{
  const TempFolder folder;
  auto             lines = NrrdLines("uint8", { 3, 2, 2 });
  lines[2] = "space: left-anterior-superior";
  lines[8] = "space origin: (10,20,30)";
  const auto     path = folder.Write("a.nrrd", Nrrd(lines, std::string(12, '\1')));
  const LabelMap volume = ReadLabelVolume(path);
  ExpectNear(volume.geometry.origin, { 10, -20, 30 });
  ExpectNear(ItkGeometry<itk::NrrdImageIO>(path).origin, { -10, 20, 30 });
  EXPECT_TRUE(HasNote(volume.warnings, "half a turn"));
}

TEST(ItkPlacement, ItkReadsWhatWeWrite)
{
  ImageGeometry geometry;
  geometry.size = { 5, 4, 3 };
  geometry.spacing = { 0.5, 1.0 / 3, 2.5 };
  geometry.origin = { -12.25, 100.0 / 7, 3 };
  LabelShape label;
  label.value = 300;
  label.shape = VoxelShape({ { 1, 1, 1 }, { 3, 2, 1 } });
  label.shape.Insert(1, 1, 1);
  label.shape.Insert(3, 2, 1);
  const auto check = [&](const std::filesystem::path & path, auto io, double tolerance, bool compress) {
    SCOPED_TRACE(path.string());
    WriteLabelVolume(path, geometry, { label }, compress);
    using TImageIO = typename decltype(io)::ObjectType;
    ExpectSame(ItkGeometry<TImageIO>(path), geometry, tolerance);
    io->SetFileName(path.string());
    io->ReadImageInformation();
    ASSERT_EQ(io->GetComponentType(), itk::IOComponentEnum::USHORT);
    itk::ImageIORegion region(3);
    for (unsigned a = 0; a < 3; ++a)
    {
      region.SetSize(a, io->GetDimensions(a));
    }
    io->SetIORegion(region);
    std::vector<std::uint16_t> voxels(60);
    io->Read(voxels.data());
    for (std::size_t i = 0; i < voxels.size(); ++i)
    {
      EXPECT_EQ(voxels[i], i == 1 + 5 * (1 + 4 * 1) || i == 3 + 5 * (2 + 4 * 1) ? 300 : 0) << i;
    }
  };
  // Right- and left-handed, near no turn, and half turns about each axis.
  const double                             c = std::cos(0.3);
  const double                             s = std::sin(0.3);
  const std::vector<std::array<double, 9>> directions{ { 1, 0, 0, 0, 1, 0, 0, 0, 1 },   { c, -s, 0, s, c, 0, 0, 0, 1 },
                                                       { c, -s, 0, s, c, 0, 0, 0, -1 }, { -1, 0, 0, 0, -1, 0, 0, 0, 1 },
                                                       { 1, 0, 0, 0, -1, 0, 0, 0, -1 }, { -1, 0, 0, 0, 1, 0, 0, 0, -1 },
                                                       { 0, 1, 0, 1, 0, 0, 0, 0, -1 },  { 0, 0, 1, 1, 0, 0, 0, 1, 0 },
                                                       { 0, 0, -1, 0, 1, 0, -1, 0, 0 } };
  for (const auto & direction : directions)
  {
    geometry.direction = direction;
    for (const bool compress : { true, false })
    {
      const TempFolder folder;
      check(folder / "a.nrrd", itk::NrrdImageIO::New(), 1e-12, compress);
      check(folder / "a.mha", itk::MetaImageIO::New(), 1e-12, compress);
      check(folder / "b.mhd", itk::MetaImageIO::New(), 1e-12, compress);
      check(folder / "a.nii", itk::NiftiImageIO::New(), 1e-5, compress);
      check(folder / "a.nii.gz", itk::NiftiImageIO::New(), 1e-5, compress);
      // The qform alone says the same as the sform that ITK prefers.
      ReadOptions options;
      options.niftiForm = "qform";
      ExpectSame(ReadLabelVolume(folder / "a.nii", options).geometry, geometry, 1e-5);
    }
  }
}
