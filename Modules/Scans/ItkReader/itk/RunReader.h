#pragma once
// The helper program's work.

namespace voxelcore::itkreader
{

/** Arguments and exit code of the program (Main.cxx). It limits its process. */
int
RunReader(int argc, char ** argv);

} // namespace voxelcore::itkreader
