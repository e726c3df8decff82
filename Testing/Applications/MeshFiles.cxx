#include "MeshFiles.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <sstream>

namespace voxelcore::testing
{
namespace
{

template <typename T>
std::string
Raw(T value, bool big = false)
{
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big)
  {
    std::reverse(bytes.begin(), bytes.end());
  }
  return bytes;
}

std::string
StlBinary(const Solid & solid)
{
  std::string bytes = "solid, in spite of what follows";
  bytes.resize(80, ' ');
  bytes += Raw(static_cast<std::uint32_t>(solid.triangles.size()));
  for (const auto & t : solid.triangles)
  {
    bytes += std::string(12, '\0');
    for (const int c : t)
    {
      for (const double x : solid.points[static_cast<std::size_t>(c)])
      {
        bytes += Raw(static_cast<float>(x));
      }
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

/** Points, then faces, one a line. */
std::string
Lines(const Solid & solid, const std::string & point, const std::string & face, int first)
{
  std::ostringstream text;
  for (const auto & p : solid.points)
  {
    text << point << p[0] << " " << p[1] << " " << p[2] << "\n";
  }
  for (const auto & t : solid.triangles)
  {
    text << face << t[0] + first << " " << t[1] + first << " " << t[2] + first << "\n";
  }
  return text.str();
}

std::string
Obj(const Solid & solid)
{
  return "# a box\n" + Lines(solid, "v ", "f ", 1);
}

std::string
PlyHeader(const Solid & solid, const std::string & format)
{
  return "ply\nformat " + format + " 1.0\ncomment by hand\nelement vertex " + std::to_string(solid.points.size()) +
         "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
         std::to_string(solid.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string
Vtp(const Solid & solid)
{
  std::ostringstream text;
  text
    << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n<PolyData>\n"
    << "<Piece NumberOfPoints=\"" << solid.points.size() << "\" NumberOfPolys=\"" << solid.triangles.size()
    << "\">\n<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n";
  for (const auto & p : solid.points)
  {
    text << p[0] << " " << p[1] << " " << p[2] << "\n";
  }
  text << "</DataArray></Points>\n<Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n";
  for (const auto & t : solid.triangles)
  {
    text << t[0] << " " << t[1] << " " << t[2] << "\n";
  }
  text << "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
  for (std::size_t i = 1; i <= solid.triangles.size(); ++i)
  {
    text << 3 * i << " ";
  }
  text << "</DataArray></Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
  return text.str();
}

} // namespace

Solid
Box()
{
  return { { { 0, 0, 0 }, { 4, 0, 0 }, { 0, 3, 0 }, { 4, 3, 0 }, { 0, 0, 2 }, { 4, 0, 2 }, { 0, 3, 2 }, { 4, 3, 2 } },
           { { 0, 4, 6 },
             { 0, 6, 2 },
             { 1, 3, 7 },
             { 1, 7, 5 },
             { 0, 1, 5 },
             { 0, 5, 4 },
             { 2, 6, 7 },
             { 2, 7, 3 },
             { 0, 2, 3 },
             { 0, 3, 1 },
             { 4, 5, 7 },
             { 4, 7, 6 } } };
}

std::string
StlText(const Solid & solid)
{
  std::ostringstream text;
  text << "solid s\n";
  for (const auto & t : solid.triangles)
  {
    text << "facet normal 0 0 0\n outer loop\n";
    for (const int c : t)
    {
      const auto & p = solid.points[static_cast<std::size_t>(c)];
      text << "  vertex " << p[0] << " " << p[1] << " " << p[2] << "\n";
    }
    text << " endloop\nendfacet\n";
  }
  text << "endsolid s\n";
  return text.str();
}

std::string
Off(const Solid & solid)
{
  return "OFF\n" + std::to_string(solid.points.size()) + " " + std::to_string(solid.triangles.size()) + " 0\n" +
         Lines(solid, "", "3 ", 0);
}

std::string
PlyText(const Solid & solid)
{
  return PlyHeader(solid, "ascii") + Lines(solid, "", "3 ", 0);
}

std::string
PlyBinary(const Solid & solid, bool big)
{
  std::string bytes = PlyHeader(solid, big ? "binary_big_endian" : "binary_little_endian");
  for (const auto & p : solid.points)
  {
    bytes += Raw(p[0], big) + Raw(p[1], big) + Raw(p[2], big);
  }
  for (const auto & t : solid.triangles)
  {
    bytes += '\3' + Raw(t[0], big) + Raw(t[1], big) + Raw(t[2], big);
  }
  return bytes;
}

std::string
Vtk(const Solid & solid)
{
  const std::string  body = Lines(solid, "", "3 ", 0);
  const std::size_t  points = solid.points.size();
  const std::size_t  faces = solid.triangles.size();
  std::istringstream lines(body);
  std::string        text =
    "# vtk DataFile Version 3.0\nbox\nASCII\nDATASET POLYDATA\nPOINTS " + std::to_string(points) + " double\n";
  std::string line;
  for (std::size_t i = 0; std::getline(lines, line); ++i)
  {
    if (i == points)
    {
      text += "POLYGONS " + std::to_string(faces) + " " + std::to_string(4 * faces) + "\n";
    }
    text += line + "\n";
  }
  return text;
}

const std::vector<Format> &
Formats()
{
  static const std::vector<Format> formats{ { "text.stl", StlText },
                                            { "binary.stl", StlBinary },
                                            { "box.obj", Obj },
                                            { "box.off", Off },
                                            { "text.ply", PlyText },
                                            { "little.ply", [](const Solid & s) { return PlyBinary(s, false); } },
                                            { "big.ply", [](const Solid & s) { return PlyBinary(s, true); } },
                                            { "box.vtk", Vtk },
                                            { "box.vtp", Vtp } };
  return formats;
}

} // namespace voxelcore::testing
