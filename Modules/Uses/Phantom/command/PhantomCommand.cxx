// `voxelcore phantom`: its options, and what it runs.

#include "voxelcore/Phantom/PhantomCommand.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Options/ParameterReader.h"
#include "voxelcore/Options/SharedRows.h"

#include <array>
#include <cmath>

namespace voxelcore
{

namespace table
{

constexpr auto kPhantomOwn = std::to_array<Parameter>({
  { "kind", "", Text, "KIND", "", true, Group::Input, "Kind of shape; 'voxelcore phantom list' prints all kinds" },
  { "output",
    "-o,--output",
    Output,
    "OUT",
    "",
    false,
    Group::Output,
    "Write the volume: .nrrd .nii .nii.gz .mha .mhd .tif .ome.zarr" },
  { "centre-lines",
    "--centre-lines",
    Output,
    "OUT.swc|OUT.rsml",
    "",
    false,
    Group::Output,
    "Write the true centre lines of a root: SWC in micrometres, or RSML" },
  { "size", "--size", Text, "N|X,Y,Z", "64", false, Group::Phantom, "Size in voxels" },
  { "spacing", "--spacing", Text, "H|X,Y,Z", "1", false, Group::Phantom, "Voxel size in mm" },
  { "seed",
    "--seed",
    Integer,
    "N",
    "1",
    false,
    Group::Phantom,
    "Seed of the random kinds: porous, noise, root, cells" },
  { "radius", "--radius", Real, "MM", "", false, Group::Phantom, "Radius; the default depends on the kind" },
  { "thickness", "--thickness", Real, "MM", "", false, Group::Phantom, "Thickness; the default depends on the kind" },
  { "period",
    "--period",
    Real,
    "MM",
    "",
    false,
    Group::Phantom,
    "Period of the gyroid, or distance between the grains of porous" },
  { "density", "--density", Real, "0..1", "", false, Group::Phantom, "Volume fraction of porous and noise" },
  { "detail", "--detail", Real, "MM", "", false, Group::Phantom, "Smallest radius of a root" },
  { "laterals", "--laterals", Integer, "N", "", false, Group::Phantom, "Number of laterals on the stem of a root" },
  { "sub-laterals", "--sub-laterals", Integer, "N", "", false, Group::Phantom, "Number of laterals on each lateral" },
  { "whorls",
    "--whorls",
    Integer,
    "N",
    "",
    false,
    Group::Phantom,
    "Let the laterals of a root spring from N heights of its stem" },
  { "contacts", "--contacts", Integer, "N", "", false, Group::Phantom, "Add N laterals that each touch another root" },
  { "grey-values",
    "--grey-values",
    Flag,
    "",
    "",
    false,
    Group::Phantom,
    "Write a grey scan of a root instead of a mask" },
  { "hollow",
    "--hollow",
    Real,
    "0..0.9",
    "",
    false,
    Group::Phantom,
    "With --grey-values: radius of the lumen of thick roots, as part of theirs" },
  { "holes",
    "--holes",
    Integer,
    "N",
    "",
    false,
    Group::Phantom,
    "With --grey-values: number of holes in the walls of hollow roots" },
  { "breaks",
    "--breaks",
    Integer,
    "N",
    "",
    false,
    Group::Phantom,
    "With --grey-values: number of places where a root is torn" },
  { "noise-level",
    "--noise-level",
    Real,
    "F",
    "",
    false,
    Group::Phantom,
    "With --grey-values: standard deviation of the noise, as part of the contrast" },
  { "rings",
    "--rings",
    Real,
    "F",
    "",
    false,
    Group::Phantom,
    "With --grey-values: amplitude of ring artefacts, as part of the contrast" },
  { "soil",
    "--soil",
    Real,
    "MM",
    "",
    false,
    Group::Phantom,
    "With --grey-values: height of the soil plane, below which the background is brighter" },
  { "cells", "--cells", Integer, "N", "", false, Group::Phantom, "Number of bodies of the kind cells" },
});

constexpr auto kPhantomRows = Joined(kRunRows, kPhantomOwn, kForceRows);

} // namespace table

namespace
{

constexpr std::string_view kFooter = R"(Examples:
  voxelcore phantom list
  voxelcore phantom ellipsoid --size 64 -o ellipsoid.nrrd
  voxelcore phantom root --size 256,256,512 --spacing 0.1,0.1,0.1 --seed 7 -o root.nii.gz)";

std::array<std::int32_t, 3>
SizeFrom(const ParameterReader & reader)
{
  auto parts = SplitText(reader.Text("size"), ',');
  if (parts.size() == 1)
  {
    parts.resize(3, parts.front());
  }
  std::array<std::int32_t, 3> size{};
  bool                        good = parts.size() == 3;
  for (std::size_t k = 0; good && k < 3; ++k)
  {
    const auto value = ParseReal(parts[k]);
    good = value && *value >= 1 && *value <= 32768 && std::floor(*value) == *value;
    size[k] = good ? static_cast<std::int32_t>(*value) : 0;
  }
  if (!good)
  {
    reader.ThrowUsageError("size", "one or three whole numbers of voxels from 1 to 32768, such as 64 or 64,64,32");
  }
  return size;
}

/** A root's grey scan; none unless it is asked for. */
std::optional<RootScanOptions>
ScanFrom(const ParameterReader & reader)
{
  RootScanOptions scan;
  scan.hollow = reader.Real("hollow").value_or(0);
  scan.noise = reader.Real("noise-level").value_or(0);
  scan.rings = reader.Real("rings").value_or(0);
  scan.soil = reader.Real("soil");
  if (reader.IsGiven("holes"))
  {
    scan.holes = static_cast<int>(reader.Whole("holes", 0, 10000));
  }
  if (reader.IsGiven("breaks"))
  {
    scan.breaks = static_cast<int>(reader.Whole("breaks", 0, 10000));
  }
  if (reader.IsSet("grey-values"))
  {
    return scan;
  }
  for (const char * name : { "hollow", "holes", "breaks", "noise-level", "rings", "soil" })
  {
    if (reader.IsGiven(name))
    {
      throw UsageError("--" + std::string(name) + ": needs --grey-values");
    }
  }
  return std::nullopt;
}

} // namespace

PhantomJobOptions
PhantomOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, kPhantomCommand);
  PhantomJobOptions     options;
  options.phantom.kind = reader.Text("kind");
  options.phantom.size = SizeFrom(reader);
  options.phantom.spacing = reader.Spacing();
  options.phantom.seed = static_cast<std::uint64_t>(reader.Whole("seed", 0, std::numeric_limits<std::int64_t>::max()));
  options.phantom.radius = reader.Real("radius");
  options.phantom.thickness = reader.Real("thickness");
  options.phantom.period = reader.Real("period");
  options.phantom.density = reader.Real("density");
  options.phantom.detail = reader.Real("detail");
  if (reader.IsGiven("laterals"))
  {
    options.phantom.laterals = static_cast<int>(reader.Whole("laterals", 0, 100000));
  }
  if (reader.IsGiven("sub-laterals"))
  {
    options.phantom.subLaterals = static_cast<int>(reader.Whole("sub-laterals", 0, 100000));
  }
  if (reader.IsGiven("whorls"))
  {
    options.phantom.whorls = static_cast<int>(reader.Whole("whorls", 1, 1000));
  }
  if (reader.IsGiven("contacts"))
  {
    options.phantom.contacts = static_cast<int>(reader.Whole("contacts", 0, 1000));
  }
  options.scan = ScanFrom(reader);
  if (reader.IsGiven("cells"))
  {
    options.phantom.cells = static_cast<int>(reader.Whole("cells", 1, 1000000));
  }
  if (reader.IsGiven("centre-lines"))
  {
    options.centreLines = reader.Text("centre-lines");
  }
  if (!reader.IsGiven("output")) // 'phantom list' needs none
  {
    throw UsageError("--output is required; see 'voxelcore phantom --help'");
  }
  options.output = reader.File("output");
  options.force = reader.IsSet("force");
  return options;
}

namespace
{

Outcome
Run(const Invocation & call)
{
  if (ValueOf(call.values, kPhantomCommand, "kind") == "list")
  {
    return { .text = PhantomList() };
  }
  return { .text = RunPhantomJob(PhantomOptionsFrom(call.values), call.context) + "\n" };
}

} // namespace

constinit const Command kPhantomCommand{ .name = "phantom",
                                         .description = "Make a synthetic volume",
                                         .footer = kFooter,
                                         .place = 160,
                                         .rows = table::kPhantomRows,
                                         .run = Run };

} // namespace voxelcore
