#pragma once
// Small scans of formats that are read through ITK and GDCM, byte by byte as their formats define them. All hold
// ForeignValues(), 6 x 5 x 4 voxels.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace voxelcore::testing
{

/** Labels 0 to 6, x fastest. */
std::vector<int>
ForeignValues();

/** MRC2014, mode 0 (bytes), cell of 60 x 100 x 120 angstroms. */
std::string
MrcBytes();

/** GIPL, unsigned bytes, 0.5 x 0.75 x 2 mm. */
std::string
GiplBytes();

/** Legacy VTK, STRUCTURED_POINTS, short, 0.5 x 0.75 x 2 mm. */
std::string
VtkBytes(bool text);

/** An element of a DICOM data set, explicit VR, little endian. */
std::string
DicomElement(std::uint16_t group, std::uint16_t element, const char * vr, std::string value);
std::string
DicomSequence(std::uint16_t group, std::uint16_t element, const std::vector<std::string> & items);
/** The preamble, the file's meta information, and the data set. */
std::string
DicomFile(const std::string & sopClass, const std::string & dataSet);

/** A CT series by file name, 0.5 x 0.75 x 2 mm. */
std::map<std::string, std::string>
DicomSeriesBytes();

/** A binary segmentation of six segments, 0.5 x 0.75 x 2 mm. */
std::string
DicomSegmentationBytes();

} // namespace voxelcore::testing
