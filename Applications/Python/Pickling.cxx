#include "Pickling.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Complex/SoundComplex.h"
#include "voxelcore/Skeleton/SoundSkeleton.h"
#include "voxelcore/VoxelCore/SoundCore.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
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

/** A pickle may have been damaged, or made by hand: what is not as a result of this version has it would lead out of
 *  its arrays later. */
[[noreturn]] void
RefuseDamaged()
{
  throw UsageError("this pickle is damaged; make it anew, or save results with save()");
}

void
RequireWhole(bool condition)
{
  if (!condition)
  {
    RefuseDamaged();
  }
}

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
  visit(graph.labels);
  visit(graph.contact);
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
    RequireWhole(text.size() % sizeof(TValue) == 0);
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
  const auto &                             tolerance = pruned.tolerance;
  std::optional<double>                    gap = tolerance ? tolerance->boundaryGapMm : std::nullopt;
  std::optional<double>                    share = tolerance ? tolerance->boundaryGapShare : std::nullopt;
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
                        margin,
                        share,
                        label.standOut);
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
  label.standOut = state[8].cast<std::optional<bool>>();
  if (label.pruned.at(0).tolerance)
  {
    label.pruned.front().tolerance->boundaryGapMm = state[5].cast<std::optional<double>>();
    label.pruned.front().tolerance->boundaryGapShare = state[7].cast<std::optional<double>>();
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
  RequireWhole(boxes.size() == 1);
  shape.box = boxes.front();
  // As VoxelShape has them; a box of no more rows than numbers of 64 bits can count.
  std::uint64_t words = 1;
  for (std::size_t a = 0; a < 3; ++a)
  {
    constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
    const std::int64_t     size = shape.box.size[a];
    RequireWhole(size > 0 && shape.box.lower[a] + size <= most);
    words *= static_cast<std::uint64_t>(a == 0 ? (size + 63) / 64 : size);
    RequireWhole(words <= std::uint64_t{ 1 } << 38U);
  }
  RequireWhole(shape.words.size() == shape.counts.size() &&
               std::find(shape.counts.begin(), shape.counts.end(), 0U) == shape.counts.end() &&
               std::accumulate(shape.counts.begin(), shape.counts.end(), std::uint64_t{ 0 }) == words);
  return std::make_shared<const PackedShape>(std::move(shape));
}

/** As ReadModel finds every core. */
bool
IsWhole(const CoreOfLabel & core)
{
  const MedialComplex & complex = core.part.core;
  const CellComplex &   cells = complex.cells;
  const std::size_t     vertices = cells.vertexCount;
  const auto &          tolerances = complex.tolerances;
  const auto            areLengths = [](const std::vector<double> & values) {
    return std::all_of(values.begin(), values.end(), [](double value) { return value >= 0; });
  };
  const bool hasNone = tolerances.vertices.empty() && tolerances.edges.empty() && tolerances.faces.empty();
  const bool sizesFit =
    vertices > 0 && complex.radius.size() == vertices && complex.vertexLambda.size() == vertices &&
    complex.edgeLambda.size() == cells.edges.size() && IsComplex(cells) &&
    complex.faceLambda.size() == cells.FaceCount() &&
    (hasNone || (tolerances.vertices.size() == vertices && tolerances.edges.size() == cells.edges.size() &&
                 tolerances.faces.size() == cells.FaceCount())) &&
    core.part.displacement.size() == (core.refined.empty() ? 0 : vertices) &&
    (core.part.radiusMargin.empty() || core.part.radiusMargin.size() == vertices);
  const bool edgesFit = !core.hasEdges || std::none_of(complex.edgeLambda.begin(),
                                                       complex.edgeLambda.end(),
                                                       [](double measure) { return std::isnan(measure); });
  const bool labelFits = core.report.labels.size() == 1 && core.report.labels.front().label == core.part.label &&
                         core.report.labels.front().component == core.part.component && core.part.component >= 0;
  return sizesFit && edgesFit && labelFits && FaultOfNumbers(complex, { .isRefined = !core.refined.empty() }).empty() &&
         areLengths(tolerances.vertices) && areLengths(tolerances.edges) && areLengths(tolerances.faces) &&
         areLengths(core.part.radiusMargin) &&
         std::all_of(core.part.displacement.begin(), core.part.displacement.end(), [](const Vector3 & move) {
           return std::isfinite(move[0]) && std::isfinite(move[1]) && std::isfinite(move[2]);
         });
}

/** Reads a state: whatever is not as StateOf() makes it is a damaged pickle. */
template <typename TRead>
auto
ReadState(TRead && read)
{
  try
  {
    return read();
  }
  catch (const Error &)
  {
    throw;
  }
  catch (const std::bad_alloc &)
  {
    throw;
  }
  catch (const std::exception &) // of pybind11's casts, of JSON, of an optional without a value
  {
    RefuseDamaged();
  }
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

namespace
{

std::shared_ptr<CoreOfLabel>
CoreOf(const py::tuple & state)
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
  RequireWhole(IsWhole(*core));
  return core;
}

} // namespace

std::shared_ptr<CoreOfLabel>
CoreFromState(const py::tuple & state)
{
  return ReadState([&] { return CoreOf(state); });
}

py::tuple
StateOf(const SkeletonOfLabel & skeleton)
{
  const SkeletonPart & part = skeleton.part;
  ArrayWriter          arrays;
  VisitGraph(part.graph, arrays);
  arrays(skeleton.report.labels.front().skeleton.value().cuts);
  py::list edits;
  for (const auto & [place, edit, name, leftOut] : skeleton.edits)
  {
    edits.append(py::make_tuple(place, edit, name, leftOut));
  }
  return py::make_tuple(VoxelCoreVersion(),
                        StateOf(skeleton.report),
                        skeleton.surface ? py::object(StateOf(*skeleton.surface)) : py::object(py::none()),
                        part.label,
                        part.component,
                        part.name,
                        part.names,
                        edits,
                        arrays.Take());
}

namespace
{

std::shared_ptr<SkeletonOfLabel>
SkeletonOf(const py::tuple & state)
{
  RequireState(state, 9);
  auto skeleton = std::make_shared<SkeletonOfLabel>();
  skeleton->report = ReportFrom(state[1]);
  skeleton->surface = state[2].is_none() ? nullptr : CoreOf(state[2]);
  SkeletonPart & part = skeleton->part;
  part.label = state[3].cast<std::int64_t>();
  part.component = state[4].cast<std::int64_t>();
  part.name = state[5].cast<std::string>();
  SkeletonRecord & record = skeleton->report.labels.front().skeleton.value();
  ArrayReader      arrays(state[8]);
  VisitGraph(part.graph, arrays);
  arrays(record.cuts);
  part.network = record.network;
  part.names = state[6].cast<std::vector<std::string>>();
  for (const py::handle & given : state[7])
  {
    const auto one = given.cast<py::tuple>();
    skeleton->edits.push_back(
      { one[0].cast<Vector3>(), one[1].cast<std::string>(), one[2].cast<std::string>(), one[3].cast<std::string>() });
  }
  RequireWhole(IsSkeleton(part.graph) && (part.names.empty() || part.names.size() == part.graph.BranchCount()) &&
               part.network.has_value() == !part.graph.labels.empty() &&
               std::all_of(record.cuts.begin(), record.cuts.end(), [](const LoopCut & cut) {
                 return std::isfinite(cut.position[0] + cut.position[1] + cut.position[2]) && cut.radius >= 0;
               }));
  const CoreReport & report = skeleton->report;
  part.table = MeasureBranches(part.graph, { report.skeleton.value().branches.root });
  record.numbers = part.table.numbers;
  return skeleton;
}

} // namespace

std::shared_ptr<SkeletonOfLabel>
SkeletonFromState(const py::tuple & state)
{
  return ReadState([&] { return SkeletonOf(state); });
}

} // namespace voxelcore
