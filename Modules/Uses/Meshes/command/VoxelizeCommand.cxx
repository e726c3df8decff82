// `voxelcore voxelize`: its options, and what it runs.

#include "voxelcore/Meshes/VoxelizeCommand.h"

#include "voxelcore/Options/ParameterReader.h"
#include "voxelcore/Options/Requests.h"
#include "voxelcore/Options/SharedRows.h"

namespace voxelcore
{

namespace table
{

constexpr auto kVoxelizeOwn = std::to_array<Parameter>({
  { "mesh", "", Input, "MESH", "", true, Group::Input, "Closed triangle mesh: .stl .obj .ply .off .vtk .vtp" },
  { "spacing", "--spacing", Text, "H|X,Y,Z", "", false, Group::Input, "Voxel size in mm" },
  { "resolution",
    "--resolution",
    Text,
    "N[,N..]",
    "",
    false,
    Group::Input,
    "Voxels along the longest side; several N write one volume each, such as OUT_resolution-256.nrrd" },
});

constexpr auto kVoxelizeRows = Joined(kRunRows, kVoxelizeOwn, kVolumeOutput, kMeshRows, kReportRows, kForceRows);

} // namespace table

namespace
{

constexpr std::string_view kFooter =
  R"(Give --resolution or --spacing. A voxel belongs to the shape if its centre does, which is decided exactly. The
grid starts at the minimum corner of the mesh's box; coordinates are LPS mm. Flipped, duplicate and degenerate
faces are repaired. In an open mesh, six rays vote on each voxel. The command reports the repairs and the number
of doubtful voxels. A mesh that encloses nothing is refused. Guide: mesh-input.md

Examples:
  voxelcore voxelize part.stl --resolution 256 -o part.nrrd
  voxelcore voxelize part.obj --spacing 0.5,0.5,1 -o part.nii.gz --report part.json
  voxelcore voxelize part.ply --resolution 64,128,256 -o part.mha)";

} // namespace

VoxelizeJobOptions
VoxelizeOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, kVoxelizeCommand);
  VoxelizeJobOptions    options;
  options.mesh = reader.Text("mesh");
  options.resolutions = ResolutionsFrom(values);
  if (reader.IsGiven("spacing"))
  {
    options.spacing = reader.Spacing();
  }
  if (options.resolutions.empty() != options.spacing.has_value())
  {
    throw UsageError("give either --resolution (voxels along the longest side) or --spacing (voxel size in mm)");
  }
  options.reading = { reader.IsSet("cap"), reader.IsSet("cover") };
  options.output = reader.File("output");
  options.report = reader.FileIfGiven("report");
  options.force = reader.IsSet("force");
  return options;
}

namespace
{

Outcome
Run(const Invocation & call)
{
  const VoxelizeResult result = RunVoxelizeJob(VoxelizeOptionsFrom(call.values), call.context);
  Outcome              outcome{ .warnings = result.warnings };
  for (const std::string & line : result.lines)
  {
    outcome.text += line + "\n";
  }
  return outcome;
}

} // namespace

constinit const Command kVoxelizeCommand{ .name = "voxelize",
                                          .description = "Convert a triangle mesh to a volume",
                                          .footer = kFooter,
                                          .place = 150,
                                          .rows = table::kVoxelizeRows,
                                          .run = Run };

} // namespace voxelcore
