#pragma once
// The promise, in one place: a voxel shape in, medial surfaces and curve skeletons out whose topology has been compared
// with that of the shape. What the program, the ITK and VTK filters and the Python module give away comes from here.
//
// The certificate. Euler number and Betti numbers are counted in the voxels and, independently, in every complex. They
// are equal, every vertex lies in the open shape, and after pruning by tolerance every boundary vertex lies within the
// tolerance of the balls that are left (of refined ones, no less than half a voxel's diagonal: RefinedGapBound()).
// No ball in the shape stands out of the curves that a whole core burns to (BallStandingOut()).
// Else a CertificateError is thrown, and there is no result.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Certified/CertifiedCore.h"
#include "voxelcore/Certified/CertifiedSkeleton.h"
#include "voxelcore/Certified/CertifiedThickness.h"
#include "voxelcore/Delaunay/DelaunayCells.h"
#include "voxelcore/Refinement/SurfaceEstimate.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace voxelcore
{

/** Gives the Delaunay cells of a shape, whose boundary vertices are `points`, where they are not to be computed. */
using CellSource =
  std::function<DelaunayCells(const std::vector<LatticePoint> & points, const ProgressCallback & progress)>;

/** Gives the estimate of a shape's smooth surface. Thread-safe. The shape's voxel (0,0,0) is voxel `place` of the scan,
 *  which a source that looks at the scan needs to know (BodyFrame.h); of labels alone it makes no difference. */
class SurfaceSource
{
public:
  using Estimate = std::shared_ptr<const SurfaceEstimate>;
  using Place = std::array<std::int32_t, 3>;
  using Function = std::function<Estimate(const VoxelShape & shape, const Place & place, const ProgressCallback &)>;
  using OfShape = std::function<Estimate(const VoxelShape & shape, const ProgressCallback &)>;

  SurfaceSource() = default;

  template <typename TFunction>
  requires(!std::is_same_v<std::remove_cvref_t<TFunction>, SurfaceSource>) &&
    (std::is_constructible_v<Function, TFunction> || std::is_constructible_v<OfShape, TFunction>)
      SurfaceSource(TFunction && source) // NOLINT(google-explicit-constructor): what is given is a function
  {
    if constexpr (std::is_constructible_v<Function, TFunction>)
    {
      m_Source = Function(std::forward<TFunction>(source));
    }
    else
    {
      m_IsOfShape = true;
      m_Source = [ofShape = OfShape(std::forward<TFunction>(source))](const VoxelShape & shape,
                                                                      const Place &,
                                                                      const ProgressCallback & progress) {
        return ofShape(shape, progress);
      };
    }
  }

  explicit operator bool() const
  {
    return static_cast<bool>(m_Source);
  }

  /** Whether the shape is all it looks at. */
  bool
  IsOfShape() const
  {
    return m_IsOfShape;
  }

  Estimate
  operator()(const VoxelShape & shape, const Place & place, const ProgressCallback & progress) const
  {
    return m_Source(shape, place, progress);
  }

private:
  Function m_Source;
  bool     m_IsOfShape = false;
};

/** What is asked of one shape; CompletePruning() fills in what is not said of lambdas and tolerances. */
struct CertifiedRequest
{
  std::string name = "the shape"; ///< in errors: "label 4 (liver)"

  std::vector<Lambda>    lambdas;    ///< one core each; 0: the whole core
  std::vector<Tolerance> tolerances; ///< where there are some: one core each, the only lambda is pruned first
  /** Cores are refined to it, and skeletons that ask for it. An empty function: nothing is refined. None: cores that
   *  RefinesUsually(), to the surface of the labels. */
  std::optional<SurfaceSource>    surface;
  bool                            refineCores = true; ///< where there is a surface; false: skeletons alone are refined
  std::optional<SkeletonRequest>  skeleton;  ///< of the whole core, or of one asked for as it is before refinement
  std::optional<ThicknessRequest> thickness; ///< by the first core
  std::optional<VoxelBox>         scan;      ///< what was read of a scan; none: there is no border
  bool spendsCores = false; ///< the skeleton is all that is wanted: whole cores may come described but empty, so that
                            ///< less memory is needed

  Engine     engine = Engine::Auto;
  bool       crossCheck = false; ///< both engines run, one after the other, and must agree bit for bit
  CellSource cells;              ///< instead of an engine
};

/** Wall-clock seconds. */
struct CertifiedSeconds
{
  double shape = 0;
  double delaunay = 0;
  double core = 0;
  double prune = 0; ///< with refinement
  double skeleton = 0;
  double thickness = 0;
};

/** Where cores are spent, and a skeleton goes up to the scan's border or is that of a single layer, those described are
 *  of the body that goes on beyond it, or of the two halves of the layer, and so are the boundary vertices. */
struct CertifiedResult
{
  CertifiedShape                    shape;
  std::uint64_t                     boundaryVertices = 0;
  ComplexRecord                     whole; ///< of the whole core
  std::vector<CertifiedCore>        cores; ///< one per lambda or tolerance, in the order asked for
  std::optional<CertifiedSkeleton>  skeleton;
  std::optional<CertifiedThickness> thickness;
  std::optional<bool>               covered; ///< true: every boundary gap is as promised; none: nothing is promised
  CertifiedSeconds                  seconds;
};

/** Without either, one core at kUsualTolerance is asked for. Tolerances without a lambda begin at the whole core. */
void
CompletePruning(std::vector<Lambda> & lambdas, std::vector<Tolerance> & tolerances);

/** Whether cores of a complete request are refined when nothing is said: those by tolerance are. Those by lambda alone
 *  are the paper's, and where a height is 0, to prune on from, all stay exact. */
bool
RefinesUsually(const std::vector<Tolerance> & tolerances);

/** \throws InputError where lengths are in voxels and the request has one in mm. ComputeCertified() asks this first. */
void
RequireLengthsIn(SpatialUnit unit, const CertifiedRequest & request);

/** Everything from a shape to its certified cores and skeleton; positions are in LPS mm of `geometry`, the shape lies
 *  in its voxels. The same bits for every engine and number of threads (OpenMP's), and wherever in the grid the shape
 *  lies: places in lattice coordinates, less the first voxel of its box, and all that is measured along them, are the
 *  same bits however the scan is cropped or padded (BodyFrame.h). Only what is measured of a skeleton as it stands in
 *  LPS mm (CertifiedSkeleton::skeleton.table) may differ by the rounding of these.
 *  \throws CertificateError, which names the shape; InputError for a shape or spacing that is beyond exact numbers;
 *  UsageError for a request that contradicts itself; Cancelled */
CertifiedResult
ComputeCertified(VoxelShape               shape,
                 const ImageGeometry &    geometry,
                 const CertifiedRequest & request,
                 const ProgressCallback & progress = {});

/** What a file says of the shape and its whole core. */
CoreOrigin
OriginOf(const CertifiedResult & result, std::int64_t label, std::string name, std::uint64_t voxels);

/** What a file says of how a core is pruned, and refined, if it is, from the labels. */
CorePruning
PruningOf(const CoreNumbers & numbers);

} // namespace voxelcore
