#include "ModelSource.h"
#include "VtpFile.h"
#include "voxelcore/Error.h"

#include <new>

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

} // namespace

MedialModel
ReadModel(const std::filesystem::path & path)
{
  const auto fail = [&](const std::string & reason) {
    return InputError("cannot read '" + path.string() + "': " + reason +
                      "; give a .vtp file that 'voxelcore core' wrote");
  };
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
  {
    throw InputError("cannot read '" + path.string() + "': there is no such file");
  }
  if (!std::filesystem::is_regular_file(path, ignored))
  {
    throw InputError("cannot read '" + path.string() + "': it is not a file");
  }
  try
  {
    FileSource file(path);
    return ReadParts(file);
  }
  catch (const UnfitFile & unfit)
  {
    throw fail(unfit.reason);
  }
  catch (const std::bad_alloc &)
  {
    throw fail("it is larger than the memory");
  }
}

} // namespace voxelcore
