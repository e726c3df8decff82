#include "voxelcore/Jobs/LabelLoop.h"

#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Jobs/LabelGroups.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Jobs/BlockJob.h"
#include "voxelcore/Jobs/LabelReading.h"
#include "voxelcore/Shape/BoundaryVertices.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <numeric>
#include <omp.h>
#include <utility>

namespace voxelcore
{

namespace
{

/** The boundary vertices of each label. */
std::vector<std::uint64_t>
CountVertices(const std::vector<EditedLabel> & labels)
{
  std::vector<std::uint64_t> vertices(labels.size());
  RunEach(labels.size(), [&](std::size_t i) { vertices[i] = CountBoundaryVertices(labels[i].label.shape); });
  return vertices;
}

/** TetGen cannot run twice at a time in one process. */
bool
MayRunSideBySide(const CoreOptions & options)
{
  return options.engine != Engine::TetGen && !options.crossCheck && options.join.empty() && omp_get_max_threads() > 1;
}

/** The wall-clock time of labels that ran side by side, shared out among the stages as the labels' own clocks say. */
void
AddSeconds(StageSeconds & seconds, const std::vector<LabelOutcome> & outcomes, double wall)
{
  StageSeconds sum;
  for (const LabelOutcome & outcome : outcomes)
  {
    AddComputing(sum, outcome.seconds);
    sum.skeleton += outcome.seconds.skeleton;
  }
  const double all = sum.shape + sum.delaunay + sum.core + sum.prune + sum.skeleton;
  const double scale = outcomes.size() == 1 || all == 0 ? 1 : wall / all;
  seconds.shape += scale * sum.shape;
  seconds.delaunay += scale * sum.delaunay;
  seconds.core += scale * sum.core;
  seconds.prune += scale * sum.prune;
  seconds.skeleton += scale * sum.skeleton;
}

} // namespace

void
ProcessLabels(std::vector<EditedLabel> &                labels,
              const CoreOptions &                       options,
              const ImageGeometry &                     geometry,
              const SurfaceSource &                     surface,
              const std::optional<VoxelBox> &           scan,
              const ProgressCallback &                  progress,
              const std::function<void(LabelOutcome)> & take,
              StageSeconds &                            seconds,
              bool                                      goOn)
{
  std::vector<std::uint64_t> vertices;
  std::vector<std::size_t>   ends;
  if (labels.size() > 1 && MayRunSideBySide(options))
  {
    Stopwatch watch;
    vertices = CountVertices(labels);
    ends = GroupLabels(vertices);
    seconds.shape += watch.Lap();
  }
  else
  {
    ends.resize(labels.size());
    std::iota(ends.begin(), ends.end(), std::size_t{ 1 });
  }

  // What a label's time grows with, where it is known.
  const auto sizeOf = [&](std::size_t label) {
    return vertices.empty() ? labels[label].label.voxels : vertices[label];
  };
  std::uint64_t all = 0;
  for (std::size_t label = 0; label < labels.size(); ++label)
  {
    all += sizeOf(label);
  }
  const LabelWork compute = [&](std::size_t label, const ProgressCallback & part) {
    EditedLabel &      one = labels[label];
    const std::int64_t value = one.label.value;
    const std::int64_t component = one.component;
    TopologyNumbers    topology;
    const CellSource   join = [&](const std::vector<LatticePoint> & points, const ProgressCallback & inner) {
      return JoinParts(options.join, options.scan, value, component, points, topology, inner);
    };
    if (!options.join.empty())
    {
      topology = ComputeShapeTopology(one.label.shape);
    }
    CertifiedRequest request = RequestOf(options, surface);
    request.scan = scan;
    request.cells = options.join.empty() ? CellSource() : join;
    return ProcessLabel(std::move(one), geometry, std::move(request), part);
  };
  const LabelWork work = [&](std::size_t label, const ProgressCallback & part) {
    try
    {
      return compute(label, part);
    }
    catch (const CertificateError & error)
    {
      if (!goOn)
      {
        throw;
      }
      LabelOutcome failed;
      failed.failure = error.what();
      return failed;
    }
  };

  std::size_t   first = 0;
  std::uint64_t done = 0;
  for (const std::size_t end : ends)
  {
    const auto        share = [&] { return static_cast<double>(done) / static_cast<double>(all); };
    const double      from = share();
    const std::string name = labels[first].label.name;
    for (std::size_t label = first; label < end; ++label)
    {
      done += sizeOf(label);
    }
    const std::string         of = "/" + std::to_string(labels.size()) + ")";
    std::vector<LabelOutcome> outcomes;
    Stopwatch                 watch;
    if (end - first == 1)
    {
      outcomes.push_back(work(first, ProgressOfLabel(progress, name, first, labels.size(), from, share())));
    }
    else
    {
      const std::string which = "labels (" + std::to_string(first + 1) + "-" + std::to_string(end) + of;
      outcomes = ProcessSideBySide(first, end, vertices, work, NamedPartOfProgress(progress, which, from, share()));
    }
    AddSeconds(seconds, outcomes, watch.Lap());
    for (LabelOutcome & outcome : outcomes)
    {
      take(std::move(outcome));
    }
    first = end;
  }
}

} // namespace voxelcore
