#include "ScanFile.h"

#include "ForeignFormats.h"
#include "ZarrArray.h"
#include "ItkProcess.h"
#include "voxelcore/TextFields.h"

#include <algorithm>

namespace voxelcore
{
namespace
{

/** What the helper reads a file or folder as; None where there is no helper in this build. */
ItkFormat
ByHelper(const std::filesystem::path & path)
{
#ifdef VOXELCORE_LIBEXEC
  std::error_code ignored;
  return !std::filesystem::is_directory(path, ignored) ? ItkFormatOf(path)
         : IsDicomFolder(path)                         ? ItkFormat::Dicom
                                                       : ItkFormat::None;
#else
  static_cast<void>(path);
  return ItkFormat::None;
#endif
}

} // namespace

std::vector<std::string>
WarningsOf(const ScanFile & scan)
{
  const auto               path = scan.path.has_filename() ? scan.path : scan.path.parent_path(); // "folder/"
  std::vector<std::string> warnings;
  for (const std::string & warning : scan.warnings)
  {
    warnings.push_back(Text(Printable(path.filename().string(), 200), ": ", warning));
  }
  return warnings;
}

void
SetGeometry(ScanFile &                     scan,
            const std::array<Vector3, 3> & axes,
            const Vector3 &                spacing,
            const Vector3 &                origin,
            const ReadOptions &            options)
{
  scan.geometry =
    CheckedGeometry(scan.path, { scan.geometry.size, axes, spacing, origin, scan.geometry.unit }, options, scan.notes);
}

std::uint64_t
ChooseVolume(const std::filesystem::path & path, std::uint64_t volumes, const ReadOptions & options)
{
  if (!options.volume)
  {
    if (volumes > 1)
    {
      RefuseInput(path,
                  Text("4-D file with ", volumes, " volumes"),
                  Text("choose one with --volume 0 to --volume ", volumes - 1));
    }
    return 0;
  }
  if (*options.volume < 0 || static_cast<std::uint64_t>(*options.volume) >= volumes)
  {
    RefuseInput(path,
                Text("there is no volume ", *options.volume, ", it has ", volumes),
                Text("volumes are counted from 0 to ", volumes - 1));
  }
  return static_cast<std::uint64_t>(*options.volume);
}

std::uint64_t
ChooseComponent(const std::filesystem::path & path,
                std::uint64_t                 components,
                std::string_view              kind,
                const ReadOptions &           options)
{
  if (!options.component)
  {
    if (components > 1)
    {
      RefuseInput(
        path,
        Text(kind, " (", components, " values a voxel)"),
        Text("save its labels as one whole number a voxel, or choose one value with --component 0 to --component ",
             components - 1));
    }
    return 0;
  }
  if (*options.component < 0 || static_cast<std::uint64_t>(*options.component) >= components)
  {
    RefuseInput(path,
                Text("there is no component ", *options.component, ", a voxel has ", components),
                Text("components are counted from 0 to ", components - 1));
  }
  return static_cast<std::uint64_t>(*options.component);
}

bool
IsZarrFolder(const std::filesystem::path & path)
{
  return IsZarr(path);
}

ScanKind
ScanKindOf(const std::filesystem::path & path)
{
  if (IsZarr(path))
  {
    return ScanKind::Zarr;
  }
  if (AreSlices(path))
  {
    return ScanKind::Slices;
  }
  const std::string name = LowerCase(path.filename().string());
  const auto        ends = [&name](std::initializer_list<std::string_view> extensions) {
    return std::any_of(extensions.begin(), extensions.end(), [&name](std::string_view extension) {
      return name.ends_with(extension);
    });
  };
  return ends({ ".nrrd", ".nhdr" })                                          ? ScanKind::Nrrd
         : ends({ ".nii", ".nii.gz", ".hdr", ".hdr.gz", ".img", ".img.gz" }) ? ScanKind::Nifti
         : ends({ ".mha", ".mhd" })                                          ? ScanKind::MetaImage
         : ends({ ".mgh", ".mgz", ".mgh.gz" })                               ? ScanKind::Mgh
         : ends({ ".tif", ".tiff" })                                         ? ScanKind::Tiff
         : ends({ ".png" })                                                  ? ScanKind::Png
                                                                             : ScanKind::Unknown;
}

ScanFile
OpenScan(const std::filesystem::path & path, const ReadOptions & options)
{
  if (options.raw)
  {
    return OpenRaw(path, options);
  }
  const ScanKind kind = ScanKindOf(path);
  if (kind == ScanKind::Zarr)
  {
    return OpenZarr(path, options);
  }
  if (options.level)
  {
    throw UsageError(
      Text("--level: ", Printable(path.string(), 4096), " has one resolution; only OME-Zarr has several"));
  }
  if (kind == ScanKind::Slices)
  {
    return ByHelper(path) == ItkFormat::Dicom ? OpenByItk(path, ItkFormat::Dicom, options) : OpenSlices(path, options);
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
    case ScanKind::Png:
      RefuseInput(path, "2-D image", "a volume is needed: name the folder of slices, or a pattern such as slice_*.png");
    case ScanKind::Slices:
    case ScanKind::Zarr:
    case ScanKind::Unknown:
      break;
  }
  if (IsRawFile(path))
  {
    return OpenRaw(path, options);
  }
  if (const ItkFormat format = ByHelper(path); format != ItkFormat::None)
  {
    return OpenByItk(path, format, options);
  }
  RefuseForeign(path);
}

std::vector<std::filesystem::path>
ScanFiles(const std::filesystem::path & path, const ReadOptions & options)
{
  std::vector<std::filesystem::path> files;
  switch (ScanKindOf(path))
  {
    case ScanKind::Zarr:
      return ZarrFiles(path, options);
    case ScanKind::Slices:
      files = ByHelper(path) == ItkFormat::Dicom ? ItkScanFiles(path, ItkFormat::Dicom) : SlicePaths(path);
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
      if (ByHelper(path) == ItkFormat::Dicom) // a file may stand for its series
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
    case ScanKind::Tiff:
    case ScanKind::Png:
      break;
  }
  std::error_code ignored;
  std::erase_if(files, [&](const auto & file) { return !std::filesystem::is_regular_file(file, ignored); });
  std::sort(files.begin(), files.end());
  files.insert(files.begin(), path);
  return files;
}

} // namespace voxelcore
