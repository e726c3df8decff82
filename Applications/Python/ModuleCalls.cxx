// Functions of the Python module: arguments in, work in a thread of its own, results out.

#include "LabelFiles.h"
#include "LabelWork.h"
#include "ModuleParts.h"
#include "OwnThread.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Progress.h"
#include "voxelcore/Certified/CertifiedSkeleton.h"
#include "voxelcore/Certified/CertifiedThickness.h"
#include "voxelcore/Compare/ProbabilityJob.h"
#include "voxelcore/Imaging/ScanRows.h"
#include "voxelcore/Report/ResultRecords.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cstring>
#include <functional>
#include <map>
#include <string>

namespace py = pybind11;
using namespace voxelcore; // NOLINT: the module speaks its library's language

namespace
{

[[noreturn]] void
RefuseArray(const std::string & what)
{
  throw InputError("the array: " + what);
}

ArrayView
ViewOf(const py::array & array)
{
  if (array.ndim() == 0)
  {
    RefuseArray(
      "it is a single value; give an array of three dimensions, or an image such as nibabel.load('scan.nii.gz')");
  }
  if (array.ndim() != 3)
  {
    RefuseArray("it has " + std::to_string(array.ndim()) + " dimensions; give three, of a single slice a[:, :, None]" +
                (array.ndim() > 3 ? ", of several volumes one, a[..., 0]" : ""));
  }
  const py::dtype type = array.dtype();
  const char      kind = type.kind();
  const bool      isWhole = kind == 'b' || kind == 'i' || kind == 'u';
  if (!(isWhole && type.itemsize() <= 8) && !(kind == 'f' && (type.itemsize() == 4 || type.itemsize() == 8)))
  {
    RefuseArray("its type is " + std::string(py::str(py::handle(type))) +
                "; give whole numbers (bool, int8 to uint64, or float32 and float64 that hold whole numbers)");
  }
  ArrayView view;
  view.data = static_cast<const std::byte *>(array.data());
  view.pixel = { static_cast<std::size_t>(type.itemsize()), kind == 'i', kind == 'f' };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    view.size[axis] = array.shape(static_cast<py::ssize_t>(axis));
    view.stride[axis] = array.strides(static_cast<py::ssize_t>(axis));
    if (view.size[axis] == 0)
    {
      RefuseArray("it is empty; give one with voxels");
    }
  }
  view.swapped = !type.attr("isnative").cast<bool>();
  return view;
}

/** Of an array. Without a spacing lengths are in voxels. */
ImageGeometry
GeometryOf(const ArrayView & view, const std::optional<std::array<double, 3>> & spacing)
{
  ImageGeometry geometry;
  geometry.size = view.size;
  geometry.spacing = spacing.value_or(Vector3{ 1, 1, 1 });
  geometry.unit = spacing ? SpatialUnit::Millimetres : SpatialUnit::Voxels;
  return geometry;
}

ImageGeometry
PlacedGeometry(const ArrayView &                            view,
               const std::optional<std::array<double, 3>> & spacing,
               const std::array<double, 3> &                origin,
               const std::array<double, 9> &                direction)
{
  ImageGeometry geometry = GeometryOf(view, spacing);
  geometry.origin = origin;
  geometry.direction = direction;
  return geometry;
}

/** `values` are options of the command line. */
std::vector<std::shared_ptr<CoreOfLabel>>
CoresOfArray(const py::array &                            array,
             const std::optional<std::array<double, 3>> & spacing,
             const std::array<double, 3> &                origin,
             const std::array<double, 9> &                direction,
             const ParameterValues &                      values,
             const py::object &                           listener)
{
  const ArrayView     view = ViewOf(array);
  const ImageGeometry geometry = PlacedGeometry(view, spacing, origin, direction);
  return RunInOwnThread(ThreadsFrom(values), listener, array, [=](const ProgressCallback & progress) {
    return MakeCores(view, geometry, values, progress);
  });
}

std::shared_ptr<ThicknessOfArray>
ThicknessOfAnArray(const py::array &                            array,
                   const std::optional<std::array<double, 3>> & spacing,
                   const ParameterValues &                      values,
                   const py::object &                           listener)
{
  const ArrayView     view = ViewOf(array);
  const ImageGeometry geometry = GeometryOf(view, spacing);
  return RunInOwnThread(ThreadsFrom(values), listener, array, [=](const ProgressCallback & progress) {
    return MakeThickness(view, geometry, values, progress);
  });
}

/** How a core is cut into sheets; numbers count from 0, -1 stands for none. */
py::dict
SheetsOfCore(const std::shared_ptr<CoreOfLabel> & core,
             const std::string &                  sliver,
             int                                  threads,
             const py::object &                   listener)
{
  const LabelRecord & record = core->report.labels.front();
  const Lambda        length = ParseLambda(sliver);
  CertifiedRequest    lengths;
  lengths.lambdas = { length };
  RequireLengthsIn(core->report.input.geometry.unit, lengths);
  const double mm =
    InMeanVoxels(length, core->report.parameters.weights, core->report.input.geometry.spacing, record.box);
  const MedialSheets cut = RunInOwnThread(threads, listener, py::none(), [=](const ProgressCallback &) {
    return SheetsOf(core->part, RecordedShape(core->report, core->report.labels.front()), mm);
  });
  const auto         numbers = [](const std::vector<std::uint32_t> & values) {
    py::array_t<std::int64_t> array(static_cast<py::ssize_t>(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      array.mutable_at(static_cast<py::ssize_t>(i)) = values[i] == kNoPiece ? -1 : std::int64_t{ values[i] };
    }
    return array;
  };
  py::dict dict;
  dict["sheet_of_face"] = numbers(cut.sheetOfFace);
  dict["curve_of_edge"] = numbers(cut.curveOfEdge);
  dict["junctions"] = numbers(cut.junctions);
  py::list sheets;
  for (const SheetRecord & sheet : cut.sheets)
  {
    py::dict one;
    one["area"] = sheet.area;
    one["thickness"] = sheet.thickness;
    one["thickness_sd"] = sheet.thicknessDeviation;
    one["normal"] = py::make_tuple(sheet.normal[0], sheet.normal[1], sheet.normal[2]);
    one["flatness"] = sheet.flatness;
    one["free_border"] = sheet.freeBorder;
    one["seam_border"] = sheet.seamBorder;
    one["neighbours"] = sheet.neighbours;
    sheets.append(one);
  }
  py::list curves;
  for (const CurveRecord & curve : cut.curves)
  {
    py::dict one;
    one["kind"] = curve.isRod ? "rod" : "seam";
    one["closed"] = curve.isClosed;
    one["length"] = curve.length;
    one["thickness"] = curve.thickness;
    one["sheets"] = curve.sheets;
    one["vertices"] = numbers(curve.vertices);
    py::list ends;
    for (const std::uint32_t junction : curve.junctions)
    {
      ends.append(junction == kNoPiece ? py::object(py::none()) : py::object(py::int_(junction)));
    }
    one["junctions"] = ends;
    curves.append(one);
  }
  dict["sheets"] = sheets;
  dict["curves"] = curves;
  return dict;
}

/** One side of a comparison, as it is made in the work's thread: of a path (bytes), a result, or an array with its
 *  spacing, origin and direction. */
std::function<CompareSide(const CompareOptions &, const ProgressCallback &)>
SideOf(const py::tuple & given)
{
  const py::object & first = given[0];
  if (py::isinstance<py::bytes>(first))
  {
    return [path = first.cast<std::string>()](const CompareOptions & options, const ProgressCallback & progress) {
      std::vector<std::string> warnings;
      return ReadCompareSide(path, options, warnings, progress);
    };
  }
  if (py::isinstance<SkeletonOfLabel>(first))
  {
    return [one = first.cast<std::shared_ptr<SkeletonOfLabel>>()](const CompareOptions &, const ProgressCallback &) {
      SkeletonModel model;
      model.unit = one->report.input.geometry.unit;
      model.parts = { one->part };
      return CompareSide{ "the skeleton", std::move(model) };
    };
  }
  if (py::isinstance<CoreOfLabel>(first))
  {
    return [one = first.cast<std::shared_ptr<CoreOfLabel>>()](const CompareOptions &, const ProgressCallback &) {
      return CompareSide{ "the core", ModelOf(*one) };
    };
  }
  const ArrayView     view = ViewOf(first.cast<py::array>());
  const ImageGeometry geometry = PlacedGeometry(view,
                                                given[1].cast<std::optional<std::array<double, 3>>>(),
                                                given[2].cast<std::array<double, 3>>(),
                                                given[3].cast<std::array<double, 9>>());
  return [=](const CompareOptions & options, const ProgressCallback & progress) {
    return SideOfArray(view, geometry, options, progress);
  };
}

/** The tables as JSON. */
std::string
CompareBoth(const py::tuple & a, const py::tuple & b, const ParameterValues & values, const py::object & listener)
{
  const auto makeA = SideOf(a);
  const auto makeB = SideOf(b);
  return RunInOwnThread(ThreadsFrom(values), listener, py::make_tuple(a, b), [=](const ProgressCallback & progress) {
    const CompareOptions options = CompareOptionsWithoutFiles(values);
    CompareSide          sideA = makeA(options, PartOfProgress(progress, "reading", 0, 0.1));
    CompareSide          sideB = makeB(options, PartOfProgress(progress, "reading", 0.1, 0.2));
    return CompareJson(
      Compare(std::move(sideA), std::move(sideB), options, PartOfProgress(progress, "comparing", 0.2, 1)),
      options);
  });
}

std::vector<std::shared_ptr<CoreOfLabel>>
PruneCore(const std::shared_ptr<CoreOfLabel> & core, const ParameterValues & values, const py::object & listener)
{
  return RunInOwnThread(ThreadsFrom(values), listener, py::none(), [=](const ProgressCallback & progress) {
    return Prune(*core, values, progress);
  });
}

std::shared_ptr<SkeletonOfLabel>
MeasureSkeleton(const std::shared_ptr<SkeletonOfLabel> & skeleton,
                const ParameterValues &                  values,
                const py::object &                       listener)
{
  return RunInOwnThread(ThreadsFrom(values), listener, py::none(), [=](const ProgressCallback &) {
    return Remeasure(*skeleton, values);
  });
}

/** Spacing and place are the core's where they are not given. */
py::dict
VerifyCore(const std::shared_ptr<CoreOfLabel> &         core,
           const py::array &                            array,
           const std::optional<std::array<double, 3>> & spacing,
           const std::optional<std::array<double, 3>> & origin,
           const std::optional<std::array<double, 9>> & direction,
           int                                          threads,
           const py::object &                           listener)
{
  const ArrayView view = ViewOf(array);
  ImageGeometry   geometry = core->report.input.geometry;
  geometry.size = view.size;
  if (spacing)
  {
    geometry.spacing = *spacing;
    geometry.unit = SpatialUnit::Millimetres;
  }
  geometry.origin = origin.value_or(geometry.origin);
  geometry.direction = direction.value_or(geometry.direction);
  const VerifyResult found = RunInOwnThread(threads, listener, array, [=](const ProgressCallback & progress) {
    return Verify(*core, view, geometry, progress);
  });
  py::dict           checks;
  py::dict           failed;
  const auto &       report = found.labels.front().report;
  for (const VerificationCheck & check : report.checks)
  {
    checks[py::str(check.name)] = check.passed;
    if (!check.passed)
    {
      failed[py::str(check.name)] = InUnit(check.firstOffender, found.unit);
    }
  }
  py::dict dict;
  dict["passed"] = found.passed;
  dict["checks"] = checks;
  dict["failed"] = failed;
  dict["notes"] = found.notes;
  dict["gap"] = report.boundaryGap ? py::object(py::float_(*report.boundaryGap)) : py::object(py::none());
  return dict;
}

std::shared_ptr<SkeletonOfLabel>
SkeletonOfCore(const std::shared_ptr<CoreOfLabel> & core,
               const ParameterValues &              values,
               const py::object &                   listener,
               bool                                 ofArray)
{
  return RunInOwnThread(ThreadsFrom(values), listener, py::none(), [=](const ProgressCallback & progress) {
    return MakeSkeletonOf(core, values, ofArray, progress);
  });
}

std::shared_ptr<SkeletonOfLabel>
NetworkOfArray(const py::array &                            array,
               const std::optional<std::array<double, 3>> & spacing,
               const std::array<double, 3> &                origin,
               const std::array<double, 9> &                direction,
               const ParameterValues &                      coreValues,
               const ParameterValues &                      skeletonValues,
               const py::object &                           listener)
{
  const ArrayView     view = ViewOf(array);
  const ImageGeometry geometry = PlacedGeometry(view, spacing, origin, direction);
  return RunInOwnThread(ThreadsFrom(coreValues), listener, array, [=](const ProgressCallback & progress) {
    return MakeNetworkOf(view, geometry, coreValues, skeletonValues, progress);
  });
}

/** `edits`: a path (bytes), or tuples of a place (LPS), an edit, a name and a label or None. */
std::shared_ptr<SkeletonOfLabel>
CorrectedOfArray(const py::array &                            array,
                 const std::optional<std::array<double, 3>> & spacing,
                 const std::array<double, 3> &                origin,
                 const std::array<double, 9> &                direction,
                 const ParameterValues &                      coreValues,
                 const ParameterValues &                      skeletonValues,
                 const py::object &                           edits,
                 const py::object &                           listener)
{
  const ArrayView     view = ViewOf(array);
  const ImageGeometry geometry = PlacedGeometry(view, spacing, origin, direction);
  std::vector<Said>   said;
  if (py::isinstance<py::bytes>(edits))
  {
    said = ReadEdits(edits.cast<std::string>());
  }
  else
  {
    std::vector<Annotation> annotations;
    for (const py::handle & given : edits)
    {
      const auto one = given.cast<py::tuple>();
      annotations.push_back({ "row " + std::to_string(annotations.size()),
                              {},
                              one[0].cast<Vector3>(),
                              one[1].cast<std::string>(),
                              one[2].cast<std::string>(),
                              one[3].cast<std::optional<std::int64_t>>() });
    }
    said = SaidIn(std::move(annotations), "edits");
  }
  return RunInOwnThread(ThreadsFrom(coreValues), listener, array, [=](const ProgressCallback & progress) {
    return MakeCorrectedOf(view, geometry, coreValues, skeletonValues, said, progress);
  });
}

/** Paths arrive as bytes, so that any file name will do. Work left behind may still hold the same temporary name. */
void
SaveCore(const std::shared_ptr<CoreOfLabel> & core,
         const std::string &                  path,
         bool                                 triangles,
         bool                                 keepEdges,
         bool                                 force)
{
  AwaitLeftBehind();
  RunInOwnThread(0, py::none(), py::none(), [=](const ProgressCallback & progress) {
    Save(*core, path, { triangles, keepEdges }, force, progress);
    return true;
  });
}

void
SaveSkeleton(const std::shared_ptr<SkeletonOfLabel> & skeleton,
             const std::string &                      path,
             const std::string &                      also,
             bool                                     force)
{
  AwaitLeftBehind();
  RunInOwnThread(0, py::none(), py::none(), [=](const ProgressCallback & progress) {
    Save(*skeleton, path, also, force, progress);
    return true;
  });
}

void
SaveSwcFile(const std::shared_ptr<SkeletonOfLabel> & skeleton, const std::string & path, bool force)
{
  AwaitLeftBehind();
  RunInOwnThread(0, py::none(), py::none(), [=](const ProgressCallback & progress) {
    SaveSwc(*skeleton, path, force, progress);
    return true;
  });
}

/** What kind of results a file has, and they. */
py::tuple
ReadResultFile(const std::string & path)
{
  const ResultsRead read =
    RunInOwnThread(0, py::none(), py::none(), [=](const ProgressCallback &) { return ReadResults(path); });
  return read.skeletons.empty() ? py::make_tuple("core", read.cores) : py::make_tuple("skeleton", read.skeletons);
}

std::map<std::int64_t, std::string>
NamesOfFile(const std::string & path)
{
  return RunInOwnThread(0, py::none(), py::none(), [=](const ProgressCallback &) { return NamesOfLabels(path); });
}

/** A scan's values as they are stored, as an array [i, j, k] whose first index changes fastest, and its place. */
py::dict
ReadScanFile(const std::string & path)
{
  const auto rows = RunInOwnThread(0, py::none(), py::none(), [=](const ProgressCallback &) {
    const ReadOptions options;
    return std::make_shared<ScanRows>(path, options);
  });
  static const std::map<PixelType, const char *> types{ { PixelType::UInt8, "u1" },   { PixelType::Int8, "i1" },
                                                        { PixelType::UInt16, "u2" },  { PixelType::Int16, "i2" },
                                                        { PixelType::UInt32, "u4" },  { PixelType::Int32, "i4" },
                                                        { PixelType::UInt64, "u8" },  { PixelType::Int64, "i8" },
                                                        { PixelType::Float32, "f4" }, { PixelType::Float64, "f8" } };
  const ImageGeometry &                          geometry = rows->Geometry();
  const auto &                                   size = geometry.size;
  const auto                                     type = py::dtype(types.at(rows->Type()));
  py::array                                      array(type, std::vector<py::ssize_t>{ size[2], size[1], size[0] });
  auto * const                                   to = static_cast<std::byte *>(array.mutable_data());
  const std::size_t rowBytes = static_cast<std::size_t>(size[0]) * PixelBytes(rows->Type());
  RunInOwnThread(0, py::none(), array, [=](const ProgressCallback & progress) {
    const auto all = static_cast<std::uint64_t>(size[1]) * static_cast<std::uint64_t>(size[2]);
    rows->Read(0, all, [&](const std::byte * row, std::uint64_t number) {
      std::memcpy(to + number * rowBytes, row, rowBytes);
      if (number % 1024 == 0)
      {
        ReportProgress(progress, "read", static_cast<double>(number) / static_cast<double>(all));
      }
    });
    return true;
  });
  py::dict found;
  found["array"] = array.attr("T");
  found["spacing"] = geometry.unit == SpatialUnit::Voxels
                       ? py::object(py::none())
                       : py::object(py::make_tuple(geometry.spacing[0], geometry.spacing[1], geometry.spacing[2]));
  found["origin"] = py::make_tuple(geometry.origin[0], geometry.origin[1], geometry.origin[2]);
  found["direction"] = geometry.direction;
  return found;
}

/** Of trees at rising thresholds, none where no voxel reaches one: lives and whether they are stable, per tree, and the
 *  number of the threshold that keeps most of what is stable. */
py::tuple
LivesOfTrees(const std::vector<std::shared_ptr<SkeletonOfLabel>> & trees,
             const std::vector<double> &                           thresholds,
             double                                                persistence)
{
  TreesOfThresholds all{ thresholds, {} };
  for (const auto & tree : trees)
  {
    all.trees.push_back(tree != nullptr ? tree->part.graph : SkeletonGraph());
  }
  const auto lives = RunInOwnThread(0, py::none(), py::none(), [&](const ProgressCallback & progress) {
    std::vector<std::vector<BranchLife>> found;
    for (std::size_t i = 0; i < all.trees.size(); ++i)
    {
      found.push_back(LivesOf(all.trees[i], i, all, progress));
      RequireLives(all.trees[i], i, all, found.back(), "the array");
    }
    return found;
  });
  py::list   ranges;
  py::list   stable;
  for (const auto & ofTree : lives)
  {
    py::array_t<double> array({ static_cast<py::ssize_t>(ofTree.size()), py::ssize_t{ 2 } });
    for (std::size_t branch = 0; branch < ofTree.size(); ++branch)
    {
      array.mutable_at(static_cast<py::ssize_t>(branch), 0) = ofTree[branch].lowest;
      array.mutable_at(static_cast<py::ssize_t>(branch), 1) = ofTree[branch].highest;
    }
    ranges.append(array);
    const auto flags = StableOnes(ofTree, persistence);
    stable.append(
      py::array_t<std::uint8_t>(static_cast<py::ssize_t>(flags.size()), flags.data()).attr("astype")("bool"));
  }
  return py::make_tuple(ranges, stable, StablestThreshold(all, lives, persistence));
}

} // namespace

void
voxelcore::DefineCalls(py::module_ & module)
{
  module.def("cores", &CoresOfArray);
  module.def("prune", &PruneCore);
  module.def("measure", &MeasureSkeleton);
  module.def("verify", &VerifyCore);
  module.def("skeleton", &SkeletonOfCore);
  module.def("network", &NetworkOfArray);
  module.def("corrected", &CorrectedOfArray);
  module.def("save_core", &SaveCore);
  module.def("save_skeleton", &SaveSkeleton);
  module.def("save_swc", &SaveSwcFile);
  module.def("read_results", &ReadResultFile);
  module.def("read_scan", &ReadScanFile);
  module.def("label_names", &NamesOfFile);
  module.def("thickness", &ThicknessOfAnArray);
  module.def("sheets", &SheetsOfCore);
  module.def("compare", &CompareBoth);
  module.def("thresholds", &ParseThresholds);
  module.def("probability_scale", [](double least, double greatest, bool areWhole) {
    return ProbabilityScale(least, greatest, areWhole, "the array");
  });
  module.def("lives", &LivesOfTrees);
}
