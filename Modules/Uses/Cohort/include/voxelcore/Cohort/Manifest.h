#pragma once
// The cases of a cohort: from a manifest, or found in folders.

#include "voxelcore/Options/Parameters.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace voxelcore
{

/** One scan and what to do with it. */
struct CohortCase
{
  std::string     id;     ///< as given, or made of the scan's name
  std::string     folder; ///< "sub-..." below the output folder, CaseFolder() of the id
  std::string     scan;   ///< path; as text, a third of what one that is taken apart takes
  ParameterValues values; ///< options of its command that hold for this case alone
};

/** Whether the value of an option is the path of a file that is read beside the scan. */
bool
NamesFileOf(const Parameter & option, const std::string & value);

/** The folder of a case: "sub-" and the id, which keeps its letters, digits, "-" and "_". An id with other characters,
 *  or more than 64, loses these ("/" becomes "_") and gets "x" and eight digits of its SHA-256, so that different ids
 *  never meet in one folder. A leading "sub-" of the id is dropped. */
std::string
CaseFolder(const std::string & id);

/** Of cases that would go into one folder, the first that comes after another, and that one before it. */
std::optional<std::pair<std::size_t, std::size_t>>
CaseThatIsThereTwice(const std::vector<CohortCase> & cases);

/** A manifest: CSV (or .tsv) whose first row names the columns `id` (or `participant_id`), `scan`, and any of `options`
 *  (OptionsOfCases) without its dashes; `note` is passed over. An empty field means the option is not given; flags take
 *  yes/no, true/false or 1/0. Relative paths, of scans and of files beside them (`within`, `b`), are looked for from
 *  the manifest's folder. Whether a scan exists, and whether a value has sense, shows when its case runs.
 *  \throws InputError naming file and line: a column missing, unknown or doubled, an id or scan empty or an id doubled,
 *  a row of another length, what ParseCsv refuses, no row at all. */
std::vector<CohortCase>
ReadManifest(const std::filesystem::path & manifest, std::span<const Parameter> options);

/** The cases that `inputs` stand for, in their order: manifests (.csv, .tsv); scans; patterns (`*`, `?`, `[..]`), of
 *  which each match is a scan; folders, in which scans are looked for at any depth, sorted by path. A folder that holds
 *  several .tif or .png directly is one scan, a stack of slices. The ids of scans that are not in a manifest are their
 *  names; those found below a folder have the folders between in front. Of one name, they get their
 *  files' whole names, then their whole paths; but a scan that has a record in `output` under one of these names keeps
 *  it, whatever scans have come or gone since. The same file twice is one case. The folder `output`, where results go,
 *  is passed over, and so are folders of cases that any batch has left. Files in folders that are neither a scan nor
 *  belong to one are added to `passedOver`.
 *  \throws InputError for an input that does not exist, a pattern or folder without scans, two cases with one id. */
std::vector<CohortCase>
FindCases(const std::vector<std::filesystem::path> & inputs,
          std::span<const Parameter>                 options,
          const std::filesystem::path &              output = {},
          std::vector<std::filesystem::path> *       passedOver = nullptr);

} // namespace voxelcore
