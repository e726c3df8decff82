#include "Models/Models/ModelFixtures.h"

#include "voxelcore/Base/Error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

/** Takes numbers off a string of bytes. */
struct Bytes
{
  std::string text;
  std::size_t at = 0;

  template <typename Number>
  Number
  Take()
  {
    Number number{};
    if (at + sizeof(Number) <= text.size())
    {
      std::memcpy(&number, text.data() + at, sizeof(Number));
    }
    at += sizeof(Number);
    return number;
  }
  std::string
  Line()
  {
    const auto end = text.find('\n', at);
    const auto line = text.substr(at, end - at);
    at = end == std::string::npos ? text.size() : end + 1;
    return line;
  }
};

std::vector<std::string>
Lines(const std::filesystem::path & path)
{
  std::vector<std::string> lines;
  std::istringstream       text(ReadAll(path));
  for (std::string line; std::getline(text, line);)
  {
    lines.push_back(line);
  }
  return lines;
}

std::vector<double>
Numbers(const std::string & line)
{
  std::istringstream  text(line);
  std::string         word;
  std::vector<double> numbers;
  text >> word;
  while (text >> word)
  {
    numbers.push_back(std::strtod(word.c_str(), nullptr));
  }
  return numbers;
}

} // namespace

TEST(MeshFormats, PlyHoldsEverythingInDoublePrecision)
{
  const TemporaryFolder folder;
  const MedialModel     model = MixedModel();
  const ModelOmissions  omissions = WriteModel(folder / "tmp.part", "a.ply", model);
  EXPECT_EQ(omissions.vertices + omissions.edges + omissions.labels, 0U);
  Bytes bytes{ ReadAll(folder / "tmp.part") };
  EXPECT_EQ(bytes.Line(), "ply");
  EXPECT_EQ(bytes.Line(), "format binary_little_endian 1.0");
  std::string header;
  for (std::string line; (line = bytes.Line()) != "end_header" && bytes.at < bytes.text.size();)
  {
    header += line + "\n";
  }
  EXPECT_NE(header.find("comment SPACE=LPS\n"), std::string::npos);
  EXPECT_NE(header.find("element vertex 13\nproperty double x\nproperty double y\nproperty double z\n"
                        "property double radius\nproperty double lambda\nproperty int label\n"),
            std::string::npos);
  EXPECT_NE(header.find("element face 2\nproperty list uchar int vertex_indices\n"), std::string::npos);
  EXPECT_NE(header.find("element edge 2\nproperty int vertex1\nproperty int vertex2\n"), std::string::npos);
  for (const ModelPart & part : model.parts)
  {
    for (std::size_t v = 0; v < part.core.cells.vertexCount; ++v)
    {
      for (const double coordinate : part.core.positions[v])
      {
        EXPECT_EQ(bytes.Take<double>(), coordinate);
      }
      EXPECT_EQ(bytes.Take<double>(), part.core.radius[v]);
      EXPECT_EQ(bytes.Take<double>(), part.core.vertexLambda[v]);
      EXPECT_EQ(bytes.Take<std::int32_t>(), part.label);
    }
  }
  const std::vector<std::vector<int>> faces{ { 0, 1, 2, 3 }, { 1, 2, 6, 7, 8 } };
  for (std::size_t face = 0; face < 2; ++face)
  {
    EXPECT_EQ(bytes.Take<std::uint8_t>(), faces[face].size());
    for (const int corner : faces[face])
    {
      EXPECT_EQ(bytes.Take<std::int32_t>(), corner);
    }
    EXPECT_EQ(bytes.Take<double>(), model.parts[0].core.faceLambda[face]);
    EXPECT_EQ(bytes.Take<std::int32_t>(), 3);
  }
  for (const std::array<int, 3> & edge : { std::array{ 3, 4, 3 }, std::array{ 11, 12, 300 } })
  {
    EXPECT_EQ(bytes.Take<std::int32_t>(), edge[0]);
    EXPECT_EQ(bytes.Take<std::int32_t>(), edge[1]);
    EXPECT_GT(bytes.Take<double>(), 0);
    EXPECT_EQ(bytes.Take<std::int32_t>(), edge[2]);
  }
  EXPECT_EQ(bytes.at, bytes.text.size());
}

TEST(MeshFormats, PlyLabelsBeyondItsIntegersStayExactOrAreCounted)
{
  const TemporaryFolder folder;
  MedialModel           model = MixedModel();
  model.parts[2].label = std::int64_t{ 1 } << 40;
  EXPECT_EQ(WriteModel(folder / "a.ply", "a.ply", model).labels, 0U);
  EXPECT_NE(ReadAll(folder / "a.ply").find("property double label\n"), std::string::npos);
  model.parts[2].label = (std::int64_t{ 1 } << 53) + 1;
  EXPECT_EQ(WriteModel(folder / "a.ply", "a.ply", model).labels, 3U);
  EXPECT_EQ(ReadAll(folder / "a.ply").find("label\n"), std::string::npos);
}

TEST(MeshFormats, ObjHoldsAllElementsByLabel)
{
  const TemporaryFolder folder;
  const MedialModel     model = MixedModel();
  const ModelOmissions  omissions = WriteModel(folder / "a.obj", "a.obj", model);
  EXPECT_EQ(omissions.vertices + omissions.edges + omissions.labels, 0U);
  const std::vector<std::string> lines = Lines(folder / "a.obj");
  ASSERT_EQ(lines.size(), 3U + 13 + 3 + 3 + 2 + 2);
  EXPECT_EQ(lines[1], "# SPACE=LPS");
  std::size_t line = 3;
  for (const ModelPart & part : model.parts)
  {
    for (const auto & position : part.core.positions)
    {
      EXPECT_EQ(lines[line].substr(0, 2), "v ");
      EXPECT_EQ(Numbers(lines[line++]), (std::vector<double>(position.begin(), position.end()))); // every bit
    }
  }
  EXPECT_EQ(std::vector<std::string>(lines.begin() + 16, lines.end()),
            (std::vector<std::string>{ "g label-3",
                                       "p 6",
                                       "l 4 5",
                                       "f 1 2 3 4",
                                       "f 2 3 7 8 9",
                                       "g label-7",
                                       "p 10",
                                       "p 11",
                                       "g label-300",
                                       "l 12 13" }));
}

TEST(MeshFormats, ComponentsAreNamedWhereTheFormatCan)
{
  const TemporaryFolder folder;
  MedialModel           model = MixedModel();
  model.parts[1].label = 3;
  model.parts[0].component = 1;
  model.parts[1].component = 2;
  model.parts[2].component = 1;
  EXPECT_EQ(WriteModel(folder / "a.obj", "a.obj", model).labels, 0U);
  const std::vector<std::string> lines = Lines(folder / "a.obj");
  for (const char * group : { "g label-3_component-1", "g label-3_component-2", "g label-300_component-1" })
  {
    EXPECT_EQ(std::count(lines.begin(), lines.end(), group), 1) << group;
  }
  const std::size_t whole = [&] {
    WriteModel(folder / "w.ply", "w.ply", MixedModel());
    return ReadAll(folder / "w.ply").size();
  }();
  EXPECT_EQ(WriteModel(folder / "a.ply", "a.ply", model).labels, 0U);
  const std::string ply = ReadAll(folder / "a.ply");
  const std::string property = "property int component\n";
  EXPECT_NE(ply.find("property int label\n" + property + "element face"), std::string::npos);
  // A number for each of the 13 points, the 2 polygons and the 2 edges.
  EXPECT_EQ(ply.size(), whole + 3 * property.size() + 4 * (13 + 2 + 2));
  EXPECT_EQ(ply.substr(ply.size() - 4), std::string("\1\0\0\0", 4));
  EXPECT_EQ(WriteModel(folder / "a.stl", "a.stl", model).labels, 3U);
}

TEST(MeshFormats, StlHoldsTrianglesAndCountsTheRest)
{
  const TemporaryFolder folder;
  const MedialModel     model = MixedModel();
  const ModelOmissions  omissions = WriteModel(folder / "a.stl", "a.stl", model);
  EXPECT_EQ(omissions.vertices, 3U);
  EXPECT_EQ(omissions.edges, 2U);
  EXPECT_EQ(omissions.labels, 3U);
  Bytes bytes{ ReadAll(folder / "a.stl") };
  EXPECT_EQ(bytes.text.size(), 84U + 5 * 50);
  EXPECT_NE(bytes.text.substr(0, 80).find("SPACE=LPS"), std::string::npos);
  EXPECT_NE(bytes.text.substr(0, 5), "solid");
  bytes.at = 80;
  EXPECT_EQ(bytes.Take<std::uint32_t>(), 5U);
  const std::array<float, 3>          normal{ bytes.Take<float>(), bytes.Take<float>(), bytes.Take<float>() };
  std::array<std::array<float, 3>, 3> p{};
  for (std::size_t corner = 0; corner < 3; ++corner)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      p[corner][axis] = bytes.Take<float>();
      EXPECT_EQ(p[corner][axis], static_cast<float>(model.parts[0].core.positions[corner][axis]));
    }
  }
  EXPECT_EQ(bytes.Take<std::uint16_t>(), 0U);
  double squared = 0;
  double along = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    squared += normal[axis] * normal[axis];
    along += normal[axis] * (p[1][axis] - p[0][axis]);
  }
  EXPECT_NEAR(squared, 1, 1e-5);
  EXPECT_NEAR(along, 0, 1e-5);

  MedialModel square;
  square.parts.push_back({ 1, MakeCore(4, {}, { { 0, 1, 2, 3 } }) });
  const ModelOmissions none = WriteModel(folder / "b.stl", "b.stl", square);
  EXPECT_EQ(none.vertices + none.edges + none.labels, 0U);
}

TEST(MeshFormats, MaListsSpheresAllEdgesAndTriangles)
{
  const TemporaryFolder folder;
  const MedialModel     model = MixedModel();
  const ModelOmissions  omissions = WriteModel(folder / "a.ma", "a.ma", model);
  EXPECT_EQ(omissions.vertices + omissions.edges, 0U);
  EXPECT_EQ(omissions.labels, 3U);
  const std::vector<std::string> lines = Lines(folder / "a.ma");
  ASSERT_EQ(lines.size(), 1U + 13 + 13 + 5); // 8 edges on faces, 3 diagonals, 2 on no face
  EXPECT_EQ(lines[0], "13 13 5");
  std::size_t line = 1;
  for (const ModelPart & part : model.parts)
  {
    for (std::size_t v = 0; v < part.core.cells.vertexCount; ++v)
    {
      const auto & p = part.core.positions[v];
      EXPECT_EQ(lines[line][0], 'v');
      EXPECT_EQ(Numbers(lines[line++]), (std::vector<double>{ p[0], p[1], p[2], part.core.radius[v] }));
    }
  }
  std::vector<std::string> edges(lines.begin() + 14, lines.begin() + 27);
  EXPECT_EQ(edges.front(), "e 0 1");
  EXPECT_EQ(edges.back(), "e 11 12");
  EXPECT_NE(std::find(edges.begin(), edges.end(), "e 1 6"), edges.end());
  EXPECT_EQ(std::vector<std::string>(lines.begin() + 27, lines.end()),
            (std::vector<std::string>{ "f 0 1 2", "f 0 2 3", "f 1 2 6", "f 1 6 7", "f 1 7 8" }));
}

TEST(MeshFormats, EqualModelsGiveEqualBytes)
{
  const TemporaryFolder folder;
  const MedialModel     model = RandomModel(5, 9, 3);
  for (const std::string name : { "a.vtp", "a.vtk", "a.ply", "a.obj", "a.stl", "a.ma" })
  {
    for (const bool triangles : { false, true })
    {
      WriteModel(folder / "1", name, model, { triangles, true });
      WriteModel(folder / "2", name, model, { triangles, true });
      EXPECT_GT(std::filesystem::file_size(folder / "1"), 1000U);
      EXPECT_EQ(ReadAll(folder / "1"), ReadAll(folder / "2")) << name;
    }
  }
}

TEST(MeshFormats, ExtensionsAreKnownInAnyCase)
{
  EXPECT_TRUE(IsModelPath("x/a.vtp") && IsModelPath("a.VTK") && IsModelPath("a.Ply") && IsModelPath("a.obj") &&
              IsModelPath("a.stl") && IsModelPath("a.ma"));
  EXPECT_FALSE(IsModelPath("vtp") || IsModelPath("a.vtp.gz") || IsModelPath("a.nrrd") || IsModelPath("x.vtp/"));
  const TemporaryFolder folder;
  EXPECT_THROW(WriteModel(folder / "a.vtp", "a.xyz", MixedModel()), UsageError);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.vtp"));
}
