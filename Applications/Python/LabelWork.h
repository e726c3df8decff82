#pragma once
// What the Python module does with a label, without a word of Python: the work of jobs on arrays in memory.

#include "ArrayLabels.h"
#include "PackedShape.h"

#include "voxelcore/Jobs/VerifyJob.h"
#include "voxelcore/Models/MedialModel.h"
#include "voxelcore/Models/SkeletonModel.h"
#include "voxelcore/Compare/CompareCommand.h"
#include "voxelcore/Corrections/LabelEdits.h"
#include "voxelcore/Options/Requests.h"
#include "voxelcore/Report/CoreReport.h"
#include "voxelcore/Thickness/ThicknessFiles.h"

#include <memory>
#include <string>
#include <vector>

namespace voxelcore
{

/** A certified core and the report on it, which has one label. */
struct CoreOfLabel
{
  CoreReport report;
  ModelPart  part;
  bool       hasEdges = true; ///< the measures of all edges are known

  std::string refined{}; ///< the surface it was refined to, as MedialModel::refined

  std::shared_ptr<const PackedShape> shape{}; ///< what it is the core of; none when it was read from a file
};

/** Without provenance. */
MedialModel
ModelOf(const CoreOfLabel & core);

/** What became of an edit of a tree. */
struct ToldEdit
{
  std::array<double, 3> place{}; ///< LPS
  std::string           edit;
  std::string           name;
  std::string           leftOut; ///< why; empty: it was done
};

/** A certified skeleton; the surface it was made of is kept for files that hold both. */
struct SkeletonOfLabel
{
  CoreReport                         report;
  SkeletonPart                       part;
  std::shared_ptr<const CoreOfLabel> surface;
  std::vector<ToldEdit>              edits{}; ///< of the body, by its tree
};

/** Local thickness of the labels of an array; values i fastest, 0 outside. */
struct ThicknessOfArray
{
  std::array<std::int64_t, 3>  size{};
  std::vector<float>           map;
  std::vector<float>           lower; ///< bounds: empty unless they were asked for
  std::vector<float>           upper;
  std::vector<ThicknessRecord> records; ///< per label, or component of one
};

/** `values` are options of `voxelcore thickness` by name, of which separation needs the program.
 *  \throws as MakeCores() */
std::shared_ptr<ThicknessOfArray>
MakeThickness(const ArrayView &        array,
              const ImageGeometry &    geometry,
              const ParameterValues &  values,
              const ProgressCallback & progress);

/** An array as one side of a comparison. */
CompareSide
SideOfArray(const ArrayView &        array,
            const ImageGeometry &    geometry,
            const CompareOptions &   options,
            const ProgressCallback & progress);

/** `values` are options of `voxelcore core` by name. The array must hold one label, unless `values` say which. Of each
 *  label, or component where these are split, a core for each lambda or tolerance, in the order given.
 *  \throws InputError, UsageError, CertificateError, Cancelled */
std::vector<std::shared_ptr<CoreOfLabel>>
MakeCores(const ArrayView &        array,
          const ImageGeometry &    geometry,
          const ParameterValues &  values,
          const ProgressCallback & progress);

/** A core pruned further, as if at once; `values` are options of `voxelcore prune`.
 *  \throws UsageError, also when it is pruned further already */
std::vector<std::shared_ptr<CoreOfLabel>>
Prune(const CoreOfLabel & core, const ParameterValues & values, const ProgressCallback & progress);

/** `values` are options of `voxelcore skeleton`. `ofArray`: as of the array that the core was made of: by tolerance its
 *  branches are those of the whole core, which is made again. */
std::shared_ptr<SkeletonOfLabel>
MakeSkeletonOf(std::shared_ptr<const CoreOfLabel> core,
               const ParameterValues &            values,
               bool                               ofArray,
               const ProgressCallback &           progress);

/** The skeleton of several labels of an array taken as one body; of `coreValues` labels say which, all but 0 unless
 *  given. \throws as MakeCores() */
std::shared_ptr<SkeletonOfLabel>
MakeNetworkOf(const ArrayView &        array,
              const ImageGeometry &    geometry,
              const ParameterValues &  coreValues,
              const ParameterValues &  skeletonValues,
              const ProgressCallback & progress);

/** The skeleton of the only label, whose body is edited before. \throws as MakeCores() */
std::shared_ptr<SkeletonOfLabel>
MakeCorrectedOf(const ArrayView &        array,
                const ImageGeometry &    geometry,
                const ParameterValues &  coreValues,
                const ParameterValues &  skeletonValues,
                std::vector<Said>        said,
                const ProgressCallback & progress);

/** A finished skeleton cut and measured anew; `values` are options of `voxelcore measure`. \throws UsageError */
std::shared_ptr<SkeletonOfLabel>
Remeasure(const SkeletonOfLabel & skeleton, const ParameterValues & values);

/** A core rechecked against its scan, which is read and edited as when the core was made.
 *  \throws InputError, UsageError, Cancelled */
VerifyResult
Verify(const CoreOfLabel &      core,
       const ArrayView &        array,
       const ImageGeometry &    geometry,
       const ProgressCallback & progress);

} // namespace voxelcore
