#pragma once
// A certified medial surface, and pruning one further without its voxels.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Lattice/TopologyNumbers.h"
#include "voxelcore/Shape/VoxelShape.h"
#include "voxelcore/VoxelCore/CoreProvenance.h"
#include "voxelcore/VoxelCore/LambdaPruning.h"
#include "voxelcore/VoxelCore/PlacedCore.h"
#include "voxelcore/VoxelCore/TolerancePruning.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

/** What a result is held against. */
struct CertifiedShape
{
  std::string     name;     ///< in errors
  TopologyNumbers topology; ///< counted in the voxels
  VoxelBox        box;      ///< tight
  ImageGeometry   geometry;
};

/** What pruning by tolerance did. */
struct ToleranceNumbers
{
  std::string           height; ///< as asked for
  double                heightMm = 0;
  std::optional<double> boundaryGapMm; ///< of a boundary vertex to the balls that are left, the largest; where measured
  /** Where voxels are no cubes: the largest of a gap's shares in what is promised there. */
  std::optional<double> boundaryGapShare{};
};

/** How far radii may be off as labels tell, in mm: PlacedCore::radiusMargin. */
struct MarginNumbers
{
  double mean = 0; ///< over the area of faces
  double max = 0;
};

/** What refining did to all that was refined. */
struct RefinedNumbers
{
  double                       meanDisplacement = 0; ///< in voxels (length in lattice coordinates)
  double                       maxDisplacement = 0;
  std::optional<MarginNumbers> radiusMargin{};   ///< of one refined from labels
  std::size_t                  hairsRemoved = 0; ///< by tolerance
};

/** How a core was pruned, and what is left. */
struct CoreNumbers
{
  std::string                     lambda; ///< as asked for
  double                          lambdaMm = 0;
  ComplexRecord                   complex;
  std::optional<ToleranceNumbers> tolerance;
  std::optional<RefinedNumbers>   refined;
};

struct CertifiedCore
{
  CoreNumbers numbers;
  PlacedCore  core;
};

/** Compares the numbers a core came with to those of the shape it is said to be of. \throws CertificateError */
void
RequireTopologyOf(const CertifiedShape & shape, const CertifiedCore & core);

/** A certified core pruned to each lambda, in the order given: the bits ComputeCertified() gives at once. Of a refined
 *  core the measures to the estimated surface decide, and what is left keeps its places and radii: pruning on equals
 *  pruning at once, but what is pruned first and then refined may be moved otherwise at its rims.
 *  \throws UsageError when it is pruned further already; CertificateError; Cancelled */
std::vector<CertifiedCore>
PruneCertified(CertifiedCore               core,
               const CertifiedShape &      shape,
               const std::vector<Lambda> & lambdas,
               const ProgressCallback &    progress = {});

/** The same by tolerance, of a core that has its heights; of a refined core the cells are those of one refined at that
 *  height. The boundary gap is not measured: this needs the voxels. */
std::vector<CertifiedCore>
PruneCertified(const CertifiedCore & core, const CertifiedShape & shape, const std::vector<Tolerance> & heights);

} // namespace voxelcore
