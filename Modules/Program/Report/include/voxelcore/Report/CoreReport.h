#pragma once
// What a job of `voxelcore core` did and found: the report, and the provenance inside the files it wrote.

#include "voxelcore/Certified/Certified.h"
#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Lattice/TopologyNumbers.h"
#include "voxelcore/Masks/ShapeEdits.h"
#include "voxelcore/Models/MedialModel.h"
#include "voxelcore/Shape/VoxelShape.h"
#include "voxelcore/Vessels/VesselLesions.h"
#include "voxelcore/VoxelCore/CoreProvenance.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace voxelcore
{

struct InputRecord
{
  std::string              path;
  std::string              sha256;
  std::string              format;
  ImageGeometry            geometry;
  std::vector<std::string> notes;
};

/** How a core was pruned when it was refined. */
struct RefinedAt
{
  std::string lambda;
  std::string tolerance; ///< empty: by lambda alone
};

/** What refinement was asked for, as it stands in a file. */
struct RefineRecord
{
  std::string                              surface; ///< empty: not refined
  std::string                              greySha256;
  std::optional<std::pair<double, double>> greyRange;
  std::optional<RefinedAt>                 at; ///< where it was pruned further afterwards
};

/** Every option that changes the result, and how the work was done. */
struct ParameterRecord
{
  std::vector<std::int64_t>          labels;     ///< values of the labels worked on
  ReadOptions                        reading;    ///< but for the choice of labels; the crop with its ends filled in
  std::optional<std::int64_t>        resolution; ///< of a mesh
  ShapeEditOptions                   edits;
  std::vector<std::string>           lambda;
  std::vector<std::string>           tolerances; ///< heights; where there are some, one lambda, the floor
  RefineRecord                       refine;
  ModelOptions                       model;
  std::map<std::string, std::string> further; ///< options without a field of their own, as given
  std::string                        engine;
  bool                               crossCheck = false; ///< both engines ran and agreed
  int                                threads = 0;
  SpacingWeights                     weights;
};

/** One result of a label. */
struct PrunedRecord : CoreNumbers
{
  std::string output{}; ///< the file
};

/** A label's curve skeleton. Its topology has been found equal to the shape's, or there is none. */
struct SkeletonRecord
{
  TopologyNumbers      topology;
  SkeletonNumbers      numbers; ///< as written: after cutting and splitting
  std::vector<LoopCut> cuts;
  std::string          output; ///< the file

  std::optional<BorderNumbers>   border{};  ///< where it is not closed, and the body lies at it
  std::optional<SkeletonNetwork> network{}; ///< of several labels

  std::optional<std::vector<VesselLesion>> lesions{}; ///< where sections were asked for; in reports, not in files
};

/** One label, or one of its components where these are split. */
struct LabelRecord
{
  std::int64_t                  label = 0;
  std::int64_t                  component = 0; ///< from 1 by size; 0: the whole label
  std::string                   name;
  std::optional<bool>           standOut = std::nullopt;  ///< CertifiedSkeleton::standOut; in reports, not in files
  std::optional<HollowBody>     hollow = std::nullopt;    ///< in reports, not in files
  std::optional<MaskDiagnosis>  diagnosis = std::nullopt; ///< where there is something to say; in reports, not in files
  std::optional<EditRecord>     edits;                    ///< of the whole label; none when none was asked for
  std::uint64_t                 voxels = 0;
  double                        volumeMm3 = 0;
  VoxelBox                      box; ///< tight
  std::uint64_t                 boundaryVertices = 0;
  TopologyNumbers               shape;
  bool                          hasCore = true; ///< false: none was made, or of parts alone; not in files
  ComplexRecord                 core;
  std::vector<PrunedRecord>     pruned; ///< one per lambda or tolerance, in the order given
  bool                          topologyEqual = false;
  bool                          enclosed = false;
  std::optional<bool>           covered; ///< no boundary gap exceeds the tolerance; none where this is not promised
  std::optional<SkeletonRecord> skeleton;
  double                        seconds = 0; ///< for the table

  bool
  Passed() const
  {
    return topologyEqual && enclosed && covered.value_or(true);
  }
};

/** Wall-clock seconds. Where labels ran side by side their stages overlap: the time all of them took is shared out in
 *  proportion to what each stage took in each label. */
struct StageSeconds
{
  double read = 0;
  double shape = 0;
  double delaunay = 0;
  double core = 0;
  double prune = 0;
  double skeleton = 0;
  double write = 0;
  double total = 0;
};

struct CoreReport
{
  std::string                    version; ///< of the VoxelCore that made it; known only of what ParseProvenance read
  std::string                    command;
  InputRecord                    input;
  ParameterRecord                parameters;
  std::optional<SkeletonRequest> skeleton; ///< where skeletons were made
  std::vector<LabelRecord>       labels;
  StageSeconds                   seconds;
  double                         peakMemoryMb = 0;
};

/** Notes in the parameters of a file's core, before it is pruned further, how it is pruned now: it was refined so. */
void
NoteRefinedAt(ParameterRecord & parameters);

/** The version all reports name. */
std::string
VoxelCoreVersion();

/** The version, the engines of this build, and the libraries at work with theirs: a line each. */
std::string
VersionText();

/** What a use adds to a report: a value as JSON. Keys of lengths end in _mm, as those of the report do. */
struct ReportMember
{
  std::string name;
  std::string json;
};

/** The report as indented JSON with a final newline, a further member at its end. Keys stand in a fixed order. Of a
 *  scan without voxel size they name voxels ("area_vox2"), and "unit" is "voxel". */
std::string
ReportJson(const CoreReport & report, const std::optional<ReportMember> & further = {});

/** The part of a report that goes into the file holding these labels (positions in report.labels) with result number
 *  `which`: without times, memory, threads, paths, command, engine and output, on one line. It names only what
 *  is in this file, so a file does not depend on what else was made in the same run. */
std::string
ProvenanceJson(const CoreReport & report, const std::vector<std::size_t> & labels, std::size_t which);

/** The same for a file of these labels' skeletons. It is the same whether these were made from the scan, beside its
 *  core, or from the file of its whole core. */
std::string
SkeletonProvenanceJson(const CoreReport & report, const std::vector<std::size_t> & labels);

/** The inverse of both; `where` names the file in errors.
 *  \throws InputError when something is missing. */
CoreReport
ParseProvenance(const std::string & json, const std::string & where);

/** A label's record as the report has it, with its seconds, on one line. */
std::string
LabelRecordJson(const LabelRecord & label, SpatialUnit unit);

/** The inverse, but for outputs and for the skeleton's numbers, which its file gives. \throws InputError */
LabelRecord
ParseLabelRecord(const std::string & json);

} // namespace voxelcore
