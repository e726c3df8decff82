// Colours and vectors: refused, unless --component says which value of a voxel is meant.

#include "NrrdFixtures.h"
#include "PngBytes.h"
#include "ScanBytes.h"

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

// Three values a voxel, of 2 x 2 x 2 voxels: component c of voxel v is kBase[v] + 50 c, 0 stays.
const std::vector<int> kBase{ 0, 1, 2, 0, 5, 6, 7, 8 };

std::vector<int>
Component(int c)
{
  std::vector<int> values;
  for (const int base : kBase)
  {
    values.push_back(base == 0 ? 0 : base + 50 * c);
  }
  return values;
}

template <typename T = std::uint8_t>
std::string
Interleaved(int components, std::size_t first = 0, std::size_t count = 8, bool big = false)
{
  std::string bytes;
  for (std::size_t v = first; v < first + count; ++v)
  {
    for (int c = 0; c < components; ++c)
    {
      bytes += Raw<T>(static_cast<T>(Component(c)[v]), big);
    }
  }
  return bytes;
}

template <typename T = std::uint8_t>
std::string
OneAfterTheOther(int components, std::size_t first = 0, std::size_t count = 8)
{
  std::string bytes;
  for (int c = 0; c < components; ++c)
  {
    for (std::size_t v = first; v < first + count; ++v)
    {
      bytes += Raw<T>(static_cast<T>(Component(c)[v]));
    }
  }
  return bytes;
}

/** Refused without a choice and for a component that is not there; each component is read as stored. */
void
ExpectComponents(const std::filesystem::path & path, int components, const std::string & kind)
{
  SCOPED_TRACE(path.filename().string());
  const auto refused = [&](const ReadOptions & options, const std::string & text) {
    try
    {
      ReadLabelVolume(path, options);
      ADD_FAILURE() << "was read";
    }
    catch (const InputError & error)
    {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << "'" << text << "' in: " << error.what();
    }
  };
  refused({}, kind);
  refused({}, "--component 0 to --component " + std::to_string(components - 1));
  ReadOptions options;
  options.component = components;
  refused(options, "no component " + std::to_string(components));
  for (int c = 0; c < components; ++c)
  {
    options.component = c;
    const auto expected = Component(c);
    EXPECT_EQ(AllValues(ReadLabelVolume(path, options)), std::vector<std::int64_t>(expected.begin(), expected.end()))
      << c;
  }
}

/** Lines of an NRRD header with a fourth axis before or behind those in space. */
std::vector<std::string>
Lines4(const std::string & type, const std::string & sizes, const std::string & kinds, bool before)
{
  const std::string axes = "(1,0,0) (0,1,0) (0,0,1)";
  return { "type: " + type,
           "dimension: 4",
           "space: LPS",
           "sizes: " + sizes,
           "space directions: " + (before ? "none " + axes : axes + " none"),
           "kinds: " + kinds,
           "endian: little",
           "encoding: raw",
           "space origin: (0,0,0)" };
}

} // namespace

TEST(Component, OfNrrdVectorsAndColoursWhereverTheirAxisIs)
{
  const TempFolder folder;
  for (const auto & [kind, count] : { std::pair("RGB-color", 3), std::pair("vector", 2), std::pair("4-vector", 4) })
  {
    const std::string n = std::to_string(count);
    const std::string name = std::string(kind) == "RGB-color" ? "colour image" : "vectors";
    ExpectComponents(folder.Write("a.nrrd",
                                  Nrrd(Lines4("uchar", n + " 2 2 2", std::string(kind) + " domain domain domain", true),
                                       Interleaved(count))),
                     count,
                     name);
    ExpectComponents(
      folder.Write("b.nrrd",
                   Nrrd(Lines4("short", "2 2 2 " + n, std::string("domain domain domain ") + kind, false),
                        OneAfterTheOther<std::int16_t>(count))),
      count,
      name);
  }
}

TEST(Component, OfVectorsInASeriesOfVolumes)
{
  const TempFolder         folder;
  std::vector<std::string> lines = Lines4("uchar", "3 2 2 2 2", "vector domain domain domain time", true);
  lines[1] = "dimension: 5";
  lines[4] += " none";
  const auto  path = folder.Write("a.nrrd", Nrrd(lines, std::string(24, '\7') + Interleaved(3)));
  ReadOptions options;
  ExpectRefused(path, { "2 volumes", "--volume" });
  options.volume = 1;
  ExpectRefused(path, { "vectors", "--component" }, options);
  options.component = 2;
  const auto expected = Component(2);
  EXPECT_EQ(AllValues(ReadLabelVolume(path, options)), std::vector<std::int64_t>(expected.begin(), expected.end()));
  // Volumes on two axes have no common number.
  lines[5] = "kinds: list domain domain domain time";
  ExpectRefused(folder.Write("b.nrrd", Nrrd(lines, std::string(48, '\7'))), { "before and behind" });
}

TEST(Component, OfNiftiColoursAndVectors)
{
  const TempFolder folder;
  NiftiFields      fields;
  fields.dim = { 2, 2, 2 };
  fields.datatype = 128;
  fields.bitpix = 24;
  ExpectComponents(folder.Write("rgb.nii", Nifti(fields, Interleaved(3))), 3, "colour image");
  fields.datatype = 2304;
  fields.bitpix = 32;
  ExpectComponents(folder.Write("rgba.nii.gz", Gzip(Nifti(fields, Interleaved(4)))), 4, "colour image");
  // The fifth axis holds the values of a voxel, the fourth is time.
  fields.datatype = 4;
  fields.bitpix = 16;
  fields.dim = { 2, 2, 2, 1, 3 };
  ExpectComponents(folder.Write("vector.nii", Nifti(fields, OneAfterTheOther<std::int16_t>(3))), 3, "vectors");
  fields.dim = { 2, 2, 2, 2, 3 };
  std::string moments;
  for (int c = 0; c < 3; ++c)
  {
    moments += std::string(16, '\1') + OneAfterTheOther<std::int16_t>(3).substr(static_cast<std::size_t>(16 * c), 16);
  }
  const auto  path = folder.Write("moments.nii", Nifti(fields, moments));
  ReadOptions options;
  ExpectRefused(path, { "2 volumes" });
  options.volume = 1;
  ExpectRefused(path, { "--component" }, options);
  for (int c = 0; c < 3; ++c)
  {
    options.component = c;
    const auto expected = Component(c);
    EXPECT_EQ(AllValues(ReadLabelVolume(path, options)), std::vector<std::int64_t>(expected.begin(), expected.end()));
  }
}

TEST(Component, OfMetaImageChannels)
{
  const TempFolder         folder;
  std::vector<std::string> lines{ "NDims = 3",
                                  "DimSize = 2 2 2",
                                  "ElementType = MET_USHORT",
                                  "ElementNumberOfChannels = 3",
                                  "ElementSpacing = 1 1 1" };
  ExpectComponents(folder.Write("a.mha", Meta(lines, Interleaved<std::uint16_t>(3))), 3, "colour image or vectors");
  lines.emplace_back("BinaryDataByteOrderMSB = True");
  lines.emplace_back("CompressedData = True");
  ExpectComponents(folder.Write("b.mha", Meta(lines, Zlib(Interleaved<std::uint16_t>(3, 0, 8, true)))), 3, "colour");
  for (const char * count : { "0", "-1", "100000", "many" })
  {
    lines[3] = std::string("ElementNumberOfChannels = ") + count;
    ExpectRefused(folder.Write("c.mha", Meta(lines, Interleaved<std::uint16_t>(3))), { "ElementNumberOfChannels" });
  }
}

TEST(Component, OfTiffSamplesSideBySideAndInPlanesOfTheirOwn)
{
  const TempFolder folder;
  for (const int samples : { 2, 3, 4 })
  {
    for (const bool planar : { false, true })
    {
      std::vector<TiffPage> pages(2);
      for (std::size_t z = 0; z < 2; ++z)
      {
        pages[z].width = 2;
        pages[z].height = 2;
        pages[z].bits = 16;
        pages[z].samples = samples;
        pages[z].photometric = samples == 2 ? 1 : 2;
        pages[z].more = { { 284, planar ? 2U : 1U } };
        const std::string all =
          planar ? OneAfterTheOther<std::uint16_t>(samples, 4 * z, 4) : Interleaved<std::uint16_t>(samples, 4 * z, 4);
        pages[z].parts = { all };
        if (planar)
        {
          pages[z].parts.clear();
          for (int s = 0; s < samples; ++s)
          {
            pages[z].parts.push_back(all.substr(static_cast<std::size_t>(8 * s), 8));
          }
        }
      }
      ExpectComponents(folder.Write("a.tif", Tiff(pages)), samples, samples == 2 ? "several values" : "colour image");
      folder.Write("s/1.tif", Tiff({ pages[0] }));
      folder.Write("s/2.tif", Tiff({ pages[1] }));
      ExpectComponents(folder / "s", samples, samples == 2 ? "several values" : "colour image");
    }
  }
}

TEST(Component, OfPackedBitsInTiff)
{
  // Four bits, three values a pixel: (1,2,3) (4,5,6) in one row of 24 bits.
  const TempFolder      folder;
  std::vector<TiffPage> pages(2);
  for (TiffPage & page : pages)
  {
    page.width = 2;
    page.height = 1;
    page.bits = 4;
    page.samples = 3;
    page.photometric = 2;
    page.parts = { std::string("\x12\x34\x56", 3) };
  }
  const auto  path = folder.Write("a.tif", Tiff(pages));
  ReadOptions options;
  for (int c = 0; c < 3; ++c)
  {
    options.component = c;
    EXPECT_EQ(AllValues(ReadLabelVolume(path, options)), (std::vector<std::int64_t>{ 1 + c, 4 + c, 1 + c, 4 + c }));
  }
}

TEST(Component, OfPngColoursAndOpacity)
{
  const TempFolder folder;
  for (const auto & [colour, samples] : { std::pair(4, 2), std::pair(2, 3), std::pair(6, 4) })
  {
    for (const int bits : { 8, 16 })
    {
      for (const bool interlaced : { false, true })
      {
        for (std::size_t z = 0; z < 2; ++z)
        {
          PngImage image;
          image.width = 2;
          image.height = 2;
          image.bits = bits;
          image.colour = colour;
          image.interlaced = interlaced;
          for (const unsigned char c : Interleaved(samples, 4 * z, 4))
          {
            image.values.push_back(c);
          }
          folder.Write("s/" + std::to_string(z) + ".png", Png(image));
        }
        ExpectComponents(folder / "s", samples, samples == 2 ? "opacity" : "colour image");
      }
    }
  }
}

TEST(Component, OfOneValueAVoxelIsTheFirst)
{
  const TempFolder  folder;
  const std::string data = RawAll<std::uint8_t>(kBase);
  const std::vector paths{
    folder.Write("a.nrrd", Nrrd(NrrdLines("uchar", { 2, 2, 2 }), data)),
    folder.Write("a.mha", Meta({ "NDims = 3", "DimSize = 2 2 2", "ElementType = MET_UCHAR" }, data)),
  };
  ReadOptions options;
  for (const auto & path : paths)
  {
    options.component = 0;
    EXPECT_EQ(AllValues(ReadLabelVolume(path, options)), std::vector<std::int64_t>(kBase.begin(), kBase.end()));
    options.component = 1;
    ExpectRefused(path, { "no component 1" }, options);
  }
}
