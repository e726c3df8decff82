#pragma once
// One mesh in every form in which VTK writes polydata.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

class vtkPolyData;

namespace voxelcore::testing
{

/** The mesh has kSheetSide^2 points, point i at (x / 4, y / 2, x * y / 64) with x = i % kSheetSide, y = i / kSheetSide:
 *  12 squares, in all rows but the last, and two strips along that one. */
inline constexpr std::uint32_t kSheetSide = 5;

/** What the sheet is in triangles, by hand. */
std::vector<std::array<std::uint32_t, 3>>
SheetTriangles();

/** .vtp files of polydata, by name: text, base64, raw and base64 appended; no compression, zlib, LZ4, LZMA; headers of
 *  32 bits and little endian, or of 64 and big. */
std::map<std::string, std::string>
XmlFormsOf(vtkPolyData & data);

/** .vtk files of polydata, by name: text and binary, versions 4.2 and 5.1. */
std::map<std::string, std::string>
LegacyFormsOf(vtkPolyData & data);

/** .vtp files of the sheet, by name: text, base64, raw and base64 appended; no compression, zlib, LZ4, LZMA; headers of
 *  32 and 64 bits, either byte order. */
const std::map<std::string, std::string> &
XmlForms();

/** .vtk files of the sheet, by name: text and binary, versions 4.2 and 5.1. */
const std::map<std::string, std::string> &
LegacyForms();

} // namespace voxelcore::testing
