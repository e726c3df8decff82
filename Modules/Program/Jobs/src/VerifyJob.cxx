#include "voxelcore/Jobs/VerifyJob.h"

#include "voxelcore/Jobs/JobTools.h"
#include "MadeAgain.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/LengthUnit.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Models/SkeletonModel.h"
#include "voxelcore/Report/Sha256.h"
#include "voxelcore/Shape/BodyFrame.h"
#include "voxelcore/Shape/BoundaryVertices.h"
#include "voxelcore/Verification/RefinedVerification.h"

#include <algorithm>
#include <utility>

namespace voxelcore
{

namespace
{

VerificationReport
VerifyPart(ModelPart                part,
           const VoxelShape &       shape,
           const ImageGeometry &    geometry,
           const SpacingWeights &   weights,
           const PrunedRecord &     pruned,
           bool                     prunedOn,
           const ProgressCallback & progress)
{
  const bool           refined = !part.displacement.empty();
  std::vector<Vector3> origins = part.core.positions;
  for (std::size_t v = 0; v < origins.size() && refined; ++v)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      origins[v][k] -= part.displacement[v][k];
    }
  }
  for (auto & position : part.core.positions)
  {
    position = PhysicalToLattice(geometry, position);
  }
  if (refined)
  {
    for (std::size_t v = 0; v < origins.size(); ++v)
    {
      const Vector3 from = PhysicalToLattice(geometry, origins[v]);
      for (std::size_t k = 0; k < 3; ++k)
      {
        part.displacement[v][k] = part.core.positions[v][k] - from[k];
      }
    }
    RefinedVerificationInput moved;
    moved.shape = &shape;
    moved.weights = weights;
    moved.spacing = geometry.spacing;
    moved.cells = &part.core.cells;
    moved.positions = part.core.positions;
    moved.displacement = part.displacement;
    moved.radius = part.core.radius;
    moved.vertexLambda = part.core.vertexLambda;
    moved.edgeLambda = part.core.edgeLambda;
    moved.faceLambda = part.core.faceLambda;
    moved.positionTolerance = PositionTolerance(geometry);
    if (pruned.tolerance)
    {
      moved.threshold = pruned.lambdaMm;
      moved.pruningTolerance = pruned.tolerance->heightMm;
      moved.prunedOn = prunedOn;
      moved.vertexTolerance = part.core.tolerances.vertices;
      moved.edgeTolerance = part.core.tolerances.edges;
      moved.faceTolerance = part.core.tolerances.faces;
    }
    return VerifyRefinedCore(moved, progress);
  }
  VerificationInput input;
  input.shape = &shape;
  input.weights = weights;
  input.spacing = geometry.spacing;
  input.cells = &part.core.cells;
  input.positions = part.core.positions;
  input.radius = part.core.radius;
  input.vertexLambda = part.core.vertexLambda;
  input.edgeLambda = part.core.edgeLambda;
  input.faceLambda = part.core.faceLambda;
  input.positionTolerance = PositionTolerance(geometry);
  input.polygonsReversed = IsLeftHanded(geometry);
  input.threshold = pruned.lambdaMm;
  if (pruned.tolerance)
  {
    input.pruningTolerance = pruned.tolerance->heightMm;
    input.vertexTolerance = part.core.tolerances.vertices;
    input.edgeTolerance = part.core.tolerances.edges;
    input.faceTolerance = part.core.tolerances.faces;
  }
  return VerifyComplex(input, progress);
}

/** How a label's cells are pruned. */
const PrunedRecord &
RecordedPruning(const CoreReport & made, std::size_t label, const std::string & where)
{
  RequireFittingProvenance(label < made.labels.size() && made.labels[label].pruned.size() == 1, where);
  return made.labels[label].pruned.front();
}

/** What is in the file, as where it was made (BodyFrame.h) or, as versions up to 0.1 did, as where it lies. */
ComplexRecord
DescribeAgain(MedialComplex &       core,
              const ImageGeometry & geometry,
              const VoxelBox &      body,
              const ComplexRecord & recorded)
{
  std::vector<Vector3> placed = core.positions;
  BodyFrame(geometry, body).Enter(core.positions);
  const ComplexRecord there = DescribeComplex(core, {});
  core.positions.swap(placed);
  return there.areaMm2 == recorded.areaMm2 ? there : DescribeComplex(core, {});
}

/** A property of the file as a whole. `cells` describes what is in the file. */
VerificationCheck
CheckProvenance(const LabelRecord &        recorded,
                const LabelShape &         label,
                std::int64_t               component,
                const ComplexRecord &      cells,
                bool                       triangles,
                const Vector3 &            spacing,
                const VerificationReport & report)
{
  const ComplexRecord & complex = recorded.pruned.front().complex;
  const VoxelBox        box = label.shape.Box();
  // Of polygons that were cut into triangles the numbers are still those of the polygons.
  const bool   sameCells = triangles || (complex.vertices == cells.vertices && complex.edges == cells.edges &&
                                       complex.faces == cells.faces && complex.areaMm2 == cells.areaMm2);
  const double volume = static_cast<double>(label.voxels) * (spacing[0] * spacing[1] * spacing[2]);
  if (recorded.label != label.value || recorded.component != component || recorded.voxels != label.voxels ||
      recorded.volumeMm3 != volume || recorded.box.lower != box.lower || recorded.box.size != box.size ||
      recorded.boundaryVertices != BoundaryVertices(label.shape).size() || !(recorded.shape == report.shapeTopology) ||
      !(complex.topology == report.complexTopology) || complex.maxRadiusMm != cells.maxRadiusMm || !sameCells)
  {
    return { "provenance", false, 1, "the record in the file does not fit the scan and the cells" };
  }
  return { "provenance", true, 0, {} };
}

/** How far the boundary lies from a core pruned by tolerance; empty for others. */
std::string
GapText(const LabelVerification & label, SpatialUnit lengths)
{
  if (!label.report.boundaryGap)
  {
    return {};
  }
  const LengthUnit  unit = LengthUnit::For(std::max(*label.report.boundaryGap, label.toleranceMm), lengths);
  const auto        length = [&unit](double mm) { return ShortText(unit.Of(mm), 4) + " " + unit.Name(); };
  const auto        share = label.report.boundaryGapShare;
  const std::string ofTolerance = share ? ", " + ShortText(100 * *share, 3) + " % of what is allowed there" : "";
  return "; boundary within " + length(*label.report.boundaryGap) + " of it" + ofTolerance + " (tolerance " +
         label.pruningTolerance + ", " + length(label.toleranceMm) + ")";
}

} // namespace

VerifyResult
VerifyModel(MedialModel              model,
            const CoreReport &       made,
            InputScan                volume,
            const VerifyOptions &    names,
            const ProgressCallback & progress)
{
  RequireSameUnit(names.core, made.input.geometry.unit, names.scan, volume.geometry.unit);
  RequireSameUnit(names.core, model.unit, names.scan, volume.geometry.unit);
  const SpacingWeights weights = ScanWeights(volume.geometry, names.scan);
  EditedLabels         edited = EditLabels(std::move(volume.labels),
                                   volume.geometry,
                                   made.parameters.edits,
                                   !made.parameters.reading.binary && !made.parameters.reading.threshold,
                                   names.scan.string(),
                                   PartOfProgress(progress, 0.05, 0.1));
  if (made.parameters.refine.surface != model.refined)
  {
    throw InputError(names.core.string() + ": its fields Refined and Provenance do not agree; make the file again");
  }
  VerifyResult result;
  result.warnings = volume.warnings;
  result.unit = volume.geometry.unit;
  const MadeAgain madeAgain(made, volume, names.scan, result.notes);
  for (std::size_t i = 0; i < model.parts.size(); ++i)
  {
    const std::int64_t value = model.parts[i].label;
    const std::int64_t component = model.parts[i].component;
    const auto         place = std::find_if(edited.labels.begin(), edited.labels.end(), [&](const EditedLabel & one) {
      return one.label.value == value && one.component == component;
    });
    if (place == edited.labels.end())
    {
      throw InputError(names.scan.string() + ": label " + std::to_string(value) +
                       (component > 0 ? ", component " + std::to_string(component) + "," : std::string()) + " of " +
                       names.core.string() + " does not occur in this scan; give the scan it was made from");
    }
    LabelShape * const found = &place->label;
    const double       from = 0.1 + 0.9 * static_cast<double>(i) / static_cast<double>(model.parts.size());
    const double       to = 0.1 + 0.9 * static_cast<double>(i + 1) / static_cast<double>(model.parts.size());
    LabelVerification  one;
    one.label = value;
    one.name = found->name;
    const PrunedRecord & pruned = RecordedPruning(made, i, names.core.string());
    one.lambdaMm = pruned.lambdaMm;
    if (pruned.tolerance)
    {
      one.pruningTolerance = pruned.tolerance->height;
      one.toleranceMm = pruned.tolerance->heightMm;
    }
    const ComplexRecord cells = DescribeAgain(model.parts[i].core, volume.geometry, found->shape.Box(), pruned.complex);
    const auto          again = madeAgain.Check(model.parts[i],
                                       *found,
                                       pruned,
                                       NamedPartOfProgress(progress, found->name, from, 0.5 * (from + to)));
    one.report = VerifyPart(std::move(model.parts[i]),
                            found->shape,
                            volume.geometry,
                            weights,
                            pruned,
                            made.parameters.refine.at.has_value(),
                            NamedPartOfProgress(progress, found->name, again ? 0.5 * (from + to) : from, to));
    one.report.checks.push_back(CheckProvenance(made.labels[i],
                                                *found,
                                                component,
                                                cells,
                                                made.parameters.model.triangles,
                                                volume.geometry.spacing,
                                                one.report));
    if (again)
    {
      one.report.checks.push_back(*again);
    }
    one.report.passed =
      std::all_of(one.report.checks.begin(), one.report.checks.end(), [](const auto & check) { return check.passed; });
    result.passed = result.passed && one.report.passed;
    result.labels.push_back(std::move(one));
    *found = LabelShape(); // its memory is not needed any longer
    found->value = value;
  }
  // A label that the record names and the file lacks would otherwise go unnoticed.
  if (made.labels.size() != model.parts.size())
  {
    throw InputError(names.core.string() + ": its field Provenance names " + std::to_string(made.labels.size()) +
                     " labels, its cells have " + std::to_string(model.parts.size()) + "; make the file again");
  }
  ReportProgress(progress, "done", 1);
  return result;
}

namespace
{

/** The medial surface; of a skeleton it is said where that is checked. */
MedialModel
ReadSurface(const std::filesystem::path & path)
{
  try
  {
    return ReadModel(path);
  }
  catch (const InputError &)
  {
    if (!ReadSkeletonIfAny(path))
    {
      throw;
    }
  }
  throw InputError(path.string() +
                   ": it is a skeleton, which is checked in the run that makes it, against the voxels: see " +
                   "'certificate' in the report of 'voxelcore skeleton --report'; here give a medial surface of " +
                   "'voxelcore core'");
}

} // namespace

VerifyResult
RunVerifyJob(const VerifyOptions & options, const JobContext & given)
{
  const JobContext context = ForwardOnly(given);
  ReportProgress(context.progress, "reading", 0);
  MedialModel              model = ReadSurface(options.core);
  const bool               vtkReads = RequireVtkReads(options.core, model);
  CoreReport               made = ParseProvenance(model.provenance, options.core.string());
  std::vector<std::string> notes;
  InputScan                volume =
    ReadScanAgain(options.scan, made.parameters, notes, PartOfProgress(context.progress, "reading", 0, 0.05));
  if (!vtkReads)
  {
    notes.push_back(options.core.string() +
                    ": not opened with VTK's reader: another program saved the file, or this build has no VTK");
  }
  if (made.input.sha256.empty())
  {
    notes.push_back(options.core.string() + ": was made from an image in memory, so it names no scan file");
  }
  else if (ScanSha256(options.scan, RecordedReading(made.parameters)) != made.input.sha256)
  {
    notes.push_back(options.scan.string() + ": not the very file that " + options.core.string() +
                    " was made from (another SHA-256); checked all the same");
  }
  VerifyResult result = VerifyModel(std::move(model), made, std::move(volume), options, context.progress);
  result.notes.insert(result.notes.begin(), notes.begin(), notes.end());
  return result;
}

std::string
VerifyText(const VerifyResult & result)
{
  std::string text;
  for (const std::string & note : result.notes)
  {
    text += "note: " + note + "\n";
  }
  for (const LabelVerification & label : result.labels)
  {
    const auto & checks = label.report.checks;
    const auto   failed = std::count_if(checks.begin(), checks.end(), [](const auto & check) { return !check.passed; });
    text += LabelText(label.label, label.name) + ": " + std::to_string(checks.size()) + " checks, " +
            (failed == 0 ? std::string("all passed") : std::to_string(failed) + " FAILED") +
            GapText(label, result.unit) + "\n";
    for (const VerificationCheck & check : checks)
    {
      if (!check.passed)
      {
        text += "  FAILED  " + check.name + ": " + InUnit(check.firstOffender, result.unit) +
                (check.offenders > 1 ? " (and " + std::to_string(check.offenders - 1) + " more)" : "") + "\n";
      }
      else if (result.labels.size() == 1)
      {
        text += "  passed  " + check.name + "\n";
      }
    }
  }
  return text;
}

} // namespace voxelcore
