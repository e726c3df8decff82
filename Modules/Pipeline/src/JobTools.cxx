#include "JobTools.h"

#include "voxelcore/BallCoverage.h"
#include "voxelcore/ComplexTopology.h"
#include "voxelcore/Error.h"
#include "voxelcore/ReportTable.h"
#include "voxelcore/Verification.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace voxelcore
{

void
Finish(OutputTransaction & transaction, const JobContext & context)
{
  ReportProgress(context.progress, "done", 1);
  transaction.Commit();
  if (context.wrote)
  {
    context.wrote(transaction.Written());
  }
}

ProgressCallback
NamedPartOfProgress(const ProgressCallback & outer, std::string name, double from, double to)
{
  if (!outer)
  {
    return {};
  }
  return [outer, name = std::move(name), from, to](std::string_view stage, double fraction) {
    return outer(name + ": " + std::string(stage), from + (to - from) * std::clamp(fraction, 0.0, 1.0));
  };
}

std::string
LabelText(std::int64_t value, const std::string & name)
{
  return "label " + std::to_string(value) + " (" + name + ")";
}

void
RequireEqualTopology(const TopologyNumbers & shape,
                     const TopologyNumbers & complex,
                     const std::string &     what,
                     const std::string &     labelText)
{
  if (!(shape == complex))
  {
    throw CertificateError(labelText + ": certificate failed: the shape has chi/b0/b1/b2 " + TopologyText(shape) +
                           ", " + what + " has " + TopologyText(complex) +
                           "; nothing was written; this is a fault of VoxelCore, please report it with the scan");
  }
}

std::vector<double>
AscendingBeyond(double doneMm, std::vector<double> thresholdsMm)
{
  std::sort(thresholdsMm.begin(), thresholdsMm.end());
  thresholdsMm.erase(std::unique(thresholdsMm.begin(), thresholdsMm.end()), thresholdsMm.end());
  std::erase_if(thresholdsMm, [doneMm](double threshold) { return threshold <= doneMm; });
  return thresholdsMm;
}

std::vector<MedialComplex>
PruneAscending(const MedialComplex &       whole,
               double                      doneMm,
               const std::vector<double> & thresholdsMm,
               const ProgressCallback &    progress)
{
  const std::vector<double> ascending = AscendingBeyond(doneMm, thresholdsMm);
  return ascending.empty() ? std::vector<MedialComplex>() : PruneByLambda(whole, ascending, progress);
}

std::vector<PrunedCore>
CertifyPruned(ModelPart                   whole,
              std::vector<MedialComplex>  complexes,
              const ComplexRecord &       wholeRecord,
              double                      doneMm,
              const std::vector<Lambda> & lambdas,
              const std::vector<double> & thresholdsMm,
              const TopologyNumbers &     shape,
              const std::string &         labelText,
              const ProgressCallback &    progress)
{
  const std::vector<double> ascending = AscendingBeyond(doneMm, thresholdsMm);
  std::vector<PrunedCore>   results(lambdas.size());
  for (std::size_t i = 0; i < lambdas.size(); ++i)
  {
    ReportProgress(progress, "certificate", static_cast<double>(i) / static_cast<double>(lambdas.size()));
    const double threshold = thresholdsMm[i];
    const auto   place = std::lower_bound(ascending.begin(), ascending.end(), threshold) - ascending.begin();
    const bool   unchanged = threshold <= doneMm;
    auto &       source = unchanged ? whole.core : complexes[static_cast<std::size_t>(place)];
    // Two lambdas may come to the same threshold; the last one takes the complex, the others a copy.
    const bool neededAgain =
      std::any_of(thresholdsMm.begin() + static_cast<std::ptrdiff_t>(i) + 1, thresholdsMm.end(), [&](double later) {
        return later == threshold || (unchanged && later <= doneMm);
      });
    PrunedCore & result = results[i];
    result.part.label = whole.label;
    result.part.component = whole.component;
    result.part.core = neededAgain ? source : std::move(source);
    const TopologyNumbers topology = unchanged ? wholeRecord.topology : ComputeComplexTopology(result.part.core.cells);
    RequireEqualTopology(shape, topology, "its core pruned at " + lambdas[i].text, labelText);
    result.record.lambda = lambdas[i].text;
    result.record.lambdaMm = threshold;
    result.record.complex = unchanged ? wholeRecord : DescribeComplex(result.part.core, topology);
  }
  return results;
}

std::vector<PrunedCore>
PruneAndCertify(ModelPart                   whole,
                const ComplexRecord &       wholeRecord,
                double                      doneMm,
                const std::vector<Lambda> & lambdas,
                const std::vector<double> & thresholdsMm,
                const TopologyNumbers &     shape,
                const std::string &         labelText,
                const ProgressCallback &    progress)
{
  StagePlan plan(progress, { 0.8, 0.2 });
  auto      complexes = PruneAscending(whole.core, doneMm, thresholdsMm, plan.Next("prune"));
  return CertifyPruned(std::move(whole),
                       std::move(complexes),
                       wholeRecord,
                       doneMm,
                       lambdas,
                       thresholdsMm,
                       shape,
                       labelText,
                       plan.Next("certificate"));
}

SpacingWeights
ScanWeights(const ImageGeometry & geometry, const std::filesystem::path & scan)
{
  SpacingWeights weights;
  std::string    hint = " with --spacing X,Y,Z";
  try
  {
    weights = ComputeSpacingWeights(geometry.spacing);
    hint.clear();
    RequireDistinctPositions(geometry);
  }
  catch (const InputError & error)
  {
    throw InputError(scan.string() + ": " + error.what() + hint);
  }
  return weights;
}

double
ScanDiagonal(const ImageGeometry & geometry)
{
  double squared = 0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double side = static_cast<double>(geometry.size[k]) * geometry.spacing[k];
    squared += side * side;
  }
  return std::sqrt(squared);
}

void
EndBumps(BumpValues & bumps, const ImageGeometry & geometry)
{
  const double end = ScanDiagonal(geometry);
  for (auto * values : { &bumps.vertices, &bumps.edges, &bumps.faces })
  {
    for (double & value : *values)
    {
      value = std::min(value, end);
    }
  }
}

std::vector<PrunedCore>
PruneByBumpsAndCertify(const ModelPart &               whole,
                       const PrunedRecord &            floor,
                       const std::vector<BumpHeight> & heights,
                       const ImageGeometry &           geometry,
                       const TopologyNumbers &         shape,
                       const std::string &             labelText)
{
  std::vector<PrunedCore> results(heights.size());
  for (std::size_t i = 0; i < heights.size(); ++i)
  {
    const double height = std::min(BumpHeightInMillimetres(heights[i], geometry.spacing), ScanDiagonal(geometry));
    PrunedCore & result = results[i];
    result.part = { whole.label, PruneByBumps(whole.core, height), whole.component };
    const TopologyNumbers topology = ComputeComplexTopology(result.part.core.cells);
    RequireEqualTopology(shape, topology, "its core pruned at bump height " + heights[i].text, labelText);
    result.record = floor;
    result.record.bumps = { heights[i].text, height, {} };
    result.record.complex = DescribeComplex(result.part.core, topology);
  }
  return results;
}

double
MeasureBoundaryGap(const ModelPart &      part,
                   const VoxelShape &     shape,
                   const ImageGeometry &  geometry,
                   const SpacingWeights & weights)
{
  std::vector<std::array<double, 3>> positions = part.core.positions;
  for (auto & position : positions)
  {
    position = PhysicalToLattice(geometry, position);
  }
  return LargestBoundaryGap(shape, weights, positions, part.core.radius).largest;
}

double
BoundaryGapTolerance(const ImageGeometry & geometry)
{
  return 4 * PositionTolerance(geometry) * *std::max_element(geometry.spacing.begin(), geometry.spacing.end());
}

void
WriteStagedModel(OutputTransaction &           transaction,
                 const std::filesystem::path & target,
                 const MedialModel &           model,
                 const ModelOptions &          options,
                 std::vector<std::string> &    notes)
{
  const ModelOmissions omitted = WriteModel(transaction.Stage(target), target, model, options);
  std::string          text;
  const auto           add = [&text](std::uint64_t count, const std::string & what) {
    if (count > 0)
    {
      text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what;
    }
  };
  add(omitted.vertices, "isolated vertices left out");
  add(omitted.edges, "edges on no face left out");
  const bool split =
    std::any_of(model.parts.begin(), model.parts.end(), [](const ModelPart & part) { return part.component != 0; });
  add(omitted.labels, split ? "components merged into one" : "labels merged into one");
  if (!text.empty())
  {
    notes.push_back(target.string() + ": what this format cannot hold: " + text + " (.vtp holds everything)");
  }
}

void
RequireUnrefined(const MedialModel & model, const std::filesystem::path & path)
{
  if (!model.refined.empty())
  {
    throw InputError(path.string() + ": was made with --refine " + model.refined +
                     ", and only cores as they come out of the voxels are worked on; make one without");
  }
}

ReadOptions
RecordedReading(const ParameterRecord & parameters)
{
  ReadOptions reading;
  reading.binary = parameters.binary;
  reading.threshold = parameters.threshold;
  reading.volume = parameters.volume;
  reading.component = parameters.component;
  reading.crop = parameters.crop;
  reading.spacing = parameters.spacing;
  reading.orthonormalize = parameters.orthonormalize;
  reading.niftiForm = parameters.niftiForm;
  if (!reading.binary && !reading.threshold)
  {
    reading.labels.clear();
    for (const std::int64_t label : parameters.labels)
    {
      reading.labels += (reading.labels.empty() ? "" : ",") + std::to_string(label);
    }
  }
  return reading;
}

} // namespace voxelcore
