// Files of other formats: each refusal says what the file is and what makes a scan of it.

#include "ForeignBytes.h"
#include "ScanBytes.h"
#include "VoxelCoreTesting/Messages.h"
#include "voxelcore/ItkReader/ForeignFormats.h"

using namespace voxelcore;
using namespace voxelcore::testing;
using namespace std::string_literals;

namespace
{

std::string
At(std::size_t offset, const std::string & magic)
{
  return std::string(offset, '\0') + magic + std::string(64, '\0');
}

} // namespace

TEST(ForeignFormats, AreToldByTheirFirstBytesWhateverTheirName)
{
  struct Case
  {
    std::string              bytes;
    std::vector<std::string> texts;
  };
  const std::vector<Case> cases{
#ifdef VOXELCORE_TESTS_ITK // the helper is asked, who knows better
    { At(128, "DICM"), { "GDCM cannot read it" } },
    { At(208, "MAP "), { "276 of 1024 bytes" } },
    { At(0, "CDF\1"), { "MINCImageIO" } },
    { At(0, "\x89HDF\r\n\x1A\n"), { "HDF5", "damaged" } },
#else
    { At(128, "DICM"), { "DICOM file", "without ITK", "dcm2niix", "3D Slicer" } },
    { At(128, "DICM") + "1.2.840.10008.5.1.4.1.1.66.4", { "DICOM segmentation", "segimage2itkimage", "dcmqi" } },
    { At(128, "DICM") + "1.2.840.10008.5.1.4.1.1.481.3", { "RTSTRUCT", "SlicerRT" } },
    { At(208, "MAP "), { "MRC", "mrc2tif -s a.any a.tif", "IMOD" } },
    { At(0, "CDF\1"), { "MINC", "mnc2nii a.any a.nii" } },
    { At(0, "\x89HDF\r\n\x1A\n"), { "HDF5", "h5py" } },
#endif
    { At(0, "ZISRAWFILE"), { "CZI", "bfconvert a.any a.ome.tif" } },
    { At(0, "\xDA\xCE\xBE\x0A"), { "ND2", "bfconvert" } },
    { At(0, "\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1"), { "OIB", "TIFF" } },
    { At(0, "# AmiraMesh BINARY"), { "Amira", "Fiji" } },
    { At(0, "#INRIMAGE-4#{"), { "Inrimage", "tail -c +257 a.any > a.raw" } },
    { At(0, "CTDATA-HEADER_V1"), { "Scanco", "python3 -c" } },
    { At(0, "\x93NUMPY"), { "NumPy", "name it a.npy" } },
    { At(0, "MATLAB 5.0 MAT-file"), { "MATLAB", "scipy.io.loadmat('a.any')", "niftiwrite" } },
    { At(0, "MATLAB 7.3 MAT-file"), { "MATLAB", "h5py.File('a.any')" } },
    { At(0, "\xFF\xD8\xFF"), { "JPEG", "changes labels" } },
    { At(0, "NRRD0004"), { "name it a.nrrd" } },
    { At(344, "n+1\0"s), { "name it a.nii" } },
    { At(0, "II*\0"s), { "name it a.tif" } },
    { At(0, "PK\3\4"), { "ZIP", "unpack" } },
    { At(0, "\x1F\x8B"), { "unknown kind of scan", ".nrrd" } },
    { At(0, "nothing known"), { "unknown kind of scan", ".nrrd" } },
  };
  const TempFolder folder;
  for (const Case & one : cases)
  {
    ExpectRefused(folder.Write("a.any", one.bytes), one.texts);
  }
}

TEST(ForeignFormats, AreToldByTheirExtensionWhereBytesSayNothing)
{
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases{
#ifdef VOXELCORE_TESTS_ITK
    { "a.dcm", { "GDCM cannot read it" } },
    { "a.mrc", { "of 1024 bytes" } },
    { "a.mnc", { "ITK" } },
    { "a.gipl", { "GiplImageIO does not know it" } },
    { "a.h5", { "HDF5", "damaged" } },
#else
    { "a.dcm", { "DICOM file", "dcm2niix" } },
    { "a.mrc", { "MRC" } },
    { "a.mnc", { "MINC" } },
    { "a.gipl", { "GIPL", "c3d a.gipl -o a.nii.gz" } },
    { "a.h5", { "HDF5" } },
#endif
    { "a.mgz", { "FreeSurfer", "truncated" } },
    { "a.MGH", { "FreeSurfer", "truncated" } },
    { "a.rec", { "PAR/REC", "MRC" } },
    { "a.vti", { "line 1", "damaged" } },
    { "a.czi", { "CZI" } },
    { "a.lif", { "LIF", "bfconvert" } },
    { "a.nd2", { "ND2" } },
    { "a.oib", { "OIB" } },
    { "a.am", { "Amira" } },
    { "a.npy", { "NumPy", "numpy.save" } },
    { "a.npz", { "NumPy", "numpy.save('a.npy', numpy.load('a.npz')" } },
    { "a.mat", { "MATLAB" } },
    { "a.jpg", { "JPEG" } },
    { "a.bmp", { "not a BMP picture" } },
    { "a.raw", { "a.nhdr", "sizes: 512 512 300", "data file: a.raw" } },
    { "a.png", { "PNG" } },
  };
  const TempFolder folder;
  for (const auto & [name, texts] : cases)
  {
    ExpectRefused(folder.Write(name, "some bytes that no format begins with"), texts);
  }
  ExpectRefused(folder.Write("c.nrrd.gz", Gzip("NRRD0004")), { "gzip file", "unpack" });
}

TEST(ForeignFormats, TheHeaderShownForBareVoxelsIsOne)
{
  // The lines that the refusal of a .raw file shows, with true sizes, make a scan of it.
  const TempFolder folder;
  folder.Write("a.raw", std::string("\1\0\0\1\1\0\0\0", 8));
  const auto header = folder.Write("a.nhdr",
                                   "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nspacings: 0.02 0.02 0.02\n"
                                   "encoding: raw\nendian: little\ndata file: a.raw\n");
  EXPECT_EQ(AllValues(ReadLabelVolume(header)), (std::vector<std::int64_t>{ 1, 0, 0, 1, 1, 0, 0, 0 }));
}

TEST(ForeignFormats, FoldersWithoutSlicesSayWhatTheyHold)
{
  const TempFolder folder;
  folder.Write("series/IM0001", At(128, "DICM"));
#ifdef VOXELCORE_TESTS_ITK
  ExpectRefused(folder / "series", { "no DICOM file in this folder that GDCM can read" });
#else
  ExpectRefused(folder / "series", { "DICOM", "dcm2niix -z y -o OUT series" });
#endif
  folder.Write("photos/a.jpg", At(0, "\xFF\xD8\xFF"));
  ExpectRefused(folder / "photos", { "a.jpg", "TIFF or PNG" });
  folder.Write("a.n5/attributes.json", "{}");
  ExpectRefused(folder / "a.n5", { "N5", "Fiji" });
  folder.Write("text/readme.txt", "nothing");
  ExpectRefused(folder / "text", { "no TIFF, PNG, BMP or JPEG slices" });
}

// What is said where nobody reads a file, as in a build without ITK.
TEST(ForeignFormats, RefusedSayWhatTheyAreAndWhoReadsThem)
{
  const TempFolder folder;
  const auto       refusal = [](const std::filesystem::path & path) { return MessageOf([&] { RefuseForeign(path); }); };
  const auto       holds = [](const std::string & message, const std::string & text) {
    EXPECT_NE(message.find(text), std::string::npos) << message;
  };
  holds(refusal(folder.Write("a", At(128, "DICM"))), "DICOM file, which this build, without ITK, does not read");
  holds(refusal(folder.Write("a", At(128, "DICM") + "1.2.840.10008.5.1.4.1.1.66.4")),
        "segimage2itkimage --inputDICOM a");
  holds(refusal(folder.Write("a", At(128, "DICM") + "1.2.840.10008.5.1.4.1.1.481.3")), "RTSTRUCT");
  holds(refusal(folder.Write("a.czi", At(0, "ZISRAWFILE"))), "not read directly");
  holds(refusal(folder.Write("a.b.gz", Gzip("x"))), "gzip file");
  holds(refusal(folder.Write("a.gz", "not packed")), "gzip file");
  holds(refusal(folder.Write("a.xyz", "")), "unknown kind of scan");
  holds(refusal(folder / "nowhere"), "unknown kind of scan");
  folder.Write("study/2dseq", "voxels");
  holds(refusal(folder / "study/2dseq"), "unknown kind of scan");
  folder.Write("study/visu_pars", "##TITLE");
  holds(refusal(folder / "study/2dseq"), "Bruker");
  EXPECT_NE(MessageOf([&] { RefuseForeignFolder(folder / "study"); }).find("Bruker"), std::string::npos);
  folder.Write("series/IM0001", At(128, "DICM"));
  for (const char * name : { "series", "series/" })
  {
    holds(MessageOf([&] { RefuseForeignFolder(folder / name); }), "dcm2niix -z y -o OUT series'");
  }
  EXPECT_NO_THROW(RefuseForeignFolder(folder / "nowhere"));
}

TEST(ForeignFormats, AFolderIsDicomByItsFirstFilesThatAreNotHidden)
{
  const TempFolder folder;
  folder.Write("s/.IM0", At(128, "DICM"));
  std::filesystem::create_directories(folder / "s/a");
  EXPECT_FALSE(IsDicomFolder(folder / "s"));
  folder.Write("s/z", At(128, "DICM"));
  EXPECT_TRUE(IsDicomFolder(folder / "s"));
  for (const char * name : { "b", "c", "d", "e", "f", "g", "h", "i" })
  {
    folder.Write(std::string("s/") + name, "text");
  }
  EXPECT_FALSE(IsDicomFolder(folder / "s"));
  EXPECT_FALSE(IsDicomFolder(folder / "nowhere"));
}

TEST(ForeignFormats, AFileOfVtkIsAnImageByTheLineThatNamesItsDataset)
{
  const TempFolder folder;
  const auto       is = [&](const std::string & name, const std::string & bytes) {
    return IsVtkImage(folder.Write(name, bytes));
  };
  EXPECT_TRUE(is("a.vtk", VtkBytes(true)));
  EXPECT_TRUE(is("a.VTK", VtkBytes(false)));
  EXPECT_FALSE(is("a.mha", VtkBytes(true)));
  EXPECT_FALSE(is("a.vtk", "# vtk DataFile Version 3.0\nDATASET STRUCTURED_POINTS\nASCII\nDATASET POLYDATA\n"));
  EXPECT_FALSE(is("a.vtk", "# vtk DataFile Version 3.0\na mesh\nASCII\nDATASET\nDATASET STRUCTURED_POINTS of cells\n"));
  EXPECT_FALSE(is("a.vtk", "# vtk DataFile Version 3.0"));
  EXPECT_FALSE(is("a.vtk", std::string(20, '\n') + "DATASET STRUCTURED_POINTS\n"));
  EXPECT_FALSE(IsVtkImage(folder / "nowhere.vtk"));
}
