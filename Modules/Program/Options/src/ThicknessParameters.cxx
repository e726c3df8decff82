// The options of `voxelcore thickness` and `voxelcore sheets`.

#include "FieldReader.h"
#include "ParameterReader.h"
#include "SkeletonValues.h"
#include "voxelcore/Certified/Certified.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Options/Parameters.h"

namespace voxelcore
{

namespace
{

/** The options that `thickness` shares with `core`. */
CoreOptions
SharedOptions(const ParameterReader & reader, const ParameterValues & values, CommandId command)
{
  CoreOptions core;
  ReadScanFields(reader, core);
  core.tolerances = ParseTolerances(reader.Text("tolerance"));
  if (core.tolerances.size() > 1)
  {
    reader.ThrowUsageError("tolerance", "one value");
  }
  CompletePruning(core.lambdas, core.tolerances);
  core.refine = RefineFrom(reader);
  const std::string engine = reader.Choice("engine");
  core.engine = engine == "tetgen" ? Engine::TetGen : engine == "lattice" ? Engine::Lattice : Engine::Auto;
  core.threads = ThreadsFrom(values, command);
  core.further = FurtherOptions(reader);
  return core;
}

void
ReadFiles(const ParameterReader & reader, CoreOptions & core)
{
  core.scan = reader.Text("scan");
  core.report = reader.FileIfGiven("report");
  core.force = reader.IsSet("force");
}

} // namespace

ThicknessOptions
ThicknessOptionsWithoutFiles(const ParameterValues & values)
{
  constexpr CommandId   command = CommandId::Thickness;
  const ParameterReader reader(values, command);
  ThicknessOptions      options;
  options.core = SharedOptions(reader, values, command);
  options.bounds = reader.IsSet("bounds");
  const std::string border = reader.Choice("border");
  options.border = border == "keep" ? BorderRule::Keep : border == "drop" ? BorderRule::Drop : BorderRule::Flag;
  const std::string separation = reader.Choice("separation");
  options.separation = separation == "box"    ? SeparationRegion::Box
                       : separation == "hull" ? SeparationRegion::Hull
                                              : SeparationRegion::None;
  if (reader.IsGiven("within"))
  {
    options.within = reader.Text("within");
    if (options.within.empty())
    {
      reader.ThrowUsageError("within", "a label of the scan, or the file of a mask");
    }
    if (options.separation != SeparationRegion::None)
    {
      reader.ThrowUsageError("within", "no --separation beside it");
    }
    options.separation = SeparationRegion::Within;
  }
  return options;
}

ThicknessOptions
ThicknessOptionsFrom(const ParameterValues & values)
{
  constexpr CommandId   command = CommandId::Thickness;
  const ParameterReader reader(values, command);
  ThicknessOptions      options = ThicknessOptionsWithoutFiles(values);
  ReadFiles(reader, options.core);
  options.output = reader.File("output");
  options.table = reader.FileIfGiven("table");
  options.surface = reader.FileIfGiven("surface");
  options.medial = reader.FileIfGiven("medial");
  options.core.display = DisplayTargetsFrom(values, command);
  if (reader.IsGiven("memory"))
  {
    options.core.memory = ParseMemory(reader.Text("memory"));
  }
  return options;
}

SheetsOptions
SheetsOptionsFrom(const ParameterValues & values)
{
  constexpr CommandId   command = CommandId::Sheets;
  const ParameterReader reader(values, command);
  SheetsOptions         options;
  if (std::filesystem::path(reader.Text("scan")).extension() == ".vtp" && !reader.FirstResolution())
  {
    RefuseScanOptions(values, reader.Text("scan"), command);
  }
  options.core = SharedOptions(reader, values, command);
  ReadFiles(reader, options.core);
  options.sliver = reader.Parsed("sliver", [](const std::string & text) { return ParseLambda(text, "length"); });
  options.output = reader.File("output");
  options.voxels = reader.FileIfGiven("voxels");
  options.table = reader.FileIfGiven("table");
  options.graph = reader.FileIfGiven("graph");
  return options;
}

} // namespace voxelcore
