#include "voxelcore/Meshes/VoxelizeJob.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/LengthUnit.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Imaging/GreyVolume.h"
#include "voxelcore/Jobs/CoreJobSteps.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Jobs/LabelVolumes.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Models/ReadMesh.h"
#include "voxelcore/Models/TableColumns.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

namespace voxelcore
{
namespace
{

using Json = nlohmann::ordered_json;

std::string
ResolutionTag(std::int64_t resolution)
{
  return "resolution-" + std::to_string(resolution);
}

std::string
RuleName(InsideRule rule)
{
  return rule == InsideRule::Winding ? "winding number" : rule == InsideRule::Parity ? "parity" : "votes of six rays";
}

Json
VolumeJson(const std::filesystem::path & target, const MeshVolume & made)
{
  const ImageGeometry & geometry = made.volume.geometry;
  const MeshFindings &  found = made.findings;
  Json                  json = Json::object();
  json["output"] = target.string();
  json["size"] = geometry.size;
  json["spacing_mm"] = geometry.spacing;
  json["origin_mm"] = geometry.origin;
  json["voxels"] = made.volume.labels.front().voxels;
  json["doubtful_voxels"] = made.doubtful;
  json["decided_by"] = RuleName(found.rule);
  json["mesh"] = { { "format", made.volume.format },   { "triangles", found.triangles },   { "pieces", found.pieces },
                   { "degenerate", found.degenerate }, { "duplicates", found.duplicates }, { "turned", found.flipped },
                   { "open_edges", found.openEdges } };
  json["notes"] = made.volume.notes;
  return json;
}

std::string
LineOf(const std::filesystem::path & target, const MeshVolume & made)
{
  const ImageGeometry & geometry = made.volume.geometry;
  const LengthUnit      unit = LengthUnit::For(*std::max_element(geometry.spacing.begin(), geometry.spacing.end()));
  std::ostringstream    line;
  line << target.string() << ": " << geometry.size[0] << " x " << geometry.size[1] << " x " << geometry.size[2]
       << " voxels of " << ShortText(unit.Of(geometry.spacing[0]), 6);
  if (geometry.spacing[1] != geometry.spacing[0] || geometry.spacing[2] != geometry.spacing[0])
  {
    line << " x " << ShortText(unit.Of(geometry.spacing[1]), 6) << " x " << ShortText(unit.Of(geometry.spacing[2]), 6);
  }
  line << " " << unit.Name() << ", " << made.volume.labels.front().voxels << " of them in";
  return line.str();
}

/** Shortest text that reads back to the same number. */
std::string
Digits(double value)
{
  return Json(value).dump();
}

std::string
StudyRows(std::int64_t resolution, const CoreReport & report)
{
  std::string rows;
  for (const LabelRecord & label : report.labels)
  {
    for (const PrunedRecord & pruned : label.pruned)
    {
      const ComplexRecord & complex = pruned.complex;
      const auto &          betti = complex.topology.betti;
      std::string           row = std::to_string(resolution);
      const auto            add = [&row](const std::string & cell) { row += "," + cell; };
      add(Digits(report.input.geometry.spacing[0]));
      add(std::to_string(label.component));
      add(pruned.tolerance ? "tolerance " + pruned.tolerance->height : pruned.lambda);
      add(Digits(pruned.tolerance ? pruned.tolerance->heightMm : pruned.lambdaMm));
      for (const std::uint64_t count :
           { label.voxels, label.boundaryVertices, label.core.faces, complex.vertices, complex.edges, complex.faces })
      {
        add(std::to_string(count));
      }
      add(Digits(complex.areaMm2));
      add(Digits(complex.maxRadiusMm));
      add(std::to_string(complex.topology.euler));
      for (const auto number : betti)
      {
        add(std::to_string(number));
      }
      for (const double seconds : { report.seconds.read,
                                    report.seconds.shape,
                                    report.seconds.delaunay,
                                    report.seconds.core,
                                    report.seconds.prune,
                                    report.seconds.total })
      {
        add(Digits(seconds));
      }
      add(Digits(report.peakMemoryMb));
      rows += row + "\n";
    }
  }
  return rows;
}

constexpr auto kStudyColumns = std::to_array<Column>({
  { "resolution", "", "voxels along the longest side" },
  { "spacing_mm", "mm", "size of a voxel" },
  { "component", "", "number of the component" },
  { "pruning", "", "lambda or tolerance, as given" },
  { "pruning_mm", "mm", "the same" },
  { "voxels", "", "of the shape" },
  { "boundary_vertices", "", "of the shape" },
  { "core_faces", "", "faces of the whole core" },
  { "vertices", "", "of the pruned core" },
  { "edges", "", "of the pruned core" },
  { "faces", "", "of the pruned core" },
  { "area_mm2", "mm^2", "area of its faces" },
  { "max_radius_mm", "mm", "radius of its largest ball" },
  { "euler", "", "Euler number" },
  { "b0", "", "pieces" },
  { "b1", "", "loops" },
  { "b2", "", "cavities" },
  { "seconds_read", "s", "time to read the mesh and find its voxels" },
  { "seconds_shape", "s", "time for the shape" },
  { "seconds_delaunay", "s", "time for the Delaunay cells" },
  { "seconds_core", "s", "time for the core" },
  { "seconds_prune", "s", "time to prune it" },
  { "seconds_total", "s", "time for all" },
  { "peak_memory_mb", "MB", "greatest memory" },
});

} // namespace

VoxelizeResult
RunVoxelizeJob(const VoxelizeJobOptions & options, const JobContext & given)
{
  const JobContext  context = ForwardOnly(given);
  OutputTransaction transaction(options.force, context.temporaries);
  transaction.Protect(options.mesh);
  struct Run
  {
    std::optional<std::int64_t> resolution;
    std::filesystem::path       target;
  };
  std::vector<Run> runs;
  for (const std::int64_t resolution : options.resolutions)
  {
    const bool single = options.resolutions.size() == 1;
    runs.push_back(
      { resolution, single ? options.output : FileOutputPath(options.output, "_" + ResolutionTag(resolution)) });
  }
  if (runs.empty())
  {
    runs.push_back({ {}, options.output });
  }
  if (!IsMeshPath(options.mesh))
  {
    throw InputError(options.mesh.string() + ": is no mesh; give .stl .obj .ply .off .vtk or .vtp");
  }
  for (const Run & run : runs)
  {
    RequireVolumePath(run.target);
    transaction.CheckTarget(run.target);
  }
  if (options.report)
  {
    transaction.CheckTarget(*options.report);
  }
  VoxelizeResult result;
  Json           volumes = Json::array();
  for (std::size_t i = 0; i < runs.size(); ++i)
  {
    const auto at = [&](double done) { return (static_cast<double>(i) + done) / static_cast<double>(runs.size()); };
    MeshVolume made = VoxelizeMeshFile(options.mesh,
                                       runs[i].resolution,
                                       options.spacing,
                                       options.reading,
                                       PartOfProgress(context.progress, at(0), at(0.5)));
    volumes.push_back(VolumeJson(runs[i].target, made));
    result.lines.push_back(LineOf(runs[i].target, made));
    for (const std::string & warning : made.volume.warnings)
    {
      result.warnings.push_back(options.mesh.string() + ": " + warning);
    }
    ReportProgress(context.progress, "writing", at(0.5));
    WriteLabelVolume(transaction.StageWithCompanions(runs[i].target), made.volume.geometry, made.volume.labels);
  }
  if (options.report)
  {
    Json json = { { "voxelcore", { { "version", VoxelCoreVersion() } } },
                  { "mesh", options.mesh.string() },
                  { "volumes", std::move(volumes) } };
    WriteTextFile(transaction.Stage(*options.report), json.dump(2) + "\n");
  }
  Finish(transaction, context);
  return result;
}

StudyResult
RunStudyJob(const CoreOptions & options, const std::vector<std::int64_t> & resolutions, const JobContext & given)
{
  const JobContext  context = ForwardOnly(given);
  OutputTransaction transaction(options.force, context.temporaries);
  const bool        toFolder = IsFolderOutput(options.output);
  if (options.display.scene || options.display.html || !options.join.empty())
  {
    throw UsageError("--scene, --html and --join: give one --resolution");
  }
  if (toFolder)
  {
    transaction.MakeDirectory(options.output);
  }
  StudyResult result;
  result.table = options.table ? *options.table
                 : toFolder    ? options.output / (ScanName(options.scan) + "_resolutions.csv")
                               : std::filesystem::path(options.output).replace_extension(".csv");
  transaction.CheckTarget(result.table);
  transaction.CheckTarget(ColumnsBeside(result.table));
  std::vector<CoreOptions> runs;
  for (const std::int64_t resolution : resolutions)
  {
    CoreOptions one = options;
    one.resolution = resolution;
    one.table.reset();
    const std::string suffix = "_" + ResolutionTag(resolution);
    one.output = toFolder ? options.output / (ResolutionTag(resolution) + "/") : FileOutputPath(options.output, suffix);
    if (one.skeleton)
    {
      one.skeletonOutput = SkeletonBesideCore(one.output);
    }
    if (one.report)
    {
      one.report = FileOutputPath(*one.report, suffix);
    }
    CheckCoreTargets(one, transaction);
    runs.push_back(std::move(one));
  }
  std::string rows = HeadLine(kStudyColumns, context.Heads(SpatialUnit::Millimetres));
  for (std::size_t i = 0; i < runs.size(); ++i)
  {
    const double count = static_cast<double>(runs.size());
    JobContext   part = context;
    part.progress = NamedPartOfProgress(context.progress,
                                        ResolutionTag(resolutions[i]),
                                        static_cast<double>(i) / count,
                                        static_cast<double>(i + 1) / count);
    result.runs.push_back(StageCoreJob(runs[i], transaction, part));
    rows += StudyRows(resolutions[i], result.runs.back().report);
  }
  WriteTextFile(transaction.Stage(result.table), rows);
  WriteTextFile(transaction.Stage(ColumnsBeside(result.table)),
                TablesJson({ { "resolutions", ColumnsJson(kStudyColumns, SpatialUnit::Millimetres) } }));
  Finish(transaction, context);
  return result;
}

} // namespace voxelcore
