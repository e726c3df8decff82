#pragma once
// Finds mistyped commands and options before the parser does, which would say less.

#include "voxelcore/Options/Command.h"

namespace voxelcore
{

/** \throws UsageError for a command or an option there is not, with the nearest there is; for an option without its
 *  value; and for one argument too many. */
void
RequireKnownNames(int argc, const char * const * argv);

} // namespace voxelcore
