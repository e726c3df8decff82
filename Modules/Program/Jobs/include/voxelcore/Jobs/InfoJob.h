#pragma once
// `voxelcore info`: what is in a scan.

#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Jobs/CostModel.h"
#include "voxelcore/Jobs/JobContext.h"
#include "voxelcore/Labels/GreyScan.h"
#include "voxelcore/Lattice/TopologyNumbers.h"
#include "voxelcore/Masks/ShapeEdits.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

struct InfoOptions
{
  std::filesystem::path scan;
  ReadOptions           reading;
  ShapeEditOptions      edits;

  std::optional<std::int64_t> resolution; ///< of a mesh
  // What `core` and `skeleton` do when nothing is said: to foretell what they need.
  std::vector<Lambda>    coreLambdas;
  std::vector<Tolerance> coreTolerances;
  bool                   coreRefined = false; ///< from labels
  std::vector<Lambda>    skeletonLambdas;
  BorderEnds             skeletonBorder = BorderEnds::Closed;
};

struct LabelInfo
{
  std::int64_t    label = 0;
  std::int64_t    component = 0; ///< from 1 by size where components are split; 0: the whole label
  std::string     name;
  std::uint64_t   voxels = 0;
  double          volumeMm3 = 0;
  VoxelBox        box;
  TopologyNumbers topology; ///< of the voxel shape: 6-connected, b0 its components
  TopologyNumbers closed;   ///< of the closed union of the voxels: 26-connected
  BoundaryCounts  boundary;
  CostPrediction  cost; ///< of its core alone
};

/** What a threshold would make of a grey scan. */
struct GreyProposal
{
  std::string     name;
  double          threshold = 0; ///< and brighter
  std::uint64_t   voxels = 0;
  TopologyNumbers topology; ///< of the voxel shape, as LabelInfo::topology
};

struct ScanInfo
{
  std::string               path;
  std::string               format;
  std::string               pixelType;
  ImageGeometry             geometry;
  std::string               orientation; ///< OrientationLetters()
  std::vector<std::string>  notes;
  std::vector<std::string>  warnings;
  std::vector<LabelInfo>    labels;
  std::optional<GreyScan>   grey;      ///< where the scan is no label volume: then there are no labels
  std::vector<GreyProposal> proposals; ///< of a grey scan, the best first
  // What jobs over all labels need with their defaults; nothing of a grey scan.
  std::optional<CostPrediction> core; ///< into one file
  std::optional<CostPrediction> skeleton;
  std::optional<CostPrediction> page;        ///< `core` with --html
  int                           threads = 1; ///< that these are for: OpenMP's number
};

/** Of a grey scan it says so, unless labels, binary or threshold were given. \throws InputError, Cancelled */
ScanInfo
RunInfoJob(const InfoOptions & options, const JobContext & context = {});

/** For i, j and k the direction of the patient they mostly run to: R, L, A, P, S or I. "LPS" for the identity. */
std::string
OrientationLetters(const ImageGeometry & geometry);

/** For people: a few lines and a table. */
std::string
InfoText(const ScanInfo & info);

/** For programs: indented JSON with a final newline. */
std::string
InfoJson(const ScanInfo & info);

} // namespace voxelcore
