#include "ModelCells.h"
#include "ModelFormats.h"
#include "voxelcore/Models/TextFile.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/OutputFile.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

namespace voxelcore
{
namespace
{

/** Appends a number's bytes, least significant first on every machine. */
template <typename Number>
void
Append(std::string & bytes, Number number)
{
  char raw[sizeof(Number)];
  std::memcpy(raw, &number, sizeof(Number));
  if constexpr (std::endian::native == std::endian::big)
  {
    std::reverse(raw, raw + sizeof(Number));
  }
  bytes.append(raw, sizeof(Number));
}

void
FlushIfLarge(OutputFile & file, std::string & bytes, std::size_t limit = std::size_t{ 1 } << 20)
{
  if (bytes.size() > limit)
  {
    file.Write(bytes);
    bytes.clear();
  }
}

struct Counts
{
  std::uint64_t vertices = 0;
  std::uint64_t edges = 0;
  std::uint64_t looseEdges = 0;
  std::uint64_t isolated = 0;
  std::uint64_t faces = 0;
  std::size_t   mostCorners = 0;
};

Counts
Count(const MedialModel & model)
{
  Counts counts;
  for (const ModelPart & part : model.parts)
  {
    const CellComplex & cells = part.core.cells;
    const auto          onFace = EdgesOnFaces(cells);
    counts.vertices += cells.vertexCount;
    counts.edges += cells.edges.size();
    counts.looseEdges += static_cast<std::uint64_t>(std::count(onFace.begin(), onFace.end(), std::uint8_t{ 0 }));
    counts.isolated += IsolatedVertices(cells).size();
    counts.faces += cells.FaceCount();
    for (std::size_t face = 0; face < cells.FaceCount(); ++face)
    {
      counts.mostCorners = std::max(counts.mostCorners, cells.FaceVertices(face).size());
    }
  }
  return counts;
}

/** How many labels, or components of them, lose themselves in a format that knows none. */
std::uint64_t
MergedLabels(const MedialModel & model)
{
  return model.parts.size() > 1 ? model.parts.size() : 0;
}

void
RequireAtMost(std::uint64_t count, std::uint64_t most, const std::filesystem::path & path, const char * what)
{
  if (count > most)
  {
    throw OutputError("cannot write '" + path.string() + "': the format holds no more than " + std::to_string(most) +
                      " " + what + "; write .vtp instead");
  }
}

constexpr std::uint64_t kMostInt32 = 0x7FFFFFFF;

} // namespace

ModelOmissions
WritePly(const std::filesystem::path & path, const MedialModel & model)
{
  const Counts counts = Count(model);
  RequireAtMost(counts.vertices, kMostInt32, path, "vertices");
  // PLY has no 64-bit integers: labels are int where they fit, else double where that is exact, else left out.
  bool labelsFitInt = true;
  bool labelsFitDouble = true;
  bool hasComponents = false;
  for (const ModelPart & part : model.parts)
  {
    constexpr std::int64_t exact = std::int64_t{ 1 } << 53;
    labelsFitInt &= part.label == static_cast<std::int32_t>(part.label);
    labelsFitDouble &= -exact <= part.label && part.label <= exact;
    hasComponents |= part.component != 0;
  }
  const bool        labelsAreLost = !labelsFitInt && !labelsFitDouble;
  const std::string labelProperty = std::string(labelsFitInt      ? "property int label\n"
                                                : labelsFitDouble ? "property double label\n"
                                                                  : "") +
                                    (hasComponents ? "property int component\n" : "");
  const auto appendLabel = [&](std::string & bytes, const ModelPart & part) {
    if (labelsFitInt)
    {
      Append(bytes, static_cast<std::int32_t>(part.label));
    }
    else if (labelsFitDouble)
    {
      Append(bytes, static_cast<double>(part.label));
    }
    if (hasComponents)
    {
      Append(bytes, static_cast<std::int32_t>(part.component));
    }
  };
  const bool smallFaces = counts.mostCorners <= 255;

  OutputFile  file(path);
  std::string bytes =
    "ply\nformat binary_little_endian 1.0\ncomment VoxelCore medial surface\ncomment SPACE=LPS\n"
    "comment Units=" +
    UnitName(model.unit) + "\nelement vertex " + std::to_string(counts.vertices) +
    "\nproperty double x\nproperty double y\nproperty double z\nproperty double radius\n"
    "property double lambda\n" +
    labelProperty + "element face " + std::to_string(counts.faces) +
    (smallFaces ? "\nproperty list uchar int vertex_indices\n" : "\nproperty list int int vertex_indices\n") +
    "property double lambda\n" + labelProperty + "element edge " + std::to_string(counts.looseEdges) +
    "\nproperty int vertex1\nproperty int vertex2\nproperty double lambda\n" + labelProperty + "end_header\n";
  for (const ModelPart & part : model.parts)
  {
    for (std::size_t v = 0; v < part.core.cells.vertexCount; ++v)
    {
      for (const double coordinate : part.core.positions[v])
      {
        Append(bytes, coordinate);
      }
      Append(bytes, part.core.radius[v]);
      Append(bytes, part.core.vertexLambda[v]);
      appendLabel(bytes, part);
      FlushIfLarge(file, bytes);
    }
  }
  std::uint64_t first = 0;
  for (const ModelPart & part : model.parts)
  {
    for (std::size_t face = 0; face < part.core.cells.FaceCount(); ++face)
    {
      const auto corners = part.core.cells.FaceVertices(face);
      if (smallFaces)
      {
        Append(bytes, static_cast<std::uint8_t>(corners.size()));
      }
      else
      {
        Append(bytes, static_cast<std::int32_t>(corners.size()));
      }
      for (const ElementIndex corner : corners)
      {
        Append(bytes, static_cast<std::int32_t>(first + corner));
      }
      Append(bytes, part.core.faceLambda[face]);
      appendLabel(bytes, part);
      FlushIfLarge(file, bytes);
    }
    first += part.core.cells.vertexCount;
  }
  first = 0;
  for (const ModelPart & part : model.parts)
  {
    const auto onFace = EdgesOnFaces(part.core.cells);
    for (std::size_t edge = 0; edge < onFace.size(); ++edge)
    {
      if (!onFace[edge])
      {
        for (const ElementIndex vertex : part.core.cells.edges[edge])
        {
          Append(bytes, static_cast<std::int32_t>(first + vertex));
        }
        Append(bytes, part.core.edgeLambda[edge]);
        appendLabel(bytes, part);
        FlushIfLarge(file, bytes);
      }
    }
    first += part.core.cells.vertexCount;
  }
  file.Write(bytes);
  file.Finish();
  return { 0, 0, labelsAreLost ? MergedLabels(model) : 0 };
}

ModelOmissions
WriteObj(const std::filesystem::path & path, const MedialModel & model)
{
  TextFile file(path);
  file << "# VoxelCore medial surface\n# SPACE=LPS\n# Units=" << UnitName(model.unit) << "\n";
  for (const ModelPart & part : model.parts)
  {
    for (const auto & position : part.core.positions)
    {
      file << "v " << position[0] << " " << position[1] << " " << position[2] << "\n";
    }
  }
  std::uint64_t first = 1;
  for (const ModelPart & part : model.parts)
  {
    const CellComplex & cells = part.core.cells;
    file << "g label-" << part.label;
    if (part.component != 0)
    {
      file << "_component-" << part.component;
    }
    file << "\n";
    for (const ElementIndex vertex : IsolatedVertices(cells))
    {
      file << "p " << first + vertex << "\n";
    }
    const auto onFace = EdgesOnFaces(cells);
    for (std::size_t edge = 0; edge < onFace.size(); ++edge)
    {
      if (!onFace[edge])
      {
        file << "l " << first + cells.edges[edge][0] << " " << first + cells.edges[edge][1] << "\n";
      }
    }
    for (std::size_t face = 0; face < cells.FaceCount(); ++face)
    {
      file << "f";
      for (const ElementIndex corner : cells.FaceVertices(face))
      {
        file << " " << first + corner;
      }
      file << "\n";
    }
    first += cells.vertexCount;
  }
  file.Finish();
  return {};
}

ModelOmissions
WriteStl(const std::filesystem::path & path, const MedialModel & model)
{
  const Counts counts = Count(model);
  RequireAtMost(counts.faces, std::numeric_limits<std::uint32_t>::max(), path, "triangles");
  OutputFile  file(path);
  std::string bytes =
    "VoxelCore medial surface. SPACE=LPS Units=" + UnitName(model.unit); // must not begin with "solid"
  bytes.resize(80, ' ');
  Append(bytes, static_cast<std::uint32_t>(counts.faces));
  for (const ModelPart & part : model.parts)
  {
    for (std::size_t face = 0; face < part.core.cells.FaceCount(); ++face)
    {
      const auto    corners = part.core.cells.FaceVertices(face);
      const auto &  a = part.core.positions[corners[0]];
      const auto &  b = part.core.positions[corners[1]];
      const auto &  c = part.core.positions[corners[2]];
      const Vector3 u{ b[0] - a[0], b[1] - a[1], b[2] - a[2] };
      const Vector3 w{ c[0] - a[0], c[1] - a[1], c[2] - a[2] };
      const Vector3 n{ u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0] };
      const double  length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
      for (const double component : n)
      {
        Append(bytes, static_cast<float>(length > 0 ? component / length : 0));
      }
      for (const ElementIndex corner : corners)
      {
        for (const double coordinate : part.core.positions[corner])
        {
          Append(bytes, static_cast<float>(coordinate));
        }
      }
      Append(bytes, std::uint16_t{ 0 });
      FlushIfLarge(file, bytes);
    }
  }
  file.Write(bytes);
  file.Finish();
  return { counts.isolated, counts.looseEdges, MergedLabels(model) };
}

ModelOmissions
WriteMa(const std::filesystem::path & path, const MedialModel & model)
{
  const Counts counts = Count(model);
  TextFile     file(path);
  file << counts.vertices << " " << counts.edges << " " << counts.faces << "\n";
  for (const ModelPart & part : model.parts)
  {
    for (std::size_t v = 0; v < part.core.cells.vertexCount; ++v)
    {
      const auto & position = part.core.positions[v];
      file << "v " << position[0] << " " << position[1] << " " << position[2] << " " << part.core.radius[v] << "\n";
    }
  }
  std::uint64_t first = 0;
  for (const ModelPart & part : model.parts)
  {
    for (const auto & edge : part.core.cells.edges)
    {
      file << "e " << first + edge[0] << " " << first + edge[1] << "\n";
    }
    first += part.core.cells.vertexCount;
  }
  first = 0;
  for (const ModelPart & part : model.parts)
  {
    for (std::size_t face = 0; face < part.core.cells.FaceCount(); ++face)
    {
      const auto corners = part.core.cells.FaceVertices(face);
      file << "f " << first + corners[0] << " " << first + corners[1] << " " << first + corners[2] << "\n";
    }
    first += part.core.cells.vertexCount;
  }
  file.Finish();
  return { 0, 0, MergedLabels(model) };
}

} // namespace voxelcore
