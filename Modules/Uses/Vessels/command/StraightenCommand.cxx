// `voxelcore straighten`: its options, and what it runs.

#include "voxelcore/Vessels/StraightenCommand.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Options/FieldReader.h"
#include "voxelcore/Options/ParameterReader.h"
#include "voxelcore/Options/SharedRows.h"
#include "voxelcore/Report/SkeletonTexts.h"

#include <charconv>

namespace voxelcore
{

namespace table
{

constexpr auto kStraightenScan = std::to_array<Parameter>({
  { "scan", "", Input, "SCAN", "", true, Group::Input, "Grey scan or labels, in any format of 'voxelcore core'" },
});

constexpr auto kStraightenOwn = std::to_array<Parameter>({
  { "scan-spacing",
    "--scan-spacing",
    Text,
    "H|X,Y,Z",
    "",
    false,
    Group::Input,
    "Use this voxel size of the scan in mm instead of the file's" },
  { "table",
    "--table",
    Output,
    "OUT.csv",
    "",
    false,
    Group::Output,
    "Write a table with a row per plane: place, directions, radius; OUT_columns.json goes beside" },
  { "mapped",
    "--mapped",
    Output,
    "OUT.csv",
    "",
    false,
    Group::Output,
    "Write the points of --points with their places both in the scan and in the straight volume" },
  { "branch",
    "--branch",
    Text,
    "N[,N..]",
    "",
    false,
    Group::Straightening,
    "Go along this branch, by its branch_id, or along several that follow each other" },
  { "from",
    "--from",
    Text,
    "X,Y,Z",
    "",
    false,
    Group::Straightening,
    "With --to: go the shortest way along the skeleton, from the place on it nearest to this point (LPS mm)" },
  { "to", "--to", Text, "X,Y,Z", "", false, Group::Straightening, "The point where the way ends" },
  { "label",
    "--label",
    Text,
    "N[#C]",
    "",
    false,
    Group::Straightening,
    "The label whose skeleton is meant, and its component C, where the file has several" },
  { "spacing",
    "--spacing",
    Text,
    "H|X,Y,Z",
    "",
    false,
    Group::Straightening,
    "Voxel size of the result in mm: across, up and along; default: the least of the scan" },
  { "width",
    "--width",
    Text,
    "L",
    "",
    false,
    Group::Straightening,
    "How far the result reaches to each side of the axis: 10mm, 20vox; default: twice the greatest radius on the way" },
  { "interpolation",
    "--interpolation",
    Choice,
    "auto|linear|nearest",
    "auto",
    false,
    Group::Straightening,
    "Take values between voxels (linear) or those of the nearest voxel; auto takes the nearest of labels" },
  { "outside", "--outside", Real, "V", "0", false, Group::Straightening, "Value where there is no scan" },
  { "points",
    "--points",
    Input,
    "POINTS.csv",
    "",
    false,
    Group::Straightening,
    "Map these points into --mapped: columns x, y, z (scan, LPS mm), or across, up, arc_length (straight volume)" },
});

constexpr auto kStraightenRows = Joined(kRunRows,
                                        kStraightenScan,
                                        kSkeletonArgument,
                                        kVolumeOutput,
                                        kStraightenOwn,
                                        kValueRows,
                                        kTableRows,
                                        kForceRows);

} // namespace table

namespace
{

constexpr std::string_view kFooter =
  R"(The result is a straight volume: its third axis is the length along the vessel, and its first two lie across it.
Planes do not turn about the axis, so a straight feature of the vessel stays straight. The axis runs through their
middle: it is the skeleton, smoothed over twice its radius to each side. The scan may be grey or labels, on any grid, as
long as it lies in the same place as the scan of the skeleton. Guide: vessels.md

--table says where each plane lies. A point (across, up, arc) of the straight volume is place + across * its first
direction + up * its second one, in LPS mm. --points maps points there or back.

Examples:
  voxelcore straighten chest.nii.gz aorta.vtp --branch 0 -o straight.nrrd --table straight.csv
  voxelcore straighten chest.nii.gz aorta.vtp --from 5,16,16 --to 27,16,16 --spacing 0.5 -o straight.nrrd)";

/** The whole text as a number from 0 on. */
std::optional<std::int64_t>
CountFrom(std::string_view text)
{
  std::int64_t value = 0;
  const auto [end, error] = from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && value >= 0 ? std::optional(value) : std::nullopt;
}

Vector3
OnePlace(const ParameterReader & reader, std::string_view name)
{
  const auto places = reader.Parsed(name, ParsePlaces);
  if (places.size() != 1)
  {
    reader.ThrowUsageError(name, "one point, X,Y,Z in LPS mm");
  }
  return places[0];
}

void
ReadWay(const ParameterReader & reader, StraightenOptions & options)
{
  const bool hasEnds = reader.IsGiven("from") || reader.IsGiven("to");
  if (hasEnds == reader.IsGiven("branch") || reader.IsGiven("from") != reader.IsGiven("to"))
  {
    throw UsageError("give either --branch N, or --from X,Y,Z and --to X,Y,Z");
  }
  if (hasEnds)
  {
    options.ends = { OnePlace(reader, "from"), OnePlace(reader, "to") };
  }
  for (const std::string & one : hasEnds ? std::vector<std::string>() : SplitText(reader.Text("branch"), ','))
  {
    const auto number = CountFrom(one);
    if (!number)
    {
      reader.ThrowUsageError("branch", "numbers of branches, from 0, separated by commas");
    }
    options.branches.push_back(*number);
  }
  if (reader.IsGiven("label"))
  {
    const auto parts = SplitText(reader.Text("label"), '#');
    options.label = CountFrom(parts[0]);
    const auto component = parts.size() == 2 ? CountFrom(parts[1]) : std::optional<std::int64_t>(0);
    if (!options.label || !component || parts.size() > 2)
    {
      reader.ThrowUsageError("label", "the value of a label, such as 3, or 3#2 for its second component");
    }
    options.component = *component;
  }
}

} // namespace

StraightenOptions
StraightenOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, kStraightenCommand);
  StraightenOptions     options;
  options.scan = reader.Text("scan");
  options.skeleton = reader.Text("skeleton");
  const FieldReader field(reader);
  field("volume", options.reading.volume);
  field("component", options.reading.component);
  field("level", options.reading.level);
  field("raw", options.reading.raw);
  field("dataset", options.reading.dataset);
  field("orthonormalize", options.reading.orthonormalize);
  field("nifti_form", options.reading.niftiForm);
  if (reader.IsGiven("scan-spacing"))
  {
    options.reading.spacing = reader.Spacing("scan-spacing");
  }
  ReadWay(reader, options);
  if (reader.IsGiven("spacing"))
  {
    options.spacing = reader.Spacing();
  }
  if (reader.IsGiven("width"))
  {
    options.width = reader.Parsed("width", [](const std::string & text) { return ParseLambda(text, "length"); });
    if (!(options.width->value > 0) || options.width->unit == Lambda::Unit::Percent)
    {
      reader.ThrowUsageError("width", "a length above 0, such as 10mm or 20vox");
    }
  }
  const std::string samples = reader.Choice("interpolation");
  options.samples = samples == "linear"    ? SampleKind::Linear
                    : samples == "nearest" ? SampleKind::Nearest
                                           : SampleKind::Auto;
  options.outside = reader.Real("outside").value_or(0);
  options.output = reader.File("output");
  options.table = reader.FileIfGiven("table");
  options.points = reader.FileIfGiven("points");
  options.mapped = reader.FileIfGiven("mapped");
  if (options.points.has_value() != options.mapped.has_value())
  {
    throw UsageError("give --points FILE.csv and --mapped OUT.csv together");
  }
  options.force = reader.IsSet("force");
  return options;
}

namespace
{

Outcome
Run(const Invocation & call)
{
  const StraightenResult result = RunStraightenJob(StraightenOptionsFrom(call.values), call.context);
  return { .warnings = result.warnings, .text = StraightenText(result), .notes = result.notes };
}

} // namespace

constinit const Command kStraightenCommand{ .name = "straighten",
                                            .description = "Resample a scan along a vessel of its skeleton",
                                            .footer = kFooter,
                                            .place = 100,
                                            .rows = table::kStraightenRows,
                                            .run = Run };

} // namespace voxelcore
