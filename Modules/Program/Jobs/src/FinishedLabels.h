#pragma once
// What labels of a folder are finished, so that a run that was stopped, however, goes on.

#include "voxelcore/Jobs/OutputTransaction.h"
#include "voxelcore/Jobs/SystemFiles.h"
#include "voxelcore/Report/CoreReport.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

/** A line of JSON for each label that was finished: the key of all it depends on, its files with their digests, what
 *  the report says of it, and the digest of the line. A line is appended before its files get their names, so that
 *  every file is known; and a label is finished when its files are there, to the last bit, so that nothing depends on
 *  the order in which a disk writes. A line cut off by a kill is passed over. */
class FinishedLabels
{
public:
  struct Label
  {
    LabelRecord              record;
    std::vector<std::string> notes; ///< what a user was told
  };

  /** `file` need not be there; it is made with the first label. Files of labels that were stopped or damaged while they
   *  were made with this key are removed when they are looked for.
   *  \throws OutputError also when another run is writing into it. */
  FinishedLabels(std::filesystem::path file, std::string key);
  /** The label, where it is finished with this key. */
  std::optional<Label>
  Find(std::int64_t value, std::int64_t component, const std::string & name) const;

  /** Notes a label whose files are staged, and gives them their names. \throws OutputError */
  void
  Finish(const Label & label, SpatialUnit unit, OutputTransaction & transaction);

  /** Whether it is a table that an earlier run left. */
  bool
  IsTable(const std::filesystem::path & target) const;

  /** The tables of a folder depend on which labels there are: those that an earlier run left are known by their line,
   *  too. Removes them, to make room for new ones. */
  void
  RemoveTables() const;

  /** Notes the files of the folder that are staged. \throws OutputError */
  void
  NoteTables(const OutputTransaction & transaction);

private:
  struct File
  {
    std::string   name; ///< in the folder
    std::uint64_t bytes = 0;
    std::string   sha256;
  };
  struct Line
  {
    std::string              key;
    std::int64_t             value = 0;
    std::int64_t             component = 0;
    std::vector<File>        files;
    std::string              record; ///< JSON
    std::vector<std::string> notes;
  };

  static std::optional<Line>
  ParseLine(const std::string & text);
  static std::string
  LineText(const Line & line);

  std::vector<File>
  StagedInFolder(const OutputTransaction & transaction) const;
  void
  Append(const Line & line);
  void
  RemoveUnlessOthers(const Line & line) const;
  void
  Open(bool create);
  void
  Read();
  bool
  IsThere(const File & file) const;

  std::filesystem::path m_File;
  std::string           m_Key;
  LockedFile            m_Lock;
  bool                  m_EndsInLine = true; ///< else a kill cut the last one off
  std::vector<Line>     m_Lines;
};

/** The digest of what a label of this report depends on, and of `more`: the scan, the options and the program's
 *  sources. The report needs its input and its parameters. */
std::string
LabelKey(const CoreReport & report, const std::string & more);

} // namespace voxelcore
