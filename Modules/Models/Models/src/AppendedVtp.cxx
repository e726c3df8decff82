#include "voxelcore/Models/AppendedVtp.h"

#include "VtpPacking.h"
#include "voxelcore/Base/OutputFile.h"

#include <type_traits>
#include <utility>

namespace voxelcore
{

namespace
{

/** Appended arrays and the header that names them, as VTK's writer makes them. */
class AppendedArrays
{
public:
  template <typename Value>
  void
  Add(const std::string & name, const std::vector<Value> & values, int components = 1)
  {
    const char * type = std::is_same_v<Value, double> ? "Float64" : "Int64";
    m_Header += "        <DataArray type=\"" + std::string(type) + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
                std::to_string(components) + "\" format=\"appended\" offset=\"" + std::to_string(m_Data.size()) +
                "\"/>\n";
    m_Data += PackVtpArray(std::span(values));
  }

  void
  AddText(const std::string & name, const std::string & text)
  {
    m_Header += "        <Array type=\"String\" Name=\"" + name +
                "\" NumberOfTuples=\"1\" format=\"appended\" offset=\"" + std::to_string(m_Data.size()) + "\"/>\n";
    m_Data += PackVtpArray({ text.c_str(), text.size() + 1 });
  }

  void
  Tag(const std::string & tag)
  {
    m_Header += "      <" + tag + ">\n";
  }

  std::string
  TakeHeader()
  {
    return std::exchange(m_Header, {});
  }

  const std::string &
  Data() const
  {
    return m_Data;
  }

private:
  std::string m_Header;
  std::string m_Data;
};

} // namespace

void
WriteVtp(const std::filesystem::path & path, const VtpContent & content)
{
  AppendedArrays arrays;
  arrays.Tag("FieldData");
  for (const auto & [name, text] : content.texts)
  {
    arrays.AddText(name, text);
  }
  arrays.Tag("/FieldData");
  const std::string fields = arrays.TakeHeader();
  arrays.Tag("PointData");
  const auto addAll = [&](const std::vector<std::pair<std::string, VtpValues>> & list) {
    for (const auto & [name, values] : list)
    {
      const std::string & called = name;
      std::visit([&](const auto & numbers) { arrays.Add(called, numbers); }, values);
    }
  };
  addAll(content.pointArrays);
  arrays.Tag("/PointData");
  arrays.Tag("CellData");
  addAll(content.cellArrays);
  arrays.Tag("/CellData");
  arrays.Tag("Points");
  arrays.Add("Points", content.positions, 3);
  arrays.Tag("/Points");
  const char * names[3] = { "Verts", "Lines", "Polys" };
  for (int kind = 0; kind < 3; ++kind)
  {
    arrays.Tag(names[kind]);
    arrays.Add("connectivity", content.cells[kind].points);
    arrays.Add("offsets", content.cells[kind].offsets);
    arrays.Tag(std::string("/") + names[kind]);
  }
  const auto count = [](std::size_t n) { return "\"" + std::to_string(n) + "\""; };
  OutputFile file(path);
  file.Write(
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
    "header_type=\"UInt64\" compressor=\"" +
    std::string(kCompressor) + "\">\n  <PolyData>\n");
  file.Write(fields);
  file.Write("    <Piece NumberOfPoints=" + count(content.positions.size() / 3) + " NumberOfVerts=" +
             count(content.cells[0].offsets.size()) + " NumberOfLines=" + count(content.cells[1].offsets.size()) +
             " NumberOfStrips=\"0\" NumberOfPolys=" + count(content.cells[2].offsets.size()) + ">\n");
  file.Write(arrays.TakeHeader());
  file.Write("    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n   _");
  file.Write(arrays.Data());
  file.Write("\n  </AppendedData>\n</VTKFile>\n");
  file.Finish();
}

} // namespace voxelcore
