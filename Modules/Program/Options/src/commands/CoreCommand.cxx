// `voxelcore core`: its options, and what it runs.

#include "voxelcore/Options/Requests.h"
#include "voxelcore/Options/SharedRows.h"
#include "voxelcore/Options/SharedValues.h"

namespace voxelcore
{

namespace table
{

constexpr auto kCoreOwn = std::to_array<Parameter>({
  { "resolution",
    "--resolution",
    Text,
    "N[,N..]",
    "",
    false,
    Group::Input,
    "Voxelize a mesh with N voxels along its longest side; several N write one result each, such as "
    "OUT_resolution-256.vtp, and one table" },
  { "output",
    "-o,--output",
    Output,
    "OUT",
    "",
    true,
    Group::Output,
    "Write the medial surface: .vtp .vtk .ply .obj .stl .ma; a folder, DIR/, gets one .vtp per label" },
  { "table",
    "--table",
    Output,
    "OUT.csv",
    "",
    false,
    Group::Output,
    "Write a table with a row per label and result; OUT_columns.json goes beside" },
  { "lambda",
    "-l,--lambda",
    Text,
    "L[,L..]",
    "",
    false,
    Group::Pruning,
    "Prune at this threshold instead: 1.5mm, 2.5vox, 2.5%; 0 keeps the whole core; several L write "
    "OUT_lambda-1mm.vtp and so on; with --tolerance, one L is applied first",
    "lambda_" },
  { "tolerance",
    "--tolerance",
    Text,
    "H[,H..]",
    "",
    false,
    Group::Pruning,
    "Prune so that the boundary stays within H of the remaining balls: 1.2diag (voxel diagonals; the default without "
    "--lambda), 2vox, 1.5mm; several H write OUT_tolerance-1.2diag.vtp and so on" },
  { "refine",
    "--refine",
    Choice,
    "auto|labels|grey|mesh|off",
    "auto",
    false,
    Group::Refinement,
    "Move the surface by up to a voxel, to the axis of the smooth shape behind labels, grey values or mesh; auto: from "
    "labels, but off with --lambda alone and with --tolerance 0; off: the exact core of the voxels" },
  { "with-skeleton",
    "--with-skeleton",
    Flag,
    "",
    "",
    false,
    Group::Skeleton,
    "Write the curve skeleton, too: OUT_skeleton.vtp, as from 'voxelcore skeleton'",
    "-" },
  { "memory",
    "--memory",
    Text,
    "8GB",
    "",
    false,
    Group::Running,
    "Stop before computing if more memory is expected to be needed; see 'voxelcore info'",
    {},
    false,
    true },
  { "cross-check",
    "--cross-check",
    Flag,
    "",
    "",
    false,
    Group::Running,
    "Run both engines for each label and require identical results",
    "cross_check" },
  { "blocks",
    "--blocks",
    Integer,
    "N",
    "",
    false,
    Group::Running,
    "Cut each label into N blocks; compute one with --block, combine all with --join",
    {},
    false,
    true },
  { "block",
    "--block",
    Integer,
    "K",
    "",
    false,
    Group::Running,
    "Compute block K of --blocks, counted from 1, into the folder OUT/; each can run on its own machine",
    {},
    false,
    true },
  { "block-size",
    "--block-size",
    Integer,
    "N",
    "",
    false,
    Group::Running,
    "Cut the scan into blocks of N voxels a side instead of a number of blocks; a block reads the voxels it needs, and "
    "none the whole scan",
    {},
    false,
    true },
  { "join",
    "--join",
    Input,
    "DIR",
    "",
    false,
    Group::Running,
    "Combine the blocks in DIR; the result is that of a single run" },
});

constexpr auto kCoreRows = Joined(kRunRows,
                                  kScanArgument,
                                  kSeparateRows,
                                  kScanRows,
                                  kCoreOwn,
                                  kCavityRows,
                                  kTreeRows,
                                  kReportRows,
                                  kTableRows,
                                  kDisplayRows,
                                  kTriangleRows,
                                  kModelRows,
                                  kForceRows,
                                  kGreyRows,
                                  kBurnRows,
                                  kStageRows,
                                  kBranchRows,
                                  kEngineRows);

} // namespace table

namespace
{

constexpr std::string_view kCoreFooter =
  R"(Pruning never changes the topology. --tolerance H keeps the boundary within H of the balls that remain, on thick
and thin parts alike. In thick slices H shrinks with the voxel's extent across the boundary, so that thin structures
in their plane stay. 1.2diag, the default, suits clean segmentations; use more for rough ones. --lambda L keeps all
of the surface whose nearest boundary points lie at least 2 L apart. A bare number is mm; vox means times the
smallest voxel spacing; diag, times a voxel's diagonal; % is of the longest side of the label's box.
  --lambda 1.5vox clears most staircase noise. It keeps parts three voxels thick along the grid, and four obliquely.
  Above 2.44vox (cubic voxels) convergence is proven, but thin parts shrink to curves.
  For thick slices, give mm: about 1.5 times the slice distance.
A --lambda given with --tolerance is applied first. Guide: choosing-the-pruning.md

Shape edits run label by label in this order: --median, --denoise, --mend-shape, --close, --fill-hollows, --fill-slices,
--connectivity, --fill-cavities, --min-voxels, --largest, --smooth-shape, --simplify-topology, --split-components.
Components are 6-connected: pieces that touch over edges or corners are joined by --connectivity joined.
--mend-shape and all that fill or close also remove true holes. Guide: noisy-masks.md

After pruning by tolerance the result is refined: it moves by up to a voxel, to the axis of the smooth shape behind
the labels. Topology stays, and the boundary stays within the tolerance. Radius and Lambda are then measured from the
estimated surface. --refine off keeps the exact core of the voxels, as --lambda alone and --tolerance 0 do.
--refine grey is better where grey values are clean; mesh, where a mesh was voxelized, takes two to four times as
long. Blocks are exact; --join refines. Guide: refinement.md

The printed table has the faces after pruning (faces at H), the greatest distance of the boundary from the remaining
balls (gap), and the Euler number, pieces, loops and cavities (chi/b0/b1/b2) of the shape and of the core.

With -o DIR/ each label is written as soon as it is done, and the same command goes on where it was stopped. If
a label fails its certificate, only the other labels are written, and the exit code is 4. --scene and --html
write the folder all at once.

--crop cuts: structures end at the cut, and cavities it opens are no longer cavities. Meshes are voxelized
first, as 'voxelcore voxelize' does. Guide: mesh-input.md. Skeleton options need --with-skeleton. Guide:
skeletons.md

Examples:
  voxelcore core scan.nii.gz -o medial.vtp --report medial.json
  voxelcore core scan.seg.nrrd --labels liver,4 --lambda 0,1mm,2.5% -o medial.vtp
  voxelcore core scan.nii.gz --tolerance 2diag -o medial.vtp
  voxelcore core atlas.nii.gz -o surfaces/
  voxelcore core ct.nrrd --threshold 300:3000 --lambda 2vox -o bone.vtp
  voxelcore core slices/ --spacing 0.5,0.5,2 --binary -o part.vtp
  voxelcore core ct.nrrd --threshold 300:3000 --fill-cavities --min-voxels 100 -o bone.vtp
  voxelcore core root.nii.gz -o root.vtp --with-skeleton --also csv --root top
  voxelcore core huge.nrrd --blocks 8 --block 1 -o parts/     (and so on to --block 8, on any machines)
  voxelcore core huge.nrrd --join parts/ -o huge.vtp
  voxelcore core teeth.nii.gz --crop 100:300,80:220,: --split-components -o teeth/
  voxelcore core ct.nrrd --threshold 300:inf --refine grey -o bone.vtp
  voxelcore core part.stl --resolution 256 -o part.vtp
  voxelcore core part.ply --resolution 256,512,1024 --lambda 1%,2.5% -o study/   (each, and one table))";

std::vector<std::string>
CaseArguments(const CasePlace & place)
{
  return { "-o", place.Stem() + "_medial.vtp", "--report", place.Stem() + "_report.json" };
}

CaseInput
Understand(const ParameterValues & values)
{
  return { CoreOptionsFrom(values).reading, {} };
}

constexpr AsCase kCoreAsCase{ .arguments = CaseArguments, .understand = Understand };

Outcome
RunCore(const Invocation & call)
{
  if (const auto block = BlockOptionsFrom(call.values))
  {
    const BlockResult result = RunBlockJob(*block, call.context);
    return { .warnings = result.warnings, .text = BlockText(result, *block) };
  }
  CoreOptions options = CoreOptionsFrom(call.values);
  options.threads = call.threads;
  options.command = call.whole;
  const CoreResult result = RunCoreJob(options, call.context);
  call.Done(result.report);
  return OutcomeOf(result);
}

} // namespace

constinit const Command kCoreCommand{ .name = "core",
                                      .description =
                                        "Compute the medial surface of one, several or all labels of a scan",
                                      .footer = kCoreFooter,
                                      .place = 10,
                                      .rows = table::kCoreRows,
                                      .run = RunCore,
                                      .resumes = Resumes::IntoFolder,
                                      .asCase = &kCoreAsCase };

} // namespace voxelcore
