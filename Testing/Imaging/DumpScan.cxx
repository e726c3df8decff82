// Prints what ReadLabelVolume makes of a scan, as JSON, for comparison with other readers.

#include "voxelcore/Error.h"
#include "voxelcore/LabelVolume.h"

#include <cstdio>
#include <cstdlib>
#include <iostream>

int
main(int argc, char ** argv)
{
  voxelcore::ReadOptions options;
  if (argc >= 3)
  {
    options.niftiForm = argv[2];
  }
  if (argc >= 4)
  {
    options.component = std::atoi(argv[3]);
  }
  try
  {
    const auto   volume = voxelcore::ReadLabelVolume(argc > 1 ? argv[1] : "", options);
    const auto & g = volume.geometry;
    std::printf("{\"size\":[%lld,%lld,%lld],\"spacing\":[%.17g,%.17g,%.17g],\"affine\":[",
                static_cast<long long>(g.size[0]),
                static_cast<long long>(g.size[1]),
                static_cast<long long>(g.size[2]),
                g.spacing[0],
                g.spacing[1],
                g.spacing[2]);
    for (std::size_t row = 0; row < 3; ++row)
    {
      for (std::size_t column = 0; column < 3; ++column)
      {
        std::printf("%.17g,", g.direction[3 * row + column] * g.spacing[column]);
      }
      std::printf("%.17g%s", g.origin[row], row < 2 ? "," : "],\"labels\":{");
    }
    const char * comma = "";
    for (const auto & label : volume.labels)
    {
      std::printf("%s\"%lld\":%llu",
                  comma,
                  static_cast<long long>(label.value),
                  static_cast<unsigned long long>(label.voxels));
      comma = ",";
    }
    std::printf("}}\n");
  }
  catch (const voxelcore::InputError & error)
  {
    std::cerr << error.what() << "\n";
    return 3;
  }
  return 0;
}
