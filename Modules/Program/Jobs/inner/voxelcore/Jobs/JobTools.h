#pragma once
// Small pieces that jobs share.

#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Base/Stopwatch.h"
#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Jobs/CoreJob.h"
#include "voxelcore/Jobs/JobContext.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Jobs/StagedModel.h"
#include "voxelcore/Models/MedialModel.h"
#include "voxelcore/Report/CoreReport.h"
#include "voxelcore/Report/ResultRecords.h"

#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

/** The end of every job: the last moment at which an interruption is heeded; then its files appear, and the context
 *  hears of them. */
void
Finish(OutputTransaction & transaction, const JobContext & context);

/** No result may replace the scan or the grey scan beside it. */
void
ProtectInputs(OutputTransaction & transaction, const CoreOptions & options);

/** Before anything is computed. \throws OutputError where one cannot be written, UsageError where two are one */
void
CheckTargets(const OutputTransaction & transaction, const std::vector<std::filesystem::path> & targets);

/** The weights of a scan's lattice. \throws InputError that names the scan where its geometry cannot be worked on. */
SpacingWeights
ScanWeights(const ImageGeometry & geometry, const std::filesystem::path & scan);

/** \throws InputError that names the scan where its lengths are in voxels and one is asked for in mm. */
void
RequireLengthsOf(const std::filesystem::path & scan, SpatialUnit unit, const CertifiedRequest & request);

/** A length that `option` gives for lines without voxels. \throws UsageError unless it is in mm or, where lengths are
 *  in voxels, in these; InputError as RequireLengthIn() */
double
PlainLength(const Lambda & length, SpatialUnit unit, const std::string & option);

/** \throws InputError where the lengths of two files are not in one unit. */
void
RequireSameUnit(const std::filesystem::path & one,
                SpatialUnit                   unit,
                const std::filesystem::path & other,
                SpatialUnit                   otherUnit);

/** Voxels; places of voxels that are so close are the same. */
constexpr double kSamePlace = 1e-3;

/** \throws InputError unless the volume at `path`, given by `option`, has the voxels of the segmentation: size, unit
 *  and places */
void
RequireSamePlace(const ImageGeometry &         other,
                 const ImageGeometry &         labels,
                 const std::string &           option,
                 const std::filesystem::path & path);

/** yyyy-mm-ddThh:mm:ss, UTC: when a file was changed last. */
std::string
ModificationTime(const std::filesystem::path & path);

/** \throws InputError, naming the file, unless its field Provenance `fits` its cells. */
void
RequireFittingProvenance(bool fits, const std::filesystem::path & path);

/** Whether a job that takes scans is given a finished core instead: a .vtp, or polydata in a .vtk, that is not asked to
 *  be voxelized. */
bool
IsFinishedCore(const std::filesystem::path &       path,
               const ReadOptions &                 reading,
               const std::optional<std::int64_t> & resolution);

/** Warns where a program that saved a file again has lost digits of its numbers (MedialModel::rounded). */
void
WarnOfRounding(const std::filesystem::path & path, const std::string & rounded, std::vector<std::string> & warnings);

} // namespace voxelcore
