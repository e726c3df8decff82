#pragma once
// A scene of 3D Slicer: one file that opens a segmentation, medial surfaces and curve skeletons with their names and
// colours.

#include "voxelcore/Models/ColorRange.h"
#include "voxelcore/Models/DisplayContent.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace voxelcore
{

/** One node with data in a file; names of files are relative to the scene's. */
struct SceneItem
{
  std::string name;
  std::string file;
  Color       color{ 0.8, 0.8, 0.8 };
};

struct SceneDescription
{
  std::vector<SceneItem> segmentations;       ///< .seg.nrrd
  std::vector<SceneItem> models;              ///< .vtp in LPS, coloured by a point array
  std::string            coloring = "Radius"; ///< the point array
  ColorRange             radius;              ///< what these colours run over; empty: each over its own
  std::vector<SceneItem> curves;              ///< .mrk.json
};

/** The text of a .mrml: each item a node with its display and storage node, all in LPS. */
std::string
SceneXml(const SceneDescription & scene);

/** Writes a zip archive of files (name in the archive, file on disk); compressed. \throws OutputError */
void
WriteZip(const std::filesystem::path & path, const std::vector<std::pair<std::string, std::filesystem::path>> & files);

} // namespace voxelcore
