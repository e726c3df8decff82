#include "voxelcore/Jobs/ReadInput.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/ItkReader/ForeignFormats.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Models/ReadMesh.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace voxelcore
{
namespace
{

/** What was found in a mesh: for the report, and of that what a user must see. */
void
Describe(const MeshFile & file, const Voxelization & made, LabelMap & volume)
{
  const MeshFindings & found = made.findings;
  const auto           note = [&](const std::string & text) { volume.notes.push_back(text); };
  const auto           warn = [&](const std::string & text) {
    volume.notes.push_back(text);
    volume.warnings.push_back(text);
  };
  note("mesh of " + Counted(found.triangles, "triangle", "triangles") + " in " +
       Counted(found.pieces, "piece", "pieces") + ", voxelized: a voxel is in when its centre is");
  if (file.polygons > 0)
  {
    note(Counted(file.polygons, "polygon", "polygons") + " cut into triangles");
  }
  if (found.degenerate > 0)
  {
    note(Counted(found.degenerate, "triangle", "triangles") + " with a corner twice left out");
  }
  if (found.duplicates > 0)
  {
    warn(Counted(found.duplicates, "triangle", "triangles") + " left out that others repeat");
  }
  if (found.flipped > 0)
  {
    warn(Counted(found.flipped, "triangle", "triangles") + " turned to agree with their neighbours");
  }
  switch (found.rule)
  {
    case InsideRule::Winding:
      if (made.doubtful > 0)
      {
        warn(Counted(made.doubtful, "voxel", "voxels") +
             " doubtful: in several parts of the mesh at once, or in one that is inside out; taken as in");
      }
      break;
    case InsideRule::Parity:
      warn("the surface has no orientation: a voxel is in where a ray crosses it an odd number of times");
      break;
    case InsideRule::Votes:
      warn("the surface is not closed: " + Counted(found.openEdges, "edge", "edges") +
           " on an odd number of triangles; a voxel is in where four of six rays along the axes say so; " +
           Counted(made.doubtful, "voxel", "voxels") + " doubtful, where not all six agree");
      break;
  }
}

LabelMap
AsVolume(const std::filesystem::path & path, const MeshFile & file, const VoxelGrid & grid, Voxelization & made)
{
  LabelMap volume;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    volume.geometry.size[axis] = grid.size[axis];
    volume.geometry.spacing[axis] = grid.spacing[axis];
    volume.geometry.origin[axis] = grid.origin[axis] + 0.5 * grid.spacing[axis];
  }
  volume.format = file.format + " mesh";
  volume.pixelType = "uint1";
  Describe(file, made, volume);
  volume.labels.push_back({ 1, ScanName(path), made.voxels, CropToVoxels(std::move(made.shape)) });
  return volume;
}

} // namespace

bool
IsMeshFile(const std::filesystem::path & path)
{
  return IsMeshPath(path) && !IsVtkImage(path);
}

MeshVolume
VoxelizeMeshFile(const std::filesystem::path &       path,
                 const std::optional<std::int64_t> & resolution,
                 const std::optional<Vector3> &      spacing,
                 const MeshReading &                 reading,
                 const ProgressCallback &            progress)
{
  if (resolution.has_value() == spacing.has_value())
  {
    throw UsageError(path.string() + ": a mesh needs either --resolution, voxels on its longest side, or --spacing, " +
                     "the size of a voxel in mm");
  }
  ReportProgress(progress, "read", 0);
  MeshFile file = ReadMesh(path);
  try
  {
    const std::uint64_t holes = reading.cap ? CapHoles(file.mesh) : 0;
    const VoxelGrid grid = resolution ? GridOfResolution(file.mesh, *resolution) : GridOfSpacing(file.mesh, *spacing);
    Voxelization    made = Voxelize(file.mesh, grid, PartOfProgress(progress, 0.2, 1), reading.cover);
    if (file.mayBeCut && made.findings.rule == InsideRule::Votes)
    {
      throw InputError("it seems cut off: its last line does not end, or points lie on no face, and it is open at " +
                       Counted(made.findings.openEdges, "edge", "edges"));
    }
    MeshVolume result;
    result.findings = made.findings;
    result.doubtful = made.doubtful;
    result.volume = AsVolume(path, file, grid, made);
    if (reading.cap)
    {
      result.volume.notes.push_back(Counted(holes, "hole", "holes") + " of the mesh capped");
    }
    if (made.touched > 0)
    {
      result.volume.notes.push_back(Counted(made.touched, "voxel", "voxels") + " added that the mesh touches");
    }
    result.mesh = std::make_shared<const TriangleMesh>(std::move(file.mesh));
    return result;
  }
  catch (const InputError & error)
  {
    throw InputError("mesh '" + path.string() + "': " + error.what());
  }
}

VoxelBox
PartRead(const LabelMap & volume)
{
  return PartRead(volume.crop, volume.geometry);
}

VoxelBox
PartRead(const std::optional<CropRange> & crop, const ImageGeometry & geometry)
{
  VoxelBox box;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] = crop ? crop->first[axis] : 0;
    const auto end = crop ? crop->end[axis] : static_cast<std::int32_t>(geometry.size[axis]);
    box.size[axis] = end - box.lower[axis];
  }
  return box;
}

std::optional<VoxelBox>
BorderOf(const InputScan & scan)
{
  return scan.mesh ? std::nullopt : std::optional(PartRead(scan));
}

InputScan
ReadScanOrMesh(const std::filesystem::path &       path,
               const ReadOptions &                 options,
               const std::optional<std::int64_t> & resolution,
               const ProgressCallback &            progress)
{
  if (options.raw || !IsMeshFile(path))
  {
    if (resolution)
    {
      throw UsageError("--resolution " + std::to_string(*resolution) + ": is for meshes, and " + path.string() +
                       " is none; leave it out");
    }
    if (options.mesh.cap || options.mesh.cover)
    {
      throw UsageError(std::string(options.mesh.cap ? "--cap" : "--cover") + ": is for meshes, and " + path.string() +
                       " is none; leave it out");
    }
    return { ReadLabelVolume(path, options, progress), {} };
  }
  if ((options.labels != "all" && options.labels != "1") || options.binary || options.threshold || options.volume ||
      options.component || options.level || options.dataset || options.crop || options.orthonormalize ||
      options.niftiForm != "auto")
  {
    throw UsageError(path.string() + ": a mesh is one shape, without labels, values or directions; of the options " +
                     "about reading give only --resolution, --spacing, --cap and --cover");
  }
  MeshVolume made = VoxelizeMeshFile(path, resolution, options.spacing, options.mesh, progress);
  return { std::move(made.volume), std::move(made.mesh) };
}

std::vector<std::int64_t>
ParseResolutions(const std::string & text)
{
  constexpr std::int64_t    most = std::int64_t{ 1 } << 20U;
  std::vector<std::int64_t> resolutions;
  for (std::size_t at = 0; at <= text.size();)
  {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    std::int64_t      value = 0;
    const auto [end, error] = from_chars(text.data() + at, text.data() + comma, value);
    if (error != std::errc() || end != text.data() + comma || value < 1 || value > most ||
        std::find(resolutions.begin(), resolutions.end(), value) != resolutions.end())
    {
      throw UsageError("--resolution " + text + ": expected a whole number of voxels from 1 to " +
                       std::to_string(most) + ", or several, separated by commas, each once");
    }
    resolutions.push_back(value);
    at = comma + 1;
  }
  return resolutions;
}

ReadOptions
RecordedReading(const ParameterRecord & parameters)
{
  ReadOptions reading = parameters.reading;
  reading.labels = "all";
  reading.refuseGrey = false;
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

namespace
{

/** Makes of how a grey scan was read how its mask is, if the scan is one: a single label, 1. */
bool
ReadAsMask(const std::filesystem::path & path, ParameterRecord & parameters)
{
  ParameterRecord ofMask = parameters;
  ofMask.reading.threshold.reset();
  ofMask.labels = { 1 };
  ofMask.edits = {};
  ofMask.edits.splitComponents = parameters.edits.splitComponents;
  ReadOptions all = RecordedReading(ofMask);
  all.labels = "all";
  all.refuseGrey = true;
  try
  {
    const LabelMap found = ReadLabelVolume(path, all);
    if (found.labels.size() != 1 || found.labels.front().value != 1)
    {
      return false;
    }
  }
  catch (const InputError &)
  {
    return false; // what was wrong with it as a grey scan is told
  }
  parameters = std::move(ofMask);
  return true;
}

} // namespace

InputScan
ReadScanAgain(const std::filesystem::path & path,
              ParameterRecord &             parameters,
              std::vector<std::string> &    notes,
              const ProgressCallback &      progress)
{
  try
  {
    return ReadScanOrMesh(path, RecordedReading(parameters), parameters.resolution, progress);
  }
  catch (const InputError &)
  {
    const auto threshold = parameters.reading.threshold;
    if (!threshold || parameters.resolution || !ReadAsMask(path, parameters))
    {
      throw;
    }
    notes.push_back(path.string() + ": taken as the mask itself: it has the label 1 alone, and no value within " +
                    RoundTripText(threshold->first) + ":" + RoundTripText(threshold->second) +
                    ", by which the mask was made; edits are in it");
  }
  return ReadScanOrMesh(path, RecordedReading(parameters), {}, progress);
}

} // namespace voxelcore
