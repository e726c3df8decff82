#pragma once
// Small pieces that jobs share.

#include "voxelcore/CoreReport.h"
#include "voxelcore/LambdaPruning.h"
#include "voxelcore/MedialModel.h"
#include "voxelcore/OutputTransaction.h"
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

/** A callback for a part of the work: its fractions 0 to 1 become `from` to `to` of `outer`, its stage `stage`. */
ProgressCallback
PartOfProgress(const ProgressCallback & outer, std::string stage, double from, double to);

/** The same, but the stage is prefixed with `name` instead of replaced. */
ProgressCallback
NamedPartOfProgress(const ProgressCallback & outer, std::string name, double from, double to);

/** The same, but the stage is passed on as it is. */
ProgressCallback
PartOfProgress(const ProgressCallback & outer, double from, double to);

/** A core at one threshold, certified. */
struct PrunedCore
{
  PrunedRecord record;
  ModelPart    part;
};

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

} // namespace voxelcore
