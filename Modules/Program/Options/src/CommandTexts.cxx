// What --help says of each command beside its options. Longer explanations stand in Applications/manual/guide.

#include "voxelcore/Options/Parameters.h"

#include <array>

namespace voxelcore
{

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

constexpr std::string_view kInfoFooter =
  R"(The forecast of time and memory holds for a machine like the one it was measured on.

Examples:
  voxelcore info scan.nii.gz
  voxelcore info ct.nrrd --threshold 300:3000 --json)";

constexpr std::string_view kVerifyFooter =
  R"(Rechecks the file independently of the code that made it. Every vertex must lie inside the shape, with two or
more nearest boundary vertices at equal distance and none nearer. Faces must be planar and convex; measures,
order and topology must agree. A failed check ends with exit code 4. The scan is read with the options recorded
in the file.

Example:
  voxelcore verify scan.nii.gz medial.vtp)";

constexpr std::string_view kPruneFooter =
  R"(The result equals that of 'voxelcore core --refine off' at the same lambda or tolerance, bit for bit. For
--lambda, make the file with --keep-edges. For --tolerance, make it with a smaller --tolerance, best 0. What
remains of a refined core keeps its places and radii.

Examples:
  voxelcore core scan.nii.gz --lambda 0 --keep-edges -o whole.vtp
  voxelcore prune whole.vtp --lambda 1.5mm,3mm -o medial.vtp
  voxelcore core scan.nii.gz --tolerance 0 -o every.vtp
  voxelcore prune every.vtp --tolerance 1diag,2diag -o medial.vtp)";

constexpr std::string_view kReconstructFooter =
  R"(A voxel belongs to the result if its centre lies in a ball of the core. A whole core of cubic voxels reproduces
its label exactly. A pruned one shows what was treated as noise. On thick slices, balls bulge out between the
corners of the slices.

Example:
  voxelcore core scan.nii.gz --tolerance 2diag -o medial.vtp
  voxelcore reconstruct medial.vtp -o rebuilt.nii.gz --scan scan.nii.gz --report rebuilt.json)";

constexpr std::string_view kVoxelizeFooter =
  R"(Give --resolution or --spacing. A voxel belongs to the shape if its centre does, which is decided exactly. The
grid starts at the minimum corner of the mesh's box; coordinates are LPS mm. Flipped, duplicate and degenerate
faces are repaired. In an open mesh, six rays vote on each voxel. The command reports the repairs and the number
of doubtful voxels. A mesh that encloses nothing is refused. Guide: mesh-input.md

Examples:
  voxelcore voxelize part.stl --resolution 256 -o part.nrrd
  voxelcore voxelize part.obj --spacing 0.5,0.5,1 -o part.nii.gz --report part.json
  voxelcore voxelize part.ply --resolution 64,128,256 -o part.mha)";

constexpr std::string_view kPhantomFooter = R"(Examples:
  voxelcore phantom list
  voxelcore phantom ellipsoid --size 64 -o ellipsoid.nrrd
  voxelcore phantom root --size 256,256,512 --spacing 0.1,0.1,0.1 --seed 7 -o root.nii.gz)";

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

Examples:
  voxelcore skeleton root.nii.gz -o root.vtp --also csv,swc --root top
  voxelcore skeleton core.vtp -o skeleton.vtp --report skeleton.json
  voxelcore skeleton atlas.nii.gz -o skeletons/ --also csv
  voxelcore skeleton vessels.seg.nrrd --prune-branches 1.5r --also mrk.json -o vessels.vtp
  voxelcore skeleton circle-of-willis.nii.gz --network --also csv -o network.vtp
  voxelcore skeleton bone.nrrd --plates 4vox -o rods-and-plates.vtp
  voxelcore skeleton --probability softmax.nrrd --thresholds 0.3,0.5,0.7 -o sure.vtp)";

constexpr std::string_view kRootsFooter =
  R"(OUTDIR gets roots.rsml, roots.swc, roots.graphml, roots.csv (a row per root), levels.csv, plant.csv, profile.csv,
columns.json (what the columns mean), page.html (a summary), roots.html (3-D), roots.png, mask.nrrd, medial.vtp,
skeleton.vtp, changes.txt (cuts and fills), annotations.csv and annotations.mrk.json (for --edits), and report.json.
All of it is written, or nothing.

A grey scan without --threshold gets one halfway between background and roots, which is reported. Where roots
touch, those that go on straight and as thick are the same root; contacts that may be read otherwise are listed.
Guide: roots.md

Examples:
  voxelcore roots slices/ --spacing 0.5,0.5,0.5 --threshold 15:inf -o maize/
  voxelcore roots root.nii.gz --up z- -o root/
  voxelcore roots root.nii.gz --up z- --edits root/annotations.csv -o edited/
  voxelcore roots root.nrrd --close 5vox --stems auto --soil-depth 30 -o crown/)";

constexpr std::string_view kThicknessFooter =
  R"(The map holds, at each voxel, the diameter of the largest ball inside the label that holds the voxel's centre
(Hildebrand, Rueegsegger 1997), in mm, and 0 outside. Slices of any thickness are measured as they are.

The balls are inscribed in the smooth surface that the voxels stand for. A voxel whose centre lies in none of them
takes the thickness of the nearest voxel that does. With --refine off they are balls that truly lie in the voxels, steps
and all, which makes everything thinner. Pruning changes neither. --bounds adds two maps: every smooth surface that the
labels allow is at least as thick as the first tells, and at most as the second. With --refine off they are bounds of
the voxels as they are.

Each label is measured by itself. One too large for memory is measured block by block, with the same map. Guide:
thickness.md

Examples:
  voxelcore thickness bone.nrrd -o bone-thickness.nrrd --table bone.csv
  voxelcore thickness ct.nrrd --threshold 300:inf --separation box -o map.nii.gz --table trabeculae.csv
  voxelcore thickness atlas.nii.gz --labels 4 -o cortex.nrrd --border drop
  voxelcore thickness atlas.nii.gz -o maps/ --table maps/thickness.csv)";

constexpr std::string_view kSheetsFooter =
  R"(A sheet is a piece of the medial surface without branching: the middle of one wall. Sheets meet in seams, and
seams in junctions. What is a line and no surface is a rod. Walls, plates and struts get numbers of their own.

Noise makes small sheets. One that stands out from its seams by less than --sliver is joined to the sheet it
continues, and a seam shorter than that is drawn together into one junction.

--voxels gives each voxel the number of the sheet or rod whose ball gives it its thickness. The volumes add up to the
label's. Guide: sheets.md

Examples:
  voxelcore sheets atlas.nii.gz --labels 4 -o sheets.vtp --table sheets.csv --graph sheets.graphml
  voxelcore sheets bone.nrrd -o sheets.vtp --voxels sheets.nii.gz --table sheets.csv
  voxelcore sheets core.vtp -o sheets.vtp --sliver 0.5mm)";

constexpr std::string_view kMeasureFooter =
  R"(OUT.csv writes OUT_branches.csv, OUT_summary.csv, and OUT_columns.json, which explains the columns.

Examples:
  voxelcore measure root.vtp -o root.csv --root top
  voxelcore measure vessels.vtp -o vessels.csv --prune-branches 5mm)";

constexpr std::string_view kRenderFooter =
  R"(Needs no screen: without a display it starts Xvfb. The projection is parallel, so the scale bar holds
everywhere. Letters name the patient's directions: left, right, anterior, posterior, superior, inferior. The
scan is read with the options recorded in the first file. The colour map is the middle of plasma: uniform, and
readable with colour blindness and in grey.

Examples:
  voxelcore render medial.vtp --scan scan.nii.gz -o medial.png
  voxelcore render core.vtp skeleton.vtp --scan root.nrrd --panels --color ErosionThickness -o root.png
  voxelcore render atlas.vtp --labels 4,7 --color Label --view front --background dark -o labels.png
  voxelcore render sure.vtp --color Confidence -o sure.png
  voxelcore render skeleton.vtp --turntable 36 -o turn.png)";

constexpr std::string_view kBatchFooter =
  R"(Folders are searched at any depth; one with several .tif or .png files is one scan. A manifest.csv has the
columns id, scan, and any option of 'voxelcore core' without dashes (lambda, labels, threshold, ...); an empty
field means not given. Commas, semicolons or tabs separate columns. Options on the command line apply to all
cases; a case's own take precedence.

Each case runs in its own process. A failure costs only that case, and the exit code is then 1. Run the same
command again to continue: finished cases are recognised by the content of scan, options and program. OUTDIR
gets a folder sub-<id>/ per case, cases.csv, labels.csv, columns.json, and index.html, which opens offline.

With --roots each case is one of 'voxelcore roots': a season of plants. labels.csv then holds their traits
(plant_...), and plants that stand out are marked.

With --thickness each case is one of 'voxelcore thickness'. Its folder gets the map; labels.csv holds the numbers
(thickness_...), and index.html shows them with a histogram.

On a cluster, run 'batch manifest.csv -o OUT --case $SLURM_ARRAY_TASK_ID' for each case, then 'batch
manifest.csv -o OUT --gather'. Applications/Snakemake does both.

Examples:
  voxelcore batch scans/ -o results --lambda 2vox
  voxelcore batch cohort.csv -o results --jobs 4 --memory 12GB --timeout 30m
  voxelcore batch 'scans/*.nii.gz' -o results --no-skeleton
  voxelcore batch season.csv --roots --up z+ -o season/
  voxelcore batch bones/ --thickness --separation hull -o thickness/)";

constexpr std::string_view kStraightenFooter =
  R"(The result is a straight volume: its third axis is the length along the vessel, and its first two lie across it.
Planes do not turn about the axis, so a straight feature of the vessel stays straight. The axis runs through their
middle: it is the skeleton, smoothed over twice its radius to each side. The scan may be grey or labels, on any grid, as
long as it lies in the same place as the scan of the skeleton. Guide: vessels.md

--table says where each plane lies. A point (across, up, arc) of the straight volume is place + across * its first
direction + up * its second one, in LPS mm. --points maps points there or back.

Examples:
  voxelcore straighten chest.nii.gz aorta.vtp --branch 0 -o straight.nrrd --table straight.csv
  voxelcore straighten chest.nii.gz aorta.vtp --from 5,16,16 --to 27,16,16 --spacing 0.5 -o straight.nrrd)";

constexpr std::string_view kCompareFooter =
  R"(A is the reference. Two masks on one grid get, label by label, Dice, distances of their surfaces, topology numbers
(6- and 26-connected) with their differences, clDice of their certified skeletons, and the pieces, loops and cavities
that differ, with places. Where only their boxes differ, what both hold is compared.

Two skeletons get branches and length detected, leakage, tips and bifurcations found, missed and invented, and
distances of axes and radii. A place is found where the other axis passes within A's radius there; a branch where one
connected run of the other follows 80 % of it. A mask is compared with a skeleton by its own skeleton. Two medial
surfaces get distances and coverage. Guide: compare.md

Examples:
  voxelcore compare truth.nii.gz network.nii.gz --table compared.csv
  voxelcore compare truth.nii.gz network.nii.gz --labels 1 --no-skeletons --report compared.json
  voxelcore compare traced.swc aorta.vtp -o found.vtp --table trees.csv
  voxelcore compare core.vtp medial.vtp --near 0.5mm)";

constexpr std::array<Command, 16> kCommands{ {
  { CommandId::Core, "core", "Compute the medial surface of one, several or all labels of a scan", kCoreFooter },
  { CommandId::Skeleton, "skeleton", "Compute the curve skeleton of a scan or of a medial surface", kSkeletonFooter },
  { CommandId::Roots, "roots", "Find the roots of a plant in a CT or MRI scan, and measure them", kRootsFooter },
  { CommandId::Thickness, "thickness", "Measure the local thickness of labels at every voxel", kThicknessFooter },
  { CommandId::Sheets, "sheets", "Cut medial surfaces into sheets, seams and rods, and measure them", kSheetsFooter },
  { CommandId::Info, "info", "Show what is in a scan, and the time and memory it will need", kInfoFooter },
  { CommandId::Verify, "verify", "Recheck a medial surface against its scan", kVerifyFooter },
  { CommandId::Render, "render", "Draw pictures of medial surfaces and skeletons", kRenderFooter },
  { CommandId::Measure, "measure", "Write tables of a skeleton's branches", kMeasureFooter },
  { CommandId::Straighten, "straighten", "Resample a scan along a vessel of its skeleton", kStraightenFooter },
  { CommandId::Compare, "compare", "Compare two masks, skeletons or medial surfaces", kCompareFooter },
  { CommandId::Prune, "prune", "Prune a medial surface further, without its scan", kPruneFooter },
  { CommandId::Batch,
    "batch",
    "Process many scans: medial surfaces, skeletons, tables and an overview page",
    kBatchFooter },
  { CommandId::Reconstruct, "reconstruct", "Rebuild a volume from the balls of a medial surface", kReconstructFooter },
  { CommandId::Voxelize, "voxelize", "Convert a triangle mesh to a volume", kVoxelizeFooter },
  { CommandId::Phantom, "phantom", "Make a synthetic volume", kPhantomFooter },
} };

} // namespace

std::span<const Command>
Commands()
{
  return kCommands;
}

} // namespace voxelcore
