#pragma once
// What the benchmark program does when it runs as its own child.

namespace voxelcore::performance
{

/** `--task phantom KIND N FOLDER` writes FOLDER/KIND-N.nrrd (8 bit, raw) and FOLDER/KIND-N.points (boundary vertices as
 *  three int32 each) and prints their number. `--task tetgen FILE.points` runs TetGen on them, with the switches of the
 *  TetGen engine, and prints the seconds of that call alone. Returns the exit code. */
int
RunTask(int argc, char ** argv);

} // namespace voxelcore::performance
