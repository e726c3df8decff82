#pragma once
// What the program does when it is interrupted, or when a library takes it down.

#include "voxelcore/OutputTransaction.h"

namespace voxelcore
{

/** From now on: the first SIGINT, SIGTERM or SIGHUP only makes WasInterrupted() true; a second one removes the temporary
 *  files and ends the program with 130. A crash prints one line to `errorDescriptor`, removes the temporary files and
 *  ends with 1, without a core dump. Writing beyond a limit or to a closed pipe is an error, not the end.
 *  Must be called once, with a registry that lives as long as the process. */
void
HandleSignals(const TemporaryRegistry & registry, int errorDescriptor);

bool
WasInterrupted();

} // namespace voxelcore
