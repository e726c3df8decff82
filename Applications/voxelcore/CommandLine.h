#pragma once
// The command line as the parameter table describes it.

#include "voxelcore/Options/Command.h"

#include <string>

namespace voxelcore
{

struct CommandLine
{
  const Command * command = nullptr; ///< null: only `text` is to be printed
  ParameterValues values;
  std::string     text;  ///< help or version
  std::string     whole; ///< the command as a shell would take it again
};

/** \throws UsageError */
CommandLine
ParseCommandLine(int argc, char ** argv);

} // namespace voxelcore
