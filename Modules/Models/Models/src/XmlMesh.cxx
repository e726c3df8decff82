// Meshes in VTK's XML.

#include "VtpFile.h"

namespace voxelcore
{
namespace
{

/** Adds the pieces of a file to one mesh. */
class PieceReader
{
public:
  PieceReader(VtpFile & vtp, MeshFile & file)
    : m_Vtp(vtp)
    , m_File(file)
    , m_Left(vtp.MostAppended())
  {}

  void
  Add(const VtpPiece & piece)
  {
    const std::size_t   first = m_File.mesh.points.size();
    const std::uint64_t points = piece.Count("NumberOfPoints");
    if (points > 0)
    {
      const auto numbers = Read<double>(piece, "Points", "");
      RequireFit(numbers.size() % 3 == 0 && numbers.size() / 3 == points, "it promises another number of points");
      AddPoints(m_File, numbers);
    }
    for (const std::string section : { "Polys", "Strips" })
    {
      const std::uint64_t cells = piece.Count("NumberOf" + section);
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
  Read(const VtpPiece & piece, const std::string & section, const std::string & name)
  {
    const auto found = piece.arrays.find({ section, name });
    if (found == piece.arrays.end())
    {
      throw UnfitFile{ "an array of its " + section + " is missing" };
    }
    const VtpArray & array = found->second;
    auto             numbers = m_Vtp.Read<Value>(array);
    if (array.format == "appended")
    {
      // Thousands of pieces may name the same bytes.
      const std::uint64_t bytes = numbers.size() * array.type.bytes;
      RequireFit(bytes <= m_Left, "its pieces hold more than its appended data");
      m_Left -= bytes;
    }
    return numbers;
  }

  VtpFile &     m_Vtp;
  MeshFile &    m_File;
  std::uint64_t m_Left; ///< bytes that the appended data may still stand for
};

} // namespace

MeshFile
ReadVtpMesh(const std::filesystem::path & path)
{
  VtpFile  vtp(path, VtpFile::Content::Mesh);
  MeshFile file;
  file.format = "VTP";
  PieceReader reader(vtp, file);
  for (const VtpPiece & piece : vtp.pieces)
  {
    reader.Add(piece);
  }
  return file;
}

} // namespace voxelcore
