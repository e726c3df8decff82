// Meshes in VTK's XML.

#include "XmlPolyData.h"
#include "XmlUnpacking.h"

namespace voxelcore
{
namespace
{

/** Adds the pieces of a file to one mesh. */
class PieceReader
{
public:
  PieceReader(const XmlEncoding & encoding, MeshFile & file)
    : m_Encoding(encoding)
    , m_File(file)
    , m_Left(encoding.appended.size())
  {
    if (m_Left > 0 && !encoding.compressor.empty())
    {
      m_Left *= MostGain(encoding.compressor);
    }
  }

  void
  Add(const XmlPiece & piece)
  {
    const std::size_t   first = m_File.mesh.points.size();
    const std::uint64_t points = XmlNumber(piece.counts, "NumberOfPoints", 0);
    if (points > 0)
    {
      const auto numbers = Read<double>(piece, "Points", "");
      RequireFit(numbers.size() % 3 == 0 && numbers.size() / 3 == points, "it promises another number of points");
      AddPoints(m_File, numbers);
    }
    for (const std::string section : { "Polys", "Strips" })
    {
      const std::uint64_t cells = XmlNumber(piece.counts, "NumberOf" + section, 0);
      if (cells > 0)
      {
        const auto ends = Read<std::int64_t>(piece, section, "offsets");
        RequireFit(ends.size() == cells, "it promises another number of polygons");
        AddCells(m_File, Read<std::int64_t>(piece, section, "connectivity"), ends, first, section == "Strips");
      }
    }
  }

private:
  template <typename Value>
  std::vector<Value>
  Read(const XmlPiece & piece, const std::string & section, const std::string & name)
  {
    const auto found = piece.arrays.find({ section, name });
    if (found == piece.arrays.end())
    {
      throw UnfitFile{ "an array of its " + section + " is missing" };
    }
    const XmlArray & array = found->second;
    auto             numbers = ReadXmlArray<Value>(array, m_Encoding);
    if (array.format == "appended")
    {
      // Thousands of pieces may name the same bytes.
      const std::uint64_t bytes = numbers.size() * array.type.bytes;
      RequireFit(bytes <= m_Left, "its pieces hold more than its appended data");
      m_Left -= bytes;
    }
    return numbers;
  }

  const XmlEncoding & m_Encoding;
  MeshFile &          m_File;
  std::uint64_t       m_Left; ///< bytes that the appended data may still stand for
};

} // namespace

MeshFile
ParseVtp(std::string_view bytes)
{
  const XmlPolyData data = ParseXmlPolyData(bytes, false);
  MeshFile          file;
  file.format = "VTP";
  PieceReader reader(data.encoding, file);
  for (const XmlPiece & piece : data.pieces)
  {
    reader.Add(piece);
  }
  return file;
}

} // namespace voxelcore
