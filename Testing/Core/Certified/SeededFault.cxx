// For tests of the promise: what the rooms below Certified give is damaged on its way up, where the environment
// variable VOXELCORE_SEEDED_FAULT names the stage. The linker's --wrap puts these functions in their place.

#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Refinement/Refinement.h"
#include "voxelcore/Skeleton/CurveSkeleton.h"
#include "voxelcore/Thickness/FineBracket.h"
#include "voxelcore/Thickness/LocalThickness.h"
#include "voxelcore/Thickness/SmoothBalls.h"
#include "voxelcore/VoxelCore/BallTree.h"
#include "voxelcore/VoxelCore/LambdaPruning.h"
#include "voxelcore/VoxelCore/TolerancePruning.h"
#include "voxelcore/VoxelCore/ToleranceWeights.h"
#include "voxelcore/VoxelCore/VoxelCore.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

namespace voxelcore
{
namespace
{

bool
IsSeeded(std::string_view stage)
{
  const char * const wanted = std::getenv("VOXELCORE_SEEDED_FAULT");
  return wanted != nullptr && stage == wanted;
}

/** Measures that a complex does not have are empty. */
void
TakeLast(std::vector<double> & measures)
{
  if (!measures.empty())
  {
    measures.pop_back();
  }
}

/** Takes the last face away, or the last edge where there is no face: another topology. */
void
Damage(MedialComplex & complex)
{
  CellComplex & cells = complex.cells;
  if (cells.FaceCount() > 0)
  {
    const bool hasCorners = cells.HasCorners();
    cells.faceOffsets.pop_back();
    cells.faceVertices.resize(hasCorners ? cells.faceOffsets.back() : 0);
    cells.faceEdges.resize(cells.faceOffsets.back());
    TakeLast(complex.faceLambda);
    TakeLast(complex.tolerances.faces);
  }
  else if (!cells.edges.empty())
  {
    cells.edges.pop_back();
    TakeLast(complex.edgeLambda);
    TakeLast(complex.tolerances.edges);
  }
}

/** What may be wrong with a core that is made, each against another promise. */
void
DamageCore(MedialComplex & core)
{
  if (IsSeeded("core"))
  {
    Damage(core);
  }
  if (IsSeeded("enclosure") && !core.positions.empty())
  {
    core.positions.back()[0] -= 1000;
  }
  if (IsSeeded("radius") && !core.radius.empty())
  {
    core.radius.back() *= 1.1;
  }
  if (IsSeeded("measure") && !core.faceLambda.empty())
  {
    core.faceLambda.back() *= 1.1;
  }
}

CurveOptions
OptionsOfCurves(CurveOptions options)
{
  options.branchThreshold *= IsSeeded("branches") ? 10 : 1;
  return options;
}

void
DamageCurves(CurveSkeleton & skeleton)
{
  if (IsSeeded("skeleton"))
  {
    Damage(skeleton.complex);
  }
}

} // namespace

// NOLINTBEGIN: names as the linker has them
#define VOXELCORE_BUILD                                                                                          \
  "_ZN9voxelcore14BuildVoxelCoreERKNS_10VoxelShapeESt6vectorINS_12LatticePointESaIS4_EENS_13DelaunayCellsERKNS_" \
  "14SpacingWeightsENS_7CoreUseE"
#define VOXELCORE_CORE                                                                                            \
  "_ZN9voxelcore16ComputeVoxelCoreERKNS_10VoxelShapeERKNS_14SpacingWeightsENS_6EngineERKSt8functionIFbSt17basic_" \
  "string_viewIcSt11char_traitsIcEEdEE"
#define VOXELCORE_LAMBDA                                                                                   \
  "_ZN9voxelcore13PruneByLambdaERKNS_13MedialComplexERKSt6vectorIdSaIdEERKSt8functionIFbSt17basic_string_" \
  "viewIcSt11char_traitsIcEEdEE"
#define VOXELCORE_SPENT_LAMBDA                                                                            \
  "_ZN9voxelcore13PruneByLambdaEONS_13MedialComplexERKSt6vectorIdSaIdEERKSt8functionIFbSt17basic_string_" \
  "viewIcSt11char_traitsIcEEdEE"
#define VOXELCORE_MOVED_LAMBDA                                                                                     \
  "_ZN9voxelcore13PruneByLambdaERKNS_13MedialComplexERKSt6vectorIdSaIdEERS3_IS3_IjSaIjEESaIS9_EERKSt8functionIFbS" \
  "t17basic_string_viewIcSt11char_traitsIcEEdEE"
#define VOXELCORE_TOLERANCE "_ZN9voxelcore16PruneByToleranceERKNS_13MedialComplexEdRSt6vectorIjSaIjEE"
#define VOXELCORE_TOUCHING                                                                                         \
  "_ZN9voxelcore20LargestTouchingBallsERKNS_10VoxelShapeERKNS_13DelaunayCellsERKSt6vectorINS_12LatticePointESaIS7" \
  "_EERKNS_14SpacingWeightsE"
#define VOXELCORE_DIRECTION \
  "_ZN9voxelcore16ToleranceWeightsERKNS_10VoxelShapeERKNS_14SpacingWeightsERKSt6vectorINS_12LatticePointESaIS7_EE"
#define VOXELCORE_REFINE                                                                                  \
  "_ZN9voxelcore10RefineCoreERKNS_15RefinementInputERKSt6vectorIdSaIdEERKSt8functionIFbSt17basic_string_" \
  "viewIcSt11char_traitsIcEEdEE"
#define VOXELCORE_CURVES                                                                                             \
  "_ZN9voxelcore20ComputeCurveSkeletonERKNS_13MedialComplexEPKNS_12LiveElementsERKNS_12CurveOptionsERKSt8functionIF" \
  "bSt17basic_string_viewIcSt11char_traitsIcEEdEE"
#define VOXELCORE_CURVES_OF_ALL                                                                                   \
  "_ZN9voxelcore20ComputeCurveSkeletonERNS_13MedialComplexERKNS_12CurveOptionsERKSt8functionIFbSt17basic_string_" \
  "viewIcSt11char_traitsIcEEdEE"
#define VOXELCORE_GAP "_ZNK9voxelcore8BallTree3GapERKSt5arrayIdLm3EEd"
#define VOXELCORE_NEAREST_GAP VOXELCORE_GAP "Rm"
#define VOXELCORE_BRACKET                                                                                      \
  "_ZN9voxelcore16BracketThicknessERKNS_10VoxelShapeESt4spanIKNS_12LatticePointELm18446744073709551615EERKNS_" \
  "13DelaunayCellsERKNS_14SpacingWeightsEbRKSt8functionIFbSt17basic_string_viewIcSt11char_traitsIcEEdEEPS1_"
#define VOXELCORE_SMOOTH_BALLS                                                                                       \
  "_ZN9voxelcore11SmoothBallsERKNS_10VoxelShapeERKNS_14SpacingWeightsEPKNS_15SurfaceEstimateERKSt8functionIFbSt17ba" \
  "sic_string_viewIcSt11char_traitsIcEEdEE"
#define VOXELCORE_SMOOTH_BRACKET                                                                                  \
  "_ZN9voxelcore13SmoothBracketERKNS_10VoxelShapeERKNS_14SpacingWeightsERKSt8functionIFbSt17basic_string_viewIcS" \
  "t11char_traitsIcEEdEE"
// What makers and checkers share (Modules/README.md)
#define VOXELCORE_WEIGHTS "_ZN9voxelcore21ComputeSpacingWeightsERKSt5arrayIdLm3EE"
#define VOXELCORE_IMAGE_WEIGHTS "_ZN9voxelcore21ComputeLatticeWeightsERKNS_13ImageGeometryE"
#define VOXELCORE_PLACE "_ZN9voxelcore17PhysicalToLatticeERKNS_13ImageGeometryERKSt5arrayIdLm3EE"
#define VOXELCORE_BOTH "_ZN9voxelcore7RunBothEbRKSt8functionIFvvEES4_"
#define VOXELCORE_PARTS "_ZN9voxelcore10RunInPartsEbmRKSt8functionIFvmmEE"
#define VOXELCORE_EACH "_ZN9voxelcore7RunEachEmRKSt8functionIFvmEES4_"
// NOLINTEND

MedialComplex
TrueBuild(const VoxelShape &, std::vector<LatticePoint>, DelaunayCells, const SpacingWeights &, CoreUse) asm(
  "__real_" VOXELCORE_BUILD);
MedialComplex
FaultyBuild(const VoxelShape &, std::vector<LatticePoint>, DelaunayCells, const SpacingWeights &, CoreUse) asm(
  "__wrap_" VOXELCORE_BUILD);
MedialComplex
FaultyBuild(const VoxelShape &        shape,
            std::vector<LatticePoint> points,
            DelaunayCells             cells,
            const SpacingWeights &    weights,
            CoreUse                   use)
{
  MedialComplex core = TrueBuild(shape, std::move(points), std::move(cells), weights, use);
  DamageCore(core);
  return core;
}

MedialComplex
TrueCore(const VoxelShape &, const SpacingWeights &, Engine, const ProgressCallback &) asm("__real_" VOXELCORE_CORE);
MedialComplex
FaultyCore(const VoxelShape &, const SpacingWeights &, Engine, const ProgressCallback &) asm("__wrap_" VOXELCORE_CORE);
MedialComplex
FaultyCore(const VoxelShape & shape, const SpacingWeights & weights, Engine engine, const ProgressCallback & progress)
{
  MedialComplex core = TrueCore(shape, weights, engine, progress);
  DamageCore(core);
  return core;
}

std::vector<MedialComplex>
TrueLambda(const MedialComplex &,
           const std::vector<double> &,
           const ProgressCallback &) asm("__real_" VOXELCORE_LAMBDA);
std::vector<MedialComplex>
FaultyLambda(const MedialComplex &,
             const std::vector<double> &,
             const ProgressCallback &) asm("__wrap_" VOXELCORE_LAMBDA);
std::vector<MedialComplex>
FaultyLambda(const MedialComplex & core, const std::vector<double> & thresholds, const ProgressCallback & progress)
{
  auto pruned = TrueLambda(core, thresholds, progress);
  if (IsSeeded("pruning") && !pruned.empty())
  {
    Damage(pruned.back());
  }
  return pruned;
}

std::vector<MedialComplex>
TrueSpentLambda(MedialComplex &&,
                const std::vector<double> &,
                const ProgressCallback &) asm("__real_" VOXELCORE_SPENT_LAMBDA);
std::vector<MedialComplex>
FaultySpentLambda(MedialComplex &&,
                  const std::vector<double> &,
                  const ProgressCallback &) asm("__wrap_" VOXELCORE_SPENT_LAMBDA);
std::vector<MedialComplex>
FaultySpentLambda(MedialComplex && core, const std::vector<double> & thresholds, const ProgressCallback & progress)
{
  auto pruned = TrueSpentLambda(std::move(core), thresholds, progress);
  if (IsSeeded("pruning") && !pruned.empty())
  {
    Damage(pruned.back());
  }
  return pruned;
}

std::vector<MedialComplex>
TrueMovedLambda(const MedialComplex &,
                const std::vector<double> &,
                std::vector<std::vector<ElementIndex>> &,
                const ProgressCallback &) asm("__real_" VOXELCORE_MOVED_LAMBDA);
std::vector<MedialComplex>
FaultyMovedLambda(const MedialComplex &,
                  const std::vector<double> &,
                  std::vector<std::vector<ElementIndex>> &,
                  const ProgressCallback &) asm("__wrap_" VOXELCORE_MOVED_LAMBDA);
std::vector<MedialComplex>
FaultyMovedLambda(const MedialComplex &                    core,
                  const std::vector<double> &              thresholds,
                  std::vector<std::vector<ElementIndex>> & vertices,
                  const ProgressCallback &                 progress)
{
  auto pruned = TrueMovedLambda(core, thresholds, vertices, progress);
  if (IsSeeded("pruning") && !pruned.empty())
  {
    Damage(pruned.back());
  }
  return pruned;
}

MedialComplex
TrueTolerance(const MedialComplex &, double, std::vector<ElementIndex> &) asm("__real_" VOXELCORE_TOLERANCE);
MedialComplex
FaultyTolerance(const MedialComplex &, double, std::vector<ElementIndex> &) asm("__wrap_" VOXELCORE_TOLERANCE);
MedialComplex
FaultyTolerance(const MedialComplex & core, double height, std::vector<ElementIndex> & vertices)
{
  MedialComplex pruned = TrueTolerance(core, IsSeeded("height") ? 3 * height : height, vertices);
  if (IsSeeded("tolerance"))
  {
    Damage(pruned);
  }
  return pruned;
}

// Of what makers weigh boundary vertices by, one is asked for where cores are pruned, the other where they are refined.
TouchingBalls
TrueTouching(const VoxelShape &,
             const DelaunayCells &,
             const std::vector<LatticePoint> &,
             const SpacingWeights &) asm("__real_" VOXELCORE_TOUCHING);
TouchingBalls
FaultyTouching(const VoxelShape &,
               const DelaunayCells &,
               const std::vector<LatticePoint> &,
               const SpacingWeights &) asm("__wrap_" VOXELCORE_TOUCHING);
TouchingBalls
FaultyTouching(const VoxelShape &                shape,
               const DelaunayCells &             cells,
               const std::vector<LatticePoint> & points,
               const SpacingWeights &            weights)
{
  TouchingBalls touching = TrueTouching(shape, cells, points, weights);
  if (IsSeeded("direction"))
  {
    std::ranges::fill(touching.weights, 1.0);
  }
  return touching;
}

std::vector<double>
TrueDirection(const VoxelShape &,
              const SpacingWeights &,
              const std::vector<LatticePoint> &) asm("__real_" VOXELCORE_DIRECTION);
std::vector<double>
FaultyDirection(const VoxelShape &,
                const SpacingWeights &,
                const std::vector<LatticePoint> &) asm("__wrap_" VOXELCORE_DIRECTION);
std::vector<double>
FaultyDirection(const VoxelShape & shape, const SpacingWeights & weights, const std::vector<LatticePoint> & points)
{
  std::vector<double> direction = TrueDirection(shape, weights, points);
  if (IsSeeded("direction"))
  {
    std::ranges::fill(direction, 1.0);
  }
  return direction;
}

std::vector<RefinedCore>
TrueRefine(const RefinementInput &,
           const std::vector<double> &,
           const ProgressCallback &) asm("__real_" VOXELCORE_REFINE);
std::vector<RefinedCore>
FaultyRefine(const RefinementInput &,
             const std::vector<double> &,
             const ProgressCallback &) asm("__wrap_" VOXELCORE_REFINE);
std::vector<RefinedCore>
FaultyRefine(const RefinementInput & input, const std::vector<double> & thresholds, const ProgressCallback & progress)
{
  auto refined = TrueRefine(input, thresholds, progress);
  if (IsSeeded("refinement") && !refined.empty())
  {
    Damage(refined.back().core);
  }
  if (IsSeeded("ball") && !refined.empty() && !refined.back().core.radius.empty())
  {
    refined.back().core.radius.back() += 4;
  }
  if (IsSeeded("moves") && !refined.empty() && !refined.back().core.positions.empty())
  {
    refined.back().core.positions.back()[0] -= 1000;
  }
  return refined;
}

CurveSkeleton
TrueCurves(const MedialComplex &,
           const LiveElements *,
           const CurveOptions &,
           const ProgressCallback &) asm("__real_" VOXELCORE_CURVES);
CurveSkeleton
FaultyCurves(const MedialComplex &,
             const LiveElements *,
             const CurveOptions &,
             const ProgressCallback &) asm("__wrap_" VOXELCORE_CURVES);
CurveSkeleton
FaultyCurves(const MedialComplex &    surface,
             const LiveElements *     part,
             const CurveOptions &     options,
             const ProgressCallback & progress)
{
  CurveSkeleton skeleton = TrueCurves(surface, part, OptionsOfCurves(options), progress);
  DamageCurves(skeleton);
  return skeleton;
}

CurveSkeleton
TrueCurvesOfAll(MedialComplex &, const CurveOptions &, const ProgressCallback &) asm("__real_" VOXELCORE_CURVES_OF_ALL);
CurveSkeleton
FaultyCurvesOfAll(MedialComplex &,
                  const CurveOptions &,
                  const ProgressCallback &) asm("__wrap_" VOXELCORE_CURVES_OF_ALL);
CurveSkeleton
FaultyCurvesOfAll(MedialComplex & surface, const CurveOptions & options, const ProgressCallback & progress)
{
  CurveSkeleton skeleton = TrueCurvesOfAll(surface, OptionsOfCurves(options), progress);
  DamageCurves(skeleton);
  return skeleton;
}

ThicknessBracket
TrueBracket(const VoxelShape &,
            std::span<const LatticePoint>,
            const DelaunayCells &,
            const SpacingWeights &,
            bool,
            const ProgressCallback &,
            const VoxelShape *) asm("__real_" VOXELCORE_BRACKET);
ThicknessBracket
FaultyBracket(const VoxelShape &,
              std::span<const LatticePoint>,
              const DelaunayCells &,
              const SpacingWeights &,
              bool,
              const ProgressCallback &,
              const VoxelShape *) asm("__wrap_" VOXELCORE_BRACKET);
ThicknessBracket
FaultyBracket(const VoxelShape &            shape,
              std::span<const LatticePoint> points,
              const DelaunayCells &         cells,
              const SpacingWeights &        weights,
              bool                          upper,
              const ProgressCallback &      progress,
              const VoxelShape *            part)
{
  ThicknessBracket bracket = TrueBracket(shape, points, cells, weights, upper, progress, part);
  if (IsSeeded("bounds"))
  {
    for (float & bound : bracket.upper.values)
    {
      bound *= 0.5F;
    }
  }
  return bracket;
}

PaintingBalls
TrueSmoothBalls(const VoxelShape &,
                const SpacingWeights &,
                const SurfaceEstimate *,
                const ProgressCallback &) asm("__real_" VOXELCORE_SMOOTH_BALLS);
PaintingBalls
FaultySmoothBalls(const VoxelShape &,
                  const SpacingWeights &,
                  const SurfaceEstimate *,
                  const ProgressCallback &) asm("__wrap_" VOXELCORE_SMOOTH_BALLS);
PaintingBalls
FaultySmoothBalls(const VoxelShape &       shape,
                  const SpacingWeights &   weights,
                  const SurfaceEstimate *  surface,
                  const ProgressCallback & progress)
{
  PaintingBalls balls = TrueSmoothBalls(shape, weights, surface, progress);
  const double  part = IsSeeded("thick") ? 1.6 : IsSeeded("thin") ? 0.4 : 1;
  for (std::size_t i = 0; i < balls.Count(); ++i)
  {
    balls.radius[i] *= part;
    balls.value[i] *= part;
  }
  return balls;
}

ThicknessBracket
TrueSmoothBracket(const VoxelShape &,
                  const SpacingWeights &,
                  const ProgressCallback &) asm("__real_" VOXELCORE_SMOOTH_BRACKET);
ThicknessBracket
FaultySmoothBracket(const VoxelShape &,
                    const SpacingWeights &,
                    const ProgressCallback &) asm("__wrap_" VOXELCORE_SMOOTH_BRACKET);
ThicknessBracket
FaultySmoothBracket(const VoxelShape & shape, const SpacingWeights & weights, const ProgressCallback & progress)
{
  ThicknessBracket bracket = TrueSmoothBracket(shape, weights, progress);
  for (float & bound : bracket.upper.values)
  {
    bound *= IsSeeded("bounds") ? 0.5F : 1;
  }
  for (float & bound : bracket.lower.values)
  {
    bound *= IsSeeded("lower") ? 1.8F : 1;
  }
  return bracket;
}

// Refinement keeps the boundary covered by these; a certificate that asked them, too, saw nothing.
double
TrueGap(const BallTree *, const std::array<double, 3> &, double) asm("__real_" VOXELCORE_GAP);
double
FaultyGap(const BallTree *, const std::array<double, 3> &, double) asm("__wrap_" VOXELCORE_GAP);
double
FaultyGap(const BallTree * tree, const std::array<double, 3> & place, double enough)
{
  return (IsSeeded("gap") ? 0.6 : 1) * TrueGap(tree, place, enough);
}

double
TrueNearestGap(const BallTree *,
               const std::array<double, 3> &,
               double,
               std::size_t &) asm("__real_" VOXELCORE_NEAREST_GAP);
double
FaultyNearestGap(const BallTree *,
                 const std::array<double, 3> &,
                 double,
                 std::size_t &) asm("__wrap_" VOXELCORE_NEAREST_GAP);
double
FaultyNearestGap(const BallTree * tree, const std::array<double, 3> & place, double enough, std::size_t & nearest)
{
  return (IsSeeded("gap") ? 0.6 : 1) * TrueNearestGap(tree, place, enough, nearest);
}

// Functions that makers and checkers share.
SpacingWeights
TrueWeights(const std::array<double, 3> &) asm("__real_" VOXELCORE_WEIGHTS);
SpacingWeights
FaultyWeights(const std::array<double, 3> &) asm("__wrap_" VOXELCORE_WEIGHTS);
SpacingWeights
FaultyWeights(const std::array<double, 3> & spacing)
{
  SpacingWeights weights = TrueWeights(spacing);
  weights.weight[0] += IsSeeded("weights") ? 1 : 0;
  return weights;
}

SpacingWeights
TrueImageWeights(const ImageGeometry &) asm("__real_" VOXELCORE_IMAGE_WEIGHTS);
SpacingWeights
FaultyImageWeights(const ImageGeometry &) asm("__wrap_" VOXELCORE_IMAGE_WEIGHTS);
SpacingWeights
FaultyImageWeights(const ImageGeometry & geometry)
{
  SpacingWeights weights = TrueImageWeights(geometry);
  weights.weight[0] += IsSeeded("weights") ? 1 : 0;
  return weights;
}

std::array<double, 3>
TruePlace(const ImageGeometry &, const std::array<double, 3> &) asm("__real_" VOXELCORE_PLACE);
std::array<double, 3>
FaultyPlace(const ImageGeometry &, const std::array<double, 3> &) asm("__wrap_" VOXELCORE_PLACE);
std::array<double, 3>
FaultyPlace(const ImageGeometry & geometry, const std::array<double, 3> & point)
{
  std::array<double, 3> place = TruePlace(geometry, point);
  place[0] += IsSeeded("place") ? 0.25 : 0;
  return place;
}

void
TrueBoth(bool, const std::function<void()> &, const std::function<void()> &) asm("__real_" VOXELCORE_BOTH);
void
FaultyBoth(bool, const std::function<void()> &, const std::function<void()> &) asm("__wrap_" VOXELCORE_BOTH);
void
FaultyBoth(bool worthIt, const std::function<void()> & first, const std::function<void()> & second)
{
  IsSeeded("both") ? first() : TrueBoth(worthIt, first, second);
}

void
TrueParts(bool, std::size_t, const std::function<void(std::size_t, std::size_t)> &) asm("__real_" VOXELCORE_PARTS);
void
FaultyParts(bool, std::size_t, const std::function<void(std::size_t, std::size_t)> &) asm("__wrap_" VOXELCORE_PARTS);
void
FaultyParts(bool worthIt, std::size_t count, const std::function<void(std::size_t, std::size_t)> & work)
{
  TrueParts(worthIt, count - (IsSeeded("parts") && count > 0 ? 1 : 0), work);
}

void
TrueEach(std::size_t,
         const std::function<void(std::size_t)> &,
         const std::function<void(std::size_t)> &) asm("__real_" VOXELCORE_EACH);
void
FaultyEach(std::size_t,
           const std::function<void(std::size_t)> &,
           const std::function<void(std::size_t)> &) asm("__wrap_" VOXELCORE_EACH);
void
FaultyEach(std::size_t                              count,
           const std::function<void(std::size_t)> & work,
           const std::function<void(std::size_t)> & done)
{
  TrueEach(count - (IsSeeded("each") && count > 0 ? 1 : 0), work, done);
}

} // namespace voxelcore
