#pragma once
// Triangle meshes in all formats that are read, written by hand.

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace voxelcore::testing
{

struct Solid
{
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<int, 3>>    triangles;
};

/** 4 x 3 x 2 mm. */
Solid
Box();

std::string
StlText(const Solid & solid);
std::string
Off(const Solid & solid);
std::string
PlyText(const Solid & solid);
std::string
PlyBinary(const Solid & solid, bool big);
std::string
Vtk(const Solid & solid);

/** By the name of a file. */
struct Format
{
  std::string                               name;
  std::function<std::string(const Solid &)> write;
};

const std::vector<Format> &
Formats();

} // namespace voxelcore::testing
