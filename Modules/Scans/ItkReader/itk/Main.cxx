// The helper program by which VoxelCore reads what ITK and GDCM know: a process of its own, so that a file that is
// damaged, or made to do harm, ends this program and not the one that asked; so that no other copy of ITK meets ours in
// one process; and so that ITK's libraries are loaded only when they are needed.
//
// usage: voxelcore-itk-reader FORMAT PATH
// Writes what the scan is (ItkScan.h), reads "VOLUME COMPONENT" from its standard input, and writes these voxels. A
// refusal is one line on its standard error and exit code 3.

#include "RunReader.h"

int
main(int argc, char ** argv)
{
  return voxelcore::itkreader::RunReader(argc, argv);
}
