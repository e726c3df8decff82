#pragma once
// One opener a format: its header is read and checked, its voxels are a stream. Which format a path has is told by its
// name. A format has an opener here only where ITK 5.2.1 takes its files for something else, or does not stream them
// (ItkShortcomingsGTest.cxx shows each; further rows are in ItkReadingTableGTest.cxx):
//   NRRD        units of length dropped, layers of segments lost, skewed axes taken; comes whole
//   NIfTI       a spacing of 0 becomes 1, units applied to half of the geometry, scaled values rounded; comes whole
//   MetaImage   no spacing becomes 1 mm; comes whole where it is packed
//   TIFF        no distance between slices, tiles become colours, pages counted with 16 bits; comes whole
//   LSM         crashes on thumbnails, metres are millimetres
//   MGH, NumPy, Zarr, precomputed, VTK in XML, bare voxels with a text beside them, folders of slices: unknown
// All else that ITK reads goes through it (ItkProcess.h).

#include "voxelcore/Formats/ScanFile.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace voxelcore
{

/** Each opener \throws InputError when the file is missing, damaged or unfit, UsageError for options without sense. */
ScanFile
OpenNrrd(const std::filesystem::path & path, const ReadOptions & options);
ScanFile
OpenNifti(const std::filesystem::path & path, const ReadOptions & options);
ScanFile
OpenMetaImage(const std::filesystem::path & path, const ReadOptions & options);
ScanFile
OpenMgh(const std::filesystem::path & path, const ReadOptions & options);
/** An array of NumPy's, .npy: the index that changes fastest is i. */
ScanFile
OpenNumpy(const std::filesystem::path & path, const ReadOptions & options);
/** Image data of VTK in XML, .vti; of several arrays options.dataset names one, else it is the active scalars. */
ScanFile
OpenVti(const std::filesystem::path & path, const ReadOptions & options);
ScanFile
OpenTiff(const std::filesystem::path & path, const ReadOptions & options);
/** Bare voxels, by options.raw or by a text beside them. */
ScanFile
OpenRaw(const std::filesystem::path & path, const ReadOptions & options);
/** Whether a text beside bare voxels says what they are, or the file is such a text (.dat). */
bool
IsRawFile(const std::filesystem::path & path);
/** That text, or for it the voxels. */
std::vector<std::filesystem::path>
RawFileTexts(const std::filesystem::path & path);
/** A picture, a folder, or a pattern in the last part of the path: `*` stands for anything, `%d`, `%04d` or a run of
 *  `#` for a number. */
ScanFile
OpenSlices(const std::filesystem::path & path, const ReadOptions & options);
/** A Zarr store, an image or an array in it. Only chunks that options.crop touches are read; beyond it voxels are 0. */
ScanFile
OpenZarr(const std::filesystem::path & path, const ReadOptions & options);
/** A volume of Neuroglancer's in a local folder ("precomputed"): raw or compressed_segmentation, packed by gzip or not,
 *  sharded or not. Only chunks that options.crop touches are read; beyond it voxels are 0. */
ScanFile
OpenPrecomputed(const std::filesystem::path & path, const ReadOptions & options);
/** Whether a folder holds one: it has a file `info` that speaks of scales. */
bool
IsPrecomputed(const std::filesystem::path & folder);
/** Its `info`, and chunks of the part that options choose. */
std::vector<std::filesystem::path>
PrecomputedFiles(const std::filesystem::path & path, const ReadOptions & options);
/** Whether a folder belongs to a Zarr store: it is read as a scan, and what lies in it is its own. */
bool
IsZarr(const std::filesystem::path & folder);
/** Whether the path names slices: a folder, or a pattern that is no file. */
bool
AreSlices(const std::filesystem::path & path);
/** The files besides `path` itself that hold its voxels, as its header names them. \throws InputError */
std::vector<std::filesystem::path>
NrrdDataFiles(const std::filesystem::path & path);
std::vector<std::filesystem::path>
MetaImageDataFiles(const std::filesystem::path & path);
std::vector<std::filesystem::path>
NiftiPartner(const std::filesystem::path & path);
/** Metadata and chunks of the part that options choose. */
std::vector<std::filesystem::path>
ZarrFiles(const std::filesystem::path & path, const ReadOptions & options);
/** Whether a folder holds a slice: a TIFF, PNG or BMP file, or JPEG files and, but for texts, nothing else. */
bool
HasSlices(const std::filesystem::path & folder);
/** The slices that a folder or pattern stands for, in natural order. */
std::vector<std::filesystem::path>
SlicePaths(const std::filesystem::path & path);

/** Kinds of scans, told by the extension. */
enum class ScanKind : std::uint8_t
{
  Nrrd,
  Nifti,
  MetaImage,
  Mgh,
  Numpy,
  Vti,
  Tiff,
  Picture, ///< one slice: .png .bmp .jpg
  Slices,
  Zarr,
  Precomputed,
  Unknown
};
ScanKind
ScanKindOf(const std::filesystem::path & path);

/** The libraries that read and write scans, as they are loaded: "libtiff 4.5.0", "libpng 1.6.39", ... */
std::vector<std::string>
FormatLibraries();

} // namespace voxelcore
