#include "ModelSource.h"
#include "SavedSource.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/TextFields.h"

#include <fstream>
#include <new>
#include <stdexcept>

namespace voxelcore
{
namespace
{

std::string
ReadOpened(const std::filesystem::path & path, const std::function<void(ModelSource &)> & read)
{
  const auto readAll = [&](ModelSource && source) {
    read(source);
    return source.Rounded();
  };
  if (LowerCase(path.extension().string()) == ".vtk")
  {
    return readAll(LegacySource(WholeFile(path)));
  }
  return readAll(XmlSource(path));
}

} // namespace

std::string
WholeFile(const std::filesystem::path & path)
{
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  RequireFit(stream.is_open(), "it cannot be opened");
  std::string bytes(static_cast<std::size_t>(stream.tellg()), '\0');
  stream.seekg(0);
  RequireFit(bytes.empty() || bool(stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))),
             "it cannot be read");
  return bytes;
}

std::string
ReadFrom(const std::filesystem::path &              path,
         Precision                                  precision,
         const std::string &                        maker,
         const std::function<void(ModelSource &)> & read)
{
  const auto fail = [&](const std::string & reason) {
    return InputError("cannot read '" + path.string() + "': " + reason + "; give a .vtp file that 'voxelcore " + maker +
                      "' wrote");
  };
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
  {
    throw InputError("cannot read '" + path.string() + "': there is no such file; check its name");
  }
  if (!std::filesystem::is_regular_file(path, ignored))
  {
    throw InputError("cannot read '" + path.string() + "': it is not a file; give a file");
  }
  try
  {
    std::string rounded = ReadOpened(path, read);
    if (precision == Precision::Exact && !rounded.empty())
    {
      throw fail(rounded + ", as another program saved it, and every digit is needed here");
    }
    return rounded;
  }
  catch (const UnfitFile & unfit)
  {
    throw fail(unfit.reason);
  }
  catch (const std::bad_alloc &)
  {
    throw fail("it is larger than the memory");
  }
  catch (const std::length_error &)
  {
    throw fail("it is larger than the memory");
  }
}

MedialModel
ReadModel(const std::filesystem::path & path, Precision precision)
{
  MedialModel model;
  std::string rounded = ReadFrom(path, precision, "core", [&](ModelSource & source) { model = ReadParts(source); });
  model.rounded = std::move(rounded);
  return model;
}

} // namespace voxelcore
