#pragma once
// Pruning a core to its lambda-subset without changing its topology (paper, section 4, step 3).

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Base/SpatialUnit.h"
#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Shape/VoxelShape.h"
#include "voxelcore/VoxelCore/MedialComplex.h"

#include <string>
#include <string_view>

namespace voxelcore
{

/** A pruning threshold as a user writes it. */
struct Lambda
{
  enum class Unit
  {
    Millimetre, ///< "1.5mm", "1.5"
    Voxel,      ///< "1.5vox": times the smallest spacing
    Percent     ///< "2.5%": of the longest side of the shape's bounding box
  };
  double      value = 0;
  Unit        unit = Unit::Millimetre;
  std::string text = "0"; ///< as written, without blanks
};

/** Reads "1.5mm", "2.5vox", "2.5%", "1.5" (mm). Decimal numbers, not negative, finite.
 *  \throws UsageError that quotes the text, as a `what`, and names the units. */
Lambda
ParseLambda(std::string_view text, std::string_view what = "lambda");

/** \throws InputError for a length in mm, unless it is 0, where lengths are in voxels. */
void
RequireLengthIn(SpatialUnit unit, const Lambda & length);

/** The threshold in mm, made by the same rounding as the measures of a core: a lambda in vox whose exact square equals
 *  the exact squared measure of an element compares equal to it. */
double
LambdaInMillimetres(const Lambda &                lambda,
                    const SpacingWeights &        weights,
                    const std::array<double, 3> & spacing,
                    const VoxelBox &              shapeBox);

/** The cores pruned to the given thresholds in mm, which must increase; threshold 0 gives the whole core.
 *  Elements with a measure >= threshold all stay; no simple pair with both measures below it is left;
 *  pruning a result on to a greater threshold equals pruning to the greater at once. */
std::vector<MedialComplex>
PruneByLambda(const MedialComplex &       core,
              const std::vector<double> & thresholds,
              const ProgressCallback &    progress = {});

/** The same of a core that is used up: the last result takes its place. */
std::vector<MedialComplex>
PruneByLambda(MedialComplex && core, const std::vector<double> & thresholds, const ProgressCallback & progress = {});

/** The same; `vertices` receives, for each result, of each of its vertices the index in `core`. */
std::vector<MedialComplex>
PruneByLambda(const MedialComplex &                    core,
              const std::vector<double> &              thresholds,
              std::vector<std::vector<ElementIndex>> & vertices,
              const ProgressCallback &                 progress = {});

} // namespace voxelcore
