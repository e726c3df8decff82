#include "voxelcore/Parameters.h"

#include <array>

namespace voxelcore
{

namespace
{

constexpr std::uint32_t kCore = static_cast<std::uint32_t>(CommandId::Core);
constexpr std::uint32_t kInfo = static_cast<std::uint32_t>(CommandId::Info);
constexpr std::uint32_t kVerify = static_cast<std::uint32_t>(CommandId::Verify);
constexpr std::uint32_t kPrune = static_cast<std::uint32_t>(CommandId::Prune);
constexpr std::uint32_t kPhantom = static_cast<std::uint32_t>(CommandId::Phantom);
constexpr std::uint32_t kSkeleton = static_cast<std::uint32_t>(CommandId::Skeleton);
constexpr std::uint32_t kMeasure = static_cast<std::uint32_t>(CommandId::Measure);
constexpr std::uint32_t kRender = static_cast<std::uint32_t>(CommandId::Render);
constexpr std::uint32_t kBatch = static_cast<std::uint32_t>(CommandId::Batch);
constexpr std::uint32_t kReconstruct = static_cast<std::uint32_t>(CommandId::Reconstruct);
constexpr std::uint32_t kVoxelize = static_cast<std::uint32_t>(CommandId::Voxelize);
constexpr std::uint32_t kReads = kCore | kInfo | kSkeleton;
constexpr std::uint32_t kModels = kCore | kPrune;
constexpr std::uint32_t kBranches = kSkeleton | kMeasure;
constexpr std::uint32_t kStages = kCore | kSkeleton;
constexpr std::uint32_t kWrites = kModels | kPhantom | kBranches | kRender | kReconstruct | kVoxelize;
constexpr std::uint32_t kAll =
  kCore | kInfo | kVerify | kPrune | kPhantom | kBranches | kRender | kReconstruct | kVoxelize;

constexpr std::string_view kCoreFooter =
  R"(Lambda says how much is pruned: all of the surface stays whose nearest boundary points lie at least 2 lambda apart.
A value needs a unit: 1.5mm, 2.5vox (times the smallest spacing), 2.5% (of the longest side of the label's box); a bare
number is mm; 0 keeps the whole voxel core. Pruning never changes the topology.
  1.5vox, the default, clears most of the staircase noise and keeps parts three voxels thick.
  Above 2.44vox (cubic voxels) the pruned core is proven to converge as scans get finer, but thin parts shrink to curves.
  On thick slices the smallest spacing does not clear the staircase across slices; give mm there, about 1.5 slices.

Bumps, in place of lambda, serve thick and thin parts at once: bumps on the boundary lower than the height are ignored, and
the balls of what stays rebuild the boundary to within it, which is checked. 1.2diag suits clean segmentations; raise it
where the segmentation is rougher than its voxels. 'Bump' in .vtp and .vtk is the height at which each element goes: a
threshold on it shows any greater height; what stays for ever has the length of the scan's diagonal. A --lambda given
with --bumps is a floor: what it prunes goes first, and nothing is promised of that.

Only the part that --crop names is looked at. A crop cuts: what it cuts through ends there, and a cavity it opens is none.
Edits are then done label by label in the order --mend-shape, --fill-cavities, --min-voxels, --largest, --smooth-shape,
--split-components. Components are connected through faces (6-connected); equally large ones keep the order of the scan.
What is in a label's cavity, other labels too, is filled.

--smooth-shape and --mend-shape are for noisy masks. Smoothing flips single voxels that stand out of the boundary around
them; pieces, loops and cavities stay as they are, nothing moves by more than a voxel's diagonal. Of clean bodies, too, a
boundary voxel in 200 or so changes. Where noise has cut or pierced thin parts, mending goes before: it joins pieces one voxel apart, fills holes a voxel wide
and takes away bridges of one voxel over a bay. True holes of that size go, too. The report says what was changed.

--with-skeleton writes what 'voxelcore skeleton' would, from the same computation: OUT_skeleton.vtp beside OUT, in a folder
<scan>_label-<value>_skeleton.vtp. The options about branches are explained there.

--refine is for smooth shapes at coarse resolution. Topology is kept; no vertex leaves the shape, moves by more than a voxel,
or turns a face over. Faces become triangles; Radius and Lambda are measured from the estimated surface. Where parts are
thinner than three voxels and at sharp edges it gains nothing. 'grey' takes the scan's own values with --threshold.

Examples:
  voxelcore core scan.nii.gz -o medial.vtp --report medial.json
  voxelcore core scan.seg.nrrd --labels liver,4 --lambda 0,1mm,2.5% -o medial.vtp
  voxelcore core scan.nii.gz --bumps 1.2diag -o medial.vtp
  voxelcore core atlas.nii.gz -o surfaces/
  voxelcore core ct.nrrd --threshold 300:3000 --lambda 2vox -o bone.vtp
  voxelcore core slices/ --spacing 0.5,0.5,2 --binary -o part.vtp
  voxelcore core ct.nrrd --threshold 300:3000 --fill-cavities --min-voxels 100 -o bone.vtp
  voxelcore core root.nii.gz -o root.vtp --with-skeleton --also csv --root top
  voxelcore core huge.nrrd --blocks 8 --block 1 -o parts/     (and so on to --block 8, on any machines)
  voxelcore core huge.nrrd --join parts/ -o huge.vtp
  voxelcore core teeth.nii.gz --crop 100:300,80:220,: --split-components -o teeth/
  voxelcore core ct.nrrd --threshold 300:inf --lambda 2.5vox --refine grey -o bone.vtp
  voxelcore core part.stl --resolution 256 --lambda 2.5% -o part.vtp
  voxelcore core part.ply --resolution 256,512,1024 --lambda 1%,2.5% -o study/   (each, and one table)

A mesh (.stl .obj .ply .off .vtk .vtp) is made voxels first, as 'voxelcore voxelize' does.)";

constexpr std::string_view kInfoFooter = R"(Examples:
  voxelcore info scan.nii.gz
  voxelcore info ct.nrrd --threshold 300:3000 --json)";

constexpr std::string_view kVerifyFooter =
  R"(Checks by other means than those that made the file: every vertex inside the shape and equidistant to its nearest
boundary vertices, none nearer; faces planar and convex; measures; order; topology. Exit code 4 when a check fails.
The scan is read with the options recorded in the file.

Example:
  voxelcore verify scan.nii.gz medial.vtp)";

constexpr std::string_view kPruneFooter =
  R"(Gives the same bits as 'voxelcore core' at that lambda or bump height, without the scan. For --lambda
the file must be made with --keep-edges; for --bumps with --bumps, at a smaller height, best 0.

Example:
  voxelcore core scan.nii.gz --lambda 0 --keep-edges -o whole.vtp
  voxelcore prune whole.vtp --lambda 1.5mm,3mm -o medial.vtp
  voxelcore core scan.nii.gz --bumps 0 -o bumps.vtp
  voxelcore prune bumps.vtp --bumps 1diag,2diag -o medial.vtp)";

constexpr std::string_view kReconstructFooter =
  R"(A voxel is in where its centre lies in a ball of the core. A whole core of cubic voxels gives its label back; pruned,
it shows what was taken for noise. On thick slices balls bulge out between the slices' corners.

Example:
  voxelcore core scan.nii.gz --bumps 1.2diag -o medial.vtp
  voxelcore reconstruct medial.vtp -o rebuilt.nii.gz --scan scan.nii.gz --report rebuilt.json)";

constexpr std::string_view kVoxelizeFooter =
  R"(A voxel is in where its centre is, decided exactly: no crossing is missed or counted twice, and a centre on the surface
counts as if moved by (e, e^2, e^3). The grid begins at the minimum corner of the mesh's box; coordinates are LPS mm.
Parts that overlap are one; a part inside out within another is a cavity. Faces that are turned, doubled or without area are
set right. An open surface is decided by the votes of six rays along the axes. What was done and how many voxels are
doubtful is said, and stands in the report. A mesh that bounds nothing is refused.

Examples:
  voxelcore voxelize part.stl --resolution 256 -o part.nrrd
  voxelcore voxelize part.obj --spacing 0.5,0.5,1 -o part.nii.gz --report part.json
  voxelcore voxelize part.ply --resolution 64,128,256 -o part.mha)";

constexpr std::string_view kPhantomFooter = R"(Examples:
  voxelcore phantom ellipsoid --size 64 -o ellipsoid.nrrd
  voxelcore phantom root --size 256,256,512 --spacing 0.1,0.1,0.1 --seed 7 -o root.nii.gz)";

constexpr std::string_view kSkeletonFooter =
  R"(A branch is there when it stands out: from the part it springs from by at least --stand-out, more than a corner of 90
degrees does. The skeleton has the components and cycles of the shape, which is checked. Surfaces around cavities cannot
become curves; they stay, and that is said. With --plates parts flatter than that stay as surfaces.
The core is not pruned first (--lambda 0): what stands out is judged on all of it, and parts two voxels thick stay.
Radii in tables are those of the body that was scanned: the largest ball in voxels and a quarter of a voxel's diagonal.

--also writes beside OUT.vtp, by the ending: csv (OUT_branches.csv, OUT_summary.csv and OUT_columns.json, which explains
them), swc (micrometres; cycles are cut), mrk.json (Slicer curves), graphml, ma (with .r: the core, for other programs).
Into a folder go <scan>_label-<value>_skeleton.vtp and so on; tables of all labels are <scan>_skeleton_branches.csv.

Examples:
  voxelcore skeleton root.nii.gz -o root.vtp --also csv,swc --root top
  voxelcore skeleton core.vtp -o skeleton.vtp --report skeleton.json
  voxelcore skeleton atlas.nii.gz -o skeletons/ --also csv
  voxelcore skeleton vessels.seg.nrrd --prune-branches 1.5r --also mrk.json -o vessels.vtp
  voxelcore skeleton bone.nrrd --plates 4vox -o rods-and-plates.vtp)";

constexpr std::string_view kMeasureFooter = R"(Tables from a finished skeleton; OUT.csv gives OUT_branches.csv,
OUT_summary.csv and OUT_columns.json, which explains them.

Examples:
  voxelcore measure root.vtp -o root.csv --root top
  voxelcore measure vessels.vtp -o vessels.csv --prune-branches 5mm)";

constexpr std::string_view kRenderFooter =
  R"(Draws without a screen: where there is no display it starts Xvfb for the time
being. The scale bar holds everywhere in the picture (parallel projection); the letters are the patient's: left, right,
anterior, posterior, superior, inferior. The scan is read with the options recorded in the first file.
The colour map (viridis) is uniform to the eye and readable with any colour blindness and in grey.

Examples:
  voxelcore render medial.vtp --scan scan.nii.gz -o medial.png
  voxelcore render core.vtp skeleton.vtp --scan root.nrrd --panels --color ErosionThickness -o root.png
  voxelcore render atlas.vtp --labels 4,7 --color Label --view front --background dark -o labels.png
  voxelcore render skeleton.vtp --turntable 36 -o turn.png)";

constexpr std::string_view kBatchFooter =
  R"(INPUT: scans; folders, in which scans are looked for at any depth (one that holds several .tif or .png is one scan, a
stack); quoted patterns, each match of which is a scan; a manifest.csv with the columns id, scan and any option of
'voxelcore core' without its dashes (lambda, labels, spacing, threshold, with-skeleton, ...), empty where it is not given.
The other options hold for all cases; a case's own come first. Skeletons are made too, with tables and SWC.

Each case is a process of its own and costs only itself when it fails; exit code 1 when one did. OUTDIR gets sub-<id>/ with
sub-<id>_medial.vtp, _skeleton.vtp, _skeleton.swc, _report.json and more, cases.csv and labels.csv with every number of the
reports, and index.html, which opens without a network. Run again, only that is done which is not done yet, decided by the
content of the scan, the options and the program; however it was stopped.

On a cluster: 'batch manifest.csv -o OUT --case $SLURM_ARRAY_TASK_ID' for each case, then 'batch manifest.csv -o OUT
--gather'. Applications/Snakemake does both.

Examples:
  voxelcore batch scans/ -o results --lambda 2vox
  voxelcore batch cohort.csv -o results --jobs 4 --memory 12GB --timeout 30m
  voxelcore batch 'scans/*.nii.gz' -o results --no-skeleton)";

constexpr std::array<Command, 11> kCommands{ {
  { CommandId::Core, "core", "Medial surface of one, several or all labels of a scan", kCoreFooter },
  { CommandId::Info, "info", "What is in a scan: geometry, labels, their sizes and topology", kInfoFooter },
  { CommandId::Verify, "verify", "Recheck a finished file against its scan", kVerifyFooter },
  { CommandId::Prune, "prune", "Prune a finished file further, without its scan", kPruneFooter },
  { CommandId::Skeleton, "skeleton", "Curve skeleton of a scan or of a finished core", kSkeletonFooter },
  { CommandId::Measure, "measure", "Tables of a finished skeleton's branches", kMeasureFooter },
  { CommandId::Render, "render", "Picture of finished files", kRenderFooter },
  { CommandId::Batch,
    "batch",
    "Medial surfaces and skeletons of a cohort of scans, with tables and a page",
    kBatchFooter },
  { CommandId::Reconstruct, "reconstruct", "The balls of a finished core as a volume", kReconstructFooter },
  { CommandId::Voxelize, "voxelize", "Make a volume of a triangle mesh", kVoxelizeFooter },
  { CommandId::Phantom, "phantom", "Make a synthetic volume", kPhantomFooter },
} };

using enum ParameterKind;

constexpr auto kParameters = std::to_array<Parameter>({
  { "scan",
    "",
    Input,
    "SCAN",
    "",
    true,
    kCore | kInfo | kVerify,
    "Scan: .nrrd .nhdr .seg.nrrd .nii .nii.gz .mha .mhd .tif, or a folder or 'pattern*' of TIFF or PNG slices; or a "
    "mesh: .stl .obj .ply .off .vtk .vtp" },
  { "mesh", "", Input, "MESH", "", true, kVoxelize, "Closed triangle mesh: .stl .obj .ply .off .vtk .vtp" },
  { "scan",
    "",
    Input,
    "SCAN|CORE.vtp",
    "",
    true,
    kSkeleton,
    "Scan or mesh, as for 'voxelcore core', or a .vtp that 'voxelcore core' wrote; with --resolution .vtp is a mesh" },
  { "skeleton", "", Input, "SKELETON.vtp", "", true, kMeasure, "File that 'voxelcore skeleton' wrote" },
  { "core", "", Input, "CORE.vtp", "", true, kVerify | kPrune | kReconstruct, "File that 'voxelcore core' wrote" },
  { "files",
    "",
    Inputs,
    "FILE...",
    "",
    true,
    kRender,
    "Files that 'voxelcore core' and 'voxelcore skeleton' wrote, .vtp; of one label they are drawn into each other" },
  { "output", "-o,--output", Output, "OUT.png", "", true, kRender, "Picture; with --turntable OUT_000.png and so on" },
  { "scan-file", "--scan", Input, "SCAN", "", false, kRender, "Draw the surface of the scan's labels around them" },
  { "labels", "--labels", Text, "all|N,NAME,..", "all", false, kRender, "Labels to draw, by value or name" },
  { "view",
    "--view",
    Choice,
    "front|top|iso|auto",
    "auto",
    false,
    kRender,
    "From anterior, from superior, from anterior left above, or from where most is to be seen" },
  { "color",
    "--color",
    Choice,
    "Radius|Lambda|ErosionThickness|Label",
    "Radius",
    false,
    kRender,
    "What colours mean: lengths in mm, or labels" },
  { "range",
    "--range",
    Text,
    "LO:HI",
    "",
    false,
    kRender,
    "Lengths in mm from one end of the colour bar to the other" },
  { "size", "--size", Text, "WxH", "1600x1200", false, kRender, "Size in pixels" },
  { "background", "--background", Choice, "white|dark", "white", false, kRender, "Background" },
  { "tubes", "--tubes", Real, "F", "0.5", false, kRender, "Curves are tubes of so many times their radius" },
  { "panels", "--panels", Flag, "", "", false, kRender, "Side by side: surface, medial surface, curve skeleton" },
  { "turntable", "--turntable", Integer, "N", "1", false, kRender, "N pictures of a full turn" },
  { "inputs", "", Inputs, "INPUT...", "", false, kBatch, "Scans, folders, 'patterns*', or a manifest.csv" },
  { "output", "-o,--output", Output, "OUTDIR", "", true, kBatch, "Folder for all results" },
  { "jobs",
    "-j,--jobs",
    Integer,
    "N",
    "0",
    false,
    kBatch,
    "Cases side by side; 0 means as many as there are processors" },
  { "memory",
    "--memory",
    Text,
    "SIZE",
    "",
    false,
    kBatch,
    "For all cases together: 12GB, 500MB; by default 9/10 of what is free" },
  { "timeout",
    "--timeout",
    Text,
    "TIME",
    "",
    false,
    kBatch,
    "What a case may take: 90s, 10m, 2h; by default as long as it likes" },
  { "no-skeleton", "--no-skeleton", Flag, "", "", false, kBatch, "Medial surfaces alone, no skeletons" },
  { "html", "--html", Flag, "", "", false, kBatch, "A page per case that shows it in 3-D, linked from index.html" },
  { "case", "--case", Integer, "K", "", false, kBatch, "Run only number K of the cases, from 1, and write no tables" },
  { "gather", "--gather", Flag, "", "", false, kBatch, "Run nothing; write tables and page of what is in OUTDIR" },
  { "list", "--list", Flag, "", "", false, kBatch, "Run nothing; print number, folder and id of each case" },
  { "kind", "", Text, "KIND", "", true, kPhantom, "What to make; 'list' names the kinds" },
  { "output",
    "-o,--output",
    Output,
    "OUT",
    "",
    true,
    kCore,
    "Result: .vtp .vtk .ply .obj .stl .ma; or a folder, DIR/, for one .vtp per label" },
  { "output",
    "-o,--output",
    Output,
    "OUT.vtp",
    "",
    true,
    kSkeleton,
    "Result: .vtp; or a folder, DIR/, for one .vtp per label" },
  { "output", "-o,--output", Output, "OUT", "", true, kMeasure, "Result: .csv, or .vtp" },
  { "output", "-o,--output", Output, "OUT", "", true, kPrune, "Result: .vtp .vtk .ply .obj .stl .ma" },
  { "output", "-o,--output", Output, "OUT", "", true, kReconstruct, "Volume: .nrrd .nii .nii.gz .mha .mhd .tif" },
  { "like",
    "--like",
    Input,
    "SCAN",
    "",
    false,
    kReconstruct,
    "Make it on this scan's grid; else on that of the core's" },
  { "scan", "--scan", Input, "SCAN", "", false, kReconstruct, "Compare with the scan the core was made from" },
  { "report", "--report", Output, "OUT.json", "", false, kReconstruct, "Write what was found as JSON" },
  { "output",
    "-o,--output",
    Output,
    "OUT",
    "",
    true,
    kVoxelize,
    "Volume: .nrrd .nii .nii.gz .mha .mhd .tif; of several resolutions OUT_resolution-256.nrrd and so on" },
  { "report", "--report", Output, "OUT.json", "", false, kVoxelize, "Write what was found and made as JSON" },
  { "resolution",
    "--resolution",
    Text,
    "N[,N..]",
    "",
    false,
    kReads | kVoxelize,
    "Of a mesh: voxels on its longest side; several give OUT_resolution-256.vtp and so on, and one table" },
  { "spacing", "--spacing", Text, "H|X,Y,Z", "", false, kVoxelize, "Voxel size in mm" },
  { "output", "-o,--output", Output, "OUT", "", false, kPhantom, "Volume: .nrrd .nii .nii.gz .mha .mhd .tif" },
  { "lambda",
    "-l,--lambda",
    Text,
    "L[,L..]",
    "1.5vox",
    false,
    kCore,
    "Pruning threshold with its unit: 1.5mm, 2.5vox, 2.5%, 0; several give OUT_lambda-1mm.vtp and so on" },
  { "lambda",
    "-l,--lambda",
    Text,
    "L[,L..]",
    "",
    false,
    kPrune,
    "Pruning threshold with its unit: 1.5mm, 2.5vox, 2.5%; several give OUT_lambda-1mm.vtp and so on" },
  { "bumps",
    "--bumps",
    Text,
    "H[,H..]",
    "",
    false,
    kModels,
    "Prune by bump height instead: 1.2diag (voxel diagonals), 2vox, 1.5mm; several give OUT_bumps-1.2diag.vtp and so "
    "on" },
  { "lambda",
    "-l,--lambda",
    Text,
    "L",
    "0",
    false,
    kSkeleton,
    "Prune the core first, with unit: 1.5mm, 2.5vox, 2.5%; only for scans" },
  { "bumps",
    "--bumps",
    Text,
    "H",
    "",
    false,
    kSkeleton,
    "Prune the core by bump height first: 1.2diag (voxel diagonals), 2vox, 1.5mm; only for scans. Tips draw back by "
    "it" },
  { "refine",
    "--refine",
    Choice,
    "off|labels|grey|mesh",
    "off",
    false,
    kCore,
    "Move the core, within a voxel, towards the axis of the smooth surface that labels, grey values or the mesh show" },
  { "grey", "--grey", Input, "SCAN", "", false, kCore, "With --refine grey: the grey scan the labels were made of" },
  { "grey-range",
    "--grey-range",
    Text,
    "LO:HI",
    "",
    false,
    kCore,
    "With --grey: the labels are where values are within" },
  { "with-skeleton",
    "--with-skeleton",
    Flag,
    "",
    "",
    false,
    kCore,
    "Curve skeletons too, of the whole core: OUT_skeleton.vtp, as 'voxelcore skeleton' writes it" },
  { "stand-out",
    "--stand-out",
    Text,
    "L",
    "3vox",
    false,
    kStages,
    "Branches stand out by at least so much, with unit: 1.5mm, 3vox, 2.5%" },
  { "plates",
    "--plates",
    Text,
    "L",
    "",
    false,
    kStages,
    "Surfaces at least so erosion-thick stay, with unit; by default all become curves" },
  { "smooth",
    "--smooth",
    Text,
    "L",
    "6vox",
    false,
    kStages,
    "Fit branches over so much before and behind each point; none moves off by more than half a voxel; 0: do not" },
  { "prune-branches",
    "--prune-branches",
    Text,
    "L|Nr",
    "1r",
    false,
    kStages,
    "Take off branches with a tip that are shorter: 5mm, 8vox, or 1.5r (times the radius where they begin); 0: none" },
  { "prune-branches",
    "--prune-branches",
    Text,
    "L|Nr",
    "",
    false,
    kMeasure,
    "Take off branches with a tip that are shorter: 5mm, 8vox, or 1.5r (times the radius where they begin)" },
  { "cut-loops",
    "--cut-loops",
    Flag,
    "",
    "",
    false,
    kStages | kMeasure,
    "Cut each cycle at its thinnest branch; says where" },
  { "split-at-junctions",
    "--split-at-junctions",
    Flag,
    "",
    "",
    false,
    kStages | kMeasure,
    "Give each branch end points of its own, so that branches do not hang together" },
  { "root",
    "--root",
    Text,
    "X,Y,Z|top|thickest",
    "thickest",
    false,
    kStages | kMeasure,
    "Where the hierarchy begins: the tip nearest to a point (LPS mm), the highest, or that of the thickest branch" },
  { "also",
    "--also",
    Text,
    "csv,swc,..",
    "",
    false,
    kStages | kMeasure,
    "Further files beside the result: csv, swc, mrk.json, graphml, ma" },
  { "labels",
    "--labels",
    Text,
    "all|N,NAME,..",
    "all",
    false,
    kReads,
    "Labels to work on, by value or name; all means all but 0" },
  { "binary", "--binary", Flag, "", "", false, kReads, "All values but 0 are one shape" },
  { "threshold", "--threshold", Text, "LO:HI", "", false, kReads, "Grey scan: voxels with LO <= value <= HI" },
  { "crop",
    "--crop",
    Text,
    "I0:I1,J0:J1,K0:K1",
    "",
    false,
    kReads,
    "Work on a part of the scan: voxels I0 to I1-1, from 0; a side left out means the scan's" },
  { "mend-shape",
    "--mend-shape",
    Flag,
    "",
    "",
    false,
    kReads,
    "Noisy masks: join pieces one voxel apart, fill holes and bays that one voxel has bridged or pierced" },
  { "fill-cavities",
    "--fill-cavities",
    Flag,
    "",
    "",
    false,
    kReads,
    "Fill each label's cavities (background that does not reach the outside, even over corners)" },
  { "min-voxels", "--min-voxels", Integer, "N", "", false, kReads, "Remove components of fewer than N voxels" },
  { "largest", "--largest", Integer, "N", "", false, kReads, "Keep the N largest components of each label" },
  { "smooth-shape",
    "--smooth-shape",
    Flag,
    "",
    "",
    false,
    kReads,
    "Noisy masks: flip single rough voxels at the boundary; pieces, loops and cavities stay as they are" },
  { "split-components",
    "--split-components",
    Flag,
    "",
    "",
    false,
    kReads,
    "Treat each component of a label by itself, named NAME#1, NAME#2, ... by size" },
  { "volume", "--volume", Integer, "N", "", false, kReads, "Which volume of a 4-D file, from 0" },
  { "component",
    "--component",
    Integer,
    "N",
    "",
    false,
    kReads,
    "Which of the values a voxel of a colour image or of vectors has, from 0" },
  { "spacing",
    "--spacing",
    Text,
    "X,Y,Z",
    "",
    false,
    kReads,
    "Voxel size in mm, instead of the file's; of a mesh also a single number" },
  { "orthonormalize",
    "--orthonormalize",
    Flag,
    "",
    "",
    false,
    kReads,
    "Accept skewed axes: take the nearest orthonormal ones, and record it" },
  { "nifti-form",
    "--nifti-form",
    Choice,
    "auto|sform|qform",
    "auto",
    false,
    kReads,
    "Which of a NIfTI file's two geometries; auto does as ITK and Slicer do" },
  { "keep-edges",
    "--keep-edges",
    Flag,
    "",
    "",
    false,
    kModels,
    "Store the measures of all edges, so that 'voxelcore prune' can work on the file" },
  { "triangles", "--triangles", Flag, "", "", false, kModels, "Write triangles instead of polygons" },
  { "table",
    "--table",
    Output,
    "OUT.csv",
    "",
    false,
    kCore | kSkeleton,
    "Table: a row per label, of skeletons per branch" },
  { "scene",
    "--scene",
    Output,
    "OUT.mrml|OUT.mrb",
    "",
    false,
    kCore | kSkeleton,
    "Scene for 3D Slicer: segmentation, models and curves with names and colours" },
  { "html",
    "--html",
    Output,
    "OUT.html",
    "",
    false,
    kCore | kSkeleton,
    "Page that shows the result in any browser, offline" },
  { "html-triangles",
    "--html-triangles",
    Integer,
    "N",
    "300000",
    false,
    kCore | kSkeleton | kBatch,
    "Show about so many triangles in the page; larger results are decimated for it" },
  { "report", "--report", Output, "OUT.json", "", false, kModels | kSkeleton, "Write what was done and found as JSON" },
  { "size", "--size", Text, "N|X,Y,Z", "64", false, kPhantom, "Size in voxels" },
  { "spacing", "--spacing", Text, "X,Y,Z", "1,1,1", false, kPhantom, "Voxel size in mm" },
  { "seed", "--seed", Integer, "N", "1", false, kPhantom, "For the kinds that use chance: porous, noise, root, cells" },
  { "radius", "--radius", Real, "MM", "", false, kPhantom, "Radius; the default depends on the kind" },
  { "thickness", "--thickness", Real, "MM", "", false, kPhantom, "Thickness; the default depends on the kind" },
  { "period", "--period", Real, "MM", "", false, kPhantom, "Period of the gyroid, or distance of porous' grains" },
  { "density", "--density", Real, "0..1", "", false, kPhantom, "Part of the volume that is in, for porous and noise" },
  { "detail", "--detail", Real, "MM", "", false, kPhantom, "Smallest radius of a root" },
  { "laterals", "--laterals", Integer, "N", "", false, kPhantom, "Laterals on the stem of a root" },
  { "sub-laterals", "--sub-laterals", Integer, "N", "", false, kPhantom, "Laterals on each of these" },
  { "cells", "--cells", Integer, "N", "", false, kPhantom, "Bodies in the volume, for the kind cells" },
  { "centre-lines",
    "--centre-lines",
    Output,
    "OUT.swc",
    "",
    false,
    kPhantom,
    "Write the true centre lines of a root (SWC, micrometres, LPS)" },
  { "engine",
    "--engine",
    Choice,
    "auto|lattice|tetgen",
    "auto",
    false,
    kCore | kSkeleton,
    "Delaunay engine; the result is the same" },
  { "cross-check",
    "--cross-check",
    Flag,
    "",
    "",
    false,
    kCore,
    "Run both engines for each label and compare what they find bit for bit" },
  { "memory",
    "--memory",
    Text,
    "8GB",
    "",
    false,
    kCore,
    "Refuse at once what is expected to need more; see 'voxelcore info'" },
  { "blocks",
    "--blocks",
    Integer,
    "N",
    "",
    false,
    kCore,
    "With --block K: cut each label into N blocks and write number K, from 1, into the folder OUT/" },
  { "block", "--block", Integer, "K", "", false, kCore, "Which of the --blocks; each can run on a machine of its own" },
  { "join",
    "--join",
    Input,
    "DIR",
    "",
    false,
    kCore,
    "Take what all --block runs wrote into DIR; the result is that of a single run" },
  { "threads", "--threads", Integer, "N", "0", false, kAll, "Processors to use; 0 means all" },
  { "json", "--json", Flag, "", "", false, kInfo, "Print JSON" },
  { "force", "--force", Flag, "", "", false, kWrites, "Replace existing files" },
  { "progress",
    "--progress",
    Choice,
    "bar|plain|json|none",
    "",
    false,
    kAll,
    "Progress on stderr; by default a bar on a terminal, else none" },
  { "quiet", "-q,--quiet", Flag, "", "", false, kAll, "Print nothing but errors" },
});

} // namespace

std::span<const Command>
Commands()
{
  return kCommands;
}

std::span<const Parameter>
Parameters()
{
  return kParameters;
}

} // namespace voxelcore
