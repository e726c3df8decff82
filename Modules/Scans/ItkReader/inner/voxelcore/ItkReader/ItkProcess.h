#pragma once
// The program voxelcore-itk-reader (Modules/Scans/ItkReader/itk) reads through ITK and GDCM, in a process of its own.

#include "voxelcore/Formats/ScanFile.h"
#include "voxelcore/ItkReader/ForeignFormats.h"

#include <filesystem>
#include <vector>

namespace voxelcore
{

/** Whether this build has the helper, and it is where it belongs: in libexec/voxelcore of a folder above this program
 *  or library. */
bool
HasItkReader();

/** What the helper reads a file or folder as; None where this build has no helper. */
ItkFormat
FormatByItk(const std::filesystem::path & path);

/** A file, or a folder of DICOM slices. \throws InputError when the helper refuses it, fails, or is not there */
ScanFile
OpenByItk(const std::filesystem::path & path, ItkFormat format, const ReadOptions & options);

/** The files it consists of. \throws InputError */
std::vector<std::filesystem::path>
ItkScanFiles(const std::filesystem::path & path, ItkFormat format);

} // namespace voxelcore
