#pragma once
// What an evaluation found, kept in a file and shown as tables.

#include "PruningScores.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace voxelcore::evaluation
{

/** One way of pruning on one sample of a body. */
struct Record
{
  std::string   body;
  bool          thick = false; ///< spacing 1:1:2.5, not 1:1:1
  double        spacing = 0;   ///< mm, the smallest
  std::uint64_t seed = 0;
  std::string   method;
  Scores        scores;
};

/** Records by what they belong to; in a file, if it has a name, to which each group is added as soon as it is there.
 *  A group that was cut off by a killed run is not there. */
class KeptRecords
{
public:
  /** \throws std::runtime_error when the file cannot be made. */
  explicit KeptRecords(std::string path);

  bool
  Has(const std::string & key) const
  {
    return m_Groups.find(key) != m_Groups.end();
  }
  const std::vector<Record> &
  Of(const std::string & key) const
  {
    return m_Groups.at(key);
  }
  void
  Add(const std::string & key, std::vector<Record> records);

private:
  std::string                                m_Path;
  std::map<std::string, std::vector<Record>> m_Groups;
};

/** A row per way of pruning: means of all samples, of some columns the worst. */
void
PrintTable(const std::string & title, const std::vector<Record> & records);

/** Per way of pruning the bodies on which it is worst: ends, lost parts and distances, each the mean of a body's
 *  samples, and the least stable. */
void
PrintWorst(const std::vector<Record> & records);

} // namespace voxelcore::evaluation
