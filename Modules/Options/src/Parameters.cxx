#include "voxelcore/Parameters.h"

#include "ParameterReader.h"
#include "voxelcore/CostModel.h"
#include "voxelcore/Error.h"
#include "voxelcore/OutputNames.h"
#include "voxelcore/ReadInput.h"
#include "voxelcore/ReadMesh.h"
#include "voxelcore/Text.h"

#include <cmath>
#include <limits>
#include <vector>

namespace voxelcore
{

namespace
{

Vector3
SpacingFrom(const ParameterReader & reader, bool isOfMesh = false)
{
  auto parts = SplitText(reader.Text("spacing"), ',');
  if (parts.size() == 1 && isOfMesh)
  {
    parts.resize(3, parts.front());
  }
  Vector3 spacing{};
  bool    good = parts.size() == 3;
  for (std::size_t k = 0; good && k < 3; ++k)
  {
    const auto value = ParseReal(parts[k]);
    good = value && *value > 0 && std::isfinite(*value);
    spacing[k] = value.value_or(0);
  }
  if (!good)
  {
    reader.Refuse("spacing", "three positive numbers in mm, such as 0.5,0.5,2");
  }
  return spacing;
}

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
    reader.Refuse("size", "one or three whole numbers of voxels from 1 to 32768, such as 64 or 64,64,32");
  }
  return size;
}

std::optional<std::filesystem::path>
ReportFrom(const ParameterReader & reader)
{
  if (!reader.IsGiven("report"))
  {
    return std::nullopt;
  }
  if (reader.Text("report").empty())
  {
    reader.Refuse("report", "a file name");
  }
  return reader.Text("report");
}

std::filesystem::path
OutputFrom(const ParameterReader & reader)
{
  if (reader.Text("output").empty())
  {
    reader.Refuse("output", "a file name");
  }
  return reader.Text("output");
}

ModelOptions
ModelOptionsFrom(const ParameterReader & reader)
{
  ModelOptions model;
  model.triangles = reader.IsSet("triangles");
  model.keepEdges = reader.IsSet("keep-edges");
  return model;
}

std::pair<double, double>
RangeFrom(const ParameterReader & reader, std::string_view name)
{
  const auto parts = SplitText(reader.Text(name), ':');
  const auto low = ParseReal(parts.front());
  const auto high = ParseReal(parts.back());
  if (parts.size() != 2 || !low || !high || !(*low <= *high))
  {
    reader.Refuse(name, "LO:HI with LO <= HI, such as 300:3000 (inf is allowed)");
  }
  return { *low, *high };
}

} // namespace

std::string
ValueOf(const ParameterValues & values, CommandId command, std::string_view name)
{
  return ParameterReader(values, command).Text(name);
}

std::string
ChoiceOf(const ParameterValues & values, CommandId command, std::string_view name)
{
  return ParameterReader(values, command).Choice(name);
}

int
ThreadsFrom(const ParameterValues & values, CommandId command)
{
  return static_cast<int>(ParameterReader(values, command).Whole("threads", 0, 4096));
}

ReadOptions
ReadOptionsFrom(const ParameterValues & values, CommandId command)
{
  const ParameterReader reader(values, command);
  ReadOptions           reading;
  reading.labels = reader.Text("labels");
  reading.binary = reader.IsSet("binary");
  if (reader.IsGiven("threshold"))
  {
    reading.threshold = RangeFrom(reader, "threshold");
  }
  if (reader.IsGiven("volume"))
  {
    reading.volume = reader.Whole("volume", 0, std::numeric_limits<std::int64_t>::max());
  }
  if (reader.IsGiven("component"))
  {
    reading.component = reader.Whole("component", 0, std::numeric_limits<std::int64_t>::max());
  }
  if (reader.IsGiven("raw"))
  {
    reading.raw = ParseRawLayout(reader.Text("raw"));
  }
  if (reader.IsGiven("crop"))
  {
    reading.crop = ParseCrop(reader.Text("crop"));
  }
  if (reader.IsGiven("spacing"))
  {
    reading.spacing = SpacingFrom(reader, IsMeshFile(reader.Text("scan")));
  }
  reading.orthonormalize = reader.IsSet("orthonormalize");
  reading.niftiForm = reader.Choice("nifti-form");
  reading.refuseGrey = !reader.IsGiven("labels");
  if (reading.labels.empty())
  {
    reader.Refuse("labels", "'all', or values or names separated by commas");
  }
  const int ways = (reading.labels != "all" ? 1 : 0) + (reading.binary ? 1 : 0) + (reading.threshold ? 1 : 0);
  if (ways > 1)
  {
    throw UsageError("give only one of --labels, --binary and --threshold");
  }
  return reading;
}

ShapeEditOptions
ShapeEditsFrom(const ParameterValues & values, CommandId command)
{
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  const ParameterReader  reader(values, command);
  ShapeEditOptions       edits;
  if (reader.IsGiven("min-voxels"))
  {
    edits.minVoxels = static_cast<std::uint64_t>(reader.Whole("min-voxels", 1, most));
  }
  if (reader.IsGiven("largest"))
  {
    edits.largest = static_cast<std::uint64_t>(reader.Whole("largest", 1, most));
  }
  edits.mend = reader.IsSet("mend-shape");
  edits.smooth = reader.IsSet("smooth-shape");
  edits.fillCavities = reader.IsSet("fill-cavities");
  edits.splitComponents = reader.IsSet("split-components");
  return edits;
}

namespace
{

/** `--lambda` and `--tolerance`, of which the latter makes the former a floor. */
void
ReadPruning(const ParameterReader & reader, std::vector<Lambda> & lambdas, std::vector<Tolerance> & tolerances)
{
  const bool hasTolerance = reader.IsGiven("tolerance");
  if (hasTolerance)
  {
    tolerances = ParseTolerances(reader.Text("tolerance"));
  }
  lambdas = ParseLambdas(hasTolerance && !reader.IsGiven("lambda") ? "0" : reader.Text("lambda"));
  if (hasTolerance && lambdas.size() > 1)
  {
    throw UsageError("--lambda " + reader.Text("lambda") + ": expected one value, the floor of --tolerance");
  }
}

} // namespace

DisplayTargets
DisplayTargetsFrom(const ParameterValues & values, CommandId command)
{
  const ParameterReader reader(values, command);
  DisplayTargets        targets;
  const auto            file = [&](std::string_view name) {
    if (reader.Text(name).empty())
    {
      reader.Refuse(name, "a file name");
    }
    return reader.Text(name);
  };
  if (reader.IsGiven("scene"))
  {
    targets.scene = file("scene");
  }
  if (reader.IsGiven("html"))
  {
    targets.html = file("html");
  }
  targets.htmlTriangles = static_cast<std::size_t>(reader.Whole("html-triangles", 1000, 20000000));
  return targets;
}

std::vector<std::int64_t>
ResolutionsFrom(const ParameterValues & values, CommandId command)
{
  const ParameterReader reader(values, command);
  return reader.IsGiven("resolution") ? ParseResolutions(reader.Text("resolution")) : std::vector<std::int64_t>();
}

namespace
{

/** For what works at one resolution; one of several is left to RunStudyJob. */
std::optional<std::int64_t>
FirstResolution(const ParameterValues & values, CommandId command)
{
  const auto resolutions = ResolutionsFrom(values, command);
  if (resolutions.size() > 1 && command != CommandId::Core)
  {
    throw UsageError("--resolution " + ValueOf(values, command, "resolution") + ": expected one value");
  }
  return resolutions.empty() ? std::nullopt : std::optional(resolutions.front());
}

} // namespace

VoxelizeJobOptions
VoxelizeOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, CommandId::Voxelize);
  VoxelizeJobOptions    options;
  options.mesh = reader.Text("mesh");
  options.resolutions = ResolutionsFrom(values, CommandId::Voxelize);
  if (reader.IsGiven("spacing"))
  {
    options.spacing = SpacingFrom(reader, true);
  }
  if (options.resolutions.empty() != options.spacing.has_value())
  {
    throw UsageError("give either --resolution (voxels along the longest side) or --spacing (voxel size in mm)");
  }
  options.output = OutputFrom(reader);
  options.report = ReportFrom(reader);
  options.force = reader.IsSet("force");
  return options;
}

namespace
{

RefineOptions
RefineFrom(const ParameterReader & reader)
{
  RefineOptions     refine;
  const std::string surface = reader.Choice("refine");
  refine.surface = surface == "off" ? std::string() : surface;
  if (reader.IsGiven("grey") != reader.IsGiven("grey-range"))
  {
    throw UsageError("give --grey SCAN and --grey-range LO:HI together");
  }
  if (reader.IsGiven("grey"))
  {
    if (surface != "grey")
    {
      throw UsageError("--grey needs --refine grey");
    }
    refine.grey = reader.Text("grey");
    refine.greyRange = RangeFrom(reader, "grey-range");
  }
  return refine;
}

} // namespace

CoreOptions
CoreOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, CommandId::Core);
  CoreOptions           options;
  options.scan = reader.Text("scan");
  options.reading = ReadOptionsFrom(values, CommandId::Core);
  options.edits = ShapeEditsFrom(values, CommandId::Core);
  options.resolution = FirstResolution(values, CommandId::Core);
  ReadPruning(reader, options.lambdas, options.tolerances);
  options.refine = RefineFrom(reader);
  options.output = OutputFrom(reader);
  options.report = ReportFrom(reader);
  if (reader.IsGiven("table"))
  {
    options.table = reader.Text("table");
  }
  options.display = DisplayTargetsFrom(values, CommandId::Core);
  options.skeleton = CoreSkeletonFrom(values);
  options.skeletonTargets = TargetsFrom(values, CommandId::Core);
  options.skeletonOutput = options.skeleton ? SkeletonBesideCore(options.output) : std::filesystem::path();
  options.model = ModelOptionsFrom(reader);
  const std::string engine = reader.Choice("engine");
  options.engine = engine == "tetgen" ? Engine::TetGen : engine == "lattice" ? Engine::Lattice : Engine::Auto;
  options.crossCheck = reader.IsSet("cross-check");
  options.join = reader.Text("join");
  if (options.crossCheck && !options.join.empty())
  {
    throw UsageError("give only one of --cross-check and --join");
  }
  options.threads = ThreadsFrom(values, CommandId::Core);
  if (reader.IsGiven("memory"))
  {
    options.memory = ParseMemory(reader.Text("memory"));
  }
  options.force = reader.IsSet("force");
  return options;
}

std::optional<BlockOptions>
BlockOptionsFrom(const ParameterValues & values)
{
  constexpr std::int64_t most = std::int64_t{ 1 } << 20U;
  const ParameterReader  reader(values, CommandId::Core);
  if (reader.IsGiven("blocks") != reader.IsGiven("block"))
  {
    throw UsageError("give --blocks N and --block K together");
  }
  if (!reader.IsGiven("blocks"))
  {
    return std::nullopt;
  }
  if (ResolutionsFrom(values, CommandId::Core).size() > 1)
  {
    throw UsageError("--resolution " + reader.Text("resolution") + ": expected one value with --blocks");
  }
  if (reader.IsGiven("join"))
  {
    throw UsageError("give only one of --block and --join");
  }
  BlockOptions options;
  options.core = CoreOptionsFrom(values);
  if (!options.core.refine.surface.empty())
  {
    throw UsageError("--refine does not work with --block; give it with --join");
  }
  options.blocks = static_cast<std::size_t>(reader.Whole("blocks", 1, most));
  options.block = static_cast<std::size_t>(reader.Whole("block", 1, most));
  return options;
}

InfoOptions
InfoOptionsFrom(const ParameterValues & values)
{
  return { ValueOf(values, CommandId::Info, "scan"),
           ReadOptionsFrom(values, CommandId::Info),
           ShapeEditsFrom(values, CommandId::Info),
           FirstResolution(values, CommandId::Info),
           ParseLambdas(ValueOf({}, CommandId::Core, "lambda")),
           ParseLambdas(ValueOf({}, CommandId::Skeleton, "lambda")) };
}

VerifyOptions
VerifyOptionsFrom(const ParameterValues & values)
{
  return { ValueOf(values, CommandId::Verify, "scan"), ValueOf(values, CommandId::Verify, "core") };
}

PruneOptions
PruneOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, CommandId::Prune);
  PruneOptions          options;
  options.core = reader.Text("core");
  if (reader.IsGiven("tolerance") == reader.IsGiven("lambda"))
  {
    throw UsageError("give either --lambda or --tolerance, such as --lambda 1.5mm or --tolerance 1.2diag");
  }
  if (reader.IsGiven("tolerance"))
  {
    options.tolerances = ParseTolerances(reader.Text("tolerance"));
  }
  else
  {
    options.lambdas = ParseLambdas(reader.Text("lambda"));
  }
  options.output = OutputFrom(reader);
  options.report = ReportFrom(reader);
  options.model = ModelOptionsFrom(reader);
  options.threads = ThreadsFrom(values, CommandId::Prune);
  options.force = reader.IsSet("force");
  return options;
}

ReconstructOptions
ReconstructOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, CommandId::Reconstruct);
  ReconstructOptions    options;
  options.core = reader.Text("core");
  for (auto [name, path] : { std::pair("like", &options.like), std::pair("scan", &options.scan) })
  {
    if (reader.IsGiven(name))
    {
      *path = reader.Text(name);
    }
  }
  options.output = OutputFrom(reader);
  options.report = ReportFrom(reader);
  options.force = reader.IsSet("force");
  return options;
}

PhantomJobOptions
PhantomOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, CommandId::Phantom);
  PhantomJobOptions     options;
  options.phantom.kind = reader.Text("kind");
  options.phantom.size = SizeFrom(reader);
  options.phantom.spacing = SpacingFrom(reader);
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
  if (reader.IsGiven("cells"))
  {
    options.phantom.cells = static_cast<int>(reader.Whole("cells", 1, 1000000));
  }
  if (reader.IsGiven("centre-lines"))
  {
    options.centreLines = reader.Text("centre-lines");
  }
  options.output = OutputFrom(reader);
  options.force = reader.IsSet("force");
  return options;
}

namespace
{

/** LO:HI, both in mm or both in per cent. */
void
ReadColorRange(const ParameterReader & reader, RenderJobOptions & options)
{
  auto                  ends = SplitText(reader.Text("range"), ':');
  const bool            shares = ends.front().ends_with('%');
  std::array<double, 2> values{};
  bool                  isRange = ends.size() == 2;
  for (std::size_t i = 0; isRange && i < 2; ++i)
  {
    if (shares && ends[i].ends_with('%'))
    {
      ends[i].pop_back();
    }
    const auto value = ParseReal(ends[i]);
    isRange = value && std::isfinite(*value) && (!shares || (*value >= 0 && *value <= 100));
    values[i] = isRange ? *value : 0;
  }
  if (!isRange || !(values[0] < values[1]) || (shares && !reader.Text("range").ends_with('%')))
  {
    reader.Refuse("range", "LO:HI with LO < HI, in mm such as 0:5, or in per cent such as 2%:98% or 0%:100%");
  }
  options.eachLabel = reader.IsSet("each-label");
  if (shares)
  {
    options.shares = { values[0] / 100, values[1] / 100 };
    return;
  }
  if (options.eachLabel)
  {
    throw UsageError("--each-label: each label has its own range, so give --range in per cent, such as 2%:98%");
  }
  options.range = values;
}

} // namespace

RenderJobOptions
RenderOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, CommandId::Render);
  RenderJobOptions      options;
  for (const std::string & file : SplitText(reader.Text("files"), '\n'))
  {
    options.files.push_back(file);
  }
  if (reader.IsGiven("scan-file"))
  {
    options.scan = reader.Text("scan-file");
  }
  options.labels = reader.Text("labels");
  options.output = OutputFrom(reader);
  const auto sides = SplitText(reader.Text("size"), 'x');
  const auto width = ParseReal(sides.front());
  const auto height = ParseReal(sides.back());
  const auto fits = [](const std::optional<double> & side) {
    return side && *side >= 64 && *side <= 8192 && std::floor(*side) == *side;
  };
  if (sides.size() != 2 || !fits(width) || !fits(height))
  {
    reader.Refuse("size", "WIDTHxHEIGHT in pixels, each from 64 to 8192, such as 1600x1200");
  }
  options.shrink = !reader.IsGiven("size");
  options.width = static_cast<int>(*width);
  options.height = static_cast<int>(*height);
  options.view = reader.Choice("view");
  options.coloring = reader.Choice("color");
  ReadColorRange(reader, options);
  options.background = reader.Choice("background");
  options.tubes = ParseReal(reader.Text("tubes")).value_or(-1);
  if (!(options.tubes > 0 && options.tubes <= 1))
  {
    reader.Refuse("tubes", "a number above 0, up to 1");
  }
  options.panels = reader.IsSet("panels");
  options.turntable = static_cast<int>(reader.Whole("turntable", 1, 999));
  options.force = reader.IsSet("force");
  return options;
}

} // namespace voxelcore
