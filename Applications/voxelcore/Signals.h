#pragma once
// What the program does when it is interrupted, or when a library takes it down.

#include "voxelcore/Jobs/OutputTransaction.h"

namespace voxelcore
{

/** From now on: the first SIGINT makes WasInterrupted() true, so that a job stops at its next look; when the program
 *  has not ended half a second later, and at once after a second SIGINT, after SIGTERM and after SIGHUP, the handler
 *  ends it, whatever runs then: it prints "interrupted; " and WhatIsLeft(), removes the temporary files and exits with
 *  130.
 *  Only the moment in which finished files get their names is not cut short.
 *  A crash prints one line to `errorDescriptor`, removes the temporary files and ends with 1, without a core dump.
 *  Writing beyond a limit or to a closed pipe is an error, not the end.
 *  Must be called once, with a registry that lives as long as the process. */
void
HandleSignals(const TemporaryRegistry & registry, int errorDescriptor);

/** For a command that keeps what is done: the text must live as long as the process. */
void
SayThatIsLeft(const char * text);

/** Of the results of a command that fails now: "nothing was written", unless the command has said something else. */
const char *
WhatIsLeft();

/** The program comes to its end now. Before, an end is a library's doing: it is said, and temporary files go. */
void
EndByItself();

bool
WasInterrupted();

/** For a job that has stopped: it says so itself, and the handler no longer ends the program. */
void
CallOffDeadline();

} // namespace voxelcore
