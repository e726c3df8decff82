#pragma once
// What a stored value is called, and whether it was asked for.

#include "voxelcore/Labels/LabelChoice.h"
#include "voxelcore/Labels/StoredVoxels.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace voxelcore
{

class LabelNaming
{
public:
  struct Label
  {
    std::int64_t value = 0;
    std::string  name;

    std::optional<Color> color{};
  };

  /** A value or name that was asked for. */
  struct Request
  {
    std::string text;
    bool        anyCase = false; ///< no label is called exactly so: upper and lower case are one
  };

  /** \throws UsageError when choice.labels makes no sense. */
  LabelNaming(const StoredVoxels & scan, const LabelChoice & choice);

  /** The label that a value above 0 in a layer stands for; to be asked once for each. Layers may use a value twice:
   *  then segments are numbered from 1 in the order of the file, and values that no segment names get numbers behind
   *  all. */
  Label
  Identify(std::size_t layer, std::int64_t value);

  /** Whether no labels were named. */
  bool
  WantsAll() const
  {
    return m_All;
  }

  /** Whether it was asked for. */
  bool
  IsWanted(const Label & label) const;

  /** True when segments had to be numbered anew. */
  bool
  IsRenumbered() const
  {
    return m_Renumbered;
  }

  /** \throws InputError when something asked for is not among the labels `present` in the part called `where`. */
  void
  RefuseMissing(const std::filesystem::path & path,
                const std::vector<Label> &    present,
                const std::string &           where) const;

private:
  std::map<std::int64_t, ListedLabel>                   m_Names;
  std::map<std::pair<std::size_t, std::int64_t>, Label> m_Segments;
  std::int64_t                                          m_Largest = 0; ///< of the numbers given so far
  bool                                                  m_Renumbered = false;
  bool                                                  m_All = false;
  std::set<std::int64_t>                                m_Given;
  std::vector<Request>                                  m_Requested;
};

} // namespace voxelcore
