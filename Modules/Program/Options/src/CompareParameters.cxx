// The options of `voxelcore compare`.

#include "FieldReader.h"
#include "ParameterReader.h"
#include "voxelcore/Options/Parameters.h"

namespace voxelcore
{

CompareOptions
CompareOptionsWithoutFiles(const ParameterValues & values)
{
  const ParameterReader reader(values, CommandId::Compare);
  CompareOptions        options;
  // Skeletons are made as `voxelcore skeleton` makes them where nothing is said.
  options.making = SkeletonOptionsFrom({ { "scan", "a scan" }, { "output", "skeleton.vtp" } });
  ReadScanFields(reader, options.making);
  options.making.reading.mayBeMissing = reader.IsGiven("labels");
  options.lines = !reader.IsSet("no-skeletons");
  if (reader.IsGiven("near"))
  {
    options.near = reader.Parsed("near", [](const std::string & text) { return ParseLambda(text, "length"); });
  }
  return options;
}

CompareOptions
CompareOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, CommandId::Compare);
  CompareOptions        options = CompareOptionsWithoutFiles(values);
  options.a = reader.File("a");
  options.b = reader.File("b");
  options.output = reader.FileIfGiven("output");
  options.table = reader.FileIfGiven("table");
  options.report = reader.FileIfGiven("report");
  options.display = DisplayTargetsFrom(values, CommandId::Compare);
  options.force = reader.IsSet("force");
  return options;
}

} // namespace voxelcore
