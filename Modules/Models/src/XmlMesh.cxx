// Meshes in VTK's XML.

#include "XmlPolyData.h"

namespace voxelcore
{
namespace
{

void
AddPiece(MeshFile & file, const XmlPiece & piece, const XmlEncoding & encoding)
{
  const std::size_t first = file.mesh.points.size();
  const auto        find = [&](const std::string & section, const std::string & name) -> const XmlArray & {
    const auto found = piece.arrays.find({ section, name });
    if (found == piece.arrays.end())
    {
      throw UnfitFile{ "an array of its " + section + " is missing" };
    }
    return found->second;
  };
  const std::uint64_t points = XmlNumber(piece.counts, "NumberOfPoints", 0);
  if (points > 0)
  {
    const auto numbers = ReadXmlArray<double>(find("Points", ""), encoding);
    RequireFit(numbers.size() % 3 == 0 && numbers.size() / 3 == points, "it promises another number of points");
    AddPoints(file, numbers);
  }
  for (const std::string section : { "Polys", "Strips" })
  {
    const std::uint64_t cells = XmlNumber(piece.counts, "NumberOf" + section, 0);
    if (cells > 0)
    {
      const auto ends = ReadXmlArray<std::int64_t>(find(section, "offsets"), encoding);
      RequireFit(ends.size() == cells, "it promises another number of polygons");
      AddCells(file,
               ReadXmlArray<std::int64_t>(find(section, "connectivity"), encoding),
               ends,
               first,
               section == "Strips");
    }
  }
}

} // namespace

MeshFile
ParseVtp(std::string_view bytes)
{
  const XmlPolyData data = ParseXmlPolyData(bytes, false);
  MeshFile          file;
  file.format = "VTP";
  for (const XmlPiece & piece : data.pieces)
  {
    AddPiece(file, piece, data.encoding);
  }
  return file;
}

} // namespace voxelcore
