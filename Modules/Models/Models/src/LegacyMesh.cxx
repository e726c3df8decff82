// Meshes in VTK's legacy polydata.

#include "LegacyPolyData.h"

namespace voxelcore
{

MeshFile
ParseLegacyVtk(std::string_view bytes)
{
  LegacyPolyData data(bytes);
  MeshFile       file;
  file.format = "VTK";
  AddPoints(file, data.Read<double>(data.points, true));
  for (const std::string section : { "Polys", "Strips" })
  {
    AddCells(file, data.cells[section].corners, data.cells[section].ends, 0, section == "Strips");
  }
  return file;
}

} // namespace voxelcore
