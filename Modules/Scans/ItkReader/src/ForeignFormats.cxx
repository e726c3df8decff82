#include "voxelcore/ItkReader/ForeignFormats.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/FormatOpeners.h"

#include <algorithm>
#include <array>
#include <fstream>

namespace voxelcore
{
namespace
{

using namespace std::string_view_literals;

struct ForeignFormat
{
  std::string_view extensions; ///< each between blanks, without the dot
  std::size_t      at;         ///< where the magic stands
  std::string_view magic;      ///< empty: told by the extension alone
  std::string_view what;
  std::string_view advice;                ///< {file} stands for its name, {stem} for that without the extension
  ItkFormat        itk = ItkFormat::None; ///< what the helper reads it as
  bool             andExtension = false;  ///< the magic is that of others, too
};

constexpr std::string_view kDicomSegmentation = "1.2.840.10008.5.1.4.1.1.66.4"sv;
constexpr std::string_view kDicomContours = "1.2.840.10008.5.1.4.1.1.481.3"sv;
constexpr std::string_view kDicomAdvice =
  "convert its series with 'dcm2niix -z y -o OUT FOLDER', or load it in 3D Slicer and save it as .nrrd"sv;
constexpr std::string_view kBioFormats = "convert it with 'bfconvert {file} {stem}.ome.tif' of Bio-Formats"sv;
constexpr std::string_view kJpeg2000 =
  "a volume is needed, and only lossless ones keep labels: 'opj_decompress -ImgDir SLICES -OutFor TIF', then name the "
  "folder"sv;
// Lines for files that are voxels behind a header; foreign_lines_test.py runs each.
constexpr std::string_view kAmira =
  R"~(run python3 -c "d = open('{file}', 'rb').read(); )~"
  R"~(open('{stem}.raw', 'wb').write(d[d.rindex(b'\n@1\n') + 4:-1])" and )~"
  "give {stem}.raw with --raw X,Y,Z,uint8, the sides as its 'define Lattice' has them; where that says HxByteRLE, "
  "save it as TIFF in Amira, or open it in Fiji"sv;
constexpr std::string_view kInrimage =
  "run tail -c +257 {file} > {stem}.raw and give {stem}.raw with --raw XDIM,YDIM,ZDIM,uint8 and --spacing VX,VY,VZ "
  "as its first lines say"sv;
constexpr std::string_view kDgtalVol =
  R"~(run python3 -c "import zlib; d = open('{file}', 'rb').read(); v = d[d.index(b'\n.\n') + 3:]; )~"
  R"~(open('{stem}.raw', 'wb').write(zlib.decompress(v) if b'Version: 3' in d[:500] else v)" and )~"
  "give {stem}.raw with --raw X,Y,Z,uint8 as its first lines say"sv;
constexpr std::string_view kScanco =
  R"~(run python3 -c "import numpy; d = open('{file}', 'rb').read(); n = numpy.frombuffer(d, '<i4', 128); )~"
  R"~(numpy.save('{stem}.npy', numpy.frombuffer(d, '<i2', offset=512 * (n[127] + 1)).reshape(n[13:10:-1])); )~"
  R"~(print('--spacing %gum,%gum,%gum' % tuple(n[14:17] / n[11:14]))" (Debian: python3-numpy) )~"
  "and give {stem}.npy with what it prints"sv;
constexpr std::string_view kMatlab =
  R"~(run python3 -c "import numpy, scipy.io; numpy.save('{stem}.npy', scipy.io.loadmat('{file}')['NAME'])" with the )~"
  "variable's name (Debian: python3-scipy) and give {stem}.npy, or write it from MATLAB with niftiwrite(labels, "
  "'{stem}.nii')"sv;
constexpr std::string_view kMatlab73 =
  R"~(run python3 -c "import h5py, numpy; numpy.save('{stem}.npy', h5py.File('{file}')['NAME'][()])" with the )~"
  "variable's name (Debian: python3-h5py) and give {stem}.npy"sv;
constexpr std::string_view kN5 =
  R"~(run python3 -c "import numpy, zarr; )~"
  R"~(numpy.save('labels.npy', zarr.open(zarr.N5Store('{file}'), 'r')['NAME'][:])" )~"
  "with the dataset's name (Debian: python3-zarr) and give labels.npy, or open it in Fiji and save its labels as "
  "TIFF"sv;
constexpr std::string_view kUnpack = "unpack it and give what is in it"sv;

/** The first that fits is taken: magics before extensions. */
constexpr std::array kFormats{
  ForeignFormat{ " dcm dicom ima ", 128, "DICM"sv, "DICOM file", kDicomAdvice, ItkFormat::Dicom },
  ForeignFormat{ " mrc map st ali ccp4 ",
                 208,
                 "MAP "sv,
                 "MRC map",
                 "convert it with 'mrc2tif -s {file} {stem}.tif' of IMOD, or open it in Fiji and save it as TIFF",
                 ItkFormat::Mrc },
  ForeignFormat{ " mnc ",
                 0,
                 "CDF\1"sv,
                 "MINC volume",
                 "convert it with 'mnc2nii {file} {stem}.nii' of the MINC tools",
                 ItkFormat::Minc },
  ForeignFormat{ " mnc ",
                 0,
                 "\x89HDF\r\n\x1A\n"sv,
                 "MINC volume",
                 "convert it with 'mnc2nii {file} {stem}.nii' of the MINC tools",
                 ItkFormat::Minc,
                 true },
  ForeignFormat{ " mnc ",
                 SIZE_MAX,
                 ""sv,
                 "MINC volume",
                 "convert it with 'mnc2nii {file} {stem}.nii' of the MINC tools",
                 ItkFormat::Minc },
  ForeignFormat{ " h5 hdf5 ims hdf nxs ilp ",
                 0,
                 "\x89HDF\r\n\x1A\n"sv,
                 "HDF5 file",
                 "export its labels as TIFF: from the program that wrote it, from Fiji, or with h5py and tifffile",
                 ItkFormat::Hdf5 },
  ForeignFormat{ " vtk ",
                 0,
                 "# vtk DataFile"sv,
                 "VTK image",
                 "load it in 3D Slicer and save it as .nrrd, or in ParaView and save it as Meta Image .mhd",
                 ItkFormat::Vtk },
  ForeignFormat{ " czi ", 0, "ZISRAWFILE"sv, "Zeiss CZI file", kBioFormats },
  ForeignFormat{ " nd2 ", 0, "\xDA\xCE\xBE\x0A"sv, "Nikon ND2 file", kBioFormats },
  ForeignFormat{ " lif ", SIZE_MAX, ""sv, "Leica LIF file", kBioFormats },
  ForeignFormat{ " txm txrm oib ",
                 0,
                 "\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1"sv,
                 "file of a microscope (Zeiss TXM, Olympus OIB)",
                 "export it as TIFF from the microscope's program or from Fiji (Bio-Formats)" },
  ForeignFormat{ " am ", 0, "# AmiraMesh"sv, "Amira file", kAmira },
  ForeignFormat{ " am ", 0, "# Avizo"sv, "Avizo file", kAmira },
  ForeignFormat{ " inr ", 0, "#INRIMAGE-4#"sv, "Inrimage", kInrimage },
  ForeignFormat{ " vol ", 0, "X: "sv, "volume of DGtal", kDgtalVol, ItkFormat::None, true },
  ForeignFormat{ " vol ", 0, "Center-X: "sv, "volume of DGtal", kDgtalVol, ItkFormat::None, true },
  ForeignFormat{ " isq rsq ", 0, "CTDATA-HEADER_V1"sv, "Scanco file", kScanco },
  ForeignFormat{ " aim ",
                 SIZE_MAX,
                 ""sv,
                 "Scanco AIM file",
                 "convert it with ITK's module IOScanco (Python: pip install itk-ioscanco) to .nrrd, or export it as "
                 "TIFF" },
  ForeignFormat{ "", 0, "\x93NUMPY"sv, "NumPy array of another extension", "name it {stem}.npy" },
  ForeignFormat{ " npz ",
                 SIZE_MAX,
                 ""sv,
                 "archive of NumPy arrays",
                 "save the one with the labels: numpy.save('{stem}.npy', numpy.load('{file}')['name'])" },
  ForeignFormat{ " mat ", 0, "MATLAB 7.3"sv, "MATLAB file (7.3)", kMatlab73 },
  ForeignFormat{ " mat ", 0, "MATLAB "sv, "MATLAB file", kMatlab },
  ForeignFormat{ " jpg jpeg ",
                 0,
                 "\xFF\xD8\xFF"sv,
                 "JPEG picture",
                 "a volume is needed, and JPEG changes labels: save slices as TIFF or PNG and name their folder" },
  ForeignFormat{ " gif ", 0, "GIF8"sv, "2-D picture", "save slices as TIFF or PNG and name their folder" },
  ForeignFormat{ " jp2 jpx ", 0, "\0\0\0\x0CjP  \r\n\x87\n"sv, "JPEG 2000 picture", kJpeg2000 },
  ForeignFormat{ " j2k j2c jpc ", 0, "\xFF\x4F\xFF\x51"sv, "JPEG 2000 picture", kJpeg2000 },
  ForeignFormat{ "", 0, "NRRD0"sv, "NRRD file of another extension", "name it {stem}.nrrd" },
  ForeignFormat{ "", 344, "n+1\0"sv, "NIfTI file of another extension", "name it {stem}.nii" },
  ForeignFormat{ "", 0, "II*\0"sv, "TIFF file of another extension", "name it {stem}.tif, or open it in Fiji" },
  ForeignFormat{ "", 0, "MM\0*"sv, "TIFF file of another extension", "name it {stem}.tif, or open it in Fiji" },
  ForeignFormat{ "", 0, "II+\0"sv, "TIFF file of another extension", "name it {stem}.tif, or open it in Fiji" },
  ForeignFormat{ "", 0, "\x89PNG"sv, "2-D picture", "name the folder of slices, or a pattern such as slice_*.png" },
  ForeignFormat{ " zip ", 0, "PK\3\4"sv, "ZIP archive", kUnpack },
  ForeignFormat{ " gz tgz ", 0, "\x1F\x8B"sv, "gzip file", kUnpack },
  ForeignFormat{ " 7z ", 0, "7z\xBC\xAF"sv, "7-Zip archive", kUnpack },
  ForeignFormat{ " bz2 ", 0, "BZh"sv, "bzip2 file", kUnpack },
  ForeignFormat{ " xz ",
                 0,
                 "\xFD"
                 "7zXZ"sv,
                 "xz file",
                 kUnpack },
  ForeignFormat{ " tar ", SIZE_MAX, ""sv, "archive", kUnpack },
  ForeignFormat{ " vti vtr vtk pvti ",
                 SIZE_MAX,
                 ""sv,
                 "VTK image",
                 "load it in 3D Slicer and save it as .nrrd, or in ParaView and save it as Meta Image .mhd" },
  ForeignFormat{ " gipl gipl.gz ",
                 SIZE_MAX,
                 ""sv,
                 "GIPL volume",
                 "convert it with 'c3d {file} -o {stem}.nii.gz' (Convert3D), or save it as .nii.gz in ITK-SNAP",
                 ItkFormat::Gipl },
  ForeignFormat{ " oif vsi stk ndpi svs scn dv r3d lei zvi ", SIZE_MAX, ""sv, "microscope file", kBioFormats },
  ForeignFormat{ " n5 ", SIZE_MAX, ""sv, "N5 store", kN5 },
  ForeignFormat{ " par rec ",
                 SIZE_MAX,
                 ""sv,
                 "Philips PAR/REC or MRC volume",
                 "convert it with dcm2niix (PAR/REC) or 'mrc2tif -s' of IMOD (MRC)" },
  ForeignFormat{
    " raw vol bin dat ",
    SIZE_MAX,
    ""sv,
    "bare voxels without a header",
    "say what they are with --raw, such as --raw 512,512,300,uint16 and --spacing 0.02,0.02,0.02, or write {stem}.nhdr "
    "beside it with these eight lines, its own type, sizes and spacings in them, and "
    "give that: 'NRRD0004', 'type: uint8', 'dimension: 3', 'sizes: 512 512 300', 'spacings: 0.02 0.02 0.02', "
    "'encoding: raw', 'endian: little', 'data file: {file}'" },
  ForeignFormat{ " npz pkl pt ",
                 SIZE_MAX,
                 ""sv,
                 "Python data",
                 "write the array with tifffile, or use the Python module voxelcore" },
  ForeignFormat{ " webp heic ", SIZE_MAX, ""sv, "2-D picture", "save slices as TIFF or PNG and name their folder" },
};

/** Bruker's 2dseq has no extension and no magic: visu_pars beside it says what it is. */
void
RefuseBruker(const std::filesystem::path & file)
{
  std::error_code ignored;
  if (file.filename() == "2dseq" && std::filesystem::exists(file.parent_path() / "visu_pars", ignored))
  {
    RefuseInput(file,
                "images of a Bruker scanner (2dseq), not read directly",
                "convert the folder of the study with 'brkraw tonii' or Bru2Nii");
  }
}

std::string
Filled(std::string_view advice, const std::filesystem::path & path)
{
  std::string text(advice);
  // Who copies a line must not run what a name says.
  const auto plain = [](const std::string & name, const char * otherwise) {
    return name.find_first_of("'\"\\`$;&|<>(){}*?! \t") == std::string::npos ? Printable(name, 200) : otherwise;
  };
  const std::pair<std::string_view, std::string> words[] = { { "{file}", plain(path.filename().string(), "FILE") },
                                                             { "{stem}", plain(path.stem().string(), "OUT") } };
  for (const auto & [word, name] : words)
  {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + name.size()))
    {
      text.replace(at, word.size(), name);
    }
  }
  return text;
}

std::string
FirstBytes(const std::filesystem::path & path)
{
  std::string   bytes(1U << 16, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, file.gcount())));
  return bytes;
}

const ForeignFormat *
FindFormat(const std::filesystem::path & path, std::string_view bytes)
{
  const std::string extension = LowerCase(path.extension().string());
  const std::string before = extension == ".gz" ? LowerCase(path.stem().extension().string()) : std::string();
  std::string       word = extension.empty() ? std::string() : Text(" ", (before + extension).substr(1), " ");
  const auto        has = [&](const ForeignFormat & format) {
    return !word.empty() && format.extensions.find(word) != std::string_view::npos;
  };
  const auto is = [&](const ForeignFormat & format) {
    // A short magic may stand anywhere by chance.
    return !format.magic.empty() && bytes.size() > format.at && bytes.substr(format.at).starts_with(format.magic) &&
           ((format.magic.size() > 2 && !format.andExtension) || has(format));
  };
  // A gzip-packed file is what its extension says, if that says anything.
  const bool packed = bytes.starts_with("\x1F\x8B"sv);
  auto       found = packed ? kFormats.end() : std::find_if(kFormats.begin(), kFormats.end(), is);
  if (found == kFormats.end())
  {
    found = std::find_if(kFormats.begin(), kFormats.end(), has);
  }
  if (found == kFormats.end() && !before.empty())
  {
    word = " gz ";
    found = std::find_if(kFormats.begin(), kFormats.end(), has);
  }
  return found == kFormats.end() ? nullptr : &*found;
}

/** The first files of a folder by name: they tell what it holds. */
std::vector<std::filesystem::path>
FirstFiles(const std::filesystem::path & folder)
{
  std::error_code                    ignored;
  std::vector<std::filesystem::path> files;
  for (const auto & entry : std::filesystem::directory_iterator(folder, ignored))
  {
    if (entry.is_regular_file(ignored) && !entry.path().filename().string().starts_with('.'))
    {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  files.resize(std::min<std::size_t>(files.size(), 8));
  return files;
}

} // namespace

ItkFormat
ItkFormatOf(const std::filesystem::path & path)
{
  const ForeignFormat * format = FindFormat(path, FirstBytes(path));
  return format == nullptr ? ItkFormat::None : format->itk;
}

bool
IsVtkImage(const std::filesystem::path & path)
{
  if (LowerCase(path.extension().string()) != ".vtk")
  {
    return false;
  }
  const std::string bytes = FirstBytes(path);
  std::size_t       at = 0;
  for (int line = 0; line < 8 && at < bytes.size(); ++line)
  {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    const auto        words = Words(Trim(std::string_view(bytes).substr(at, end - at)));
    if (line > 1 && words.size() == 2 && words[0] == "DATASET")
    {
      return words[1] == "STRUCTURED_POINTS";
    }
    at = end + 1;
  }
  return false;
}

bool
IsDicomFolder(const std::filesystem::path & path)
{
  const auto isDicom = [](const auto & file) { return ItkFormatOf(file) == ItkFormat::Dicom; };
  return !HasSlices(path) && ranges::any_of(FirstFiles(path), isDicom);
}

void
RefuseForeign(const std::filesystem::path & path)
{
  RefuseBruker(path);
  const std::string bytes = FirstBytes(path);
  if (const ForeignFormat * format = FindFormat(path, bytes))
  {
    if (format->magic == "DICM" && bytes.find(kDicomSegmentation) != std::string::npos)
    {
      RefuseInput(
        path,
        "DICOM segmentation, which this build, without ITK, does not read",
        Filled("convert it with 'segimage2itkimage --inputDICOM {file} --outputType nrrd --outputDirectory OUT' of "
               "dcmqi",
               path));
    }
    if (format->magic == "DICM" && bytes.find(kDicomContours) != std::string::npos)
    {
      RefuseInput(path, "DICOM contours (RTSTRUCT), not read", "load them in 3D Slicer (SlicerRT) and save .seg.nrrd");
    }
    RefuseInput(
      path,
      Text(format->what,
           format->itk == ItkFormat::None ? ", not read directly" : ", which this build, without ITK, does not read"),
      Filled(format->advice, path));
  }
  RefuseInput(path,
              "unknown kind of scan",
              "give .nrrd .nhdr .nii .nii.gz .hdr .img .mha .mhd .tif .tiff, or a folder of TIFF, PNG or DICOM slices");
}

void
RefuseForeignFolder(const std::filesystem::path & path)
{
  std::error_code ignored;
  if (std::filesystem::exists(path / "attributes.json", ignored))
  {
    RefuseInput(path, "N5 store, not read directly", Filled(kN5, path.has_filename() ? path : path.parent_path()));
  }
  RefuseBruker(path / "2dseq");
  for (const auto & file : FirstFiles(path))
  {
    const ForeignFormat * format = FindFormat(file, FirstBytes(file));
    if (format != nullptr && format->magic == "DICM")
    {
      RefuseInput(path,
                  "folder of DICOM files, which this build, without ITK, does not read",
                  Filled("convert it with 'dcm2niix -z y -o OUT {file}', or load it in 3D Slicer and save it as .nrrd",
                         path.has_filename() ? path : path.parent_path()));
    }
    if (format != nullptr && format->what.ends_with("picture"))
    {
      RefuseInput(path,
                  Text("folder of pictures not read directly ('", Printable(file.filename().string()), "')"),
                  "save the slices as TIFF or PNG");
    }
  }
}

} // namespace voxelcore
