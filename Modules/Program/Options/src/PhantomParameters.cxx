// The options of `voxelcore phantom`.

#include "ParameterReader.h"
#include "voxelcore/Base/Error.h"

#include <array>
#include <cmath>

namespace voxelcore
{

namespace
{

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
  const ParameterReader reader(values, CommandId::Phantom);
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

} // namespace voxelcore
