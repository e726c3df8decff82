#pragma once
// A small NRRD volume and ways to change its header.

#include "ScanBytes.h"

namespace voxelcore::testing::nrrd
{

inline const std::vector<int>   kValues{ 0, 1, 2, 3, 0, 7, 0, 0, 0, 2, 2, 250 }; // 3 x 2 x 2
inline const std::array<int, 3> kSize{ 3, 2, 2 };

inline std::vector<std::string>
Lines(const std::string & type = "uint8")
{
  return NrrdLines(type, kSize);
}

/** The lines with one field replaced, or added when it is not there; an empty value takes it away. */
inline std::vector<std::string>
With(std::vector<std::string> lines, const std::string & field, const std::string & value)
{
  std::erase_if(lines, [&](const std::string & line) { return line.starts_with(field + ":"); });
  if (!value.empty())
  {
    lines.push_back(field + ": " + value);
  }
  return lines;
}

/** Of a segmentation of two segments, Liver and Vessel, in a layer each; 3 x 2 x 2. */
inline std::vector<std::string>
LayerLines(int liver = 1, int vessel = 4)
{
  return { "type: uint8",
           "dimension: 4",
           "space: left-posterior-superior",
           "sizes: 2 3 2 2",
           "space directions: none (1,0,0) (0,1,0) (0,0,1)",
           "kinds: list domain domain domain",
           "encoding: raw",
           "space origin: (0,0,0)",
           "Segment0_Name:=Liver",
           "Segment0_LabelValue:=" + std::to_string(liver),
           "Segment0_Layer:=0",
           "Segment1_Name:=Vessel",
           "Segment1_LabelValue:=" + std::to_string(vessel),
           "Segment1_Layer:=1" };
}

inline void
ExpectValues(const LabelMap & volume, const std::vector<int> & values = kValues)
{
  EXPECT_EQ(AllValues(volume), std::vector<std::int64_t>(values.begin(), values.end()));
}

} // namespace voxelcore::testing::nrrd
