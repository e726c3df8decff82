#include "voxelcore/Formats/FormatOpeners.h"
#include "NrrdFixtures.h"

#include <map>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

const std::string kBytes = RawAll<std::uint8_t>(nrrd::kValues);

TiffPage
Page(std::size_t k)
{
  TiffPage page;
  page.width = 3;
  page.height = 2;
  page.parts = { kBytes.substr(6 * k, 6) };
  return page;
}

/** The voxels as they are stored. */
std::string
VoxelsOf(ScanFile scan)
{
  std::string bytes(kBytes.size() * PixelBytes(scan.type), '?');
  scan.voxels->Read(reinterpret_cast<std::byte *>(bytes.data()), bytes.size());
  return bytes;
}

} // namespace

TEST(FormatOpeners, EachGivesTheSameSizeAndVoxels)
{
  const TempFolder folder;
  folder.Write("slices/a9.tif", Tiff({ Page(0) }));
  folder.Write("slices/a10.tif", Tiff({ Page(1) }));
  ReadOptions bare;
  bare.raw = ParseRawLayout("3,2,2,uint8");
  std::map<std::string, ScanFile> scans;
  scans["NRRD"] = OpenNrrd(folder.Write("a.nrrd", Nrrd(nrrd::Lines(), kBytes)), {});
  scans["NIfTI"] = OpenNifti(folder.Write("a.nii.gz", Gzip(Nifti({ .dim = { 3, 2, 2 } }, kBytes))), {});
  scans["MetaImage"] =
    OpenMetaImage(folder.Write("a.mha", Meta({ "NDims = 3", "DimSize = 3 2 2", "ElementType = MET_UCHAR" }, kBytes)),
                  {});
  scans["TIFF"] = OpenTiff(folder.Write("a.tif", Tiff({ Page(0), Page(1) })), {});
  scans["slices"] = OpenSlices(folder / "slices", {});
  scans["raw"] = OpenRaw(folder.Write("a.raw", kBytes), bare);
  for (auto & [format, scan] : scans)
  {
    SCOPED_TRACE(format);
    EXPECT_EQ(scan.geometry.size, (std::array<std::int64_t, 3>{ 3, 2, 2 }));
    EXPECT_EQ(scan.type, PixelType::UInt8);
    EXPECT_FALSE(scan.format.empty());
    EXPECT_EQ(VoxelsOf(std::move(scan)), kBytes);
  }
}

TEST(FormatOpeners, RefuseAFileOfAnotherFormat)
{
  const TempFolder folder;
  const auto       path = folder.Write("a", "this is a letter and no scan, however long one looks at it " + kBytes);
  for (const auto open : { OpenNrrd, OpenNifti, OpenMetaImage, OpenMgh, OpenTiff })
  {
    EXPECT_THROW(open(path, {}), InputError);
    EXPECT_THROW(open(folder / "nowhere", {}), InputError);
  }
  EXPECT_THROW(OpenSlices(folder.Path(), {}), InputError);
  EXPECT_THROW(OpenZarr(folder.Path(), {}), InputError);
}

TEST(FormatOpeners, AKindIsToldByTheNameInAnyCase)
{
  const TempFolder folder;
  for (const auto & [name, kind] : std::map<std::string, ScanKind>{ { "a.nrrd", ScanKind::Nrrd },
                                                                    { "a.seg.NRRD", ScanKind::Nrrd },
                                                                    { "a.nhdr", ScanKind::Nrrd },
                                                                    { "a.nii", ScanKind::Nifti },
                                                                    { "a.Nii.Gz", ScanKind::Nifti },
                                                                    { "a.img.gz", ScanKind::Nifti },
                                                                    { "a.mha", ScanKind::MetaImage },
                                                                    { "a.mhd", ScanKind::MetaImage },
                                                                    { "a.mgz", ScanKind::Mgh },
                                                                    { "a.npy", ScanKind::Numpy },
                                                                    { "a.TIFF", ScanKind::Tiff },
                                                                    { "a.tif", ScanKind::Tiff },
                                                                    { "a.png", ScanKind::Picture },
                                                                    { "a.nii.zip", ScanKind::Unknown },
                                                                    { "nrrd", ScanKind::Unknown },
                                                                    { "a.dcm", ScanKind::Unknown },
                                                                    { "slice_*.png", ScanKind::Slices },
                                                                    { "s%04d.tif", ScanKind::Slices },
                                                                    { "s###.tif", ScanKind::Slices } })
  {
    EXPECT_EQ(ScanKindOf(folder / name), kind) << name;
  }
  EXPECT_EQ(ScanKindOf(folder.Path()), ScanKind::Slices);
  folder.Write("store/.zgroup", R"({"zarr_format":2})");
  EXPECT_TRUE(IsZarr(folder / "store"));
  EXPECT_EQ(ScanKindOf(folder / "store"), ScanKind::Zarr);
  EXPECT_FALSE(IsZarr(folder.Path()));
}

TEST(FormatOpeners, SlicesComeInNaturalOrderAndHiddenFilesAreNone)
{
  const TempFolder folder;
  EXPECT_FALSE(HasSlices(folder.Path()));
  EXPECT_FALSE(HasSlices(folder / "nowhere"));
  folder.Write(".a1.tif", "");
  folder.Write("notes.txt", "");
  EXPECT_FALSE(HasSlices(folder.Path()));
  for (const char * name : { "a10.tif", "a2.tif", "a9.TIF" })
  {
    folder.Write(name, "");
  }
  EXPECT_TRUE(HasSlices(folder.Path()));
  EXPECT_EQ(SlicePaths(folder.Path()),
            (std::vector<std::filesystem::path>{ folder / "a2.tif", folder / "a9.TIF", folder / "a10.tif" }));
}

TEST(FormatOpeners, DetachedHeadersNameTheirData)
{
  const TempFolder folder;
  folder.Write("a.raw", kBytes);
  auto lines = nrrd::Lines();
  lines.push_back("data file: a.raw");
  EXPECT_EQ(NrrdDataFiles(folder.Write("a.nhdr", Nrrd(lines, {}))),
            std::vector<std::filesystem::path>{ folder / "a.raw" });
  EXPECT_FALSE(IsRawFile(folder / "a.raw"));
  const std::string meta = "NDims = 3\nDimSize = 3 2 2\nElementType = MET_UCHAR\nElementDataFile = a.raw\n";
  EXPECT_EQ(MetaImageDataFiles(folder.Write("a.mhd", meta)), std::vector<std::filesystem::path>{ folder / "a.raw" });
  folder.Write("b.img", kBytes);
  const auto pair = folder.Write("b.hdr", Nifti({ .pair = true, .dim = { 3, 2, 2 } }, {}));
  EXPECT_EQ(NiftiPartner(pair), std::vector<std::filesystem::path>{ folder / "b.img" });
  folder.Write("c.raw", kBytes);
  folder.Write("c.txt", "DimSize = 3 2 2\nElementType = MET_UCHAR\n");
  EXPECT_TRUE(IsRawFile(folder / "c.raw"));
  EXPECT_EQ(RawFileTexts(folder / "c.raw"), std::vector<std::filesystem::path>{ folder / "c.txt" });
}

TEST(FormatOpeners, LibrariesAreNamedWithTheirVersions)
{
  const auto libraries = FormatLibraries();
  for (const char * name : { "libtiff ", "libpng ", "zlib " })
  {
    const auto found = std::find_if(libraries.begin(), libraries.end(), [&](const std::string & library) {
      return library.starts_with(name);
    });
    ASSERT_NE(found, libraries.end()) << name;
    EXPECT_NE(found->find('.'), std::string::npos) << *found;
  }
}
