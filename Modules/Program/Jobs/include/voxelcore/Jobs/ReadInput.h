#pragma once
// What a job works on: a scan as it is, or a mesh made voxels.

#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Meshes/Voxelization.h"
#include "voxelcore/Report/CoreReport.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace voxelcore
{

/** A mesh as a volume of one label, 1, named after its file. */
struct MeshVolume
{
  LabelMap     volume; ///< its box is that of the mesh; notes and warnings say what was found in the mesh
  MeshFindings findings;

  std::shared_ptr<const TriangleMesh> mesh;         ///< as it stands in the file
  std::uint64_t                       doubtful = 0; ///< voxels the mesh is not clear about
};

/** Whether a path names a mesh, and not an image in a .vtk file. */
bool
IsMeshFile(const std::filesystem::path & path);

/** Reads and voxelizes a mesh, either with `resolution` voxels on its longest side or with voxels of this size, mm.
 *  \throws UsageError unless exactly one of the two is given; InputError; Cancelled */
MeshVolume
VoxelizeMeshFile(const std::filesystem::path &       path,
                 const std::optional<std::int64_t> & resolution,
                 const std::optional<Vector3> &      spacing,
                 const MeshReading &                 reading = {},
                 const ProgressCallback &            progress = {});

/** What a job works on, opened once. */
struct InputScan : LabelMap
{
  std::shared_ptr<const TriangleMesh> mesh; ///< of which the voxels were made; none of a scan

  /** Of a scan in memory, where somebody may ask for them: values along x, from (x, y, z) on. Thread-safe. */
  std::function<void(std::int32_t x, std::int32_t y, std::int32_t z, std::span<float> values)> greyRows{};
};

/** ReadLabelVolume, or for the path of a mesh VoxelizeMeshFile with the spacing of `options`.
 *  \throws as these; UsageError for a resolution that is none of a mesh, or options that are those of scans */
InputScan
ReadScanOrMesh(const std::filesystem::path &       path,
               const ReadOptions &                 options,
               const std::optional<std::int64_t> & resolution,
               const ProgressCallback &            progress = {});

/** The part of a scan that was read, in its indices. */
VoxelBox
PartRead(const LabelMap & scan);
VoxelBox
PartRead(const std::optional<CropRange> & crop, const ImageGeometry & geometry);

/** The same where bodies at its border may be cut by it: that of a mesh's box cuts nothing. */
std::optional<VoxelBox>
BorderOf(const InputScan & scan);

/** How the scan was read when a file was made. */
ReadOptions
RecordedReading(const ParameterRecord & parameters);

/** The scan that a file was made from, read as it was then. Where that was a grey scan with a threshold and `path` is
 *  the mask that came of it, such as the one `roots` writes, it is taken as it is: `parameters` then tell of neither
 *  threshold nor edits, which are in it, and a note says so. \throws as ReadScanOrMesh */
InputScan
ReadScanAgain(const std::filesystem::path & path,
              ParameterRecord &             parameters,
              std::vector<std::string> &    notes,
              const ProgressCallback &      progress = {});

/** "256,512": numbers of voxels, each once. \throws UsageError */
std::vector<std::int64_t>
ParseResolutions(const std::string & text);

/** Whether a value that is a label or a file is a file: it has a dot or a slash. */
inline bool
NamesFile(std::string_view value)
{
  return value.find_first_of("./") != std::string_view::npos;
}

} // namespace voxelcore
