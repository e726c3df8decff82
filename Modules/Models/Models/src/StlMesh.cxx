#include "MeshText.h"

#include <bit>
#include <cstring>

namespace voxelcore
{
namespace
{

constexpr std::size_t kHeader = 84;
constexpr std::size_t kFacet = 50;

static_assert(std::endian::native == std::endian::little, "binary STL is read as it lies");

std::uint32_t
PromisedFacets(std::string_view bytes)
{
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof(count));
  return count;
}

MeshFile
ParseBinary(std::string_view bytes)
{
  const std::size_t count = PromisedFacets(bytes);
  MeshFile          file;
  for (std::size_t facet = 0; facet < count; ++facet)
  {
    float corner[9];
    std::memcpy(corner, bytes.data() + kHeader + facet * kFacet + 12, sizeof(corner)); // behind the normal
    const auto first = static_cast<std::uint32_t>(file.mesh.points.size());
    for (std::size_t c = 0; c < 3; ++c)
    {
      for (std::size_t a = 0; a < 3; ++a)
      {
        if (!std::isfinite(corner[3 * c + a]))
        {
          throw UnfitFile{ "a coordinate of facet " + std::to_string(facet + 1) + " is not a finite number" };
        }
      }
      file.mesh.points.push_back({ corner[3 * c], corner[3 * c + 1], corner[3 * c + 2] });
    }
    file.mesh.triangles.push_back({ first, first + 1, first + 2 });
  }
  return file;
}

MeshFile
ParseText(std::string_view bytes)
{
  MeshFile   file;
  MeshText   text(bytes);
  const auto expect = [&](std::string_view word) {
    text.Require(text.Word() == word, "'" + std::string(word) + "' is missing");
  };
  const auto line = [&] { text.Require(text.NextLine('\0'), "it ends too early"); };
  while (text.NextLine('\0'))
  {
    expect("solid");
    for (line();; line())
    {
      const std::string_view word = text.Word();
      if (word == "endsolid")
      {
        break;
      }
      text.Require(word == "facet", "'facet' or 'endsolid' is missing");
      line();
      expect("outer");
      expect("loop");
      const auto first = static_cast<std::uint32_t>(file.mesh.points.size());
      for (int c = 0; c < 3; ++c)
      {
        line();
        expect("vertex");
        file.mesh.points.push_back(text.Point());
      }
      file.mesh.triangles.push_back({ first, first + 1, first + 2 });
      line();
      expect("endloop");
      line();
      expect("endfacet");
    }
  }
  return file;
}

} // namespace

MeshFile
ParseStl(std::string_view bytes)
{
  // Some binary files begin with "solid", too; their length tells.
  const bool        hasCount = bytes.size() >= kHeader;
  const std::size_t promised = hasCount ? kHeader + kFacet * std::size_t{ PromisedFacets(bytes) } : 0;
  const bool        isText = bytes.starts_with("solid") && !(hasCount && promised == bytes.size()) &&
                      bytes.substr(0, 1024).find('\0') == std::string_view::npos;
  if (!isText)
  {
    RequireFit(hasCount, "it is neither a text that begins with 'solid' nor long enough for binary STL");
    if (promised != bytes.size())
    {
      throw UnfitFile{ "its header promises " + std::to_string(PromisedFacets(bytes)) + " facets, which take " +
                       std::to_string(promised) + " bytes; it has " + std::to_string(bytes.size()) };
    }
  }
  MeshFile file = isText ? ParseText(bytes) : ParseBinary(bytes);
  file.format = "STL";
  return file;
}

} // namespace voxelcore
