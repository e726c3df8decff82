#include "voxelcore/Meshes/Voxelization.h"

#include "AxisCrossings.h"
#include "RayVotes.h"
#include "RowBits.h"
#include "TouchedVoxels.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <omp.h>
#include <utility>

namespace voxelcore
{
namespace
{

/** The closed case: rays along x suffice. Returns the number of voxels that are in several parts, or inside out. */
std::uint64_t
FillByRows(const AxisCrossings & crossings, VoxelShape & shape, const ProgressCallback & progress)
{
  const auto slabs = static_cast<std::int64_t>(crossings.SlabCount());
  // A callback may be called from one thread at a time, and throws: it is asked between batches.
  const auto    batch = std::max<std::int64_t>(16 * omp_get_max_threads(), slabs / 64);
  std::uint64_t several = 0;
  for (std::int64_t begin = 0; begin < slabs; begin += batch)
  {
    ReportProgress(progress, "voxelize", static_cast<double>(begin) / static_cast<double>(slabs));
    const std::int64_t end = std::min(slabs, begin + batch);
    FirstFailure       failure;
#pragma omp parallel for schedule(dynamic) reduction(+ : several)
    for (std::int64_t slab = begin; slab < end; ++slab)
    {
      failure.Guard(static_cast<std::size_t>(slab), [&] {
        const auto planes = crossings.Runs(static_cast<std::size_t>(slab));
        for (std::size_t i = 0; i < planes.size(); ++i)
        {
          const auto z = static_cast<std::int32_t>(slab * AxisCrossings::kSlab + static_cast<std::int64_t>(i));
          for (const RayRun & run : planes[i].in)
          {
            SetBits(shape.Row(run.inner, z), run.first, run.end);
          }
          for (const RayRun & run : planes[i].several)
          {
            several += static_cast<std::uint64_t>(run.end - run.first);
          }
        }
      });
    }
    failure.Rethrow();
  }
  return several;
}

} // namespace

Voxelization
Voxelize(const TriangleMesh & mesh, const VoxelGrid & grid, const ProgressCallback & progress, bool cover)
{
  ReportProgress(progress, "voxelize", 0);
  const MeshSurface surface = PrepareSurface(mesh);
  const IndexMesh   indexed(mesh, grid);
  Voxelization      result;
  result.findings = surface.findings;
  result.shape = VoxelShape({ { 0, 0, 0 }, grid.size });
  result.doubtful = surface.findings.rule == InsideRule::Votes
                      ? FillByVotes(indexed, surface, grid, result.shape, progress)
                      : FillByRows(AxisCrossings(indexed, surface, grid, 0), result.shape, progress);
  result.touched = cover ? AddTouchedVoxels(indexed, surface, result.shape) : 0;
  result.voxels = result.shape.CountVoxels();
  if (result.voxels == 0)
  {
    throw InputError("no voxel's centre lies in it; it bounds nothing, or it needs a finer grid");
  }
  result.shape = CropToVoxels(std::move(result.shape));
  ReportProgress(progress, "voxelize", 1);
  return result;
}

} // namespace voxelcore
