// `voxelcore skeleton`: its options, and what it runs.

#include "voxelcore/Options/Requests.h"
#include "voxelcore/Options/SharedRows.h"
#include "voxelcore/Report/ReportTable.h"

namespace voxelcore
{

namespace table
{

constexpr auto kSkeletonOwn = std::to_array<Parameter>({
  { "output",
    "-o,--output",
    Output,
    "OUT",
    "",
    true,
    Group::Output,
    "Write the skeleton as .vtp, or as .csv its tables alone; a folder, DIR/, gets one .vtp per label" },
  { "table",
    "--table",
    Output,
    "OUT.csv",
    "",
    false,
    Group::Output,
    "Write a table with a row per branch, of all labels; it replaces the OUT_branches.csv of --also csv" },
  { "lambda",
    "-l,--lambda",
    Text,
    "L",
    "0",
    false,
    Group::Pruning,
    "Prune the core of a scan first, at this threshold: 1.5mm, 2.5vox, 2.5%",
    "lambda_" },
  { "tolerance",
    "--tolerance",
    Text,
    "H",
    "",
    false,
    Group::Pruning,
    "Prune the core of a scan first so that the boundary stays within H of the remaining balls: 1.2diag (voxel "
    "diagonals), 2vox, 1.5mm; tips shorten by about H" },
  { "cavities",
    "--cavities",
    Text,
    "fill|keep|N",
    "fill",
    false,
    Group::ShapeEdits,
    "Fill cavities, so that the skeleton is curves (fill), or keep surfaces around them (keep); with "
    "--simplify-topology, N cavities are wanted" },
  { "refine",
    "--refine",
    Choice,
    "off|labels|grey|mesh",
    "off",
    false,
    Group::Refinement,
    "Move the skeleton by up to a voxel, to the axis of the smooth shape behind labels, grey values or mesh" },
  { "network",
    "--network",
    Flag,
    "",
    "",
    false,
    Group::Skeleton,
    "Make one skeleton of all labels together, such as the vessels of a circle of Willis: each point has its label, "
    "and branches are cut where labels meet" },
  { "sections",
    "--sections",
    Text,
    "all|L",
    "",
    false,
    Group::Skeleton,
    "Measure cross-sections of the body along branches, at each point (all) or every L: 1mm, 2vox; writes "
    "OUT_sections.csv, the contours as OUT_sections.vtp, and stenoses, bulges and domes as OUT_lesions.csv" },
  { "branch-map",
    "--branch-map",
    Output,
    "OUT.nrrd",
    "",
    false,
    Group::Skeleton,
    "Write a volume with the branch each voxel belongs to, as its row in the table of branches, from 1: .nrrd .nii "
    ".nii.gz .mha .mhd .tif .ome.zarr" },
  { "order-map",
    "--order-map",
    Output,
    "OUT.nrrd",
    "",
    false,
    Group::Skeleton,
    "Write a volume with the Strahler order of the branch each voxel belongs to" },
  { "skeleton-map",
    "--skeleton-map",
    Output,
    "OUT.nrrd",
    "",
    false,
    Group::Skeleton,
    "Write the skeleton as voxels of the scan, with the values of labels" },
});

constexpr auto kSkeletonRows = Joined(kRunRows,
                                      kScanOrCoreArgument,
                                      kJoinRows,
                                      kScanRows,
                                      kSkeletonOwn,
                                      kResolutionRows,
                                      kTreeRows,
                                      kReportRows,
                                      kTableRows,
                                      kDisplayRows,
                                      kTriangleRows,
                                      kForceRows,
                                      kGreyRows,
                                      kBurnRows,
                                      kStageRows,
                                      kBranchRows,
                                      kNetworkRows,
                                      kBorderRows,
                                      kEngineRows);

} // namespace table

namespace
{

constexpr std::string_view kSkeletonFooter =
  R"(The skeleton has the same components and cycles as the shape, which is checked. Cavities are filled first, as
surfaces around them cannot become curves; --cavities keep leaves them. Branches of bodies that the scan's border
cuts run up to the border. By default the core is not pruned first, so that parts two voxels thick keep their
branches. Radii in tables are those of the scanned body. Guide: skeletons.md

--also writes beside OUT.vtp:
  csv       OUT_branches.csv, OUT_summary.csv, and OUT_columns.json, which explains the columns;
            with --network OUT_contacts.csv, too
  swc       OUT.swc, in micrometres; cycles are cut
  mrk.json  OUT.mrk.json, curves for 3D Slicer
  graphml   OUT.graphml
  obj       OUT.obj, a line a branch
  precomputed  the folder OUT_precomputed with a file a label, for Neuroglancer
  ma        OUT.ma and OUT.r: the medial surface, for other programs
A folder gets one set per label, named <scan>_label-<value>_skeleton; tables hold all labels.

With -o DIR/ each label of a scan is written as soon as it is done, and the same command goes on where it was
stopped. If a label fails its certificate, only the other labels are written, and the exit code is 4. --scene
and --html write the folder all at once.

--probability writes the tree of each threshold as OUT_threshold-0.3.vtp and so on, numbers as OUT_thresholds.csv,
and as OUT.vtp that of the threshold that keeps most of what is stable, without unstable ends and pieces. Its
arrays LowestThreshold, HighestThreshold and Persistence tell over which thresholds each branch lives.

--edits does what a person filled in beside a branch or a place of --annotations: cut (the body ends here), remove
(the branch and what springs from it), join X Y Z (this tip to that one), path X Y Z; .. radius R (a branch from
here), root (of the hierarchy), loop (real: --cut-loops leaves it), background (this voxel). Names stand in tables and
in the file. The skeleton is that of the edited body. Edits hold for another threshold or version as long as the tree
passes there; those that do not fit are told and left out.

Examples:
  voxelcore skeleton root.nii.gz -o root.vtp --also csv,swc --root top
  voxelcore skeleton core.vtp -o skeleton.vtp --report skeleton.json
  voxelcore skeleton atlas.nii.gz -o skeletons/ --also csv
  voxelcore skeleton vessels.seg.nrrd --prune-branches 1.5r --also mrk.json -o vessels.vtp
  voxelcore skeleton circle-of-willis.nii.gz --network --also csv -o network.vtp
  voxelcore skeleton bone.nrrd --plates 4vox -o rods-and-plates.vtp
  voxelcore skeleton --probability softmax.nrrd --thresholds 0.3,0.5,0.7 -o sure.vtp
  voxelcore skeleton root.nrrd -o found.vtp --annotations
  voxelcore skeleton root.nrrd -o corrected.vtp --edits found_annotations.csv)";

Outcome
RunSkeleton(const Invocation & call)
{
  SkeletonOptions options = SkeletonOptionsFrom(call.values);
  options.threads = call.threads;
  options.command = call.whole;
  const SkeletonResult result = RunSkeletonJob(options, call.context);
  return { .warnings = result.warnings, .text = SkeletonTable(result.report), .notes = result.notes };
}

} // namespace

constinit const Command kSkeletonCommand{ .name = "skeleton",
                                          .description = "Compute the curve skeleton of a scan or of a medial surface",
                                          .footer = kSkeletonFooter,
                                          .place = 20,
                                          .rows = table::kSkeletonRows,
                                          .run = RunSkeleton,
                                          .resumes = Resumes::IntoFolder };

} // namespace voxelcore
