#pragma once
// The helper program voxelcore-itk-reader (Modules/Imaging/itk): it reads through ITK and GDCM in a process of its own.

#include "ItkScan.h"
#include "ScanFile.h"

#include <filesystem>
#include <vector>

namespace voxelcore
{

/** Whether this build has the helper, and it is where it belongs: in libexec/voxelcore of a folder above this program
 *  or library. */
bool
HasItkReader();

/** A file, or a folder of DICOM slices. \throws InputError when the helper refuses it, fails, or is not there */
ScanFile
OpenByItk(const std::filesystem::path & path, ItkFormat format, const ReadOptions & options);

/** The files it consists of. \throws InputError */
std::vector<std::filesystem::path>
ItkScanFiles(const std::filesystem::path & path, ItkFormat format);

} // namespace voxelcore
