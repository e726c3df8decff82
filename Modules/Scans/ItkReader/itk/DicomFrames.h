#pragma once
// The functional groups of a DICOM object of many frames.

#include "DicomPixels.h"
#include "DicomPlanes.h"

#include <gdcmDataSet.h>

#include <filesystem>
#include <functional>
#include <vector>

namespace voxelcore::itkreader
{

/** What the groups of one frame say: the shared ones, replaced by its own. */
struct DicomFrame
{
  DicomPlane    plane;
  double        slope = 1;
  double        intercept = 0;
  std::uint16_t segment = 0; ///< Referenced Segment Number; 0: none
};

/** One for each frame. \throws InputError when there are not as many as frames */
std::vector<DicomFrame>
ReadFrames(const std::filesystem::path & path, const gdcm::DataSet & set, const DicomPixels & pixels);

} // namespace voxelcore::itkreader
