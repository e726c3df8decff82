#include "MeshText.h"

#include <algorithm>

namespace voxelcore
{
namespace
{

constexpr std::int64_t kMostPoints = 0xfffffff0;

} // namespace

MeshFile
ParseObj(std::string_view bytes)
{
  MeshFile file;
  file.format = "OBJ";
  MeshText                   text(bytes);
  std::vector<std::uint32_t> corners;
  while (text.NextLine('#'))
  {
    const std::string_view word = text.Word();
    if (word == "v")
    {
      file.mesh.points.push_back(text.Point()); // a weight or colours may follow
      text.Require(file.mesh.points.size() < kMostPoints, "more points than can be counted");
    }
    else if (word == "f")
    {
      corners.clear();
      for (std::string_view corner = text.Word(); !corner.empty(); corner = text.Word())
      {
        text.Require(corner != "\\", "a face that goes on in the next line; join its lines");
        const auto         count = static_cast<std::int64_t>(file.mesh.points.size());
        const std::int64_t number = text.Whole(corner.substr(0, corner.find('/')));
        const std::int64_t index = number < 0 ? count + number : number - 1;
        text.Require(index >= 0 && index < count,
                     "a face has corner " + std::to_string(number) + ", and there are " + std::to_string(count) +
                       " points before it");
        corners.push_back(static_cast<std::uint32_t>(index));
      }
      text.Require(corners.size() >= 3, "a face with fewer than three corners");
      AddPolygon(file, corners);
    }
  }
  // Nothing tells how many faces there should be.
  std::vector<bool> isUsed(file.mesh.points.size(), false);
  for (const auto & triangle : file.mesh.triangles)
  {
    for (const std::uint32_t corner : triangle)
    {
      isUsed[corner] = true;
    }
  }
  file.mayBeCut =
    bytes.empty() || bytes.back() != '\n' || std::find(isUsed.begin(), isUsed.end(), false) != isUsed.end();
  return file;
}

MeshFile
ParseOff(std::string_view bytes)
{
  MeshFile file;
  file.format = "OFF";
  MeshText text(bytes);
  RequireFit(text.NextLine('#'), "it is empty");
  const std::string_view kind = text.Word();
  text.Require(kind == "OFF" || kind == "COFF" || kind == "NOFF" || kind == "CNOFF" || kind == "STOFF",
               "it does not begin with OFF, COFF or NOFF");
  std::string_view word = text.Word();
  text.Require(word != "BINARY", "binary OFF is not read; write it as text, or as PLY");
  if (word.empty())
  {
    text.Require(text.NextLine('#'), "it ends before its counts");
    word = text.Word();
  }
  const std::int64_t points = text.Whole(word);
  const std::int64_t faces = text.Whole(text.Word());
  text.Require(points >= 0 && points < kMostPoints && faces >= 0, "counts that cannot be");
  const auto line = [&](const std::string & what, std::int64_t found, std::int64_t promised) {
    text.Require(text.NextLine('#'),
                 "it ends after " + std::to_string(found) + " of " + std::to_string(promised) + " " + what);
  };
  // Each point in a line of its own; with C colours and with N a normal follow.
  for (std::int64_t i = 0; i < points; ++i)
  {
    line("points", i, points);
    file.mesh.points.push_back(text.Point());
  }
  std::vector<std::uint32_t> corners;
  for (std::int64_t i = 0; i < faces; ++i)
  {
    line("faces", i, faces);
    const std::int64_t count = text.Whole(text.Word());
    text.Require(count >= 1 && count <= points, "a face with " + std::to_string(count) + " corners");
    corners.clear();
    for (std::int64_t c = 0; c < count; ++c)
    {
      const std::int64_t index = text.Whole(text.Word());
      text.Require(index >= 0 && index < points,
                   "a face has corner " + std::to_string(index) + ", and there are points 0 to " +
                     std::to_string(points - 1));
      corners.push_back(static_cast<std::uint32_t>(index));
    }
    AddPolygon(file, corners);
  }
  text.Require(!text.NextLine('#'), "more follows than its counts promise");
  return file;
}

} // namespace voxelcore
