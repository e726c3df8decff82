// The legacy file that VTK's writer would make, to the last byte.

#include "ModelFormats.h"
#include "PlainArrays.h"

#include "voxelcore/Base/OutputFile.h"
#include "voxelcore/Base/Library.h"

#include <bit>
#include <type_traits>

namespace voxelcore
{
namespace
{

using Array = PlainArrays::Array;

/** Numbers the way round that legacy files have them. */
class BigEndianFile
{
public:
  explicit BigEndianFile(const std::filesystem::path & path)
    : m_File(path)
  {}

  void
  Line(const std::string & text)
  {
    m_File.Write(text + "\n");
  }

  template <typename Value>
  void
  Number(Value value)
  {
    using Bits = std::conditional_t<sizeof(Value) == 8,
                                    std::uint64_t,
                                    std::conditional_t<sizeof(Value) == 4, std::uint32_t, std::uint16_t>>;
    const Bits bits = bit_cast<Bits>(value);
    char       bytes[sizeof(Bits)];
    for (std::size_t i = 0; i < sizeof(Bits); ++i)
    {
      bytes[i] = static_cast<char>((bits >> (8 * (sizeof(Bits) - 1 - i))) & 0xFFU);
    }
    m_File.Write(bytes, sizeof(bytes));
  }

  /** Behind its length in 1, 2, 4 or 8 bytes, whose first two bits say which. */
  void
  Text(const std::string & text)
  {
    const std::uint64_t length = text.size();
    if (length < (std::uint64_t{ 1 } << 6))
    {
      const char byte = static_cast<char>(0xC0U | length);
      m_File.Write(&byte, 1);
    }
    else if (length < (std::uint64_t{ 1 } << 14))
    {
      Number(static_cast<std::uint16_t>(0x8000U | length));
    }
    else if (length < (std::uint64_t{ 1 } << 30))
    {
      Number(static_cast<std::uint32_t>(0x40000000U | length));
    }
    else
    {
      Number(length);
    }
    m_File.Write(text);
  }

  void
  Values(const Array & array)
  {
    for (const double value : array.reals)
    {
      Number(value);
    }
    for (const std::int64_t value : array.wholes)
    {
      Number(value);
    }
    Line("");
  }

  void
  Finish()
  {
    m_File.Finish();
  }

private:
  OutputFile m_File;
};

void
WriteFields(BigEndianFile & file, const std::vector<const Array *> & arrays)
{
  file.Line("FIELD FieldData " + std::to_string(arrays.size()));
  for (const Array * array : arrays)
  {
    file.Line(array->name + " " + std::to_string(array->components) + " " + std::to_string(array->tuples) + " " +
              (array->isText   ? "string"
               : array->isReal ? "double"
                               : "vtktypeint64"));
    if (array->isText)
    {
      file.Text(array->text);
      file.Line("");
    }
    else
    {
      file.Values(*array);
    }
  }
}

void
WriteCells(BigEndianFile & file, const PlainArrays & arrays, const char * section, const char * word)
{
  const std::uint64_t cells = arrays.CellCount(section);
  if (cells == 0)
  {
    return;
  }
  const Array & offsets = arrays.Named(section, "offsets");
  const Array & points = arrays.Named(section, "connectivity");
  file.Line(word + std::string(" ") + std::to_string(cells) + " " + std::to_string(cells + points.tuples));
  for (std::uint64_t cell = 0; cell < cells; ++cell)
  {
    const auto from = static_cast<std::uint64_t>(offsets.Value(cell));
    const auto to = static_cast<std::uint64_t>(offsets.Value(cell + 1));
    file.Number(static_cast<std::int32_t>(to - from));
    for (std::uint64_t i = from; i < to; ++i)
    {
      file.Number(static_cast<std::int32_t>(points.Value(i)));
    }
  }
  file.Line("");
}

} // namespace

void
WriteVtk(const std::filesystem::path & path, const MedialModel & model, bool keepEdges)
{
  PlainArrays arrays;
  WriteParts(model, keepEdges, arrays);
  BigEndianFile file(path);
  file.Line("# vtk DataFile Version 4.2");
  file.Line("VoxelCore medial surface. SPACE=LPS Units=" + UnitName(model.unit));
  file.Line("BINARY");
  file.Line("DATASET POLYDATA");
  WriteFields(file, arrays.Of("FieldData"));
  file.Line("POINTS " + std::to_string(arrays.PointCount()) + " double");
  file.Values(arrays.Named("Points", "Points"));
  WriteCells(file, arrays, "Verts", "VERTICES");
  WriteCells(file, arrays, "Lines", "LINES");
  WriteCells(file, arrays, "Polys", "POLYGONS");
  const std::uint64_t cells = arrays.CellCount("Verts") + arrays.CellCount("Lines") + arrays.CellCount("Polys");
  const auto          writeData = [&](const char * word, std::uint64_t count, const char * section) {
    if (count > 0)
    {
      file.Line(word + std::string(" ") + std::to_string(count));
      WriteFields(file, arrays.Of(section));
    }
  };
  writeData("CELL_DATA", cells, "CellData");
  writeData("POINT_DATA", arrays.PointCount(), "PointData");
  file.Finish();
}

} // namespace voxelcore
