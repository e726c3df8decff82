#include "ModelSource.h"
#include "SavedSource.h"
#include "VtpFile.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/TextFields.h"

#include <fstream>
#include <new>
#include <stdexcept>

namespace voxelcore
{
namespace
{

/** A file as a source. */
class FileSource : public ModelSource
{
public:
  explicit FileSource(const std::filesystem::path & path)
    : m_File(path)
  {}
  std::uint64_t
  PieceCount(const std::string & attribute) const override
  {
    return m_File.PieceCount(attribute);
  }
  bool
  Has(const std::string & section, const std::string & name) const override
  {
    return m_File.Has(section, name);
  }
  std::vector<double>
  ReadReals(const std::string & section, const std::string & name, int components) override
  {
    return m_File.Read<double>(section, name, components);
  }
  std::vector<std::int64_t>
  ReadWholes(const std::string & section, const std::string & name, int components) override
  {
    return m_File.Read<std::int64_t>(section, name, components);
  }
  std::vector<std::int64_t>
  ReadIndices(const std::string & section, const std::string & name) override
  {
    return m_File.ReadIndices(section, name);
  }
  std::string
  ReadText(const std::string & section, const std::string & name) override
  {
    return m_File.ReadText(section, name);
  }

private:
  VtpFile m_File;
};

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
  try
  {
    return readAll(FileSource(path));
  }
  catch (const OtherForm &)
  {
    return readAll(XmlSource(WholeFile(path)));
  }
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
