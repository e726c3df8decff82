// Pruning by tolerance beside pruning by lambda, on the same core in the same process: processor time and memory.
//
//     VoxelCoreToleranceTime KIND SIZE [REPEATS]          # a phantom; OMP_NUM_THREADS=1 for one processor
//
// Both begin with the Delaunay cells and end with what is left at one threshold, 1.5 voxels and 1.2 diagonals. They
// take turns; the medians and the median of the quotients of neighbours are shown. Memory is what is in use at the most
// while they run, less what was before.

#include "ProcessFigures.h"

#include "voxelcore/Phantom/Phantom.h"
#include "voxelcore/Shape/BoundaryVertices.h"
#include "voxelcore/VoxelCore/LambdaPruning.h"
#include "voxelcore/VoxelCore/TolerancePruning.h"
#include "voxelcore/VoxelCore/VoxelCore.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <malloc.h>
#include <string>
#include <vector>

namespace voxelcore::performance
{
namespace
{

struct Cost
{
  double seconds;
  double bytes;
};

template <typename Task>
Cost
Measure(const Task & task)
{
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5"; // the greatest use begins anew
  const double before = StatusBytes("VmRSS:");
  const double start = ProcessorSeconds();
  task();
  const double seconds = ProcessorSeconds() - start;
  return { seconds, StatusBytes("VmHWM:") - before };
}

double
Median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

int
Main(int argc, char ** argv)
{
  if (argc < 3)
  {
    std::fprintf(stderr, "usage: %s KIND SIZE [REPEATS]\n", argv[0]);
    return 2;
  }
  mallopt(M_MMAP_THRESHOLD, 2 << 20); // as the program has it: large arrays go back to the system
  PhantomOptions options;
  options.kind = argv[1];
  const int size = std::atoi(argv[2]);
  options.size = { size, size, size };
  const int            repeats = argc > 3 ? std::max(1, std::atoi(argv[3])) : 5;
  const VoxelShape     shape = MakePhantom(options);
  const SpacingWeights weights = ComputeSpacingWeights(options.spacing);
  const auto           points = BoundaryVertices(shape);
  const DelaunayCells  cells = ComputeDelaunayCells(shape, points, weights, Engine::Lattice);
  MedialComplex        core = BuildVoxelCore(shape, points, DelaunayCells(cells), weights);
  std::vector<double>  lambda[2];
  std::vector<double>  byTolerances[2];
  std::vector<double>  quotients;
  std::vector<double>  stages[3];
  std::size_t          faces[2]{};
  for (int i = 0; i < repeats; ++i)
  {
    core.tolerances = {};
    const Cost byLambda = Measure([&] { faces[0] = PruneByLambda(core, { 1.5 }).front().cells.FaceCount(); });
    const Cost byTolerance = Measure([&] {
      double     start = ProcessorSeconds();
      const auto lap = [&](std::size_t stage) {
        stages[stage].push_back(ProcessorSeconds() - start);
        start = ProcessorSeconds();
      };
      TouchingBalls touching = LargestTouchingBalls(shape, cells, points, weights);
      lap(0);
      core.tolerances = ComputeTolerances(core, weights, points, std::move(touching));
      lap(1);
      faces[1] = PruneByTolerance(core, 1.2 * std::sqrt(3.0)).cells.FaceCount();
      lap(2);
    });
    lambda[0].push_back(byLambda.seconds);
    lambda[1].push_back(byLambda.bytes);
    byTolerances[0].push_back(byTolerance.seconds);
    byTolerances[1].push_back(byTolerance.bytes);
    quotients.push_back(byTolerance.seconds / byLambda.seconds);
  }
  const auto each = 1.0 / static_cast<double>(points.size());
  std::printf("%s %d: %zu boundary vertices, core of %zu vertices, %zu edges, %zu faces\n",
              argv[1],
              size,
              points.size(),
              core.cells.vertexCount,
              core.cells.edges.size(),
              core.cells.FaceCount());
  std::printf("lambda 1.5vox   %.3f s, %.0f bytes a boundary vertex, %zu faces left\n",
              Median(lambda[0]),
              each * Median(lambda[1]),
              faces[0]);
  std::printf("tolerance 1.2diag   %.3f s (balls %.3f, heights %.3f, taking out %.3f), %.0f bytes, %zu faces left\n",
              Median(byTolerances[0]),
              Median(stages[0]),
              Median(stages[1]),
              Median(stages[2]),
              each * Median(byTolerances[1]),
              faces[1]);
  std::printf("tolerance / lambda  %.2f\n", Median(quotients));
  return 0;
}

} // namespace
} // namespace voxelcore::performance

int
main(int argc, char ** argv)
{
  return voxelcore::performance::Main(argc, argv);
}
