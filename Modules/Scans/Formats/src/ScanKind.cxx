#include "voxelcore/Formats/FormatOpeners.h"

#include <algorithm>
#include <initializer_list>

namespace voxelcore
{

ScanKind
ScanKindOf(const std::filesystem::path & path)
{
  if (IsZarr(path))
  {
    return ScanKind::Zarr;
  }
  if (IsPrecomputed(path))
  {
    return ScanKind::Precomputed;
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
         : ends({ ".npy" })                                                  ? ScanKind::Numpy
         : ends({ ".vti" })                                                  ? ScanKind::Vti
         : ends({ ".tif", ".tiff", ".lsm" })                                 ? ScanKind::Tiff
         : ends({ ".png", ".bmp", ".jpg", ".jpeg" })                         ? ScanKind::Picture
                                                                             : ScanKind::Unknown;
}

} // namespace voxelcore
