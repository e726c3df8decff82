// What libFuzzer calls with the bytes of a file that it made up; fuzz.py builds and runs it. VOXELCORE_FUZZ is
// KIND:FOLDER:NAME, as in scan:/tmp/whole:a.nrrd: how the bytes are read, and the whole file they stand in for. Found
// is any end but a file read or an InputError of one line.

#include "ReadByKind.h"

#include "voxelcore/Base/Error.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

namespace
{

struct Target
{
  std::string                                     kind;
  std::unique_ptr<voxelcore::testing::StagedFile> file;

  Target()
  {
    const char *      given = std::getenv("VOXELCORE_FUZZ");
    const std::string text = given == nullptr ? "" : given;
    const std::size_t first = text.find(':');
    const std::size_t last = text.rfind(':');
    if (first == last)
    {
      std::fputs("VOXELCORE_FUZZ must be KIND:FOLDER:NAME\n", stderr);
      std::exit(2);
    }
    kind = text.substr(0, first);
    file =
      std::make_unique<voxelcore::testing::StagedFile>(text.substr(first + 1, last - first - 1), text.substr(last + 1));
  }
};

} // namespace

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  static const Target target;
  target.file->Write(reinterpret_cast<const char *>(data), size);
  try
  {
    voxelcore::testing::ReadByKind(target.kind, target.file->Read());
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
