#include "Pickling.h"

#include "voxelcore/Error.h"

#include <cstring>
#include <numeric>
#include <optional>
#include <pybind11/stl.h>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace py = pybind11;

namespace voxelcore
{

namespace
{

[[noreturn]] void
RefuseState()
{
  throw UsageError("this pickle was not made by voxelcore " + VoxelCoreVersion() +
                   "; results that must outlast a version are saved with save()");
}

/** Calls `visit` with every array of a core, in an order that is the format. */
template <typename TPart, typename TVisit>
void
VisitCore(TPart & part, TVisit && visit)
{
  auto & core = part.core;
  visit(core.cells.edges);
  visit(core.cells.faceOffsets);
  visit(core.cells.faceVertices);
  visit(core.cells.faceEdges);
  visit(core.positions);
  visit(core.radius);
  visit(core.vertexLambda);
  visit(core.edgeLambda);
  visit(core.faceLambda);
  visit(core.tolerances.vertices);
  visit(core.tolerances.edges);
  visit(core.tolerances.faces);
  visit(part.displacement);
  visit(part.radiusMargin);
}

template <typename TGraph, typename TVisit>
void
VisitGraph(TGraph & graph, TVisit && visit)
{
  visit(graph.positions);
  visit(graph.medial);
  visit(graph.radius);
  visit(graph.sectionRadius);
  visit(graph.erosionThickness);
  visit(graph.nodePoints);
  visit(graph.nodeKinds);
  visit(graph.branchOffsets);
  visit(graph.branchPoints);
  visit(graph.branchNodes);
  visit(graph.faceOffsets);
  visit(graph.faceVertices);
  visit(graph.closedFace);
}

class ArrayWriter
{
public:
  template <typename TValue>
  void
  operator()(const std::vector<TValue> & values)
  {
    static_assert(std::is_trivially_copyable_v<TValue>);
    m_Arrays.append(py::bytes(reinterpret_cast<const char *>(values.data()), values.size() * sizeof(TValue)));
  }

  py::tuple
  Take() const
  {
    return py::tuple(m_Arrays);
  }

private:
  py::list m_Arrays;
};

class ArrayReader
{
public:
  explicit ArrayReader(py::tuple arrays)
    : m_Arrays(std::move(arrays))
  {}

  template <typename TValue>
  void
  operator()(std::vector<TValue> & values)
  {
    if (m_Next >= m_Arrays.size())
    {
      RefuseState();
    }
    const auto             bytes = m_Arrays[m_Next++].template cast<py::bytes>();
    const std::string_view text = bytes;
    if (text.size() % sizeof(TValue) != 0)
    {
      RefuseState();
    }
    values.resize(text.size() / sizeof(TValue));
    if (!values.empty())
    {
      std::memcpy(values.data(), text.data(), text.size());
    }
  }

private:
  py::tuple   m_Arrays;
  std::size_t m_Next = 0;
};

/** The report as JSON, and what the JSON leaves to the file it stands in. */
py::tuple
StateOf(const CoreReport & report)
{
  const LabelRecord &                      label = report.labels.front();
  const PrunedRecord &                     pruned = label.pruned.front();
  std::optional<double>                    gap = pruned.tolerance ? pruned.tolerance->boundaryGapMm : std::nullopt;
  std::optional<std::pair<double, double>> margin;
  if (pruned.refined && pruned.refined->radiusMargin)
  {
    margin = { pruned.refined->radiusMargin->mean, pruned.refined->radiusMargin->max };
  }
  return py::make_tuple(ReportJson(report),
                        report.input.path,
                        report.parameters.engine,
                        report.parameters.threads,
                        label.covered,
                        gap,
                        margin);
}

CoreReport
ReportFrom(const py::tuple & state)
{
  CoreReport    report = ParseProvenance(state[0].cast<std::string>(), "the pickle");
  LabelRecord & label = report.labels.at(0);
  report.input.path = state[1].cast<std::string>();
  report.parameters.engine = state[2].cast<std::string>();
  report.parameters.threads = state[3].cast<int>();
  label.covered = state[4].cast<std::optional<bool>>();
  if (label.pruned.at(0).tolerance)
  {
    label.pruned.front().tolerance->boundaryGapMm = state[5].cast<std::optional<double>>();
  }
  if (const auto margin = state[6].cast<std::optional<std::pair<double, double>>>())
  {
    label.pruned.front().refined.value().radiusMargin = MarginNumbers{ margin->first, margin->second };
  }
  return report;
}

void
RequireState(const py::tuple & state, std::size_t size)
{
  if (state.size() != size || state[0].cast<std::string>() != VoxelCoreVersion())
  {
    RefuseState();
  }
}

void
WriteShape(const PackedShape * shape, ArrayWriter & arrays)
{
  arrays(shape != nullptr ? std::vector<VoxelBox>{ shape->box } : std::vector<VoxelBox>());
  arrays(shape != nullptr ? shape->words : std::vector<std::uint64_t>());
  arrays(shape != nullptr ? shape->counts : std::vector<std::uint32_t>());
}

std::shared_ptr<const PackedShape>
ReadShape(ArrayReader & arrays)
{
  std::vector<VoxelBox> boxes;
  PackedShape           shape;
  arrays(boxes);
  arrays(shape.words);
  arrays(shape.counts);
  if (boxes.empty())
  {
    return nullptr;
  }
  shape.box = boxes.front();
  const auto & size = shape.box.size;
  const auto   rows = static_cast<std::uint64_t>(size[1]) * static_cast<std::uint64_t>(size[2]);
  if (shape.words.size() != shape.counts.size() ||
      std::accumulate(shape.counts.begin(), shape.counts.end(), std::uint64_t{ 0 }) !=
        rows * ((static_cast<std::uint64_t>(size[0]) + 63) / 64))
  {
    RefuseState();
  }
  return std::make_shared<const PackedShape>(std::move(shape));
}

} // namespace

py::tuple
StateOf(const CoreOfLabel & core)
{
  ArrayWriter arrays;
  VisitCore(core.part, arrays);
  WriteShape(core.shape.get(), arrays);
  return py::make_tuple(VoxelCoreVersion(),
                        StateOf(core.report),
                        core.hasEdges,
                        core.refined,
                        core.part.label,
                        core.part.component,
                        arrays.Take());
}

std::shared_ptr<CoreOfLabel>
CoreFromState(const py::tuple & state)
{
  RequireState(state, 7);
  auto core = std::make_shared<CoreOfLabel>();
  core->report = ReportFrom(state[1]);
  core->hasEdges = state[2].cast<bool>();
  core->refined = state[3].cast<std::string>();
  core->part.label = state[4].cast<std::int64_t>();
  core->part.component = state[5].cast<std::int64_t>();
  ArrayReader arrays(state[6]);
  VisitCore(core->part, arrays);
  core->shape = ReadShape(arrays);
  core->part.core.cells.vertexCount = core->part.core.positions.size();
  return core;
}

py::tuple
StateOf(const SkeletonOfLabel & skeleton)
{
  const SkeletonPart & part = skeleton.part;
  ArrayWriter          arrays;
  VisitGraph(part.graph, arrays);
  arrays(skeleton.report.labels.front().skeleton.value().cuts);
  return py::make_tuple(VoxelCoreVersion(),
                        StateOf(skeleton.report),
                        StateOf(*skeleton.surface),
                        part.label,
                        part.component,
                        part.name,
                        arrays.Take());
}

std::shared_ptr<SkeletonOfLabel>
SkeletonFromState(const py::tuple & state)
{
  RequireState(state, 7);
  auto skeleton = std::make_shared<SkeletonOfLabel>();
  skeleton->report = ReportFrom(state[1]);
  skeleton->surface = CoreFromState(state[2]);
  SkeletonPart & part = skeleton->part;
  part.label = state[3].cast<std::int64_t>();
  part.component = state[4].cast<std::int64_t>();
  part.name = state[5].cast<std::string>();
  SkeletonRecord & record = skeleton->report.labels.front().skeleton.value();
  ArrayReader      arrays(state[6]);
  VisitGraph(part.graph, arrays);
  arrays(record.cuts);
  const CoreReport & report = skeleton->report;
  part.table = MeasureBranches(part.graph, { report.skeleton.value().branches.root });
  record.numbers = part.table.numbers;
  return skeleton;
}

} // namespace voxelcore
