#pragma once
// One opener a kind of DICOM object.

#include "ScanSource.h"

#include <gdcmFile.h>

#include <filesystem>
#include <memory>
#include <vector>

namespace voxelcore::itkreader
{

/** A segmentation (SEG): binary, fractional or label map. */
std::unique_ptr<ScanSource>
OpenSegmentation(const std::filesystem::path & path, const gdcm::DataSet & set);

/** One image of many frames (enhanced CT, MR, ...). */
std::unique_ptr<ScanSource>
OpenFrames(const std::filesystem::path & path, const gdcm::DataSet & set);

/** Slices, a file each: those of `files` that are of the series; the first names it. */
std::unique_ptr<ScanSource>
OpenSeries(const std::filesystem::path & path, const std::vector<std::filesystem::path> & files);

} // namespace voxelcore::itkreader
