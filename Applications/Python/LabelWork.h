#pragma once
// What the Python module does with a label, without a word of Python: the jobs of module Pipeline on arrays in memory.

#include "ArrayLabels.h"
#include "voxelcore/CoreReport.h"
#include "voxelcore/MedialModel.h"
#include "voxelcore/Parameters.h"
#include "voxelcore/SkeletonModel.h"

#include <filesystem>
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
};

/** A certified skeleton; the surface it was made of is kept for files that hold both. */
struct SkeletonOfLabel
{
  CoreReport                         report;
  SkeletonPart                       part;
  std::shared_ptr<const CoreOfLabel> surface;
};

/** `values` are options of `voxelcore core` by name. The array must hold one label, or `values` name one.
 *  \throws InputError, UsageError, CertificateError, Cancelled */
std::shared_ptr<CoreOfLabel>
MakeCore(const ArrayView &        array,
         const ImageGeometry &    geometry,
         ParameterValues          values,
         const ProgressCallback & progress);

/** A core pruned further, as if at once. \throws UsageError, also when it is pruned further already */
std::shared_ptr<CoreOfLabel>
Prune(const CoreOfLabel & core, const std::string & lambda, const ProgressCallback & progress);

/** `values` are options of `voxelcore skeleton`. */
std::shared_ptr<SkeletonOfLabel>
MakeSkeletonOf(std::shared_ptr<const CoreOfLabel> core, ParameterValues values, const ProgressCallback & progress);

/** \throws OutputError, UsageError */
void
Save(const CoreOfLabel & core, const std::filesystem::path & path, const ModelOptions & options, bool force);

void
Save(const SkeletonOfLabel & skeleton, const std::filesystem::path & path, const std::string & also, bool force);

/** What `voxelcore core` wrote, when it holds one label. \throws InputError */
std::shared_ptr<CoreOfLabel>
ReadCore(const std::filesystem::path & path);

} // namespace voxelcore
