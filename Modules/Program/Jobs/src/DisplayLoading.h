#pragma once
// From finished files and a scan to what is shown of them.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Models/DisplayContent.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

struct DisplaySources
{
  std::vector<std::filesystem::path>   files; ///< .vtp and .vtk with a record; other polydata and meshes as they are
  std::optional<std::filesystem::path> scan;  ///< read as the first file says
  std::string                          labels = "all";           ///< or values and names, separated by commas
  bool                                 erosionThickness = false; ///< of medial surfaces, too
};

/** Labels of all files together; names from the files' provenance, colours from the scan or the fixed palette. Of the
 *  scan the same labels, edited as the first file says, for their surfaces.
 *  \throws InputError, UsageError, Cancelled */
DisplayContent
LoadDisplayContent(const DisplaySources &     sources,
                   std::vector<std::string> & notes,
                   std::vector<std::string> & warnings,
                   const ProgressCallback &   progress);

/** Erosion thickness in mm at the vertices of a medial surface (LPS mm) of a scan of this spacing; infinite where it is
 *  closed. */
std::vector<double>
VertexErosionThickness(const MedialComplex & surface, const Vector3 & spacing, const ProgressCallback & progress);

} // namespace voxelcore
