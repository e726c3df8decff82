// Prints what ReadLabelVolume makes of a scan, as JSON, for comparison with other readers.
// usage: DumpScan SCAN [form=auto|sform|qform] [component=N] [volume=N] [threshold=LO:HI] [names]

#include "voxelcore/Error.h"
#include "voxelcore/LabelVolume.h"

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <zlib.h>

namespace
{

voxelcore::ReadOptions
OptionsFrom(int argc, char ** argv)
{
  voxelcore::ReadOptions options;
  for (int n = 2; n < argc; ++n)
  {
    const std::string word = argv[n];
    const std::size_t equals = word.find('=');
    const std::string key = word.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : word.substr(equals + 1);
    if (key == "form")
    {
      options.niftiForm = value;
    }
    else if (key == "component")
    {
      options.component = std::stoll(value);
    }
    else if (key == "volume")
    {
      options.volume = std::stoll(value);
    }
    else if (key == "threshold")
    {
      options.threshold = { std::stod(value), std::stod(value.substr(value.find(':') + 1)) };
    }
    else if (key != "names")
    {
      std::cerr << "unknown option " << word << "\n";
      std::exit(2);
    }
  }
  return options;
}

/** The CRC-32 of a label's voxels as bytes 0 and 1, x fastest. */
unsigned long
MaskDigest(const voxelcore::LabelShape & label, const voxelcore::ImageGeometry & geometry)
{
  unsigned long      digest = crc32(0, nullptr, 0);
  const auto &       size = geometry.size;
  std::vector<Bytef> row(static_cast<std::size_t>(size[0]));
  const auto &       box = label.shape.Box();
  const auto         inside = [&](std::int64_t value, std::size_t axis) {
    return value >= box.lower[axis] && value < box.lower[axis] + box.size[axis];
  };
  for (std::int32_t z = 0; z < size[2]; ++z)
  {
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      for (std::int32_t x = 0; x < size[0]; ++x)
      {
        row[static_cast<std::size_t>(x)] =
          inside(x, 0) && inside(y, 1) && inside(z, 2) && label.shape.Contains(x, y, z) ? 1 : 0;
      }
      digest = crc32(digest, row.data(), static_cast<uInt>(row.size()));
    }
  }
  return digest;
}

} // namespace

int
main(int argc, char ** argv)
{
  try
  {
    const voxelcore::ReadOptions options = OptionsFrom(argc, argv);
    const bool                   names = argc > 2 && std::string(argv[argc - 1]) == "names";
    const auto                   volume = voxelcore::ReadLabelVolume(argc > 1 ? argv[1] : "", options);
    const auto &                 g = volume.geometry;
    std::printf(
      "{\"format\":\"%s\",\"type\":\"%s\",\"size\":[%lld,%lld,%lld],"
      "\"spacing\":[%.17g,%.17g,%.17g],\"affine\":[",
      volume.format.c_str(),
      volume.pixelType.c_str(),
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
    std::printf("}");
    if (names)
    {
      std::printf(",\"more\":{");
      comma = "";
      for (const auto & label : volume.labels)
      {
        const auto color = label.color.value_or(voxelcore::Color{ -1, -1, -1 });
        std::printf("%s\"%lld\":{\"name\":\"%s\",\"color\":[%.6f,%.6f,%.6f],\"mask\":%lu}",
                    comma,
                    static_cast<long long>(label.value),
                    label.name.c_str(),
                    color[0],
                    color[1],
                    color[2],
                    MaskDigest(label, g));
        comma = ",";
      }
      std::printf("}");
    }
    std::printf("}\n");
  }
  catch (const voxelcore::InputError & error)
  {
    std::cerr << error.what() << "\n";
    return 3;
  }
  return 0;
}
