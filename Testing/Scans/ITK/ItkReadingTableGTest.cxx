// Awkward scans, of which a plain ITK read makes something else without a word: by all three readers the same, which is
// right, or the same refusal.

#include "ItkScanOutcomes.h"
#include "NrrdFixtures.h"

#include <functional>
#include <optional>

using namespace voxelcore;
using namespace voxelcore::testing;
using namespace voxelcore::testing::nrrd;

namespace
{

/** One reading of an awkward scan. */
struct Reading
{
  std::filesystem::path  path;
  std::string            refusal{}; ///< a part of it; empty: it is read
  ReadOptions            options{};
  std::optional<Vector3> spacing{};
  std::optional<Vector3> origin{};
  std::optional<Vector3> directionI{};
  std::vector<int>       values = kValues; ///< x fastest
};

struct Row
{
  const char *                                               name;
  std::function<std::vector<Reading>(const TempFolder & in)> make;
};

std::vector<int>
ValuesOf(const Outcome & outcome)
{
  const auto &     size = outcome.geometry.size;
  std::vector<int> values(static_cast<std::size_t>(size[0] * size[1] * size[2]), 0);
  for (const auto & [label, voxels] : outcome.voxels)
  {
    for (const LatticePoint & at : voxels)
    {
      values[static_cast<std::size_t>(at.x + size[0] * (at.y + size[1] * at.z))] = static_cast<int>(label);
    }
  }
  return values;
}

std::string
Bytes()
{
  return RawAll<std::uint8_t>(kValues);
}

std::filesystem::path
NrrdWith(const TempFolder & in, const std::string & field, const std::string & value)
{
  return in.Write(field + ".nrrd", Nrrd(With(Lines(), field, value), Bytes()));
}

/** 3 x 2 x 2 bytes of 0.5 x 0.75 x 2 mm with neither form. */
NiftiFields
Plain(int datatype = 2, int bitpix = 8)
{
  NiftiFields fields;
  fields.dim = { 3, 2, 2 };
  fields.datatype = datatype;
  fields.bitpix = bitpix;
  fields.pixdim = { 1, 0.5, 0.75, 2 };
  return fields;
}

ReadOptions
Volume(std::int64_t number)
{
  ReadOptions options;
  options.volume = number;
  return options;
}

ReadOptions
Orthonormalized()
{
  ReadOptions options;
  options.orthonormalize = true;
  return options;
}

ReadOptions
Form(const char * form)
{
  ReadOptions options;
  options.niftiForm = form;
  return options;
}

TiffPage
Page(const std::vector<int> & values, std::uint32_t width = 3, std::uint32_t height = 2)
{
  TiffPage page;
  page.width = width;
  page.height = height;
  page.parts = { RawAll<std::uint8_t>(values) };
  return page;
}

std::vector<int>
Slice(std::size_t z)
{
  return { kValues.begin() + static_cast<std::ptrdiff_t>(6 * z),
           kValues.begin() + static_cast<std::ptrdiff_t>(6 * z + 6) };
}

std::vector<TiffPage>
Stack(const std::string & description = "")
{
  std::vector<TiffPage> pages{ Page(Slice(0)), Page(Slice(1)) };
  pages[0].description = description;
  return pages;
}

std::vector<Reading>
FourDimensions(const TempFolder & in)
{
  NiftiFields fields = Plain();
  fields.dim = { 3, 2, 2, 2 };
  fields.qformCode = 1;
  fields.quaternion = { 0, 0, 1 }; // half a turn about k: NIfTI's RAS becomes ITK's LPS
  fields.qoffset = { 4, 5, 6 };
  const std::string bytes = std::string(12, '\1') + Bytes();
  const auto        path = in.Write("two.nii", Nifti(fields, bytes));
  NiftiFields       one = fields;
  one.dim = { 3, 2, 2, 1 };
  return { { path, "4-D file with 2 volumes" },
           { path, "", Volume(1), Vector3{ 0.5, 0.75, 2 }, Vector3{ -4, -5, 6 }, Vector3{ 1, 0, 0 } },
           { path, "there is no volume 2", Volume(2) },
           { in.Write("one.nii", Nifti(one, Bytes())), "", {}, {}, Vector3{ -4, -5, 6 } } };
}

std::vector<Reading>
FractionsAndLargeNumbers(const TempFolder & in)
{
  const auto path = [&](const char * name, const char * type, double value) {
    std::vector<double> values(12, 1);
    values[7] = value;
    return in.Write(name, Nrrd(Lines(type), type[0] == 'f' ? RawAll<float>(values) : RawAll<double>(values)));
  };
  std::vector<int> large(12, 1);
  large[7] = 70000;
  return { { path("fraction.nrrd", "double", 0.9999999), "is a fraction" },
           { path("negative.nrrd", "float", -1), "value -1 at voxel (1,0,1) is negative" },
           { path("large.nrrd", "float", 70000), "", {}, {}, {}, {}, large } };
}

std::vector<Reading>
SkewedForms(const TempFolder & in)
{
  NiftiFields fields = Plain();
  fields.sformCode = 1;
  fields.srow = { 1, 0.3, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0 };
  const auto sform = in.Write("sform.nii", Nifti(fields, Bytes()));
  fields.qformCode = 1;
  fields.quaternion = { 0, 0, 1 };
  return { { sform, "skewed" },
           { sform, "", Orthonormalized() },
           { in.Write("both.nii", Nifti(fields, Bytes())), "", {}, Vector3{ 0.5, 0.75, 2 } } };
}

std::vector<Reading>
FormsThatDisagree(const TempFolder & in)
{
  NiftiFields fields = Plain();
  fields.qformCode = 1;
  fields.quaternion = { 0, 0, 1 };
  fields.sformCode = 1;
  fields.srow = { -1, 0, 0, 5, 0, -1, 0, 0, 0, 0, 1, 0 };
  const auto path = in.Write("a.nii", Nifti(fields, Bytes()));
  return { { path, "", Form("auto"), {}, Vector3{ -5, 0, 0 } },
           { path, "", Form("qform"), {}, Vector3{ 0, 0, 0 } },
           { path, "", Form("sform"), {}, Vector3{ -5, 0, 0 } } };
}

std::vector<Reading>
Slopes(const TempFolder & in)
{
  NiftiFields fields = Plain(4, 16);
  fields.slope = 0.5;
  const auto half = in.Write("half.nii", Nifti(fields, RawAll<std::int16_t>(kValues)));
  auto       doubled = kValues;
  for (int & value : doubled)
  {
    value *= 2;
  }
  fields.slope = 3.0F / 255; // a float that is no exact fraction
  auto multiples = kValues;
  for (int & value : multiples)
  {
    value *= 255 / 3;
  }
  const auto rounded = in.Write("rounded.nii", Nifti(fields, RawAll<std::int16_t>(multiples)));
  fields.slope = 0.5;
  return { { half, "is a fraction" },
           { in.Write("doubled.nii", Nifti(fields, RawAll<std::int16_t>(doubled))) },
           { rounded } };
}

std::vector<Reading>
Micrometres(const TempFolder & in)
{
  NiftiFields fields = Plain();
  fields.units = 3;
  fields.qformCode = 1;
  fields.quaternion = { 0, 0, 1 };
  fields.qoffset = { 1000, 2000, -3000 };
  const Vector3 spacing{ 0.5e-3, 0.75e-3, 2e-3 };
  const auto    qform = in.Write("qform.nii", Nifti(fields, Bytes()));
  fields.qformCode = 0;
  fields.sformCode = 1;
  fields.srow = { -0.5, 0, 0, 1000, 0, -0.75, 0, 2000, 0, 0, 2, -3000 };
  return { { qform, "", {}, spacing, Vector3{ -1, -2, -3 } },
           { in.Write("sform.nii", Nifti(fields, Bytes())), "", {}, spacing, Vector3{ -1, -2, -3 } } };
}

std::vector<Reading>
NoSpacing(const TempFolder & in)
{
  NiftiFields fields = Plain();
  fields.pixdim[2] = 0;
  const auto  path = in.Write("a.nii", Nifti(fields, Bytes()));
  ReadOptions given;
  given.spacing = Vector3{ 0.5, 0.25, 3 };
  return { { path, "spacing along axis j is 0" }, { path, "", given, given.spacing } };
}

std::vector<Reading>
Layers(const TempFolder & in)
{
  std::vector<int> stored(24, 0);
  std::vector<int> values(12, 0);
  for (std::size_t voxel = 0; voxel < 12; ++voxel)
  {
    values[voxel] = voxel % 5 == 0 ? 0 : voxel < 6 ? 1 : 4;
    stored[2 * voxel + (voxel < 6 ? 0 : 1)] = values[voxel];
  }
  return { { in.Write("a.seg.nrrd", Nrrd(LayerLines(), RawAll<std::uint8_t>(stored))), "", {}, {}, {}, {}, values } };
}

std::vector<Reading>
Tiles(const TempFolder & in)
{
  std::vector<TiffPage> pages;
  for (std::size_t z = 0; z < 2; ++z)
  {
    TiffPage page = Page({});
    page.tileWidth = 16;
    page.tileHeight = 16;
    std::string tile(256, '\0');
    tile.replace(0, 3, RawAll<std::uint8_t>(Slice(z)).substr(0, 3));
    tile.replace(16, 3, RawAll<std::uint8_t>(Slice(z)).substr(3, 3));
    page.parts = { tile };
    pages.push_back(page);
  }
  return { { in.Write("a.tif", Tiff(pages)) } };
}

std::vector<Reading>
ManyPages(const TempFolder & in)
{
  std::vector<TiffPage> pages(65537, Page({ 0 }, 1, 1));
  pages[65536] = Page({ 2 }, 1, 1);
  std::vector<int> values(65537, 0);
  values[65536] = 2;
  return { { in.Write("a.tif", Tiff(pages)), "", {}, {}, {}, {}, values } };
}

std::vector<Reading>
SlicesInOrder(const TempFolder & in)
{
  const auto write = [&](const std::string & name, std::size_t z) { in.Write(name, Tiff({ Page(Slice(z)) })); };
  write("natural/s_9.tif", 0);
  write("natural/s_10.tif", 1);
  write("gap/s_9.tif", 0);
  write("gap/s_11.tif", 1);
  write("unequal/s_1.tif", 0);
  in.Write("unequal/s_2.tif", Tiff({ Page({ 1, 2, 3, 4 }, 2, 2) }));
  return { { in / "natural" },
           { in / "natural/s_*.tif" },
           { in / "gap", "slice 10 is missing" },
           { in / "unequal", "is not like the first" } };
}

std::vector<Reading>
CutOff(const TempFolder & in)
{
  const std::string all = Nrrd(Lines(), Bytes());
  const std::string packed = Gzip(Bytes());
  const auto        gzip = With(Lines(), "encoding", "gzip");
  const auto        nifti = Nifti(Plain(), Bytes());
  const auto        niftiPacked = Gzip(nifti);
  return { { in.Write("raw.nrrd", all.substr(0, all.size() - 1)), "truncated" },
           { in.Write("gzip.nrrd", Nrrd(gzip, packed)) },
           { in.Write("cut.nrrd", Nrrd(gzip, packed.substr(0, packed.size() - 6))), "end too early" },
           { in.Write("a.nii", nifti.substr(0, nifti.size() - 1)), "truncated" },
           { in.Write("a.nii.gz", niftiPacked.substr(0, niftiPacked.size() - 9)), "end too early" } };
}

const std::vector<Row> kRows{
  { "FourDimensionalFile", FourDimensions },
  { "FloatLabels", FractionsAndLargeNumbers },
  { "NegativeLabels",
    [](const TempFolder & in) {
      auto values = kValues;
      values[7] = -1024;
      return std::vector<Reading>{ { in.Write("a.nrrd", Nrrd(Lines("int16"), RawAll<std::int16_t>(values))),
                                     "value -1024 at voxel (1,0,1) is negative" } };
    } },
  { "ThreeComponents",
    [](const TempFolder & in) {
      return std::vector<Reading>{ { in.Write("a.nii", Nifti(Plain(128, 24), Bytes() + Bytes() + Bytes())),
                                     "3 values a voxel" } };
    } },
  { "SegmentsInLayers", Layers },
  { "NrrdInMicrometres",
    [](const TempFolder & in) {
      auto lines = With(Lines(), "space units", "\"um\" \"um\" \"um\"");
      lines = With(With(lines, "space directions", "(5,0,0) (0,5,0) (0,0,5)"), "space origin", "(1000,0,-500)");
      return std::vector<Reading>{
        { in.Write("a.nrrd", Nrrd(lines, Bytes())), "", {}, Vector3{ 5e-3, 5e-3, 5e-3 }, Vector3{ 1, 0, -0.5 } }
      };
    } },
  { "NrrdInRas",
    [](const TempFolder & in) {
      const auto lines = With(With(Lines(), "space", "right-anterior-superior"), "space origin", "(1,2,3)");
      return std::vector<Reading>{
        { in.Write("a.nrrd", Nrrd(lines, Bytes())), "", {}, {}, Vector3{ -1, -2, 3 }, Vector3{ -1, 0, 0 } }
      };
    } },
  { "NrrdSkewed",
    [](const TempFolder & in) {
      const auto far = NrrdWith(in, "space directions", "(1,0.5,0) (0,1,0) (0,0,1)");
      auto       lines = With(Lines(), "space directions", "(1,0.001,0) (0,1,0) (0,0,1)");
      const auto near = in.Write("near.nrrd", Nrrd(lines, Bytes()));
      return std::vector<Reading>{ { far, "skewed" }, { near, "skewed" }, { near, "", Orthonormalized() } };
    } },
  { "NrrdSingular",
    [](const TempFolder & in) {
      return std::vector<Reading>{ { NrrdWith(in, "space directions", "(1,0,0) (1,0,0) (0,0,1)"), "in one plane" } };
    } },
  { "NrrdWithSpacingsAlone",
    [](const TempFolder & in) {
      const std::vector<std::string> lines{ "type: uint8",
                                            "dimension: 3",
                                            "sizes: 3 2 2",
                                            "spacings: 0.5 0.25 2",
                                            "encoding: raw" };
      return std::vector<Reading>{ { in.Write("a.nrrd", Nrrd(lines, Bytes())),
                                     "",
                                     {},
                                     Vector3{ 0.5, 0.25, 2 },
                                     Vector3{ 0, 0, 0 },
                                     Vector3{ 1, 0, 0 } } };
    } },
  { "NiftiInMicrometres", Micrometres },
  { "NiftiSkewedSform", SkewedForms },
  { "NiftiFormsThatDisagree", FormsThatDisagree },
  { "NiftiWithNeitherForm",
    [](const TempFolder & in) {
      return std::vector<Reading>{ { in.Write("a.nii", Nifti(Plain(), Bytes())),
                                     "",
                                     {},
                                     Vector3{ 0.5, 0.75, 2 },
                                     Vector3{ 0, 0, 0 },
                                     Vector3{ 1, 0, 0 } } };
    } },
  { "NiftiSlope", Slopes },
  { "NiftiWithoutSpacing", NoSpacing },
  { "MultiPageTiff",
    [](const TempFolder & in) {
      const std::string imageJ = "ImageJ=1.53t\nimages=2\nslices=2\nunit=micron\nspacing=2.5\n";
      auto              pages = Stack(imageJ);
      for (TiffPage & page : pages)
      {
        page.more = { { std::uint16_t{ 296 }, 1 } };
        page.rationals = { { std::uint16_t{ 282 }, 0.5 }, { std::uint16_t{ 283 }, 0.25 } };
      }
      return std::vector<Reading>{
        { in.Write("imagej.tif", Tiff(pages)), "", {}, Vector3{ 2e-3, 4e-3, 2.5e-3 } },
        { in.Write("none.tif", Tiff(Stack())), "", {}, Vector3{ 1, 1, 1 } },
      };
    } },
  { "TiledTiff", Tiles },
  { "SeriesOfSlices", SlicesInOrder },
  { "Truncated", CutOff },
};

class ItkReadingTable
  : public ScanByAllReaders
  , public ::testing::WithParamInterface<Row>
{};

} // namespace

TEST_P(ItkReadingTable, GivesOneOutcomeByAllReadersAndItIsRight)
{
  for (const Reading & one : GetParam().make(m_Folder))
  {
    const Outcome outcome = ExpectSameByAll(one.path, one.refusal, one.options);
    if (!one.refusal.empty() || !outcome.refusal.empty())
    {
      continue;
    }
    EXPECT_EQ(ValuesOf(outcome), one.values) << one.path;
    const auto expectNear = [&](const std::optional<Vector3> & expected, const Vector3 & found) {
      for (std::size_t a = 0; expected && a < 3; ++a)
      {
        EXPECT_NEAR(found[a], (*expected)[a], 1e-6 * std::max(1e-3, std::abs((*expected)[a]))) << one.path << " " << a;
      }
    };
    expectNear(one.spacing, outcome.geometry.spacing);
    expectNear(one.origin, outcome.geometry.origin);
    const auto & direction = outcome.geometry.direction;
    expectNear(one.directionI, { direction[0], direction[3], direction[6] });
  }
}

const auto kRowName = [](const auto & row) { return std::string(row.param.name); };

INSTANTIATE_TEST_SUITE_P(Rows, ItkReadingTable, ::testing::ValuesIn(kRows), kRowName);
// Each of many openings goes through 65537 directories.
INSTANTIATE_TEST_SUITE_P(HeavyRows,
                         ItkReadingTable,
                         ::testing::Values(Row{ "MoreThan65535Pages", ManyPages }),
                         kRowName);
