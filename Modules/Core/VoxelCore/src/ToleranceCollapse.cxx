// The collapse behind ComputeTolerances().

#include "LooseEnds.h"
#include "RimFire.h"
#include "WholeSheets.h"

#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Complex/SimplePairCollapse.h"
#include "voxelcore/VoxelCore/TolerancePruning.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

namespace voxelcore
{

namespace
{

// How far one has come, for another that follows.
class Stages
{
public:
  void
  Finish(std::size_t stage, std::size_t count)
  {
    const std::lock_guard lock(m_Mutex);
    m_Counts.resize(stage + 1, count);
    m_Changed.notify_one();
  }
  // No stage after those that are finished changes the count.
  void
  FinishAll()
  {
    const std::lock_guard lock(m_Mutex);
    m_AreAllFinished = true;
    m_Changed.notify_one();
  }
  void
  Stop()
  {
    const std::lock_guard lock(m_Mutex);
    m_IsStopped = true;
    m_Changed.notify_one();
  }
  // The count of a stage once it is finished; false when it never will be.
  bool
  Await(std::size_t stage, std::size_t & count)
  {
    std::unique_lock lock(m_Mutex);
    m_Changed.wait(lock, [&] { return m_IsStopped || m_AreAllFinished || stage < m_Counts.size(); });
    if (stage >= m_Counts.size() && !m_AreAllFinished)
    {
      return false;
    }
    count = m_Counts[std::min(stage, m_Counts.size() - 1)];
    return true;
  }
  // Whether nothing comes after a stage that is finished.
  bool
  IsLast(std::size_t stage)
  {
    const std::lock_guard lock(m_Mutex);
    return m_AreAllFinished && stage + 1 >= m_Counts.size();
  }

private:
  std::mutex               m_Mutex;
  std::condition_variable  m_Changed;
  std::vector<std::size_t> m_Counts;
  bool                     m_AreAllFinished = false;
  bool                     m_IsStopped = false;
};

// Whatever happens, nobody waits for stages that will not come.
struct StopAtEnd
{
  Stages & stages;
  ~StopAtEnd()
  {
    stages.Stop();
  }
};

BallCentre
ScaleOf(const SpacingWeights & weights)
{
  return { weights.unit * static_cast<double>(weights.weight[0]),
           weights.unit * static_cast<double>(weights.weight[1]),
           weights.unit * static_cast<double>(weights.weight[2]) };
}

LiveElements
LeftByFloor(const MedialComplex & core, double floor, const ProgressCallback & progress)
{
  SimplePairCollapse collapse(core.cells, core.vertexLambda, core.edgeLambda, core.faceLambda);
  collapse.CollapseBelow(floor, progress);
  return std::move(collapse).TakeLive();
}

std::vector<CoreBall>
BallsOf(const MedialComplex & core, std::vector<std::array<double, 3>> places, const BallCentre & scale)
{
  std::vector<CoreBall> balls(places.size());
  const auto            count = static_cast<std::int64_t>(places.size());
#pragma omp parallel for schedule(static) if (count > 10000)
  for (std::int64_t i = 0; i < count; ++i)
  {
    const auto   vertex = static_cast<std::size_t>(i);
    const auto & p = places[vertex];
    balls[vertex].centre = { scale[0] * p[0], scale[1] * p[1], scale[2] * p[2] };
    balls[vertex].radius = core.radius[vertex];
    balls[vertex].witness = static_cast<ElementIndex>(i);
  }
  return balls;
}

TouchedPlaces
TouchedBy(const TouchingBalls & touching, const std::vector<LatticePoint> & points, const BallCentre & scale)
{
  TouchedPlaces touched{ std::vector<WeighedPlace>(touching.weights.size()), touching.offsets, touching.touched };
  for (const double weight : touching.weights)
  {
    touched.largestWeight = std::max(touched.largestWeight, weight);
  }
  RunInParts(touched.places.size() > 10000, touched.places.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
    {
      touched.places[i] = { PlaceFromFirst(points[i], points.front(), scale), touching.weights[i] };
    }
  });
  return touched;
}

} // namespace

ToleranceValues
ComputeTolerances(const MedialComplex &             core,
                  const SpacingWeights &            weights,
                  const std::vector<LatticePoint> & points,
                  TouchingBalls                     touching,
                  double                            floor,
                  const ProgressCallback &          progress)
{
  const CellComplex &   cells = core.cells;
  const BallCentre      scale = ScaleOf(weights);
  const ToleranceLevels levels(std::sqrt(SquaredDistance(scale, { 0, 0, 0 })));
  const LiveElements    left = floor > 0 ? LeftByFloor(core, floor, progress) : LiveElements();
  std::vector<CoreBall> balls = BallsOf(core, std::move(touching.places), scale);
  TouchedPlaces         touched = TouchedBy(touching, points, scale);
  ToleranceValues       values;
  std::vector<std::pair<ElementIndex, ElementIndex>> edgesOfEnds;
  Stages                                             stages;
  std::optional<RimFire>                             fire;
  // Loose ends follow the fire, which does not look back.
  RunBoth(
    cells.FaceCount() > 10000,
    [&] {
      const StopAtEnd stop{ stages };
      fire.emplace(cells, left, levels, touched, balls);
      bool isOut = false; // most levels lie beyond all costs
      for (std::size_t level = 0; level < levels.Count() && !isOut; ++level)
      {
        if (level % 8 == 0)
        {
          ReportProgress(progress, "prune", 0.0);
        }
        fire->Burn(level);
        stages.Finish(level, fire->BurntCount());
        isOut = fire->IsOut();
      }
      stages.FinishAll();
      fire->KeepLevelsOnly();
      std::vector<WeighedPlace>().swap(touched.places);
      std::vector<std::uint32_t>().swap(touching.offsets);
      std::vector<std::uint32_t>().swap(touching.touched);
    },
    [&] {
      LooseEnds ends(cells, left, points, scale, touching.weights, touching.largest, levels, balls);
      std::vector<ElementIndex>().swap(touching.largest);
      std::size_t done = 0;
      std::size_t end = 0;
      bool        isOut = false;
      for (std::size_t level = 0; level < levels.Count() && !isOut && stages.Await(level, end); ++level)
      {
        ends.Take(level, fire->Burnt(done, end));
        done = end;
        isOut = ends.IsOut() && stages.IsLast(level);
      }
      values.vertices = ends.TakeVertexHeights();
      edgesOfEnds = ends.TakeGone();
    });
  values.faces = fire->TakeFaceHeights();
  values.edges = fire->TakeEdgeHeights();
  fire.reset();
  RunInParts(edgesOfEnds.size() > 10000, edgesOfEnds.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
    {
      values.edges[edgesOfEnds[i].first] = values.vertices[edgesOfEnds[i].second];
    }
  });
  std::vector<std::pair<ElementIndex, ElementIndex>>().swap(edgesOfEnds);
  KeepSheetsWhole(core, balls, levels, values);
  return values;
}

} // namespace voxelcore
