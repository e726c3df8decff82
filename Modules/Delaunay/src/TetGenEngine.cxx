#include "TetGenEngine.h"

#include <tetgen.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

namespace voxelcore
{

namespace
{

// TetGen numbers with int: 2^31 / 4 neighbours / 5.6 tetrahedra a point.
constexpr std::size_t largestPointCount = 94'000'000;

// Owned by both threads, so that an abandoned run keeps its data.
struct Run
{
  std::vector<LatticePoint> points;
  SpacingWeights            weights;
  Tetrahedra                result;
  std::string               failure;
  bool                      done = false;
  std::mutex                mutex;
  std::condition_variable   finished;
};

std::mutex &
OneAtATime()
{
  static std::mutex mutex;
  return mutex;
}

void
RunTetGen(Run & run)
{
  const std::lock_guard<std::mutex> turn(OneAtATime());
  const std::size_t                 count = run.points.size();
  tetgenio                          input;
  input.numberofpoints = static_cast<int>(count);
  input.pointlist = new REAL[3 * count];
  for (std::size_t i = 0; i < count; ++i)
  {
    // Weighted integers: exact doubles, and the metric TetGen knows is then the lattice's.
    input.pointlist[3 * i] = static_cast<double>(run.points[i].x * run.weights.weight[0]);
    input.pointlist[3 * i + 1] = static_cast<double>(run.points[i].y * run.weights.weight[1]);
    input.pointlist[3 * i + 2] = static_cast<double>(run.points[i].z * run.weights.weight[2]);
  }
  std::vector<LatticePoint>().swap(run.points);
  tetgenio output;
  // Quiet, from zero, neighbours; no node, face or boundary output; points keep their numbers.
  char switches[] = "QznNFBJ";
  tetrahedralize(switches, &input, &output);
  const auto tetrahedra = static_cast<std::size_t>(output.numberoftetrahedra);
  if (tetrahedra == 0 || output.neighborlist == nullptr || output.numberofcorners != 4)
  {
    throw Error("TetGen returned no tetrahedra");
  }
  run.result.corners.resize(tetrahedra);
  for (std::size_t t = 0; t < tetrahedra; ++t)
  {
    for (std::size_t i = 0; i < 4; ++i)
    {
      run.result.corners[t][i] = static_cast<std::uint32_t>(output.tetrahedronlist[4 * t + i]);
    }
  }
  delete[] output.tetrahedronlist;
  output.tetrahedronlist = nullptr;
  run.result.neighbours.resize(tetrahedra);
  for (std::size_t t = 0; t < tetrahedra; ++t)
  {
    for (std::size_t i = 0; i < 4; ++i)
    {
      run.result.neighbours[t][i] = static_cast<std::uint32_t>(output.neighborlist[4 * t + i]); // -1 is kOutside
    }
  }
}

} // namespace

Tetrahedra
TetGenTetrahedra(const std::vector<LatticePoint> & points,
                 const SpacingWeights &            weights,
                 const ProgressCallback &          progress)
{
  if (points.size() > largestPointCount)
  {
    throw InputError("the shape has more boundary vertices than TetGen can number (94 million); crop or split it");
  }
  const auto run = std::make_shared<Run>();
  run->points = points;
  run->weights = weights;
  std::thread([run] {
    std::string failure;
    try
    {
      RunTetGen(*run);
    }
    catch (const std::bad_alloc &)
    {
      failure = "not enough memory for TetGen; crop the volume or use a machine with more";
    }
    catch (const std::exception & error)
    {
      failure = error.what();
    }
    catch (int code) // what TetGen throws when it gives up
    {
      failure = code == 1 ? "not enough memory for TetGen; crop the volume or use a machine with more"
                          : "TetGen failed with code " + std::to_string(code);
    }
    const std::lock_guard<std::mutex> lock(run->mutex);
    run->failure = failure;
    run->done = true;
    run->finished.notify_one();
  }).detach();

  std::unique_lock<std::mutex> lock(run->mutex);
  while (!run->finished.wait_for(lock, std::chrono::milliseconds(50), [&] { return run->done; }))
  {
    ReportProgress(progress, "delaunay", 0.0);
  }
  if (!run->failure.empty())
  {
    throw Error(run->failure);
  }
  return std::move(run->result);
}

DelaunayCells
TetGenCells(const VoxelShape &                shape,
            const std::vector<LatticePoint> & points,
            const SpacingWeights &            weights,
            const ProgressCallback &          progress)
{
  return MergeTetrahedra(TetGenTetrahedra(points, weights, progress), shape, points, weights);
}

} // namespace voxelcore
