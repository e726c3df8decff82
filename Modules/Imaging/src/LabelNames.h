#pragma once
// What a stored value is called, and whether it was asked for.

#include "ScanFile.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace voxelcore
{

/** What a list beside a scan says of a value. */
struct ListedLabel
{
  std::string                          name; ///< empty where the list has colours only
  std::optional<std::array<double, 3>> color{};
};

/** From "<scan without .gz>.txt", "<scan without extensions>.txt", or the same with .label, .ctab or .lut, beside the scan;
 *  the first that says anything gives the names, the first with colours the colours. A line each:
 *  - ITK-SNAP's label descriptions: value, red, green, blue (0 to 255), opacity, two flags, "name";
 *  - FreeSurfer's colour tables: value, name, red, green, blue, and one more number;
 *  - value, blank or tab, name; columns of numbers behind the name that every line has are dropped.
 *  Lines that do not begin with a number are ignored. A .lut of 768 bytes is MRIcron's: 256 reds, greens and blues.
 *  Empty when there is no such file. */
std::map<std::int64_t, ListedLabel>
ReadLabelList(const std::filesystem::path & scan);

class LabelBook
{
public:
  struct Label
  {
    std::int64_t value = 0;
    std::string  name;

    std::optional<std::array<double, 3>> color{}; ///< as LabelShape::color
  };

  /** A value or name that was asked for. */
  struct Wish
  {
    std::string text;
    bool        anyCase = false; ///< no label is called exactly so: upper and lower case are one
  };

  /** \throws UsageError when options.labels makes no sense. */
  LabelBook(const ScanFile & scan, const ReadOptions & options);

  /** The label that a value above 0 in a layer stands for; to be asked once for each. Layers may use a value twice: then
   *  segments are numbered from 1 in the order of the file, and values that no segment names get numbers behind all. */
  Label
  Identify(std::size_t layer, std::int64_t value);

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
  std::vector<Wish>                                     m_Wishes;
};

} // namespace voxelcore
