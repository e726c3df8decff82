#include "SourceDigest.h"
#include "voxelcore/Delaunay/DelaunayCells.h"
#include "voxelcore/Formats/FormatOpeners.h"
#include "voxelcore/Report/BuildFacts.h"
#include "voxelcore/Report/CoreReport.h"

namespace voxelcore
{

std::string
VoxelCoreVersion()
{
  return VOXELCORE_VERSION;
}

std::string
SourceDigest()
{
  return VOXELCORE_SOURCE_DIGEST;
}

std::string
VersionText()
{
  std::string text = "voxelcore " + VoxelCoreVersion() + "\nsources: " + SourceDigest() + "\nengines: lattice";
  if (HasEngine(Engine::TetGen))
  {
    text += ", tetgen (AGPL-3, and so is this program as a whole)";
  }
  text += "\nlibraries: " + ModelLibrary();
  for (const std::string & library : FormatLibraries())
  {
    text += ", " + library;
  }
#ifdef _OPENMP
  text += ", OpenMP " + std::to_string(_OPENMP);
#else
  text += ", one thread";
#endif
  return text + "\n";
}

} // namespace voxelcore
