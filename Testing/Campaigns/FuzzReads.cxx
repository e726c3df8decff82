// What libFuzzer calls with the bytes of a file that it made up; fuzz.py builds and runs it. VOXELCORE_FUZZ is
// KIND:NAME, as in scan:a.nrrd: how the bytes are read, and the name they stand under meanwhile. Found is any end but a
// file read or an InputError of one line.

#include "ReadByKind.h"

#include "voxelcore/Error.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace
{

struct Target
{
  std::string           kind;
  std::filesystem::path path;

  Target()
  {
    const char *      given = std::getenv("VOXELCORE_FUZZ");
    const std::string text = given == nullptr ? "" : given;
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos)
    {
      std::fputs("VOXELCORE_FUZZ must be KIND:NAME\n", stderr);
      std::exit(2);
    }
    kind = text.substr(0, colon);
    // A folder of its own: what lies beside a scan may be read with it.
    path = std::filesystem::path("/dev/shm") / ("voxelcore-fuzz-" + std::to_string(getpid())) / text.substr(colon + 1);
    std::filesystem::create_directory(path.parent_path());
  }

  ~Target()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path.parent_path(), ignored);
  }
};

} // namespace

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  static const Target target;
  {
    std::ofstream file(target.path, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char *>(data), static_cast<std::streamsize>(size));
  }
  try
  {
    voxelcore::testing::ReadByKind(target.kind, target.path);
  }
  catch (const voxelcore::InputError & error)
  {
    const std::string said = error.what();
    if (said.empty() || said.find('\n') != std::string::npos)
    {
      std::fprintf(stderr, "not one line: %s\n", said.c_str());
      std::abort();
    }
  }
  return 0;
}
