// The options of `voxelcore render`.

#include "voxelcore/Base/Error.h"
#include "voxelcore/Options/ParameterReader.h"
#include "voxelcore/Options/Requests.h"

#include <array>
#include <cmath>

namespace voxelcore
{

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
    reader.ThrowUsageError("range", "LO:HI with LO < HI, in mm such as 0:5, or in per cent such as 2%:98% or 0%:100%");
  }
  if (reader.IsSet("each-label") || reader.IsGiven("range"))
  {
    options.eachLabel = reader.IsSet("each-label");
  }
  if (shares)
  {
    options.shares = { values[0] / 100, values[1] / 100 };
    return;
  }
  if (*options.eachLabel)
  {
    throw UsageError("--each-label: each label has its own range, so give --range in per cent, such as 2%:98%");
  }
  options.range = values;
}

} // namespace

RenderJobOptions
RenderOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, kRenderCommand);
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
  options.output = reader.File("output");
  const auto sides = SplitText(reader.Text("size"), 'x');
  const auto width = ParseReal(sides.front());
  const auto height = ParseReal(sides.back());
  const auto fits = [](const std::optional<double> & side) {
    return side && *side >= 64 && *side <= 8192 && std::floor(*side) == *side;
  };
  if (sides.size() != 2 || !fits(width) || !fits(height))
  {
    reader.ThrowUsageError("size", "WIDTHxHEIGHT in pixels, each from 64 to 8192, such as 1600x1200");
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
    reader.ThrowUsageError("tubes", "a number above 0, up to 1");
  }
  options.panels = reader.IsSet("panels");
  options.turntable = static_cast<int>(reader.Whole("turntable", 1, 999));
  options.force = reader.IsSet("force");
  return options;
}

} // namespace voxelcore
