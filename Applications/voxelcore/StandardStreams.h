#pragma once
// The streams that a program is born with.

namespace voxelcore
{

/** Sends stdout and stderr to nowhere, and gives descriptors of what they were; where that is not to be had, all stays
 *  as it is. */
void
TakeStandardStreams(int & output, int & error);

} // namespace voxelcore
