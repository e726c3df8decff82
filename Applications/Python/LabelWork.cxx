#include "LabelWork.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Jobs/CoreJob.h"
#include "voxelcore/Jobs/LabelLoop.h"
#include "voxelcore/Jobs/NetworkLabels.h"
#include "voxelcore/Jobs/RefineStage.h"
#include "voxelcore/Jobs/SkeletonJob.h"
#include "voxelcore/Labels/GreyScan.h"
#include "voxelcore/Thickness/ThicknessCommand.h"
#include "voxelcore/Report/ResultRecords.h"

#include <functional>
#include <optional>
#include <utility>

namespace voxelcore
{
namespace
{

/** Who names no label expects one. */
void
RequireOneLabel(const std::vector<LabelShape> & labels)
{
  if (labels.size() == 1)
  {
    return;
  }
  std::string text;
  for (std::size_t i = 0; i < labels.size() && i < 10; ++i)
  {
    text += (i > 0 ? ", " : "") + std::to_string(labels[i].value);
  }
  throw InputError("the array: it holds " + std::to_string(labels.size()) + " labels (" + text +
                   (labels.size() > 10 ? ", ..." : "") +
                   "); choose with label=, take each by label='all', or all but 0 as one shape with label='any'");
}

/** A core for each part, with a report that names it alone, as a file's provenance does. */
std::vector<std::shared_ptr<CoreOfLabel>>
ResultsOf(const CoreReport & report, const std::vector<PrunedRecord> & pruned, std::vector<ModelPart> parts)
{
  std::vector<std::shared_ptr<CoreOfLabel>> results;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    auto result = std::make_shared<CoreOfLabel>();
    result->report = report;
    result->report.parameters.lambda = { pruned[i].lambda };
    if (pruned[i].tolerance)
    {
      result->report.parameters.tolerances = { pruned[i].tolerance->height };
    }
    result->report.labels.front().pruned = { pruned[i] };
    result->part = std::move(parts[i]);
    results.push_back(std::move(result));
  }
  return results;
}

/** \throws UsageError, in Python's words, when the core is pruned further than asked for, or in another way */
void
RequirePrunable(const CoreOfLabel & core, const PruneOptions & options)
{
  const LabelRecord &  record = core.report.labels.front();
  const PrunedRecord & done = record.pruned.front();
  const Vector3 &      spacing = core.report.input.geometry.spacing;
  if (!options.tolerances.empty())
  {
    if (!done.tolerance)
    {
      throw UsageError("this core does not hold tolerances; make it with tolerance=0");
    }
    for (const Tolerance & height : options.tolerances)
    {
      if (ToleranceInMillimetres(height, spacing) < done.tolerance->heightMm)
      {
        throw UsageError("this core is pruned at tolerance " + done.tolerance->height + " already, further than " +
                         height.text + "; make one with tolerance=0");
      }
    }
    return;
  }
  if (done.tolerance && done.tolerance->heightMm > 0)
  {
    throw UsageError("this core is pruned by tolerance " + done.tolerance->height +
                     " already; prune it further with tolerance=, or make one with lambda_=0");
  }
  if (!core.hasEdges)
  {
    throw UsageError("the file this core was read from lacks the measures of its edges; write it with keep_edges=True");
  }
  for (const Lambda & wanted : options.lambdas)
  {
    if (LambdaInMillimetres(wanted, core.report.parameters.weights, spacing, record.box) < done.lambdaMm)
    {
      throw UsageError("this core is pruned at " + done.lambda + " already, further than " + wanted.text +
                       "; make one with lambda_=0");
    }
  }
}

/** Writes the values of a shape's voxels into a volume, i fastest. */
void
SpreadOver(const std::array<std::int64_t, 3> & size,
           const VoxelShape &                  shape,
           const VoxelValues &                 values,
           std::vector<float> &                volume)
{
  const auto & box = shape.Box();
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const auto first = ((z + box.lower[2]) * size[1] + y + box.lower[1]) * size[0] + box.lower[0];
      WriteRow(shape, values, y, z, volume.data() + first);
    }
  }
}

constexpr double kEditEnds = 0.1; ///< of the progress

/** The array must outlive it. */
auto
GreyRowsOf(const ArrayView & array)
{
  return [array](std::int32_t i, std::int32_t j, std::int32_t k, std::span<float> values) {
    ReadRow(array, i, j, k, values);
  };
}

/** \throws InputError in Python's words for a grey scan */
std::vector<LabelShape>
LabelsOfArray(const ArrayView &        array,
              const ImageGeometry &    geometry,
              const ReadOptions &      reading,
              const ProgressCallback & progress)
{
  try
  {
    return LabelsOf(array, geometry, reading, progress);
  }
  catch (const GreyScanError & error)
  {
    const std::string range = ProposedRange(error.grey);
    throw InputError("the array: " + GreyScanText(error.grey) + "; choose a range, for example threshold=(" +
                     range.substr(0, range.find(':')) + ", numpy.inf), or give label= if its values are labels");
  }
}

/** What is read of an array. */
struct ReadArray
{
  CoreReport    report;
  EditedLabels  edited;
  SurfaceSource surface;

  std::optional<NetworkLabels> network; ///< where a network is asked for
};

ReadArray
Read(const ArrayView &        array,
     const ImageGeometry &    geometry,
     const CoreOptions &      options,
     const ParameterValues &  values,
     const ProgressCallback & progress)
{
  ReadArray    read;
  CoreReport & report = read.report;
  report.input.path = "the array";
  report.input.format = "array";
  report.input.geometry = CheckedGeometry("the array", geometry, options.reading.orthonormalize);

  if (options.refine.surface == "mesh")
  {
    throw UsageError("--refine mesh: expected labels or grey; for a mesh use the program");
  }
  if (options.refine.surface == "grey" && !options.reading.threshold)
  {
    throw UsageError("--refine grey: expected --threshold LO:HI, to say which grey values are the shape");
  }

  constexpr double readEnds = 0.05;
  InputScan        map;
  map.geometry = report.input.geometry;
  map.labels = LabelsOfArray(array, map.geometry, options.reading, PartOfProgress(progress, "reading", 0, readEnds));
  if (options.reading.crop)
  {
    map.crop = ResolveCrop(options.reading.crop, map.geometry.size, "the array");
  }
  if (options.refine.surface == "grey")
  {
    RequireFiniteValues(array, PartRead(map));
  }
  if (options.skeleton && options.skeleton->network)
  {
    std::vector<std::string> notes;
    read.network.emplace(map.labels, "the array", notes);
  }
  else if (!values.contains("labels"))
  {
    RequireOneLabel(map.labels);
  }
  read.edited = EditLabels(std::move(map.labels),
                           map.geometry,
                           options.edits,
                           options.reading.labels != "all",
                           "the array",
                           PartOfProgress(progress, "reading", readEnds, kEditEnds));
  if (read.network)
  {
    read.network->Fit(read.edited.labels.front(), map.geometry, PartRead(map), *options.skeleton);
  }
  map.greyRows = GreyRowsOf(array);
  read.surface = MakeSurfaceSource(options.refine, options.scan, options.reading, map);
  report.parameters = DescribeParameters(options, map, read.edited, ComputeLatticeWeights(map.geometry));
  return read;
}

} // namespace

MedialModel
ModelOf(const CoreOfLabel & core)
{
  MedialModel model;
  model.unit = core.report.input.geometry.unit;
  model.parts = { core.part };
  model.hasEdges = core.hasEdges;
  model.refined = core.refined;
  return model;
}

CompareSide
SideOfArray(const ArrayView &        array,
            const ImageGeometry &    geometry,
            const CompareOptions &   options,
            const ProgressCallback & progress)
{
  LabelMap map;
  map.geometry = CheckedGeometry("the array", geometry, options.making.reading.orthonormalize);
  map.labels = LabelsOfArray(array, map.geometry, options.making.reading, progress);
  return { "the array", std::move(map) };
}

std::vector<std::shared_ptr<CoreOfLabel>>
MakeCores(const ArrayView &        array,
          const ImageGeometry &    geometry,
          const ParameterValues &  values,
          const ProgressCallback & progress)
{
  CoreOptions options = CoreOptionsWithoutFiles(values);
  options.scan = "the array";
  ReadArray             read = Read(array, geometry, options, values, progress);
  CoreReport &          report = read.report;
  EditedLabels &        edited = read.edited;
  const ImageGeometry & place = report.input.geometry;

  std::vector<std::shared_ptr<const PackedShape>> shapes;
  for (const EditedLabel & one : edited.labels)
  {
    shapes.push_back(std::make_shared<const PackedShape>(Pack(one.label.shape)));
  }
  std::vector<std::shared_ptr<CoreOfLabel>> results;
  std::size_t                               next = 0;
  StageSeconds                              seconds;
  const auto                                take = [&](LabelOutcome outcome) {
    const std::vector<PrunedRecord> pruned = std::move(outcome.record.pruned);
    report.parameters.labels = { outcome.record.label };
    report.labels = { std::move(outcome.record) };
    for (auto & result : ResultsOf(report, pruned, std::move(outcome.parts)))
    {
      result->refined = options.refine.surface;
      result->shape = shapes[next];
      results.push_back(std::move(result));
    }
    ++next;
  };
  ProcessLabels(edited.labels, options, place, read.surface, {}, PartOfProgress(progress, kEditEnds, 1), take, seconds);
  return results;
}

std::shared_ptr<ThicknessOfArray>
MakeThickness(const ArrayView &        array,
              const ImageGeometry &    geometry,
              const ParameterValues &  values,
              const ProgressCallback & progress)
{
  ThicknessOptions options = ThicknessOptionsWithoutFiles(values);
  options.core.scan = "the array";
  ReadArray             read = Read(array, geometry, options.core, values, progress);
  const ImageGeometry & place = read.report.input.geometry;
  if (options.separation != SeparationRegion::None)
  {
    throw UsageError("--separation: use the program, or give the background as an array");
  }
  auto result = std::make_shared<ThicknessOfArray>();
  result->size = place.size;
  const std::size_t count = static_cast<std::size_t>(place.size[0]) * static_cast<std::size_t>(place.size[1]) *
                            static_cast<std::size_t>(place.size[2]);
  result->map.assign(count, 0.0F);
  result->lower.assign(options.bounds ? count : 0, 0.0F);
  result->upper.assign(options.bounds ? count : 0, 0.0F);
  const VoxelBox whole{ { 0, 0, 0 },
                        { static_cast<std::int32_t>(place.size[0]),
                          static_cast<std::int32_t>(place.size[1]),
                          static_cast<std::int32_t>(place.size[2]) } };
  const auto     labels = static_cast<double>(read.edited.labels.size());
  for (std::size_t i = 0; i < read.edited.labels.size(); ++i)
  {
    const auto share = [&](std::size_t done) {
      return kEditEnds + (1 - kEditEnds) * static_cast<double>(done) / labels;
    };
    CertifiedRequest request = RequestOf(options.core, read.surface);
    request.refineCores = static_cast<bool>(read.surface);
    request.thickness = ThicknessRequest{ options.bounds };
    LabelOutcome    outcome = ProcessLabel(std::move(read.edited.labels[i]),
                                        place,
                                        std::move(request),
                                        PartOfProgress(progress, share(i), share(i + 1)));
    const auto &    found = *outcome.thickness;
    ThicknessRecord record;
    record.label = outcome.record.label;
    record.component = outcome.record.component;
    record.name = outcome.record.name;
    Summarize(found, place, BallsAtSides(found.balls, place, whole), options.border, record);
    result->records.push_back(std::move(record));
    SpreadOver(place.size, found.shape, found.map, result->map);
    if (options.bounds)
    {
      SpreadOver(place.size, found.shape, found.bracket.lower, result->lower);
      SpreadOver(place.size, found.shape, found.bracket.upper, result->upper);
    }
  }
  return result;
}

std::vector<std::shared_ptr<CoreOfLabel>>
Prune(const CoreOfLabel & core, const ParameterValues & values, const ProgressCallback & progress)
{
  const PruneOptions options = PruneOptionsWithoutFiles(values);
  RequirePrunable(core, options);
  CertifiedRequest lengths;
  lengths.lambdas = options.lambdas;
  lengths.tolerances = options.tolerances;
  RequireLengthsIn(core.report.input.geometry.unit, lengths);
  const LabelRecord &        record = core.report.labels.front();
  const CertifiedShape       shape = RecordedShape(core.report, record);
  const CertifiedCore        before{ record.pruned.front(), core.part };
  std::vector<CertifiedCore> pruned = options.tolerances.empty()
                                        ? PruneCertified(before, shape, options.lambdas, progress)
                                        : PruneCertified(before, shape, options.tolerances);
  CoreReport                 report = core.report;
  NoteRefinedAt(report.parameters);
  report.parameters.tolerances.clear();
  report.labels.front().covered.reset(); // there is no boundary here to measure it on
  std::vector<PrunedRecord> records;
  std::vector<ModelPart>    parts;
  for (CertifiedCore & one : pruned)
  {
    records.push_back({ std::move(one.numbers) });
    parts.push_back(std::move(one.core));
  }
  auto results = ResultsOf(report, records, std::move(parts));
  for (const auto & result : results)
  {
    result->hasEdges = core.hasEdges;
    result->refined = core.refined;
    result->shape = core.shape;
  }
  return results;
}

namespace
{

/** What was taken of the array that a report is of. */
VoxelBox
ReadBox(const CoreReport & report)
{
  LabelMap map;
  map.geometry = report.input.geometry;
  map.crop = report.parameters.reading.crop;
  return PartRead(map);
}

} // namespace

std::shared_ptr<SkeletonOfLabel>
MakeSkeletonOf(std::shared_ptr<const CoreOfLabel> core,
               const ParameterValues &            values,
               bool                               ofArray,
               const ProgressCallback &           progress)
{
  auto result = std::make_shared<SkeletonOfLabel>();
  result->report = core->report;
  SkeletonRequest stage = SkeletonRequestFrom(values);
  stage.refined = !core->refined.empty();
  stage.lambda = ParseLambda(core->report.parameters.lambda.front());
  if (!core->report.parameters.tolerances.empty())
  {
    const Tolerance height = ParseTolerance(core->report.parameters.tolerances.front());
    stage.tolerance = height.value > 0 ? std::optional(height) : std::nullopt;
  }
  LabelRecord &             record = result->report.labels.front();
  const CertifiedShape      shape = RecordedShape(core->report, record);
  std::optional<VoxelShape> voxels;
  if (core->shape != nullptr)
  {
    voxels = Unpack(*core->shape);
  }
  const bool isOfVoxels = ofArray && voxels && (core->refined.empty() || core->refined == "labels");
  if (!isOfVoxels)
  {
    stage.border = BorderEnds::Closed;
  }
  const VoxelBox border = ReadBox(core->report);
  const bool     isCut = isOfVoxels && GoesBeyondBorder(*voxels, border, shape.geometry.spacing, stage.border);
  if (isOfVoxels && (isCut || (stage.tolerance && core->refined.empty())))
  {
    CertifiedRequest request;
    request.surface = core->refined.empty() ? SurfaceSource() : SurfacesFromLabels(shape.geometry.spacing);
    request.refineCores = false;
    request.name = shape.name;
    request.lambdas = { stage.lambda };
    if (stage.tolerance)
    {
      request.tolerances = { *stage.tolerance };
    }
    request.skeleton = stage;
    request.scan = border;
    request.spendsCores = isCut;
    CertifiedResult made = ComputeCertified(std::move(*voxels), shape.geometry, request, progress);
    if (isCut)
    {
      // As in a file of the program: the core that was burned is that of the body beyond the border.
      record.boundaryVertices = made.boundaryVertices;
      record.core = made.whole;
      record.pruned.front() = { made.cores.front().numbers };
    }
    result->part = TakeSkeleton(std::move(*made.skeleton), record);
  }
  else
  {
    result->part = TakeSkeleton(SkeletonOf(core->part, shape, stage, progress, voxels ? &*voxels : nullptr), record);
  }
  result->report.skeleton = std::move(stage);
  result->surface = std::move(core);
  return result;
}

namespace
{

/** By which the skeleton of an array is made as the program makes it of a scan. */
CoreOptions
OptionsOfSkeleton(const ParameterValues & coreValues, const ParameterValues & skeletonValues, bool network)
{
  CoreOptions options = CoreOptionsWithoutFiles(coreValues);
  options.scan = "the array";
  if (options.lambdas.size() != 1 || options.tolerances.size() > 1)
  {
    throw UsageError("lambda_, tolerance: give one; a skeleton has one core");
  }
  SkeletonRequest stage = SkeletonRequestFrom(skeletonValues);
  stage.network = network;
  stage.refined = !options.refine.surface.empty();
  stage.lambda = options.lambdas.front();
  if (!options.tolerances.empty() && options.tolerances.front().value > 0)
  {
    stage.tolerance = options.tolerances.front();
  }
  options.skeleton = stage;
  options.skeletonTargets.also = { "ma" }; // a skeleton here knows its core
  return options;
}

/** The skeleton of the only label of what was read; `look` sees it first. */
std::shared_ptr<SkeletonOfLabel>
SkeletonOfRead(ReadArray &                                 read,
               const CoreOptions &                         options,
               const std::function<void(LabelOutcome &)> & look,
               const ProgressCallback &                    progress)
{
  auto         result = std::make_shared<SkeletonOfLabel>();
  StageSeconds seconds;
  const auto   shape = std::make_shared<const PackedShape>(Pack(read.edited.labels.front().label.shape));
  const auto   take = [&](LabelOutcome outcome) {
    look(outcome);
    CoreReport report = read.report;
    report.labels = { outcome.record };
    report.labels.front().skeleton.reset();
    auto surface = ResultsOf(report, outcome.record.pruned, std::move(outcome.parts)).front();
    surface->refined = options.refine.surface;
    surface->shape = shape;
    result->part = std::move(*outcome.skeleton);
    result->surface = std::move(surface);
    result->report = std::move(report);
    result->report.labels = { std::move(outcome.record) };
    result->report.skeleton = options.skeleton;
  };
  const ImageGeometry & place = read.report.input.geometry;
  ProcessLabels(read.edited.labels, options, place, read.surface, ReadBox(read.report), progress, take, seconds);
  return result;
}

} // namespace

std::shared_ptr<SkeletonOfLabel>
MakeNetworkOf(const ArrayView &        array,
              const ImageGeometry &    geometry,
              const ParameterValues &  coreValues,
              const ParameterValues &  skeletonValues,
              const ProgressCallback & progress)
{
  const CoreOptions options = OptionsOfSkeleton(coreValues, skeletonValues, true);
  ReadArray         read = Read(array, geometry, options, coreValues, progress);
  const auto        look = [&](LabelOutcome & outcome) {
    std::vector<std::string> notes;
    read.network->Take(outcome, *options.skeleton, read.report, notes);
  };
  return SkeletonOfRead(read, options, look, PartOfProgress(progress, kEditEnds, 1));
}

std::shared_ptr<SkeletonOfLabel>
MakeCorrectedOf(const ArrayView &        array,
                const ImageGeometry &    geometry,
                const ParameterValues &  coreValues,
                const ParameterValues &  skeletonValues,
                std::vector<Said>        said,
                const ProgressCallback & progress)
{
  CoreOptions options = OptionsOfSkeleton(coreValues, skeletonValues, false);
  ReadArray   read = Read(array, geometry, options, coreValues, progress);
  if (read.edited.labels.size() != 1)
  {
    throw UsageError("edits: are of one body; choose with label=, and leave split_components out");
  }
  EditedLabel &         label = read.edited.labels.front();
  const ImageGeometry & place = read.report.input.geometry;
  std::erase_if(said, [&](const Said & one) {
    return one.annotation.label.value_or(label.label.value) != label.label.value;
  });
  CertifiedRequest request = RequestOf(options, read.surface);
  request.skeleton->branches.cutLoops = false; // edits name places on them, too
  request.scan = ReadBox(read.report);
  constexpr double      editsEnd = 0.5; // of the progress
  const LabelOutcome    found = ProcessLabel(label, place, request, PartOfProgress(progress, kEditEnds, editsEnd));
  const auto            rows = RowsOf(found.skeleton->graph, said);
  const VoxelShape      before = label.label.shape;
  std::vector<TreeEdit> edits;
  for (const Said & one : said)
  {
    edits.push_back(one.edit);
  }
  EditedTree edited = EditBody(label, place, *found.skeleton, edits, options);
  read.report.parameters.edits.change = options.edits.change;
  const auto look = [&](LabelOutcome & outcome) {
    RequireEdits(before, found.record.shape, edits, edited, outcome.record.skeleton->topology, "the array");
    NameBranches(said, rows, place, *outcome.skeleton, edited);
  };
  auto result = SkeletonOfRead(read, options, look, PartOfProgress(progress, editsEnd, 1));
  for (std::size_t i = 0; i < said.size(); ++i)
  {
    result->edits.push_back(
      { edits[i].place, TreeEditText(edits[i]), said[i].annotation.name, edited.outcomes[i].misfit });
  }
  return result;
}

std::shared_ptr<SkeletonOfLabel>
Remeasure(const SkeletonOfLabel & skeleton, const ParameterValues & values)
{
  auto                      result = std::make_shared<SkeletonOfLabel>(skeleton);
  std::vector<SkeletonPart> parts{ std::move(result->part) };
  MeasureAgain(parts, MeasureBranchesFrom(values), result->report, "the skeleton");
  result->part = std::move(parts.front());
  return result;
}

VerifyResult
Verify(const CoreOfLabel &      core,
       const ArrayView &        array,
       const ImageGeometry &    geometry,
       const ProgressCallback & progress)
{
  if (core.refined == "mesh" || core.report.parameters.refine.greyRange)
  {
    throw UsageError("the core is refined to a surface that the array does not hold (" + core.refined +
                     "); verify its file with the program");
  }
  const VerifyOptions names{ "the array", "the core" };
  const ReadOptions   reading = RecordedReading(core.report.parameters);
  CoreReport          made = core.report;
  if (made.version.empty())
  {
    made.version = VoxelCoreVersion(); // files are told it when they are written
  }
  InputScan volume;
  volume.geometry = CheckedGeometry(names.scan.string(), geometry, reading.orthonormalize);
  volume.labels = LabelsOf(array, volume.geometry, reading, PartOfProgress(progress, "reading", 0, 0.05));
  volume.greyRows = GreyRowsOf(array);
  if (reading.crop)
  {
    volume.crop = ResolveCrop(reading.crop, volume.geometry.size, names.scan.string());
  }
  return VerifyModel(ModelOf(core), made, std::move(volume), names, progress);
}

} // namespace voxelcore
