#pragma once
// What is shown of a scan: per label its surface, its medial surface and its curve skeleton, with a name and a colour.

#include "voxelcore/Models/MedialModel.h"
#include "voxelcore/Skeleton/SkeletonGraph.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace voxelcore
{

using Color = std::array<double, 3>; ///< red, green, blue from 0 to 1

/** Triangles in LPS mm, seen counter-clockwise from outside. */
struct LabelSurfaceMesh
{
  std::vector<std::array<float, 3>>         points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/** One label, or one component of it; LPS mm. What is not to be shown is empty. */
struct DisplayLabel
{
  std::int64_t             label = 0;
  std::int64_t             component = 0; ///< from 1 for a label split into its components; 0: the whole label
  std::string              name;
  Color                    color{ 0.8, 0.8, 0.8 };
  LabelSurfaceMesh         surface;
  ModelPart                medial;
  std::vector<double>      erosionThickness; ///< of the medial surface's vertices; empty when it is not known
  SkeletonGraph            curves;
  std::vector<double>      confidence;       ///< of the curves' points: PointConfidence()
  bool                     hasRadius = true; ///< radii are known; else those of the medial surface are 0
  std::vector<std::string> curveNames;       ///< per branch of the curves; empty, or pages can colour by branch
};

/** By label, then component. */
struct DisplayContent
{
  std::vector<DisplayLabel> labels;
  SpatialUnit               unit = SpatialUnit::Millimetres; ///< of all lengths
  bool                      areSheets = false;               ///< each label is a sheet or rod
};

} // namespace voxelcore
