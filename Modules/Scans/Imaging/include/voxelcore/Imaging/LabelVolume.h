#pragma once
// Label volumes: segmented scans as files, read and written.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Formats/ReadOptions.h"
#include "voxelcore/Labels/LabelMap.h"

#include <filesystem>
#include <vector>

namespace voxelcore
{

/** Reads the labels of a scan in one pass over its voxels:
 *  - NRRD (.nrrd, .nhdr; raw, gzip, bzip2, ascii, hex; data detached, listed or by pattern) with the names and
 *    overlapping layers of .seg.nrrd;
 *  - NIfTI-1 and -2 (.nii, .nii.gz, .hdr/.img, .hdr.gz/.img.gz);
 *  - MetaImage (.mha, .mhd; raw, compressed, text);
 *  - TIFF (.tif, .tiff; many pages, BigTIFF, tiles, packed bits, any compression of libtiff);
 *  - LSM of Zeiss microscopes (.lsm);
 *  - bare voxels (.raw .vol .bin .dat) with options.raw, or with a text beside them: a .dat with Resolution,
 *    SliceThickness and Format (OpenQVis, North Star), or lines as of MetaImage in .mhd, .txt or .info;
 *  - through ITK and GDCM, by a program of its own: DICOM series, multi-frame images and segmentations, MRC, MINC,
 *    GIPL, legacy VTK images, and HDF5;
 *  - slices, one TIFF, PNG or BMP each (grey, 1 to 16 bits), or a single one: a folder, or a pattern in the last part
 *    of the path, where `*` stands for anything and `%d`, `%04d` or a run of `#` for a number. They come in natural
 *    order (2 before 10) and must be numbered without a gap. The log of SkyScan's reconstruction gives the voxel size;
 *  - a folder of masks on one grid, one volume a structure: labels named as the files, which may overlap;
 *  - NumPy arrays (.npy), of which the index that changes fastest is i;
 *  - FreeSurfer (.mgh, .mgz), named by FreeSurferColorLUT.txt beside it or in $FREESURFER_HOME;
 *  - OME-Zarr, Zarr versions 2 and 3 (a folder; blosc, zstd, gzip, zlib, bzip2, crc32c, shards): an image, a label
 *    image or an array; options.level picks the resolution. Of a part only its chunks are read.
 *  Colour images and vectors have several values a voxel: options.component picks one of them as it is stored.
 *
 *  Values are whole numbers or the scan is refused; nothing is ever rounded, clipped or reinterpreted (a NIfTI slope
 *  that is itself rounded, such as 1/255, is allowed for). Names come from the file, else from
 *  "<scan without .gz>.txt" or "<scan without extension>.txt" beside it.
 *  Memory: a slab of a few MB, and the shapes. Of a scan that is cropped only the shapes of the part; what lies outside
 *  is not looked at, and not read either where the data are stored plain or slice by slice (layers of a segmentation
 *  are: the numbers their labels get must not depend on the crop). Places do not move: shapes lie where they lie in the
 *  whole scan.
 *
 *  The voxel size is the file's: of TIFF as ImageJ, OME-XML or its resolution tags state it. Where there is none, the
 *  unit of the geometry is the voxel, which is warned of. Of hyperstacks, options.component picks the channel and
 *  options.volume the time point.
 *
 *  With options.refuseGrey a grey scan is told from labels and refused with a threshold proposed (GreyScanError), as
 *  long as neither binary nor threshold is set and the file names no labels.
 *
 *  Progress is reported as stage "read". May be called from several threads at once.
 *  \throws InputError with one line when the file is missing, damaged or unfit, when a label asked for does not occur,
 *  or when there is nothing but background; Cancelled when the callback says so. */
LabelMap
ReadLabelVolume(const std::filesystem::path & path,
                const ReadOptions &           options = {},
                const ProgressCallback &      progress = {});

/** The files a scan consists of: the file itself first, then, sorted by name, the data files that a detached header
 *  points to, or the other half of a NIfTI pair; for a folder or a pattern the slices alone. Files that are not there
 *  are left out. Of a Zarr store its metadata and the chunks that the options' level and crop touch.
 *  \throws InputError when a header that must be looked into is none. */
std::vector<std::filesystem::path>
ScanFiles(const std::filesystem::path & path, const ReadOptions & options = {});

/** The lists of names and colours that go with a scan (LabelList.h says which), those that are there: the first to say
 *  something first. */
std::vector<std::filesystem::path>
LabelListFiles(const std::filesystem::path & scan);

/** Writes labels as a volume: .nrrd .nii .nii.gz .mha .mhd .tif by the extension of `path`; the smallest unsigned type
 *  that holds the values. Packed when `compress` and the format can (.nii never, .nii.gz always). NIfTI keeps the
 *  geometry in single precision, TIFF the spacing alone. The file is read back before it takes its name, so a full disk
 *  leaves nothing.
 *  \throws OutputError when it cannot be written; UsageError for an unknown extension, a value below 1, labels that
 *  overlap or reach beyond the volume. */
void
WriteLabelVolume(const std::filesystem::path &   path,
                 const ImageGeometry &           geometry,
                 const std::vector<LabelShape> & labels,
                 bool                            compress = true);

/** Writes labels as a segmentation of 3D Slicer (.seg.nrrd, packed) with their names and colours. Labels that overlap
 *  get layers of their own; labels that share a value, as components do, or beyond 65535 are numbered anew from 1.
 *  \throws OutputError when it cannot be written in full; UsageError for a label beyond the volume, and above 65535
 *  labels */
void
WriteSegmentation(const std::filesystem::path &   path,
                  const ImageGeometry &           geometry,
                  const std::vector<LabelShape> & labels);

} // namespace voxelcore
