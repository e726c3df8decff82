#include "voxelcore/Delaunay/DelaunayCells.h"

#include "LatticeEngine.h"
#include "voxelcore/Delaunay/CanonicalCells.h"
#include "TetGenEngine.h"

#include "voxelcore/Lattice/Predicates.h"

#include <algorithm>

namespace voxelcore
{

bool
HasEngine([[maybe_unused]] Engine engine)
{
#ifdef VOXELCORE_HAS_TETGEN
  return true;
#else
  return engine != Engine::TetGen;
#endif
}

DelaunayCells
ComputeDelaunayCells(const VoxelShape &                shape,
                     const std::vector<LatticePoint> & points,
                     const SpacingWeights &            weights,
                     Engine                            engine,
                     const ProgressCallback &          progress,
                     Facets                            facets)
{
  if (!HasEngine(engine))
  {
    throw Error("this build has no TetGen engine; configure it with -DVOXELCORE_TETGEN=ON, or use another engine");
  }
  const auto & size = shape.Box().size;
  // Sides beyond 2^20 would still pass the in-sphere bound where weights are small, but not the coordinates' own.
  const std::int32_t longest = *std::max_element(size.begin(), size.end());
  if (longest > (1 << 20) || !ExactRangeAllows(longest, weights))
  {
    throw InputError(
      "the shape is too large for exact arithmetic at this spacing; crop it, or give a simpler --spacing");
  }
  if (points.empty())
  {
    return {};
  }
  DelaunayCells raw;
  ReportProgress(progress, "delaunay", 0.0);
#ifdef VOXELCORE_HAS_TETGEN
  if (engine == Engine::TetGen)
  {
    raw = TetGenCells(shape, points, weights, progress);
  }
  else
#endif
  {
    raw = LatticeCells(shape, points, weights, progress, facets);
  }
  DelaunayCells cells = MakeCanonical(std::move(raw), points, weights, facets);
  ReportProgress(progress, "delaunay", 1.0);
  return cells;
}

} // namespace voxelcore
