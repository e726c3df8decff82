#pragma once
// A folder of a test's own that goes with it.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>

namespace voxelcore::testing
{

class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::string name = (std::filesystem::temp_directory_path() / "voxelcore-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
    {
      throw std::runtime_error("cannot make " + name);
    }
    m_Path = name;
  }
  TemporaryFolder(const TemporaryFolder &) = delete;
  TemporaryFolder &
  operator=(const TemporaryFolder &) = delete;
  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(m_Path, ignored);
  }

  std::filesystem::path
  operator/(const std::string & name) const
  {
    return m_Path / name;
  }
  const std::filesystem::path &
  Path() const
  {
    return m_Path;
  }

  /** Names of all entries. */
  std::set<std::string>
  Names() const
  {
    std::set<std::string> names;
    for (const auto & entry : std::filesystem::directory_iterator(m_Path))
    {
      names.insert(entry.path().filename().string());
    }
    return names;
  }

private:
  std::filesystem::path m_Path;
};

inline std::string
ReadAll(const std::filesystem::path & path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

inline void
WriteAll(const std::filesystem::path & path, const std::string & text)
{
  std::ofstream(path, std::ios::binary) << text;
}

} // namespace voxelcore::testing
