#include "TetGenEngine.h"

#include <tetgen.h>

#include <algorithm>
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
struct TetGenRun
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
RunTetGen(TetGenRun & run)
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

// A tetrahedron lies wholly inside or outside (Theorem 3.1), so the voxel that holds its centroid decides; where the
// centroid lies between voxels all of them agree.
bool
LiesInside(const std::array<std::uint32_t, 4> & t, const std::vector<LatticePoint> & p, const VoxelShape & shape)
{
  const auto floorOfQuarter = [](std::int64_t sum) { return static_cast<std::int32_t>(sum >> 2); };
  const auto sum = [&](std::int32_t LatticePoint::*axis) {
    return std::int64_t{ p[t[0]].*axis } + p[t[1]].*axis + p[t[2]].*axis + p[t[3]].*axis;
  };
  return shape.Contains(floorOfQuarter(sum(&LatticePoint::x)),
                        floorOfQuarter(sum(&LatticePoint::y)),
                        floorOfQuarter(sum(&LatticePoint::z)));
}

// The faces of a tetrahedron, each opposite to the corner of its number, counter-clockwise from outside when
// orient(corner 0, 1, 2, 3) = det(1 - 0, 2 - 0, 3 - 0) is positive.
constexpr int faceCorners[4][3] = { { 1, 2, 3 }, { 0, 3, 2 }, { 0, 1, 3 }, { 0, 2, 1 } };

// Names a boundary square: the axis it is perpendicular to and its least corner, which three corners of four give.
// Coordinates take 20 bits each: the exact range ends at sides of 2^20.
std::uint64_t
NameSquare(const std::array<std::uint32_t, 3> & triangle, const std::vector<LatticePoint> & points)
{
  const LatticePoint & a = points[triangle[0]];
  const LatticePoint & b = points[triangle[1]];
  const LatticePoint & c = points[triangle[2]];
  const std::uint64_t  axis = a.x == b.x && a.x == c.x ? 0 : a.y == b.y && a.y == c.y ? 1 : 2;
  const auto           least = [](std::int32_t p, std::int32_t q, std::int32_t r) {
    return static_cast<std::uint64_t>(std::min({ p, q, r })) & 0xFFFFFU;
  };
  return axis << 60 | least(a.x, b.x, c.x) << 40 | least(a.y, b.y, c.y) << 20 | least(a.z, b.z, c.z);
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
  const auto run = std::make_shared<TetGenRun>();
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
  Tetrahedra                tetrahedra = TetGenTetrahedra(points, weights, progress);
  std::vector<std::uint8_t> inside(tetrahedra.corners.size());
#pragma omp parallel for schedule(static) if (inside.size() > 10000)
  for (std::size_t t = 0; t < inside.size(); ++t)
  {
    inside[t] = LiesInside(tetrahedra.corners[t], points, shape);
  }
  const auto nameWall = [&](std::size_t, std::size_t, const std::array<std::uint32_t, 3> & triangle) {
    return NameSquare(triangle, points);
  };
  return MergeTetrahedra(std::move(tetrahedra), inside, points, weights, nameWall);
}

} // namespace voxelcore
