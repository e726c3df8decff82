#include "voxelcore/Models/ReadMesh.h"

#include "MeshText.h"
#include "voxelcore/Base/Error.h"

#include <algorithm>
#include <array>

namespace voxelcore
{
namespace
{

namespace fs = std::filesystem;

std::string
Extension(const fs::path & path)
{
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return extension;
}

MeshFile
ReadByExtension(const fs::path & path)
{
  const std::string extension = Extension(path);
  if (extension == ".vtp")
  {
    return ReadVtpMesh(path);
  }
  const std::string bytes = WholeFile(path);
  RequireFit(!bytes.empty(), "it is empty");
  return extension == ".stl"   ? ParseStl(bytes)
         : extension == ".obj" ? ParseObj(bytes)
         : extension == ".ply" ? ParsePly(bytes)
         : extension == ".vtk" ? ParseLegacyVtk(bytes)
                               : ParseOff(bytes);
}

} // namespace

bool
IsMeshPath(const fs::path & path)
{
  constexpr std::array<std::string_view, 6> known{ ".stl", ".obj", ".ply", ".off", ".vtk", ".vtp" };
  return std::find(known.begin(), known.end(), Extension(path)) != known.end();
}

MeshFile
ReadMesh(const fs::path & path)
{
  const auto fail = [&](const std::string & reason) {
    return InputError("cannot read mesh '" + path.string() + "': " + reason);
  };
  std::error_code ignored;
  if (!fs::exists(path, ignored))
  {
    throw fail("there is no such file");
  }
  if (!fs::is_regular_file(path, ignored))
  {
    throw fail("it is not a file");
  }
  if (!IsMeshPath(path))
  {
    throw fail("unknown extension; give .stl .obj .ply .off .vtk or .vtp");
  }
  try
  {
    MeshFile file = ReadByExtension(path);
    RequireFit(!file.mesh.triangles.empty(), "it has no triangles");
    return file;
  }
  catch (const UnfitFile & unfit)
  {
    throw fail(unfit.reason);
  }
  catch (const std::bad_alloc &)
  {
    throw fail("it is larger than the memory");
  }
  catch (const std::length_error &)
  {
    throw fail("it is larger than the memory");
  }
}

} // namespace voxelcore
