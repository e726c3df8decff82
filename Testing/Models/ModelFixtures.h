#pragma once
// Small models, and a folder of its own for each test.

#include "voxelcore/MedialModel.h"

#include <filesystem>
#include <string>

namespace voxelcore::testing
{

/** A core of the given corners and edges on no face; positions, radii and measures are distinct numbers that need all
 *  bits of a double. */
MedialComplex
MakeCore(std::size_t                                      vertices,
         const std::vector<std::array<ElementIndex, 2>> & looseEdges,
         const std::vector<std::vector<ElementIndex>> &   faces,
         double                                           seed = 0);

/** Label 3: a square 0-1-2-3, an edge 3-4, an isolated vertex 5, a pentagon 1-2-6-7-8. Label 7: two isolated vertices.
 *  Label 300: an edge. */
MedialModel
MixedModel();

/** Squares, edges and vertices of an n^3 grid, each there by chance. */
MedialModel
RandomModel(std::uint64_t seed, int n, int parts);

std::string
ReadBytes(const std::filesystem::path & path);
void
WriteBytes(const std::filesystem::path & path, const std::string & bytes);

/** A new folder, removed with all in it at the end. */
class TemporaryFolder
{
public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder &) = delete;
  TemporaryFolder &
  operator=(const TemporaryFolder &) = delete;
  ~TemporaryFolder();
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

private:
  std::filesystem::path m_Path;
};

} // namespace voxelcore::testing
