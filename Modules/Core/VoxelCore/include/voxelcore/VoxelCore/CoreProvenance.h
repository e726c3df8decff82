#pragma once
// What the cores of an image are and what they came from, as the field Provenance of a file has it. `voxelcore core`
// says more there, of the scan's file and its options; what stands here is what those have at hand who hold the image
// in memory, and it suffices for verify, prune, skeleton and render.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Lattice/TopologyNumbers.h"
#include "voxelcore/Shape/ShapeConnectivity.h"
#include "voxelcore/Shape/VoxelShape.h"
#include "voxelcore/VoxelCore/MedialComplex.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace voxelcore
{

/** Size and topology of a complex. */
struct ComplexRecord
{
  std::uint64_t   vertices = 0;
  std::uint64_t   edges = 0;
  std::uint64_t   faces = 0;
  TopologyNumbers topology;
  double          areaMm2 = 0;
  double          maxRadiusMm = 0;
};

/** Counts, area (in the unit of its positions, squared) and greatest radius. */
ComplexRecord
DescribeComplex(const MedialComplex & complex, const TopologyNumbers & topology);

/** Moves a core from lattice coordinates, rounded to OnPlaces(), to LPS mm; reverses polygons when the geometry is
 *  left-handed, so that their normals still point from the smaller to the greater of their boundary vertices.
 *  \throws InputError as RequireDistinctPositions does */
MedialComplex
PlaceInLps(MedialComplex core, const ImageGeometry & geometry);

/** A shape and its whole core. */
struct CoreOrigin
{
  std::int64_t    label = 0;
  std::string     name;
  std::uint64_t   voxels = 0;
  VoxelBox        box; ///< tight
  std::uint64_t   boundaryVertices = 0;
  TopologyNumbers shape;
  ComplexRecord   core;                             ///< as PlaceInLps leaves it
  bool            enclosed = false;                 ///< every vertex lies inside the shape
  Connectivity    connectivity = Connectivity::Six; ///< by which the shape's voxels were made to hang together
};

/** What a core is pruned to. */
struct CorePruning
{
  std::string   lambda = "0"; ///< as given, such as "2vox"
  double        lambdaMm = 0;
  ComplexRecord complex;     ///< what is left
  std::string   tolerance{}; ///< as given, such as "1.2diag"; empty: not pruned by tolerance
  double        toleranceMm = 0;
  std::string   refined{};    ///< the surface it was refined to, such as "labels"; empty: not refined
  double        meanMove = 0; ///< of refinement, voxels
  double        farthestMove = 0;
};

/** JSON on one line, in the form of `voxelcore core`. One pruning for each origin; they share the text of the first.
 *  `keepEdges`: the file holds the measures of all edges. */
std::string
CoreProvenanceJson(const ImageGeometry &            geometry,
                   const std::vector<CoreOrigin> &  origins,
                   const std::vector<CorePruning> & prunings,
                   bool                             keepEdges);

/** The same record with cores pruned further: `prunings` one for each of its labels; a label that is pruned as far
 *  already keeps its lambda. Empty when `json` is no record of these labels. */
std::string
PrunedProvenanceJson(const std::string & json, const std::vector<CorePruning> & prunings);

/** Where a body lies: its scan's geometry, and its tight box in voxels. */
struct BodyPlace
{
  ImageGeometry geometry;
  VoxelBox      box;
};

/** Of each label of a record, in its order; empty when `json` is no record. */
std::vector<BodyPlace>
RecordedPlaces(const std::string & json);

} // namespace voxelcore
