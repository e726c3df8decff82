#pragma once
// What the reading benchmark does when it runs as its own child.

#include <string>
#include <vector>

namespace voxelcore::performance
{

struct ReadingScan
{
  std::string name;
  std::string file;   ///< file or folder, in the benchmark's folder
  bool        packed; ///< one stream of deflate, gzip or zlib
};

/** The scans that the task `write` makes. */
std::vector<ReadingScan>
ReadingScans();

/** `--task write X,Y,Z FOLDER` writes a root phantom in every format. `--task read SCAN labels|binary` reads it, makes
 *  the boundary vertices of all its labels and prints figures. `--task inflate SCAN` unpacks the voxels of a packed
 *  scan with zlib into a buffer that nobody looks at and prints seconds and processor seconds. Returns the exit
 *  code. */
int
RunReadingTask(int argc, char ** argv);

} // namespace voxelcore::performance
