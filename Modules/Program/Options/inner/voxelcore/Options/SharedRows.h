#pragma once
// Options that several commands share: a command's options are some of these and its own, joined.

#include "voxelcore/Options/CommandTable.h"

#include <array>

namespace voxelcore::table
{

inline constexpr const char * kConnectivityHelp =
  "Which voxels hang together: 6, those that share a face; 26, those that touch over edges and corners, too: the least "
  "change makes them share faces and alters no piece, loop or cavity of the mask; joined: pieces that touch are "
  "joined, and nothing else changes";

inline constexpr auto kScanArgument = std::to_array<Parameter>({
  { "scan",
    "",
    Input,
    "SCAN",
    "",
    true,
    Group::Input,
    "Segmented scan (.nrrd .nhdr .seg.nrrd .nii .nii.gz .hdr .mha .mhd .mgz .npy .tif .png, OME-Zarr, DICOM, .mrc "
    ".mnc .gipl, ...), folder or 'pattern*' of slices, or mesh (.stl .obj .ply .off .vtk .vtp)" },
});

inline constexpr auto kScanOrCoreArgument = std::to_array<Parameter>({
  { "scan",
    "",
    Input,
    "SCAN|CORE.vtp",
    "",
    true,
    Group::Input,
    "Scan or mesh, as for 'voxelcore core', or a medial surface it wrote (.vtp .vtk); with --resolution, that is read "
    "as a mesh" },
});

inline constexpr auto kSkeletonArgument = std::to_array<Parameter>({
  { "skeleton", "", Input, "SKELETON.vtp", "", true, Group::Input, "Skeleton written by 'voxelcore skeleton'" },
});

inline constexpr auto kCoreArgument = std::to_array<Parameter>({
  { "core", "", Input, "CORE.vtp", "", true, Group::Input, "Medial surface written by 'voxelcore core'" },
});

inline constexpr auto kLabelRows = std::to_array<Parameter>({
  { "labels",
    "--labels",
    Text,
    "all|N,NAME,..",
    "all",
    false,
    Group::Input,
    "Labels to use, by value or name; 'all' means all but 0",
    "label" },
  { "binary", "--binary", Flag, "", "", false, Group::Input, "Treat all values but 0 as one shape", "label='any'" },
  { "threshold",
    "--threshold",
    Text,
    "LO:HI",
    "",
    false,
    Group::Input,
    "Segment a grey scan: take voxels with LO <= value <= HI, such as 300:inf",
    "threshold" },
  { "spacing",
    "--spacing",
    Text,
    "H|X,Y,Z",
    "",
    false,
    Group::Input,
    "Use this voxel size instead of the file's: one number or three, in mm or with a unit, such as 50um",
    "spacing" },
});

inline constexpr auto kResolutionRows = std::to_array<Parameter>({
  { "resolution",
    "--resolution",
    Text,
    "N",
    "",
    false,
    Group::Input,
    "Voxelize a mesh with N voxels along its longest side" },
});

inline constexpr auto kValueRows = std::to_array<Parameter>({
  { "dataset",
    "--dataset",
    Text,
    "NAME",
    "",
    false,
    Group::Input,
    "Read this array of an HDF5 or .vti file that holds several" },
  { "volume", "--volume", Integer, "N", "", false, Group::Input, "Volume of a 4-D file to read, counted from 0" },
  { "component",
    "--component",
    Integer,
    "N",
    "",
    false,
    Group::Input,
    "Channel of a colour or vector scan to read, counted from 0" },
  { "level",
    "--level",
    Integer,
    "N",
    "",
    false,
    Group::Input,
    "Resolution of an OME-Zarr image to read, counted from 0, the finest" },
  { "raw",
    "--raw",
    Text,
    "I,J,K,TYPE[,big]",
    "",
    false,
    Group::Input,
    "Read bare voxels: the sides and the type, such as 512,512,300,uint16; give --spacing, too" },
  { "orthonormalize",
    "--orthonormalize",
    Flag,
    "",
    "",
    false,
    Group::Input,
    "Accept skewed axes: use the nearest orthonormal ones and record that",
    "orthonormalize" },
  { "nifti-form",
    "--nifti-form",
    Choice,
    "auto|sform|qform",
    "auto",
    false,
    Group::Input,
    "Choose between the two geometries of a NIfTI file; auto follows ITK and Slicer" },
});

inline constexpr auto kMeshRows = std::to_array<Parameter>({
  { "cap", "--cap", Flag, "", "", false, Group::Input, "Close the holes of a mesh" },
  { "cover",
    "--cover",
    Flag,
    "",
    "",
    false,
    Group::Input,
    "Take every voxel that a mesh touches, too, so that parts thinner than a voxel stay" },
});

inline constexpr auto kShapeRows = std::to_array<Parameter>({
  { "crop",
    "--crop",
    Text,
    "I0:I1,J0:J1,K0:K1",
    "",
    false,
    Group::Input,
    "Use only voxels I0 to I1-1, J0 to J1-1, K0 to K1-1, counted from 0; an empty side means the scan's edge",
    "crop" },
  { "smooth-shape",
    "--smooth-shape",
    Flag,
    "",
    "",
    false,
    Group::ShapeEdits,
    "Smooth rough masks voxel by voxel; components, loops and cavities stay the same" },
  { "median",
    "--median",
    Text,
    "N",
    "",
    false,
    Group::ShapeEdits,
    "Take the majority in the cube of N voxels (3, 5, ...) around each voxel: removes salt-and-pepper noise, and parts "
    "less than N voxels thick" },
  { "denoise",
    "--denoise",
    Flag,
    "",
    "",
    false,
    Group::ShapeEdits,
    "Remove noise at boundaries: a majority weighted over about three voxels, in mm along each axis, so that thin and "
    "curved parts keep their size" },
  { "mend-shape",
    "--mend-shape",
    Flag,
    "",
    "",
    false,
    Group::ShapeEdits,
    "Repair noisy masks: join pieces one voxel apart, fill holes and remove bridges one voxel wide" },
  { "close",
    "--close",
    Text,
    "D",
    "",
    false,
    Group::ShapeEdits,
    "Close gaps up to D wide, such as 4vox or 0.5mm (closing by a ball of diameter D); parts farther apart than D are "
    "not joined; a gap of one voxel needs 2vox" },
  { "fill-hollows",
    "--fill-hollows",
    Text,
    "D",
    "",
    false,
    Group::ShapeEdits,
    "Fill lumens that open only through holes up to D wide, such as 4vox or 0.5mm, or where the scan's border cuts "
    "them" },
  { "fill-slices",
    "--fill-slices",
    Text,
    "i|j|k",
    "",
    false,
    Group::ShapeEdits,
    "Fill the holes of each slice across this voxel axis: lumens of tubes that run along it" },
  { "fill-cavities",
    "--fill-cavities",
    Flag,
    "",
    "",
    false,
    Group::ShapeEdits,
    "Fill each label's cavities (background enclosed on all sides, corners included)" },
  { "min-voxels",
    "--min-voxels",
    Integer,
    "N",
    "",
    false,
    Group::ShapeEdits,
    "Remove components smaller than N voxels" },
  { "largest",
    "--largest",
    Integer,
    "N",
    "",
    false,
    Group::ShapeEdits,
    "Keep only the N largest components of each label" },
  { "simplify-topology",
    "--simplify-topology",
    Text,
    "D",
    "",
    false,
    Group::ShapeEdits,
    "Join, cut and fill with the least change, no deeper than D from the boundary, such as 2vox or 0.5mm, until there "
    "are as few pieces, loops and cavities as that allows, or those asked for" },
  { "pieces",
    "--pieces",
    Integer,
    "N",
    "",
    false,
    Group::ShapeEdits,
    "With --simplify-topology: pieces wanted; numbers not given stay as they are" },
  { "loops", "--loops", Integer, "N", "", false, Group::ShapeEdits, "With --simplify-topology: loops wanted" },
  { "change-voxels",
    "--change-voxels",
    Input,
    "FILE",
    "",
    false,
    Group::ShapeEdits,
    "Put voxels in and take voxels out as a text file lists them: +I,J,K or -I,J,K, with xN for N voxels along I",
    "-" },
  { "split-components",
    "--split-components",
    Flag,
    "",
    "",
    false,
    Group::ShapeEdits,
    "Process each component separately, named NAME#1, NAME#2, ... by size" },
});

inline constexpr auto kFolderOutput = std::to_array<Parameter>({
  { "output", "-o,--output", Output, "OUTDIR", "", true, Group::Output, "Folder for all results" },
});

inline constexpr auto kVolumeOutput = std::to_array<Parameter>({
  { "output",
    "-o,--output",
    Output,
    "OUT",
    "",
    true,
    Group::Output,
    "Write the volume: .nrrd .nii .nii.gz .mha .mhd .tif .ome.zarr" },
});

inline constexpr auto kReportRows = std::to_array<Parameter>({
  { "report",
    "--report",
    Output,
    "OUT.json",
    "",
    false,
    Group::Output,
    "Write a report as JSON: input, options, results, times" },
});

inline constexpr auto kTableRows = std::to_array<Parameter>({
  { "units",
    "--units",
    Flag,
    "",
    "",
    false,
    Group::Output,
    "Give the unit of each column in the first line of tables, as in 'length [mm]'" },
});

inline constexpr auto kDisplayRows = std::to_array<Parameter>({
  { "html",
    "--html",
    Output,
    "OUT.html",
    "",
    false,
    Group::Output,
    "Write a page that shows the result in any browser, offline" },
  { "scene",
    "--scene",
    Output,
    "OUT.mrml|OUT.mrb",
    "",
    false,
    Group::Output,
    "Write a scene for 3D Slicer: segmentation, models and curves with names and colours" },
});

inline constexpr auto kTriangleRows = std::to_array<Parameter>({
  { "html-triangles",
    "--html-triangles",
    Integer,
    "N",
    "500000",
    false,
    Group::Output,
    "Simplify the page's meshes to about N triangles" },
});

inline constexpr auto kModelRows = std::to_array<Parameter>({
  { "keep-edges",
    "--keep-edges",
    Flag,
    "",
    "",
    false,
    Group::Output,
    "Store the measures of all edges, which 'voxelcore prune' needs",
    "keep_edges" },
  { "triangles",
    "--triangles",
    Flag,
    "",
    "",
    false,
    Group::Output,
    "Write triangles instead of polygons",
    "triangles" },
});

inline constexpr auto kForceRows = std::to_array<Parameter>({
  { "force", "--force", Flag, "", "", false, Group::Output, "Replace existing files", "overwrite=True" },
});

inline constexpr auto kSeparateRows = std::to_array<Parameter>({
  { "connectivity", "--connectivity", Choice, "6|26|joined", "6", false, Group::ShapeEdits, kConnectivityHelp },
});

inline constexpr auto kJoinRows = std::to_array<Parameter>({
  { "connectivity", "--connectivity", Choice, "6|26|joined", "joined", false, Group::ShapeEdits, kConnectivityHelp },
});

inline constexpr auto kCavityRows = std::to_array<Parameter>({
  { "cavities", "--cavities", Integer, "N", "", false, Group::ShapeEdits, "With --simplify-topology: cavities wanted" },
});

inline constexpr auto kTreeRows = std::to_array<Parameter>({
  { "tree",
    "--tree",
    Flag,
    "",
    "",
    false,
    Group::ShapeEdits,
    "Make one piece without loops and cavities of each label: --simplify-topology 3vox --pieces 1 --loops 0 "
    "--cavities 0" },
});

inline constexpr auto kRefinedRows = std::to_array<Parameter>({
  { "refine",
    "--refine",
    Choice,
    "off|labels|grey|mesh",
    "labels",
    false,
    Group::Refinement,
    "Measure the smooth shape behind labels, grey values or mesh; off: the voxels as they are, by balls that lie in "
    "them" },
});

inline constexpr auto kGreyRows = std::to_array<Parameter>({
  { "grey",
    "--grey",
    Input,
    "SCAN",
    "",
    false,
    Group::Refinement,
    "For --refine grey: the grey scan that the labels were segmented from" },
  { "grey-range",
    "--grey-range",
    Text,
    "LO:HI",
    "",
    false,
    Group::Refinement,
    "For --grey: the grey values inside the labels, such as 300:inf",
    "-",
    false,
    true },
});

inline constexpr auto kAlsoRows = std::to_array<Parameter>({
  { "also",
    "--also",
    Text,
    "csv,swc,..",
    "",
    false,
    Group::Skeleton,
    "Write the skeleton in more forms: csv, swc, mrk.json, graphml, obj, precomputed, ma" },
});

inline constexpr auto kRootRows = std::to_array<Parameter>({
  { "root",
    "--root",
    Text,
    "X,Y,Z|top|bottom|thickest",
    "thickest",
    false,
    Group::Skeleton,
    "Start the hierarchy of branches at the tip nearest to a point (LPS mm), the tip with the greatest z (top) or the "
    "least (bottom), or the tip of the thickest branch" },
});

inline constexpr auto kCutRows = std::to_array<Parameter>({
  { "cut-loops",
    "--cut-loops",
    Flag,
    "",
    "",
    false,
    Group::Skeleton,
    "Cut each cycle at its thinnest branch and report where" },
  { "split-at-junctions",
    "--split-at-junctions",
    Flag,
    "",
    "",
    false,
    Group::Skeleton,
    "Give each branch its own end points, so that branches are separate lines" },
});

inline constexpr auto kBranchRows = Joined(kAlsoRows, kRootRows, kCutRows);

inline constexpr auto kNetworkRows = std::to_array<Parameter>({
  { "soma",
    "--soma",
    Text,
    "auto|X,Y,Z",
    "",
    false,
    Group::Skeleton,
    "Begin the SWC at the soma, a point of type 1: the greatest ball of each label (auto), or the greatest that holds "
    "a point (LPS mm); branches begin at its surface",
    {},
    true },
  { "centerlines",
    "--centerlines",
    Output,
    "OUT.vtp",
    "",
    false,
    Group::Skeleton,
    "Write lines from the inlet to all tips, split into branches and bifurcations with VMTK's arrays" },
  { "flow",
    "--flow",
    Output,
    "OUT.csv|OUT.json|OUT.yaml",
    "",
    false,
    Group::Skeleton,
    "Write the branches as a network of pipes: .csv, with OUT_nodes.csv, .json for svZeroDSolver, or .yaml, with "
    "OUT_inlet.dat, for openBF" },
  { "inlet",
    "--inlet",
    Text,
    "X,Y,Z;..",
    "",
    false,
    Group::Skeleton,
    "Where flow enters, for --centerlines and --flow: the tip nearest to each point (LPS mm); default: the thickest, "
    "at the scan's border if one is" },
});

inline constexpr auto kStageRows = std::to_array<Parameter>({
  { "prune-branches",
    "--prune-branches",
    Text,
    "L|Nr",
    "1r",
    false,
    Group::Skeleton,
    "Remove terminal branches shorter than L: 5mm, 8vox, or 1.5r (times the radius at their base); 0 keeps all" },
  { "plates",
    "--plates",
    Text,
    "L",
    "",
    false,
    Group::Skeleton,
    "Keep surfaces whose erosion thickness is at least L; default: reduce all to curves" },
});

inline constexpr auto kBurnRows = std::to_array<Parameter>({
  { "stand-out",
    "--stand-out",
    Text,
    "L",
    "3vox",
    false,
    Group::Skeleton,
    "Keep branches that stand out from the shape by at least L: 1.5mm, 3vox, 2.5%" },
  { "smooth",
    "--smooth",
    Text,
    "L",
    "6vox",
    false,
    Group::Skeleton,
    "Smooth branches over a window of L to each side, more in thick parts; points move by at most half a voxel in thin "
    "parts; 0 turns it off" },
});

inline constexpr auto kBorderRows = std::to_array<Parameter>({
  { "border",
    "--border",
    Choice,
    "open|closed|overlap",
    "open",
    false,
    Group::Skeleton,
    "Bodies cut by the scan's border: run on to it (open), end as if their voxels were all (closed), or, in parts of "
    "one volume that share a layer of voxels, end at the same place in both parts (overlap)",
    {},
    false,
    true },
});

inline constexpr auto kRunRows = std::to_array<Parameter>({
  { "threads",
    "--threads",
    Integer,
    "N",
    "0",
    false,
    Group::Running,
    "Number of processors to use; 0 means all",
    "threads" },
  { "progress",
    "--progress",
    Choice,
    "bar|plain|json|none",
    "",
    false,
    Group::Running,
    "Show progress on stderr; default: a bar on a terminal, else none",
    "progress" },
  { "quiet", "-q,--quiet", Flag, "", "", false, Group::Running, "Print errors only" },
});

inline constexpr auto kEngineRows = std::to_array<Parameter>({
  { "engine",
    "--engine",
    Choice,
    "auto|lattice|tetgen",
    "auto",
    false,
    Group::Running,
    "Choose the Delaunay engine; the result is the same",
    "engine" },
});

/** What is read of a scan, and how its shapes are edited. */
inline constexpr auto kScanRows = Joined(kLabelRows, kShapeRows, kValueRows, kMeshRows);

} // namespace voxelcore::table
