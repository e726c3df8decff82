#pragma once
// Cross-sections of a body across the branches of its skeleton: what a vessel lab or an airway lab measures.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Refinement/SurfaceEstimate.h"
#include "voxelcore/Shape/VoxelShape.h"
#include "voxelcore/Skeleton/BranchTable.h"
#include "voxelcore/Skeleton/SkeletonGraph.h"

#include <optional>
#include <vector>

namespace voxelcore
{

/** Where a plane across a branch meets the body: the connected part around the branch. Lengths in mm; places and
 *  directions in LPS. Where the outline leaves nothing of the body around the place, area, perimeter and
 *  diameters are NaN, and there is no contour. */
struct BranchSection
{
  ElementIndex branch = 0;
  double       arc = 0;              ///< along the branch from its first point
  Vector3      place{};              ///< on the branch
  Vector3      axis{};               ///< unit length, at right angles to the section, the way the branch runs
  double       area = 0;             ///< mm^2, without holes
  double       perimeter = 0;        ///< of all contours
  double       leastDiameter = 0;    ///< the least distance of two parallel lines around it
  double       greatestDiameter = 0; ///< the greatest distance of two of its points
  Vector3      leastWay{};           ///< unit length, across those lines
  Vector3      greatestWay{};        ///< unit length, from one of those points to the other
  Vector3      centre{};             ///< of gravity
  ElementIndex runsInto = kNoBranch; ///< the branch that a part of the contour is nearer to
  bool         isCut = false;        ///< it reaches the border of the scan

  std::vector<std::vector<Vector3>> contours; ///< closed: the last point is joined to the first; holes run backwards

  /** Diameter of the circle of the same area. */
  double
  EquivalentDiameter() const;

  /** 4 pi area / perimeter^2: 1 for a circle. */
  double
  Circularity() const;
};

/** A body in the voxels of `geometry`. A surface that is known better than its voxels, from grey values or a mesh, is
 *  in mm along the axes of the grid; without one the voxels tell the outlines. All must outlive the call. */
struct SectionBody
{
  const VoxelShape *      shape = nullptr;
  const SurfaceEstimate * surface = nullptr;
  ImageGeometry           geometry;
  std::optional<VoxelBox> scan; ///< whose border may cut the body
};

/** Sections at each point of each branch, or, with `every`, at places so far apart, about, from end to end. Those of
 *  round and flat tubes have their area within 2 percent, whatever their direction. In order of branches and arcs. The
 *  same bits for every number of threads. `graph` in LPS mm of the geometry. */
std::vector<BranchSection>
MeasureSections(const SkeletonGraph & graph, const SectionBody & body, std::optional<double> every);

} // namespace voxelcore
