#pragma once
// What is known of a case that was run: sub-X/sub-X_case.json. It decides what a batch that is started again has to do.

#include "voxelcore/Formats/ReadOptions.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

class TemporaryRegistry;

struct RecordedFile
{
  std::string   name; ///< in the case's folder
  std::uint64_t bytes = 0;
  std::string   sha256;
};

struct CaseRecord
{
  std::string               id;
  std::string               scan;
  std::string               key; ///< CaseKey(): of input, parameters and sources
  bool                      done = false;
  std::string               reason;   ///< why it failed
  std::vector<std::string>  warnings; ///< what the case said on its way
  std::vector<RecordedFile> outputs;  ///< every file it left, by name
  double                    seconds = 0;
};

/** Digest of what a result depends on: the scan's content, as far as it is read (and that of the lists of label names
 *  beside it), the options that were given and the content of `masks`, files they name, and the sources of the program.
 *  Where the scan lies does not matter. \throws InputError when a file cannot be read */
std::string
CaseKey(const std::filesystem::path &              scan,
        const std::string &                        options,
        const ReadOptions &                        reading = {},
        const std::vector<std::filesystem::path> & masks = {});

/** The same key where the scan has been read: `digest` is its ScanSha256(). */
std::string
CaseKeyOf(const std::string &                        digest,
          const std::filesystem::path &              scan,
          const std::string &                        options,
          const std::vector<std::filesystem::path> & masks);

/** "<folder>/<folder's name>_case.json" */
std::filesystem::path
RecordPath(const std::filesystem::path & folder);

/** Everything the case has left in its folder, by name, with digests; the record itself and files that were not
 *  finished are no outputs. None when there is no folder. \throws InputError when a file goes away meanwhile */
std::vector<RecordedFile>
ListOutputs(const std::filesystem::path & folder);

/** Writes the record, all at once. `temporaries`, where given, names the temporary file meanwhile, so that it is
 *  removed if the program is ended. \throws OutputError */
void
WriteCaseRecord(const std::filesystem::path & folder,
                const CaseRecord &            record,
                TemporaryRegistry *           temporaries = nullptr);

/** The same for a folder that somebody may have removed: false when it has gone.
 *  \throws OutputError for other reasons */
bool
WriteRecordIfThere(const std::filesystem::path & folder,
                   const CaseRecord &            record,
                   TemporaryRegistry *           temporaries = nullptr);

/** None when there is none or it is damaged: a record ends in its own digest. */
std::optional<CaseRecord>
ReadCaseRecord(const std::filesystem::path & folder);

/** The digest of the scan that a case has seen, by its report; empty when there is none. */
std::string
ScanDigestOfResults(const std::filesystem::path & folder);

/** Whether the case is done with this key and every file is there as it was written, to the last bit. Asking the files
 *  themselves holds after a loss of power too, which may lose what was written before what was renamed. */
bool
IsDone(const std::filesystem::path & folder, const std::string & key);

/** Removes what a case left, finished or not: the files that begin with the folder's name. The record goes first. */
void
ClearCase(const std::filesystem::path & folder);

} // namespace voxelcore
