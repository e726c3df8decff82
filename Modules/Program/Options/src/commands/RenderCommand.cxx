// `voxelcore render`: its options, and what it runs.

#include "voxelcore/Options/Requests.h"
#include "voxelcore/Options/SharedRows.h"

namespace voxelcore
{

namespace table
{

constexpr auto kRenderOwn = std::to_array<Parameter>({
  { "files",
    "",
    Inputs,
    "FILE...",
    "",
    true,
    Group::Input,
    "Medial surfaces, skeletons, sheets and surfaces of labels (.vtp .vtk) written by VoxelCore, also saved again by "
    "other programs, and meshes; files of one label are drawn together" },
  { "labels", "--labels", Text, "all|N,NAME,..", "all", false, Group::Input, "Labels to draw, by value or name" },
  { "scan-file", "--scan", Input, "SCAN", "", false, Group::Input, "Draw the surface of the scan's labels, too" },
  { "output",
    "-o,--output",
    Output,
    "OUT.png",
    "",
    true,
    Group::Output,
    "Write the picture; --turntable writes OUT_000.png and so on" },
  { "color",
    "--color",
    Choice,
    "Radius|Lambda|ErosionThickness|Thickness|Confidence|SheetId|Label",
    "Radius",
    false,
    Group::Picture,
    "Colour by this length, by confidence (of a skeleton made from probabilities), by sheet, or by label" },
  { "view",
    "--view",
    Choice,
    "front|top|iso|auto",
    "auto",
    false,
    Group::Picture,
    "View from anterior, superior, or obliquely; auto shows the largest side" },
  { "panels",
    "--panels",
    Flag,
    "",
    "",
    false,
    Group::Picture,
    "Draw surface, medial surface and curve skeleton side by side" },
  { "range",
    "--range",
    Text,
    "LO:HI",
    "2%:98%",
    false,
    Group::Picture,
    "Ends of the colour bar: in mm (in voxels where the scan has no voxel size), or as shares of the area; 0%:100% is "
    "the full range" },
  { "each-label", "--each-label", Flag, "", "", false, Group::Picture, "Colour each label over its own range" },
  { "size",
    "--size",
    Text,
    "WxH",
    "1600x1200",
    false,
    Group::Picture,
    "Picture size in pixels; without it, at most this and no wide margins" },
  { "background", "--background", Choice, "white|dark", "white", false, Group::Picture, "Background colour" },
  { "tubes",
    "--tubes",
    Real,
    "F",
    "0.3",
    false,
    Group::Picture,
    "Draw curves as tubes of F times their radius, above 0, up to 1" },
  { "turntable", "--turntable", Integer, "N", "1", false, Group::Picture, "Draw N pictures of a full turn" },
});

constexpr auto kRenderRows = Joined(kRunRows, kRenderOwn, kForceRows);

} // namespace table

namespace
{

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

Outcome
RunRender(const Invocation & call)
{
  const RenderResult result = RunRenderJob(RenderOptionsFrom(call.values), call.context);
  return { .warnings = result.warnings, .notes = result.notes };
}

} // namespace

constinit const Command kRenderCommand{ .name = "render",
                                        .description = "Draw pictures of medial surfaces and skeletons",
                                        .footer = kRenderFooter,
                                        .place = 80,
                                        .rows = table::kRenderRows,
                                        .run = RunRender };

} // namespace voxelcore
