#pragma once
// Small scans of formats that ITK and GDCM read, byte by byte as their formats define them. All hold ForeignValues(),
// 6 x 5 x 4 voxels.

#include <array>
#include <cstddef>
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

/** What the block of an LSM file says; pages are there for one frame of four slices, for two with `frames` 2. */
struct LsmLayout
{
  std::array<double, 3> metres{ 2e-7, 3e-7, 5e-7 };
  bool                  thumbnails = true;
  int                   width = 6;
  int                   slices = 4;
  int                   channels = 1; ///< the second holds 0
  int                   frames = 1;
  int                   kind = 0;
  std::uint32_t         magic = 0x0400494C;
  std::size_t           blockBytes = 512;
};

/** LSM of Zeiss, unsigned bytes, each slice followed by its thumbnail. */
std::string
LsmBytes(const LsmLayout & layout = {});

/** An element of a DICOM data set, explicit VR, little endian. */
std::string
DicomElement(std::uint16_t group, std::uint16_t element, const char * vr, std::string value);
std::string
DicomSequence(std::uint16_t group, std::uint16_t element, const std::vector<std::string> & items);
/** The preamble, the file's meta information, and the data set. */
std::string
DicomFile(const std::string & sopClass, const std::string & dataSet);

/** The file with this element of its data set replaced, put in, or, with an empty `encoded`, taken out. */
std::string
WithDicomElement(const std::string & file, std::uint16_t group, std::uint16_t element, const std::string & encoded);

/** A CT series by file name, 0.5 x 0.75 x 2 mm. */
std::map<std::string, std::string>
DicomSeriesBytes();

/** A binary segmentation of six segments, 0.5 x 0.75 x 2 mm. */
std::string
DicomSegmentationBytes();

} // namespace voxelcore::testing
