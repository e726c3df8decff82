// The options of `voxelcore straighten`.

#include "FieldReader.h"
#include "ParameterReader.h"
#include "voxelcore/Options/Parameters.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Report/SkeletonTexts.h"

#include <charconv>

namespace voxelcore
{

namespace
{

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
  constexpr CommandId   command = CommandId::Straighten;
  const ParameterReader reader(values, command);
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

} // namespace voxelcore
