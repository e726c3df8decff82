#pragma once
// Formats without a reader of ours. Some are read through ITK (ItkProcess.h). The others are named, and how to convert
// them.

#include <cstdint>
#include <filesystem>

namespace voxelcore
{

/** Formats the helper knows. */
enum class ItkFormat : std::uint8_t
{
  None,
  Dicom, ///< a file or a folder: a series, a multi-frame image, a segmentation
  Mrc,
  Minc,
  Gipl,
  Vtk,
  Hdf5
};

/** By the first bytes, else by the extension. */
ItkFormat
ItkFormatOf(const std::filesystem::path & path);

/** Whether the first files of a folder are DICOM, and there are no slices of other kinds. */
bool
IsDicomFolder(const std::filesystem::path & path);

/** Whether a .vtk file holds an image (STRUCTURED_POINTS), not a mesh. */
bool
IsVtkImage(const std::filesystem::path & path);

/** For a file of no kind that is read: told by its first bytes, else by its extension. \throws InputError, always: one
 *  line that says what it is and which program or option leads on */
[[noreturn]] void
RefuseForeign(const std::filesystem::path & path);

/** For a folder without slices. \throws InputError where it is a store or holds files of a kind known here */
void
RefuseForeignFolder(const std::filesystem::path & path);

} // namespace voxelcore
