#include "ScanBytes.h"

#include <cmath>

namespace voxelcore::testing::nifti
{

namespace
{

const std::vector<int> kValues{ 0, 1, 2, 3, 0, 7, 0, 0, 0, 2, 2, 120 }; // 3 x 2 x 2
const std::string      kData = RawAll<std::uint8_t>(kValues);

NiftiFields
Fields()
{
  NiftiFields fields;
  fields.dim = { 3, 2, 2 };
  return fields;
}

void
ExpectValues(const LabelMap & volume)
{
  EXPECT_EQ(AllValues(volume), std::vector<std::int64_t>(kValues.begin(), kValues.end()));
}

/** An sform: columns and origin in RAS. */
void
SetSform(NiftiFields & fields, const std::array<double, 12> & rows, int code)
{
  fields.srow = rows;
  fields.sformCode = code;
}

} // namespace

TEST(Nifti, BothVersionsInBothByteOrdersPackedOrNot)
{
  const TempFolder folder;
  for (const int version : { 1, 2 })
  {
    for (const bool big : { false, true })
    {
      NiftiFields fields = Fields();
      fields.version = version;
      fields.big = big;
      fields.datatype = 4;
      fields.bitpix = 16;
      fields.pixdim = { 1, 0.5, 0.25, 2 };
      const std::string bytes = Nifti(fields, RawAll<std::int16_t>(kValues, big));
      for (const bool packed : { false, true })
      {
        const LabelMap volume =
          ReadLabelVolume(folder.Write(packed ? "a.nii.gz" : "a.nii", packed ? Gzip(bytes) : bytes));
        ExpectValues(volume);
        ExpectNear(volume.geometry.spacing, { 0.5, 0.25, 2 });
        EXPECT_EQ(volume.format, version == 1 ? "NIfTI-1" : "NIfTI-2");
        EXPECT_EQ(volume.pixelType, "int16");
      }
    }
  }
}

TEST(Nifti, EveryTypeOfWholeNumbersAndFloatsThatAreWhole)
{
  const TempFolder folder;
  const auto       check = [&](int datatype, const std::string & data) {
    NiftiFields fields = Fields();
    fields.datatype = datatype;
    ExpectValues(ReadLabelVolume(folder.Write("a.nii", Nifti(fields, data))));
  };
  check(2, kData);
  check(256, RawAll<std::int8_t>(kValues));
  check(4, RawAll<std::int16_t>(kValues));
  check(512, RawAll<std::uint16_t>(kValues));
  check(8, RawAll<std::int32_t>(kValues));
  check(768, RawAll<std::uint32_t>(kValues));
  check(1024, RawAll<std::int64_t>(kValues));
  check(1280, RawAll<std::uint64_t>(kValues));
  check(16, RawAll<float>(kValues));
  check(64, RawAll<double>(kValues));
}

TEST(Nifti, PairsOfHeaderAndImageAreReadByEitherName)
{
  const TempFolder folder;
  NiftiFields      fields = Fields();
  fields.pair = true;
  folder.Write("a.hdr", NiftiHeaderBytes(fields));
  folder.Write("a.img", kData);
  ExpectValues(ReadLabelVolume(folder / "a.hdr"));
  ExpectValues(ReadLabelVolume(folder / "a.img"));
  folder.Write("b.hdr.gz", Gzip(NiftiHeaderBytes(fields)));
  folder.Write("b.img.gz", Gzip(kData));
  ExpectValues(ReadLabelVolume(folder / "b.hdr.gz"));
  ExpectRefused(folder.Write("c.hdr", NiftiHeaderBytes(fields)), { "c.img" });
}

TEST(NiftiGeometry, RightAnteriorSuperiorBecomesLps)
{
  const TempFolder folder;
  NiftiFields      fields = Fields();
  fields.pixdim = { 1, 2, 3, 4 };
  SetSform(fields, { 2, 0, 0, 10, 0, 3, 0, 20, 0, 0, 4, 30 }, 2);
  ExpectNear(CentreOf(ReadLabelVolume(folder.Write("a.nii", Nifti(fields, kData))), 2, 1, 1), { -14, -23, 34 });
}

TEST(NiftiGeometry, QuaternionsTurnAndQfacReverses)
{
  const TempFolder folder;
  NiftiFields      fields = Fields();
  fields.qformCode = 1;
  fields.pixdim = { -1, 2, 3, 4 };
  const double s = std::sqrt(0.5); // a quarter turn about z: i runs along +y, j along -x, k reversed by qfac
  fields.quaternion = { 0, 0, s };
  fields.qoffset = { 10, 20, 30 };
  const LabelMap volume = ReadLabelVolume(folder.Write("a.nii", Nifti(fields, kData)));
  // RAS: (10 - 3, 20 + 4, 30 - 4)
  ExpectNear(CentreOf(volume, 2, 1, 1), { -7, -24, 26 }, 1e-5);
  EXPECT_TRUE(IsLeftHanded(volume.geometry));
}

TEST(NiftiGeometry, MicrometresAndMetresScaleSpacingAndOrigin)
{
  const TempFolder folder;
  for (const int form : { 1, 2 }) // qform, sform
  {
    NiftiFields fields = Fields();
    fields.pixdim = { 1, 5, 5, 10 };
    fields.units = 3;
    fields.qformCode = form == 1 ? 1 : 0;
    fields.qoffset = { 1000, 2000, 3000 };
    SetSform(fields, { 5, 0, 0, 1000, 0, 5, 0, 2000, 0, 0, 10, 3000 }, form == 2 ? 1 : 0);
    const LabelMap volume = ReadLabelVolume(folder.Write("a.nii", Nifti(fields, kData)));
    ExpectNear(volume.geometry.spacing, { 0.005, 0.005, 0.01 }, 1e-12);
    ExpectNear(CentreOf(volume, 2, 1, 1), { -1.010, -2.005, 3.010 }, 1e-9);
    EXPECT_TRUE(HasNote(volume.notes, "um"));
    fields.units = 1;
    ExpectNear(ReadLabelVolume(folder.Write("b.nii", Nifti(fields, kData))).geometry.spacing, { 5000, 5000, 10000 });
  }
}

TEST(NiftiGeometry, SkewedSformAloneIsRefusedUnlessAccepted)
{
  const TempFolder folder;
  NiftiFields      fields = Fields();
  SetSform(fields, { 1, 0.1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0 }, 2);
  const auto path = folder.Write("a.nii", Nifti(fields, kData));
  ExpectRefused(path, { "5.71", "--orthonormalize" });
  ReadOptions accept;
  accept.orthonormalize = true;
  const LabelMap volume = ReadLabelVolume(path, accept);
  EXPECT_LT(OrthonormalityDeviationDegrees(volume.geometry), 1e-9);
  EXPECT_TRUE(HasNote(volume.notes, "nearest right-angled"));
}

TEST(NiftiGeometry, SkewedSformWithQformGivesTheQformNoted)
{
  const TempFolder folder;
  NiftiFields      fields = Fields();
  fields.qformCode = 1;
  fields.qoffset = { 1, 2, 3 };
  SetSform(fields, { 1, 0.1, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3 }, 1);
  const LabelMap volume = ReadLabelVolume(folder.Write("a.nii", Nifti(fields, kData)));
  ExpectNear(CentreOf(volume, 2, 1, 1), { -3, -3, 4 });
  EXPECT_TRUE(HasNote(volume.notes, "sform is skewed"));
}

TEST(NiftiGeometry, DisagreeingFormsFollowItksRuleWithAWarning)
{
  const TempFolder folder;
  NiftiFields      fields = Fields();
  fields.qformCode = 1;
  fields.qoffset = { 1, 2, 3 };
  // The sform lies 5 mm along x from the qform.
  for (const int code : { 1, 2, 4 })
  {
    SetSform(fields, { 1, 0, 0, 6, 0, 1, 0, 2, 0, 0, 1, 3 }, code);
    const auto     path = folder.Write("a.nii", Nifti(fields, kData));
    const LabelMap volume = ReadLabelVolume(path);
    EXPECT_NEAR(volume.geometry.origin[0], code == 1 ? -6 : -1, 1e-6);
    ASSERT_EQ(volume.warnings.size(), 1U);
    EXPECT_TRUE(HasNote(volume.warnings, "disagree by up to 5 mm"));
    EXPECT_TRUE(HasNote(volume.notes, "disagree by up to 5 mm"));
    ReadOptions options;
    options.niftiForm = "sform";
    EXPECT_NEAR(ReadLabelVolume(path, options).geometry.origin[0], -6, 1e-6);
    options.niftiForm = "qform";
    EXPECT_NEAR(ReadLabelVolume(path, options).geometry.origin[0], -1, 1e-6);
    options.niftiForm = "oform";
    EXPECT_THROW(ReadLabelVolume(path, options), UsageError);
  }
}

TEST(NiftiGeometry, AgreeingFormsGiveNoWarning)
{
  const TempFolder folder;
  NiftiFields      fields = Fields();
  fields.qformCode = 1;
  fields.qoffset = { 1, 2, 3 };
  SetSform(fields, { 1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3 }, 4);
  EXPECT_TRUE(ReadLabelVolume(folder.Write("a.nii", Nifti(fields, kData))).warnings.empty());
}

TEST(NiftiGeometry, AskingForAFormThatIsNotThereIsRefused)
{
  const TempFolder folder;
  ReadOptions      options;
  options.niftiForm = "sform";
  ExpectRefused(folder.Write("a.nii", Nifti(Fields(), kData)), { "no sform" }, options);
}

TEST(NiftiGeometry, NeitherFormIsLpsWithOriginZeroNoted)
{
  const TempFolder folder;
  const LabelMap   volume = ReadLabelVolume(folder.Write("a.nii", Nifti(Fields(), kData)));
  EXPECT_EQ(volume.geometry.direction, (std::array<double, 9>{ 1, 0, 0, 0, 1, 0, 0, 0, 1 }));
  EXPECT_EQ(volume.geometry.origin, (Vector3{ 0, 0, 0 }));
  EXPECT_TRUE(HasNote(volume.notes, "neither qform nor sform"));
}

TEST(NiftiGeometry, SpacingThatIsNoLengthIsRefusedUnlessGiven)
{
  const TempFolder folder;
  for (const double bad : { 0.0, -1.0, std::nan(""), static_cast<double>(INFINITY) })
  {
    NiftiFields fields = Fields();
    fields.qformCode = 1;
    fields.pixdim[2] = bad;
    const auto path = folder.Write("a.nii", Nifti(fields, kData));
    ExpectRefused(path, { "axis j", "--spacing" });
    ReadOptions options;
    options.spacing = Vector3{ 1, 2, 3 };
    ExpectNear(ReadLabelVolume(path, options).geometry.spacing, { 1, 2, 3 });
  }
}

TEST(NiftiGeometry, ScalesOfTheSformThatContradictPixdimAreReported)
{
  const TempFolder folder;
  NiftiFields      fields = Fields();
  SetSform(fields, { 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0 }, 1);
  const auto     path = folder.Write("a.nii", Nifti(fields, kData));
  const LabelMap volume = ReadLabelVolume(path);
  ExpectNear(volume.geometry.spacing, { 1, 1, 1 }); // as ITK
  EXPECT_TRUE(HasNote(volume.warnings, "contradicts pixdim"));
  ReadOptions options;
  options.niftiForm = "sform";
  ExpectNear(ReadLabelVolume(path, options).geometry.spacing, { 2, 2, 2 });
}

TEST(NiftiVolumes, ASeriesNeedsAChoiceAndKeepsItsGeometry)
{
  const TempFolder folder;
  NiftiFields      fields = Fields();
  fields.dim = { 3, 2, 2, 2 };
  fields.pixdim = { 1, 2, 3, 4 };
  SetSform(fields, { 2, 0, 0, 10, 0, 3, 0, 20, 0, 0, 4, 30 }, 1);
  const std::string bytes = Nifti(fields, std::string(12, '\5') + kData);
  for (const bool packed : { false, true })
  {
    const auto path = folder.Write(packed ? "a.nii.gz" : "a.nii", packed ? Gzip(bytes) : bytes);
    ExpectRefused(path, { "4-D", "--volume 0 to --volume 1" });
    ReadOptions options;
    options.volume = 1;
    const LabelMap volume = ReadLabelVolume(path, options);
    ExpectValues(volume);
    ExpectNear(CentreOf(volume, 2, 1, 1), { -14, -23, 34 });
    options.volume = 5;
    ExpectRefused(path, { "no volume 5" }, options);
  }
  fields.dim = { 3, 2, 2, 1 };
  ExpectValues(ReadLabelVolume(folder.Write("b.nii", Nifti(fields, kData))));
}

TEST(NiftiScaling, WholeNumbersAfterScalingOrRefused)
{
  const TempFolder folder;
  NiftiFields      fields = Fields();
  fields.slope = 0.5;
  std::vector<int> doubled;
  for (const int value : kValues)
  {
    doubled.push_back(2 * value);
  }
  const LabelMap volume = ReadLabelVolume(folder.Write("a.nii", Nifti(fields, RawAll<std::uint8_t>(doubled))));
  ExpectValues(volume);
  EXPECT_TRUE(HasNote(volume.notes, "0.5 * stored"));
  // Stored 1 is 0.5 and would merge with a neighbour.
  ExpectRefused(folder.Write("b.nii", Nifti(fields, kData)), { "0.5", "(1,0,0)", "fraction", "--threshold" });
}

TEST(NiftiScaling, ASlopeOfOneOver255MakesAMaskOfOnes)
{
  const TempFolder folder;
  NiftiFields      fields = Fields();
  fields.slope = 1.0 / 255; // rounded to single precision in the file
  std::string data(12, '\0');
  data[4] = '\xFF';
  const LabelMap volume = ReadLabelVolume(folder.Write("a.nii", Nifti(fields, data)));
  ASSERT_EQ(volume.labels.size(), 1U);
  EXPECT_EQ(volume.labels[0].value, 1);
  data[5] = '\x7F';
  ExpectRefused(folder.Write("b.nii", Nifti(fields, data)), { "0.498", "(2,1,0)" });
}

TEST(NiftiScaling, AnInterceptMovesTheBackground)
{
  const TempFolder folder;
  NiftiFields      fields = Fields();
  fields.slope = 1;
  fields.intercept = -3;
  std::string data(12, '\3');
  data[7] = '\5';
  const LabelMap volume = ReadLabelVolume(folder.Write("a.nii", Nifti(fields, data)));
  ASSERT_EQ(volume.labels.size(), 1U);
  EXPECT_EQ(volume.labels[0].value, 2);
  EXPECT_EQ(volume.labels[0].voxels, 1U);
  // A slope too small to tell values apart must not merge them.
  fields.slope = 1e-9;
  fields.intercept = 1;
  ExpectRefused(folder.Write("b.nii", Nifti(fields, data)), { "fraction" });
}

TEST(NiftiBad, OtherKindsOfImagesAreRefused)
{
  const TempFolder folder;
  NiftiFields      fields = Fields();
  fields.dim = { 6, 2 };
  ExpectRefused(folder.Write("flat.nii", Nifti(fields, kData)), { "2-D" });
  fields = Fields();
  fields.datatype = 128;
  ExpectRefused(folder.Write("rgb.nii", Nifti(fields, kData + kData + kData)), { "colour" });
  fields.datatype = 2304;
  ExpectRefused(folder.Write("rgba.nii", Nifti(fields, kData + kData + kData + kData)), { "colour" });
  fields.datatype = 32;
  ExpectRefused(folder.Write("complex.nii", Nifti(fields, std::string(96, '\0'))), { "complex" });
  fields.datatype = 1536;
  ExpectRefused(folder.Write("long.nii", Nifti(fields, std::string(192, '\0'))), { "1536" });
}

TEST(NiftiBad, TruncatedFilesAreRefusedWhereverTheyEnd)
{
  const TempFolder  folder;
  const std::string bytes = Nifti(Fields(), kData);
  for (std::size_t size = 1; size < bytes.size(); size += size < 340 ? 17 : 1)
  {
    ExpectRefused(folder.Write("a.nii", bytes.substr(0, size)), {});
  }
  const std::string packed = Gzip(bytes);
  for (std::size_t size = 1; size < packed.size(); ++size)
  {
    ExpectRefused(folder.Write("a.nii.gz", packed.substr(0, size)), {});
  }
}

TEST(NiftiBad, HeadersThatClaimTooMuchAreRefused)
{
  const TempFolder folder;
  NiftiFields      fields = Fields();
  fields.version = 2;
  for (const std::vector<std::int64_t> & dim :
       std::vector<std::vector<std::int64_t>>{ { 1 << 14, 1 << 14, 1 << 12 },
                                               { std::int64_t{ 1 } << 62, 4, 4 },
                                               { -3, 2, 2 },
                                               { 0, 2, 2 },
                                               { INT64_MIN, INT64_MIN, INT64_MIN },
                                               { 3, 2, 2, std::int64_t{ 1 } << 40 },
                                               { 3, 2, 2, -1 },
                                               { 3, 2, 2, 1 << 30, 1 << 30, 1 << 30, 1 << 30 } })
  {
    fields.dim = dim;
    ReadOptions first;
    first.volume = 0;
    ExpectRefused(folder.Write("a.nii", Nifti(fields, kData)), {}, first);
    ExpectRefused(folder.Write("a.nii.gz", Gzip(Nifti(fields, kData))), {}, first);
  }
  for (const double offset : { -1e30, 1e30, 100.0, 352.0 + 1, 1e9 })
  {
    NiftiFields odd = Fields();
    odd.voxOffset = std::abs(offset) < 1e20 ? offset : 1e30;
    ExpectRefused(folder.Write("b.nii", Nifti(odd, kData)), {});
  }
}

} // namespace voxelcore::testing::nifti
