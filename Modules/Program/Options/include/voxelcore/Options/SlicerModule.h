#pragma once
// VoxelCore's commands as CLI modules of 3D Slicer: the same parameter table, in the form Slicer asks for.

#include "voxelcore/Options/Parameters.h"
#include "voxelcore/Report/CoreReport.h"

#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

/** What `MODULE --xml` prints: every parameter of the command that makes sense in Slicer. Input and output stand last
 *  on Slicer's command line, in the order of their index. \throws std::logic_error but for Core and Skeleton. */
std::string
SlicerXml(CommandId command);

/** A command line as Slicer makes it from that description. */
struct SlicerCall
{
  bool                       wantsXml = false;
  ParameterValues            values;
  std::optional<std::string> returnParameterFile;
};

/** Options with an empty value count as not given: Slicer passes each text field. Files may be replaced, since Slicer
 *  hands out names of temporary files. \throws UsageError */
SlicerCall
ParseSlicerCall(CommandId command, const std::vector<std::string> & arguments);

/** `name = value` lines that Slicer shows in the module's panel: sums over labels. */
std::string
SlicerReturnText(CommandId command, const CoreReport & report);

} // namespace voxelcore
