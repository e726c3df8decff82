#include "ModelFormats.h"
#include "PlainArrays.h"
#include "VtpPacking.h"
#include "voxelcore/Base/OutputFile.h"
#include "voxelcore/Models/AppendedVtp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <locale>
#include <sstream>

namespace voxelcore
{
namespace
{

using Array = PlainArrays::Array;

/** VTK leaves room for the longest number, as it writes some attributes when it knows them. */
std::string
Padded(const std::string & value)
{
  return value + "\"" + std::string(value.size() < 20 ? 20 - value.size() : 0, ' ');
}

std::string
Text(double value)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(11);
  text << value;
  return text.str();
}

/** Of the values, or of the lengths of vectors. */
std::string
Range(const Array & array)
{
  double smallest = 1e299; // VTK's greatest double, which stays where there are no values
  double greatest = -smallest;
  for (std::uint64_t tuple = 0; tuple < array.tuples; ++tuple)
  {
    const auto width = static_cast<std::uint64_t>(array.components);
    double     value = array.Value(tuple * width);
    if (width > 1)
    {
      value *= value;
      for (std::uint64_t i = 1; i < width; ++i)
      {
        const double next = array.Value(tuple * width + i);
        value += next * next;
      }
    }
    smallest = std::min(smallest, value);
    greatest = std::max(greatest, value);
  }
  const bool isVector = array.components > 1 && array.tuples > 0;
  return " RangeMin=\"" + Padded(Text(isVector ? std::sqrt(smallest) : smallest)) + " RangeMax=\"" +
         Padded(Text(isVector ? std::sqrt(greatest) : greatest));
}

std::string
NoRange()
{
  return " RangeMin=\"" + Padded("") + " RangeMax=\"" + Padded("");
}

/** The arrays one after another, and the header that names them. */
class Appended
{
public:
  explicit Appended(std::string & header)
    : m_Header(header)
  {}

  void
  Name(const Array & array, std::uint64_t skipped = 0)
  {
    const bool isCells = array.name == "connectivity" || array.name == "offsets"; // which VTK leaves without a range
    const bool isField = array.section == "FieldData";
    m_Header += isField ? "      " : "        ";
    if (array.isText)
    {
      m_Header += "<Array type=\"String\" Name=\"" + array.name + "\" NumberOfTuples=\"1\" format=\"appended\"";
    }
    else
    {
      m_Header += "<DataArray type=\"" +
                  std::string(array.isReal     ? "Float64"
                              : array.isNarrow ? "Int32"
                                               : "Int64") +
                  "\" Name=\"" + array.name + "\"";
      m_Header +=
        array.components > 1 ? " NumberOfComponents=\"" + std::to_string(array.components) + "\"" : std::string();
      m_Header += isField ? " NumberOfTuples=\"" + std::to_string(array.tuples) + "\"" : std::string();
      m_Header += " format=\"appended\"" + (isCells ? NoRange() : Range(array));
    }
    m_Header += " offset=\"";
    m_Blocks.push_back({ &array, skipped, m_Header.size() });
    m_Header += Padded("") + "/>\n";
  }

  /** Behind the header, which begins the file and is filled in. */
  void
  Write(OutputFile & file) const
  {
    const std::uint64_t        begin = file.Place();
    std::vector<std::uint64_t> places;
    for (const Block & block : m_Blocks)
    {
      places.push_back(file.Place());
      file.Write(PackVtpArray(BytesOf(block)));
    }
    const std::uint64_t end = file.Place();
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      file.MoveTo(m_Blocks[i].offsetAt);
      file.Write(Padded(std::to_string(places[i] - begin)));
    }
    file.MoveTo(end);
  }

private:
  struct Block
  {
    const Array * array;
    std::uint64_t skipped;  ///< values that are not written
    std::size_t   offsetAt; ///< in the header
  };

  static std::string_view
  BytesOf(const Block & block)
  {
    const Array & array = *block.array;
    if (array.isText)
    {
      return { array.text.c_str(), array.text.size() + 1 };
    }
    const auto bytes = [&](const auto & values) {
      constexpr std::size_t width = sizeof(values[0]);
      return std::string_view(reinterpret_cast<const char *>(values.data()) + block.skipped * width,
                              (values.size() - block.skipped) * width);
    };
    return array.isReal ? bytes(array.reals) : array.isNarrow ? bytes(array.indices) : bytes(array.wholes);
  }

  std::string &      m_Header;
  std::vector<Block> m_Blocks;
};

/** VTK's form, with appended data in zlib's streams. */
void
WriteArrays(const std::filesystem::path & path, const PlainArrays & arrays)
{
  const Array noStrips{ "Strips", "connectivity", {}, {}, {}, {}, 0, 1, false, false, false };
  const Array noOffsets{ "Strips", "offsets", {}, {}, {}, {}, 0, 1, false, false, false };

  std::string header =
    "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
    "compressor=\"" +
    std::string(kCompressor) + "\">\n  <PolyData>\n";
  Appended   appended(header);
  const auto named = [&](const std::string & section, const std::string & indent, auto && add) {
    header += indent + "<" + section + ">\n";
    add();
    header += indent + "</" + section + ">\n";
  };
  const auto namedAll = [&](const char * section, const std::string & indent) {
    named(section, indent, [&] {
      for (const Array * array : arrays.Of(section))
      {
        appended.Name(*array);
      }
    });
  };
  const auto count = [](const char * name, std::uint64_t number) {
    return " NumberOf" + std::string(name) + "=\"" + Padded(std::to_string(number));
  };
  namedAll("FieldData", "    ");
  header += "    <Piece" + count("Points", arrays.PointCount()) + count("Verts", arrays.CellCount("Verts")) +
            count("Lines", arrays.CellCount("Lines")) + count("Strips", 0) + count("Polys", arrays.CellCount("Polys")) +
            ">\n";
  namedAll("PointData", "      ");
  namedAll("CellData", "      ");
  namedAll("Points", "      ");
  for (const char * section : { "Verts", "Lines", "Strips", "Polys" })
  {
    named(section, "      ", [&] {
      const bool strips = std::string_view(section) == "Strips";
      appended.Name(strips ? noStrips : arrays.Named(section, "connectivity"));
      appended.Name(strips ? noOffsets : arrays.Named(section, "offsets"), strips ? 0 : 1); // the first is always 0
    });
  }
  header += "    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n   _";

  OutputFile file(path);
  file.Write(header);
  appended.Write(file);
  file.Write("\n  </AppendedData>\n</VTKFile>\n");
  file.Finish();
}

} // namespace

void
WriteVtp(const std::filesystem::path & path, const MedialModel & model, bool keepEdges)
{
  PlainArrays arrays;
  WriteParts(model, keepEdges, arrays);
  WriteArrays(path, arrays);
}

void
WriteVtp(const std::filesystem::path & path, VtpContent content)
{
  PlainArrays arrays;
  for (const auto & [name, text] : content.texts)
  {
    arrays.Text(name.c_str(), text);
  }
  const auto takeAll = [&](const char * section, std::vector<std::pair<std::string, VtpValues>> & list) {
    for (auto & [name, values] : list)
    {
      std::visit([&, &called = name](auto & numbers) { arrays.Take(section, called, std::move(numbers)); }, values);
    }
  };
  takeAll("PointData", content.pointArrays);
  takeAll("CellData", content.cellArrays);
  arrays.Take("Points", "Points", std::move(content.positions), 3);
  constexpr std::array<const char *, 3> sections{ "Verts", "Lines", "Polys" };
  for (std::size_t kind = 0; kind < sections.size(); ++kind)
  {
    VtpCells & cells = content.cells[kind];
    cells.offsets.insert(cells.offsets.begin(), 0);
    arrays.Take(sections[kind], "connectivity", std::move(cells.points));
    arrays.Take(sections[kind], "offsets", std::move(cells.offsets));
  }
  WriteArrays(path, arrays);
}

} // namespace voxelcore
