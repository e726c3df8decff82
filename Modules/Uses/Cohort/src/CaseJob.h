#pragma once
// A case with all that its process gets.

#include "voxelcore/Cohort/BatchJob.h"

#include <filesystem>
#include <string>
#include <vector>

namespace voxelcore
{

struct CaseJob
{
  CohortCase                         one;
  std::filesystem::path              folder;
  std::vector<std::string>           arguments; ///< of its process
  std::string                        options;   ///< those that change the result, for CaseKey()
  ReadOptions                        reading;   ///< of its scan
  std::vector<std::filesystem::path> masks;     ///< files that its options name
  std::string                        refusal;   ///< why its command takes no such options; empty: it does
};

/** \throws UsageError for options of a command that is not run */
CaseJob
MakeCaseJob(const CohortCase & one, const BatchOptions & options);

/** CaseKey() of the case, whose scan has this ScanSha256(). \throws InputError */
std::string
KeyOf(const CaseJob & job, const std::string & digest);

/** Whether it is what `batch` runs where nothing is said. */
bool
IsUsual(const Command & command);

/** Whether one of OptionsOfCases() says what becomes of a case. */
bool
DescribesACase(const Parameter & parameter);

/** `where` stands in front of what is wrong. \throws UsageError for options of a command that is not run */
void
RequireTaken(const ParameterValues & values, const BatchOptions & options, const std::string & where);

/** What stands where the folder of a case goes, which is made if need be; empty when it is there. It is this case's
 *  trouble alone. \throws OutputError when no folder can be made where all of them go */
std::string
TroubleWith(const std::filesystem::path & folder);

/** Why no results can go into the folder of a case; empty when they can. \throws OutputError as TroubleWith() */
std::string
TroubleWritingInto(const std::filesystem::path & folder);

} // namespace voxelcore
