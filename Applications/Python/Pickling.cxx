#include "Pickling.h"

#include "voxelcore/Error.h"

#include <algorithm>
#include <cstring>
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
  const LabelRecord &   label = report.labels.front();
  const PrunedRecord &  pruned = label.pruned.front();
  std::optional<double> gap = pruned.tolerance ? pruned.tolerance->boundaryGapMm : std::nullopt;
  return py::make_tuple(ReportJson(report),
                        report.input.path,
                        report.parameters.engine,
                        report.parameters.threads,
                        label.covered,
                        gap);
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
WriteShape(const VoxelShape * shape, ArrayWriter & arrays)
{
  std::vector<VoxelBox>      boxes;
  std::vector<std::uint64_t> words;
  if (shape != nullptr)
  {
    boxes.push_back(shape->Box());
    for (std::int32_t z = 0; z < shape->Box().size[2]; ++z)
    {
      for (std::int32_t y = 0; y < shape->Box().size[1]; ++y)
      {
        const auto row = shape->Row(y, z);
        words.insert(words.end(), row.begin(), row.end());
      }
    }
  }
  arrays(boxes);
  arrays(words);
}

std::shared_ptr<const VoxelShape>
ReadShape(ArrayReader & arrays)
{
  std::vector<VoxelBox>      boxes;
  std::vector<std::uint64_t> words;
  arrays(boxes);
  arrays(words);
  if (boxes.empty())
  {
    return nullptr;
  }
  const VoxelBox & box = boxes.front();
  const auto       rows = static_cast<std::size_t>(box.size[1]) * static_cast<std::size_t>(box.size[2]);
  if (words.size() != rows * ((static_cast<std::size_t>(box.size[0]) + 63) / 64))
  {
    RefuseState();
  }
  auto shape = std::make_shared<VoxelShape>(box);
  auto from = words.begin();
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const auto row = shape->Row(y, z);
      std::copy_n(from, row.size(), row.begin());
      from += static_cast<std::ptrdiff_t>(row.size());
    }
  }
  return shape;
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
