#include "OpenScan.h"

#include "MaskFolder.h"
#include "voxelcore/Formats/FormatOpeners.h"
#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/ItkReader/ForeignFormats.h"
#include "voxelcore/ItkReader/ItkProcess.h"

#include <algorithm>

namespace voxelcore
{
namespace
{

/** A folder without slices: says what it holds instead. */
void
RefuseWithoutSlices(const std::filesystem::path & path)
{
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored) && !HasSlices(path))
  {
    RefuseForeignFolder(path);
  }
}

} // namespace

ScanFile
OpenScan(const std::filesystem::path & path, const ReadOptions & options)
{
  if (options.raw)
  {
    return OpenRaw(path, options);
  }
  const ScanKind kind = ScanKindOf(path);
  if (options.dataset && kind != ScanKind::Vti && (kind != ScanKind::Unknown || FormatByItk(path) != ItkFormat::Hdf5))
  {
    throw UsageError(
      Text("--dataset: is for HDF5 and .vti files, and ", Printable(path.string(), 4096), " is neither; leave it out"));
  }
  if (kind == ScanKind::Zarr)
  {
    return OpenZarr(path, options);
  }
  if (kind == ScanKind::Precomputed)
  {
    return OpenPrecomputed(path, options);
  }
  if (options.level)
  {
    throw UsageError(Text("--level: ", Printable(path.string(), 4096), " has one resolution; leave it out"));
  }
  if (kind == ScanKind::Slices)
  {
    if (FormatByItk(path) == ItkFormat::Dicom)
    {
      return OpenByItk(path, ItkFormat::Dicom, options);
    }
    if (const auto masks = MaskPaths(path); !masks.empty())
    {
      return OpenMaskFolder(path, masks, options);
    }
    RefuseWithoutSlices(path);
    return OpenSlices(path, options);
  }
  if (FileSize(path) == 0)
  {
    RefuseInput(path, "the file is empty", "fetch or write it anew");
  }
  switch (kind)
  {
    case ScanKind::Nrrd:
      return OpenNrrd(path, options);
    case ScanKind::Nifti:
      return OpenNifti(path, options);
    case ScanKind::MetaImage:
      return OpenMetaImage(path, options);
    case ScanKind::Mgh:
      return OpenMgh(path, options);
    case ScanKind::Tiff:
      return OpenTiff(path, options);
    case ScanKind::Picture:
      return OpenSlices(path, options);
    case ScanKind::Numpy:
      return OpenNumpy(path, options);
    case ScanKind::Vti:
      return OpenVti(path, options);
    case ScanKind::Slices:
    case ScanKind::Zarr:
    case ScanKind::Precomputed:
    case ScanKind::Unknown:
      break;
  }
  if (IsRawFile(path))
  {
    return OpenRaw(path, options);
  }
  if (const ItkFormat format = FormatByItk(path); format != ItkFormat::None)
  {
    return OpenByItk(path, format, options);
  }
  RefuseForeign(path);
}

std::vector<std::filesystem::path>
ScanFiles(const std::filesystem::path & path, const ReadOptions & options)
{
  std::error_code ignored;
  if (const auto status = std::filesystem::status(path, ignored); // to open a pipe may wait for ever
      std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
      !std::filesystem::is_directory(status))
  {
    RefuseInput(path, "not a regular file", "name a file that holds a scan");
  }
  std::vector<std::filesystem::path> files;
  switch (ScanKindOf(path))
  {
    case ScanKind::Zarr:
      return ZarrFiles(path, options);
    case ScanKind::Precomputed:
      return PrecomputedFiles(path, options);
    case ScanKind::Slices:
      if (FormatByItk(path) == ItkFormat::Dicom)
      {
        files = ItkScanFiles(path, ItkFormat::Dicom);
      }
      else if (const auto masks = MaskPaths(path); !masks.empty())
      {
        for (const std::filesystem::path & mask : masks)
        {
          const auto its = ScanFiles(mask, options);
          files.insert(files.end(), its.begin(), its.end());
        }
      }
      else
      {
        RefuseWithoutSlices(path);
        files = SlicePaths(path);
      }
      std::sort(files.begin(), files.end());
      return files;
    case ScanKind::Nrrd:
      files = NrrdDataFiles(path);
      break;
    case ScanKind::Nifti:
      files = NiftiPartner(path);
      break;
    case ScanKind::MetaImage:
      files = MetaImageDataFiles(path);
      break;
    case ScanKind::Unknown:
      if (FormatByItk(path) == ItkFormat::Dicom) // a file may stand for its series
      {
        files = ItkScanFiles(path, ItkFormat::Dicom);
        std::erase_if(files, [&](const auto & file) {
          std::error_code notThere;
          return std::filesystem::equivalent(file, path, notThere);
        });
      }
      else if (IsRawFile(path))
      {
        files = RawFileTexts(path);
      }
      break;
    case ScanKind::Mgh:
    case ScanKind::Numpy:
    case ScanKind::Vti:
    case ScanKind::Tiff:
    case ScanKind::Picture:
      break;
  }
  std::erase_if(files, [&](const auto & file) { return !std::filesystem::is_regular_file(file, ignored); });
  std::sort(files.begin(), files.end());
  files.insert(files.begin(), path);
  return files;
}

} // namespace voxelcore
