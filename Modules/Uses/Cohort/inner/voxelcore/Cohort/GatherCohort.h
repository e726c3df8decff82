#pragma once
// Tables and a page over all cases of an output folder.

#include "voxelcore/Cohort/BatchJob.h"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace voxelcore
{

struct CohortSummary
{
  std::size_t             cases = 0;
  std::vector<FailedCase> failed;
};

/** Writes, all at once, from the records and reports of the cases in `folder` (whichever batch made them):
 *  - cases.csv: a row per case: id, status, reason, and every number and word of its report outside its labels, whose
 *    values stand in one column;
 *  - labels.csv: a row per case and label with every number of the report's label (of `cuts` only how many there are),
 *    and `outliers`: FindOutliers();
 *  - means.csv, of comparisons: a row per label and measure, MeansOfComparisons();
 *  - dataset_description.json, of BIDS derivatives;
 *  - columns.json: what the columns mean;
 *  - bids/, if asked for: the results under the names of BIDS derivatives;
 *  - index.html: the same for people, without anything from elsewhere.
 *  Columns: the keys of the report joined by "_"; numbers in lists from 0. Text that a spreadsheet would take for a
 *  formula has an apostrophe in front. Cases of `expected` that have left no record count as failed, and so do those of
 *  `failed` that could not be recorded, whatever record they have from before. Ordered by id.
 *  \throws OutputError; InputError when there is nothing to gather */
CohortSummary
GatherCohort(const std::filesystem::path &   folder,
             const std::vector<CohortCase> & expected,
             const JobContext &              context = {},
             const std::vector<FailedCase> & failed = {},
             bool                            bids = false);

} // namespace voxelcore
