// The options of `voxelcore roots`.

#include "FieldReader.h"
#include "ParameterReader.h"
#include "SkeletonValues.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Options/Parameters.h"
#include "voxelcore/Report/SkeletonTexts.h"

#include <vector>

namespace voxelcore
{

RootsOptions
RootsOptionsFrom(const ParameterValues & values)
{
  constexpr CommandId   command = CommandId::Roots;
  const ParameterReader reader(values, command);
  RootsOptions          options;
  options.scan = reader.Text("scan");
  ReadScanFields(reader, options);
  if (options.edits.splitComponents)
  {
    throw UsageError("--split-components: roots works on one piece");
  }
  options.asIs = reader.IsSet("as-is");
  options.kernel = reader.Real("kernel");
  options.neighbourhood = reader.Real("neighborhood");
  options.keepLoops = reader.IsSet("keep-loops");
  options.stage = BurningFrom(values, command);
  options.stage.border = BorderFrom(reader);
  options.edits.openAtBorder = options.stage.border == BorderEnds::Closed;
  options.stage.lambda.text = "0";
  options.rules.up = ParseUp(reader.Text("up"));
  options.rules.stems = reader.Text("stems") == "auto" ? 0 : static_cast<int>(reader.Whole("stems", 1, 1000));
  if (reader.IsGiven("stem"))
  {
    options.rules.stem = reader.Parsed("stem", ParsePlaces);
  }
  if (!options.rules.stem.empty() && options.rules.stems != 1)
  {
    throw UsageError("--stem gives the only stem; leave out --stems");
  }
  options.rules.bulge = reader.Real("roughness").value_or(options.rules.bulge);
  options.annotations = reader.FileIfGiven("edits").value_or("");
  options.soilDepth = reader.Real("soil-depth");
  options.prefix = reader.Text("prefix");
  // It stands in links of the page, too.
  if (options.prefix.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-.") !=
        std::string::npos ||
      options.prefix.starts_with('.'))
  {
    throw UsageError("--prefix " + options.prefix +
                     ": expected letters, digits, '_', '-' and '.', and no '.' in front");
  }
  options.pictures = !reader.IsSet("no-pictures");
  options.htmlTriangles = static_cast<std::size_t>(reader.Whole("html-triangles", 1000, 20000000));
  options.output = reader.File("output");
  const std::string engine = ChoiceOf(values, command, "engine");
  options.engine = engine == "tetgen" ? Engine::TetGen : engine == "lattice" ? Engine::Lattice : Engine::Auto;
  options.threads = ThreadsFrom(values, command);
  options.force = reader.IsSet("force");
  return options;
}

} // namespace voxelcore
