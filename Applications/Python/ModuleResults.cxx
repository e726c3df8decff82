// What results are to Python: classes with read-only views.

#include "LabelWork.h"
#include "ModuleParts.h"
#include "Pickling.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <map>
#include <string>

namespace py = pybind11;
using namespace voxelcore; // NOLINT: the module speaks its library's language

namespace
{

py::dict
NumbersOf(const ThicknessRecord & record)
{
  const ThicknessNumbers & n = record.numbers;
  py::dict                 dict;
  dict["voxels"] = n.voxels;
  dict["volume"] = static_cast<double>(n.voxels) * record.voxelVolume;
  dict["mean"] = n.mean;
  dict["sd"] = n.deviation;
  dict["min"] = n.least;
  dict["p5"] = n.quantile5;
  dict["p25"] = n.quantile25;
  dict["median"] = n.median;
  dict["p75"] = n.quantile75;
  dict["p95"] = n.quantile95;
  dict["max"] = n.greatest;
  dict["border_voxels"] = record.borderVoxels;
  dict["inner_mean"] = record.inner.voxels > 0 ? py::object(py::float_(record.inner.mean)) : py::object(py::none());
  dict["bin_width"] = n.binWidth;
  dict["histogram"] = n.bins;
  return dict;
}

/** A read-only array of `columns` numbers a row on memory that `owner` keeps alive; columns 0: one-dimensional. */
template <typename TNumber, typename TOwner>
py::array
View(const std::shared_ptr<TOwner> & owner, const void * data, std::size_t rows, std::size_t columns = 0)
{
  auto *                   keep = new std::shared_ptr<TOwner>(owner);
  py::capsule              capsule(keep, [](void * kept) { delete static_cast<std::shared_ptr<TOwner> *>(kept); });
  std::vector<py::ssize_t> shape{ static_cast<py::ssize_t>(rows) };
  if (columns > 0)
  {
    shape.push_back(static_cast<py::ssize_t>(columns));
  }
  py::array_t<TNumber> view(shape, static_cast<const TNumber *>(data), capsule);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

template <typename TNumber, typename TOwner>
py::array
View(const std::shared_ptr<TOwner> & owner, const std::vector<TNumber> & values)
{
  return View<TNumber>(owner, values.data(), values.size());
}

template <typename TNumber, std::size_t TColumns, typename TOwner>
py::array
View(const std::shared_ptr<TOwner> & owner, const std::vector<std::array<TNumber, TColumns>> & rows)
{
  return View<TNumber>(owner, rows.data(), rows.size(), TColumns);
}

py::dict
Topology(const TopologyNumbers & numbers)
{
  py::dict dict;
  dict["euler"] = numbers.euler;
  dict["betti"] = py::make_tuple(numbers.betti[0], numbers.betti[1], numbers.betti[2]);
  return dict;
}

py::dict
NumbersOf(const SkeletonNumbers & numbers)
{
  py::dict dict;
  dict["components"] = numbers.components;
  dict["branches"] = numbers.branches;
  dict["tips"] = numbers.tips;
  dict["junctions"] = numbers.junctions;
  dict["triple_points"] = numbers.triplePoints;
  dict["quadruple_points"] = numbers.quadruplePoints;
  dict["cycles"] = numbers.cycles;
  dict["isolated_loops"] = numbers.isolatedLoops;
  dict["isolated_points"] = numbers.isolatedPoints;
  dict["closed_faces"] = numbers.closedFaces;
  dict["plate_faces"] = numbers.plateFaces;
  dict["total_length"] = numbers.totalLength;
  dict["mean_length"] = numbers.meanLength;
  dict["max_length"] = numbers.maxLength;
  dict["mean_radius"] = numbers.meanRadius;
  dict["volume"] = numbers.volume;
  dict["surface"] = numbers.surface;
  return dict;
}

/** A column of the branch table. */
template <typename TNumber, typename TOf>
py::array
Column(const std::vector<BranchRecord> & branches, TOf && of)
{
  py::array_t<TNumber> column(static_cast<py::ssize_t>(branches.size()));
  for (std::size_t b = 0; b < branches.size(); ++b)
  {
    column.mutable_at(static_cast<py::ssize_t>(b)) = of(branches[b]);
  }
  return column;
}

/** The numbers of all branches under the names of the command line's tables. */
py::dict
BranchColumns(const SkeletonOfLabel & skeleton)
{
  using Branch = BranchRecord;
  const auto & branches = skeleton.part.table.branches;
  py::dict     dict;
  const auto   real = [&](const char * name, double Branch::*field) {
    dict[name] = Column<double>(branches, [field](const Branch & branch) { return branch.*field; });
  };
  const auto whole = [&](const char * name, std::int32_t Branch::*field) {
    dict[name] = Column<std::int64_t>(branches, [field](const Branch & branch) { return branch.*field; });
  };
  dict["skeleton_id"] = Column<std::int64_t>(branches, [](const Branch & branch) { return branch.component; });
  dict["branch_type"] =
    Column<std::int64_t>(branches, [](const Branch & branch) { return static_cast<std::int64_t>(branch.type); });
  real("branch_distance", &Branch::length);
  real("euclidean_distance", &Branch::chord);
  real("tortuosity", &Branch::tortuosity);
  real("free_length", &Branch::freeLength);
  real("mean_radius", &Branch::meanRadius);
  real("min_radius", &Branch::minRadius);
  real("max_radius", &Branch::maxRadius);
  real("sd_radius", &Branch::sdRadius);
  real("mean_ball_radius", &Branch::meanBallRadius);
  real("min_ball_radius", &Branch::minBallRadius);
  real("max_ball_radius", &Branch::maxBallRadius);
  real("volume", &Branch::volume);
  real("surface", &Branch::surface);
  dict["parent_branch"] = Column<std::int64_t>(branches, [](const Branch & branch) {
    return branch.parent == kNoBranch ? std::int64_t{ -1 } : std::int64_t{ branch.parent };
  });
  real("parent_angle", &Branch::parentAngle);
  whole("strahler", &Branch::strahler);
  whole("centrifugal", &Branch::centrifugal);
  whole("level", &Branch::level);
  dict["axis"] = Column<std::int64_t>(branches, [](const Branch & branch) { return branch.axis; });
  dict["closes_loop"] = Column<bool>(branches, [](const Branch & branch) { return branch.closesLoop; });
  return dict;
}

void
DefineCore(py::module_ & module)
{
  using Handle = std::shared_ptr<CoreOfLabel>;
  const auto cells = [](const Handle & core) -> const CellComplex & { return core->part.core.cells; };
  py::class_<CoreOfLabel, Handle>(module, "CoreData")
    .def_property_readonly("vertices", [](const Handle & core) { return View(core, core->part.core.positions); })
    .def_property_readonly("radius", [](const Handle & core) { return View(core, core->part.core.radius); })
    .def_property_readonly("radius_margin", [](const Handle & core) { return View(core, core->part.radiusMargin); })
    .def_property_readonly("edges", [cells](const Handle & core) { return View(core, cells(core).edges); })
    .def_property_readonly("face_offsets", [cells](const Handle & core) { return View(core, cells(core).faceOffsets); })
    .def_property_readonly("face_vertices",
                           [cells](const Handle & core) { return View(core, cells(core).faceVertices); })
    .def_property_readonly("face_edges", [cells](const Handle & core) { return View(core, cells(core).faceEdges); })
    .def_property_readonly("lambda_vertices",
                           [](const Handle & core) { return View(core, core->part.core.vertexLambda); })
    .def_property_readonly("lambda_edges", [](const Handle & core) { return View(core, core->part.core.edgeLambda); })
    .def_property_readonly("lambda_faces", [](const Handle & core) { return View(core, core->part.core.faceLambda); })
    .def_property_readonly("tolerance_vertices",
                           [](const Handle & core) { return View(core, core->part.core.tolerances.vertices); })
    .def_property_readonly("tolerance_edges",
                           [](const Handle & core) { return View(core, core->part.core.tolerances.edges); })
    .def_property_readonly("tolerance_faces",
                           [](const Handle & core) { return View(core, core->part.core.tolerances.faces); })
    .def_property_readonly("label", [](const Handle & core) { return core->report.labels.front().label; })
    .def_property_readonly("component", [](const Handle & core) { return core->report.labels.front().component; })
    .def_property_readonly("lambda_mm",
                           [](const Handle & core) { return core->report.labels.front().pruned.front().lambdaMm; })
    .def_property_readonly("voxels", [](const Handle & core) { return core->report.labels.front().voxels; })
    .def_property_readonly("spacing", [](const Handle & core) { return core->report.input.geometry.spacing; })
    .def_property_readonly("unit", [](const Handle & core) { return UnitName(core->report.input.geometry.unit); })
    .def_property_readonly(
      "topology",
      [](const Handle & core) { return Topology(core->report.labels.front().pruned.front().complex.topology); })
    .def_property_readonly("shape_topology",
                           [](const Handle & core) { return Topology(core->report.labels.front().shape); })
    .def_property_readonly("report", [](const Handle & core) { return ReportJson(core->report); })
    .def("state", [](const Handle & core) { return StateOf(*core); });
}

/** Values, i fastest, as an array a[i, j, k]. */
py::array
Volume(const std::shared_ptr<ThicknessOfArray> & owner, const std::vector<float> & values)
{
  const auto                     size = owner->size;
  const auto                     step = static_cast<py::ssize_t>(sizeof(float));
  const std::vector<py::ssize_t> shape{ size[0], size[1], size[2] };
  const std::vector<py::ssize_t> strides{ step, step * size[0], step * size[0] * size[1] };
  auto *                         keep = new std::shared_ptr<ThicknessOfArray>(owner);
  const py::capsule capsule(keep, [](void * kept) { delete static_cast<std::shared_ptr<ThicknessOfArray> *>(kept); });
  return py::array_t<float>(shape, strides, values.data(), capsule);
}

void
DefineThickness(py::module_ & module)
{
  using Handle = std::shared_ptr<ThicknessOfArray>;
  py::class_<ThicknessOfArray, Handle>(module, "ThicknessData")
    .def_property_readonly("map", [](const Handle & t) { return Volume(t, t->map); })
    .def_property_readonly("lower",
                           [](const Handle & t) -> py::object {
                             return t->lower.empty() ? py::object(py::none()) : py::object(Volume(t, t->lower));
                           })
    .def_property_readonly("upper",
                           [](const Handle & t) -> py::object {
                             return t->upper.empty() ? py::object(py::none()) : py::object(Volume(t, t->upper));
                           })
    .def_property_readonly("numbers", [](const Handle & t) {
      py::list all;
      for (const ThicknessRecord & record : t->records)
      {
        all.append(py::make_tuple(record.label, record.component, NumbersOf(record)));
      }
      return all;
    });
}

/** A dict for each contact of a network; none where it is none. */
py::list
ContactsOf(const SkeletonPart & part)
{
  py::list all;
  if (!part.network)
  {
    return all;
  }
  for (const NetworkContact & contact : part.network->contacts)
  {
    py::list nodes;
    for (const auto & place : contact.places)
    {
      for (std::size_t node = 0; node < part.graph.nodePoints.size(); ++node)
      {
        const ElementIndex point = part.graph.nodePoints[node];
        if (part.graph.contact[point] != 0 && part.graph.positions[point] == place)
        {
          nodes.append(node);
          break;
        }
      }
    }
    py::dict one;
    one["labels"] = py::make_tuple(contact.labels[0], contact.labels[1]);
    one["area"] = contact.areaMm2;
    one["faces"] = contact.faces;
    one["voxels"] = contact.voxels;
    one["centre"] = py::make_tuple(contact.centre[0], contact.centre[1], contact.centre[2]);
    one["nodes"] = nodes;
    all.append(one);
  }
  return all;
}

void
DefineSkeleton(py::module_ & module)
{
  using Handle = std::shared_ptr<SkeletonOfLabel>;
  const auto graph = [](const Handle & skeleton) -> const SkeletonGraph & { return skeleton->part.graph; };
  py::class_<SkeletonOfLabel, Handle>(module, "SkeletonData")
    .def_property_readonly("points", [graph](const Handle & s) { return View(s, graph(s).positions); })
    .def_property_readonly("radius", [graph](const Handle & s) { return View(s, SectionRadii(graph(s))); })
    .def_property_readonly("ball_radius", [graph](const Handle & s) { return View(s, graph(s).radius); })
    .def_property_readonly("erosion_thickness",
                           [graph](const Handle & s) { return View(s, graph(s).erosionThickness); })
    .def_property_readonly("branch_offsets", [graph](const Handle & s) { return View(s, graph(s).branchOffsets); })
    .def_property_readonly("branch_points", [graph](const Handle & s) { return View(s, graph(s).branchPoints); })
    .def_property_readonly("branch_nodes", [graph](const Handle & s) { return View(s, graph(s).branchNodes); })
    .def_property_readonly("node_points", [graph](const Handle & s) { return View(s, graph(s).nodePoints); })
    .def_property_readonly("node_kinds",
                           [graph](const Handle & s) {
                             const auto & kinds = graph(s).nodeKinds;
                             return View<std::uint8_t>(s, kinds.data(), kinds.size());
                           })
    .def_property_readonly("face_offsets", [graph](const Handle & s) { return View(s, graph(s).faceOffsets); })
    .def_property_readonly("face_vertices", [graph](const Handle & s) { return View(s, graph(s).faceVertices); })
    .def_property_readonly("names",
                           [](const Handle & s) {
                             std::map<std::int64_t, std::string> names;
                             if (!s->part.network)
                             {
                               names[s->part.label] = s->part.name;
                               return names;
                             }
                             for (const NetworkLabel & label : s->part.network->labels)
                             {
                               names[label.value] = label.name;
                             }
                             return names;
                           })
    .def_property_readonly("point_labels", [graph](const Handle & s) { return View(s, graph(s).labels); })
    .def_property_readonly("branch_labels",
                           [](const Handle & s) {
                             std::vector<std::int64_t> labels;
                             for (std::size_t branch = 0; branch < s->part.graph.BranchCount(); ++branch)
                             {
                               labels.push_back(s->part.network ? s->part.graph.BranchLabel(branch) : s->part.label);
                             }
                             return py::array_t<std::int64_t>(static_cast<py::ssize_t>(labels.size()), labels.data());
                           })
    .def_property_readonly("branch_names", [](const Handle & s) { return s->part.names; })
    .def_property_readonly("edits",
                           [](const Handle & s) {
                             py::list edits;
                             for (const auto & [place, edit, name, leftOut] : s->edits)
                             {
                               edits.append(py::dict(py::arg("x") = place[0],
                                                     py::arg("y") = place[1],
                                                     py::arg("z") = place[2],
                                                     py::arg("edit") = edit,
                                                     py::arg("name") = name,
                                                     py::arg("left_out") = leftOut));
                             }
                             return edits;
                           })
    .def_property_readonly("contacts", [](const Handle & s) { return ContactsOf(s->part); })
    .def_property_readonly("label", [](const Handle & s) { return s->part.label; })
    .def_property_readonly("component", [](const Handle & s) { return s->report.labels.front().component; })
    .def_property_readonly(
      "topology",
      [](const Handle & s) { return Topology(s->report.labels.front().skeleton.value().topology); })
    .def_property_readonly("unit", [](const Handle & s) { return UnitName(s->report.input.geometry.unit); })
    .def_property_readonly("numbers", [](const Handle & s) { return NumbersOf(s->part.table.numbers); })
    .def_property_readonly("report", [](const Handle & s) { return ReportJson(s->report); })
    .def("branch_columns", [](const Handle & s) { return BranchColumns(*s); })
    .def("state", [](const Handle & s) { return StateOf(*s); });
}

} // namespace

void
voxelcore::DefineResults(py::module_ & module)
{
  DefineCore(module);
  DefineSkeleton(module);
  DefineThickness(module);
}
