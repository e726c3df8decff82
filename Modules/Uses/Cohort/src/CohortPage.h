#pragma once
// The page over a cohort.

#include "CaseTable.h"
#include "voxelcore/Cohort/CaseRecord.h"

#include <string>
#include <vector>

namespace voxelcore
{

/** What the page shows of a case. */
struct PageCase
{
  std::string      folder;
  CaseRecord       record;
  std::vector<Row> labels; ///< its rows of labels.csv
};

/** The whole page as HTML with everything it needs in it: works from disk, offline. Nothing of the cases is ever taken
 *  for markup: it comes as data and becomes text. */
std::string
CohortPage(const std::vector<PageCase> & cases);

} // namespace voxelcore
