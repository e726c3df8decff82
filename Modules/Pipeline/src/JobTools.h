#pragma once
// Small pieces that jobs share.

#include "voxelcore/BumpPruning.h"
#include "voxelcore/CoreReport.h"
#include "voxelcore/JobContext.h"
#include "voxelcore/LabelVolume.h"
#include "voxelcore/LambdaPruning.h"
#include "voxelcore/MedialModel.h"
#include "voxelcore/OutputTransaction.h"
#include "voxelcore/StagePlan.h"
#include "voxelcore/Progress.h"

#include <chrono>
#include <string>
#include <vector>

namespace voxelcore
{

/** Wall-clock seconds since it was made or last asked. */
class Stopwatch
{
public:
  double
  Lap()
  {
    const auto   now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - m_Start).count();
    m_Start = now;
    return seconds;
  }

private:
  std::chrono::steady_clock::time_point m_Start = std::chrono::steady_clock::now();
};

/** The end of every job: the last moment at which an interruption is heeded; then its files appear, and the context hears
 *  of them. */
void
Finish(OutputTransaction & transaction, const JobContext & context);

/** PartOfProgress() that puts `name` before the stage. */
ProgressCallback
NamedPartOfProgress(const ProgressCallback & outer, std::string name, double from, double to);

/** A core at one threshold, certified. */
struct PrunedCore
{
  PrunedRecord record;
  ModelPart    part;
};

/** The different thresholds beyond doneMm, ascending. */
std::vector<double>
AscendingBeyond(double doneMm, std::vector<double> thresholdsMm);

/** `whole`, which is pruned to `doneMm` already, pruned to each different threshold beyond that, ascending. */
std::vector<MedialComplex>
PruneAscending(const MedialComplex &       whole,
               double                      doneMm,
               const std::vector<double> & thresholdsMm,
               const ProgressCallback &    progress);

/** Checks and describes what PruneAscending() made of `whole`: a core for each of the thresholds.
 *  \throws CertificateError when the topology is no longer the shape's. */
std::vector<PrunedCore>
CertifyPruned(ModelPart                   whole,
              std::vector<MedialComplex>  complexes,
              const ComplexRecord &       wholeRecord,
              double                      doneMm,
              const std::vector<Lambda> & lambdas,
              const std::vector<double> & thresholdsMm,
              const TopologyNumbers &     shape,
              const std::string &         labelText,
              const ProgressCallback &    progress);

/** Prunes `whole`, which is pruned to `doneMm` already and described by `wholeRecord`, to each threshold (mm, none below
 *  doneMm, in any order).
 *  \throws CertificateError when the topology is no longer the shape's. */
std::vector<PrunedCore>
PruneAndCertify(ModelPart                   whole,
                const ComplexRecord &       wholeRecord,
                double                      doneMm,
                const std::vector<Lambda> & lambdas,
                const std::vector<double> & thresholdsMm,
                const TopologyNumbers &     shape,
                const std::string &         labelText,
                const ProgressCallback &    progress);

/** The weights of a scan's lattice. \throws InputError that names the scan where its geometry cannot be worked on. */
SpacingWeights
ScanWeights(const ImageGeometry & geometry, const std::filesystem::path & scan);

/** The diagonal of a scan in mm: no bump is higher. */
double
ScanDiagonal(const ImageGeometry & geometry);

/** Makes heights ready for files: what never goes, and what would go beyond the scan's diagonal, has that height. */
void
EndBumps(BumpValues & bumps, const ImageGeometry & geometry);

/** Prunes a core with ended bump heights to each height; `floor` holds the lambda it was pruned to before.
 *  \throws CertificateError when the topology is no longer the shape's. */
std::vector<PrunedCore>
PruneByBumpsAndCertify(const ModelPart &               whole,
                       const PrunedRecord &            floor,
                       const std::vector<BumpHeight> & heights,
                       const ImageGeometry &           geometry,
                       const TopologyNumbers &         shape,
                       const std::string &             labelText);

/** Largest distance of a boundary vertex to the balls of a core, in mm. */
double
MeasureBoundaryGap(const ModelPart &      part,
                   const VoxelShape &     shape,
                   const ImageGeometry &  geometry,
                   const SpacingWeights & weights);

/** By how much a boundary gap measured in LPS mm may exceed a height by rounding, mm. */
double
BoundaryGapTolerance(const ImageGeometry & geometry);

/** \throws CertificateError that names the label when the numbers differ. */
void
RequireEqualTopology(const TopologyNumbers & shape,
                     const TopologyNumbers & complex,
                     const std::string &     what,
                     const std::string &     labelText);

/** Writes a model under its staged name; what the format could not hold is added to `notes`. */
void
WriteStagedModel(OutputTransaction &           transaction,
                 const std::filesystem::path & target,
                 const MedialModel &           model,
                 const ModelOptions &          options,
                 std::vector<std::string> &    notes);

/** "label 4 (Precentral_L)" */
std::string
LabelText(std::int64_t value, const std::string & name);

/** \throws InputError for a refined core: what works on exact ones does not take it. */
void
RequireUnrefined(const MedialModel & model, const std::filesystem::path & path);

/** How the scan was read when a file was made. */
ReadOptions
RecordedReading(const ParameterRecord & parameters);

} // namespace voxelcore
