#pragma once
// What comparisons of a cohort come to.

#include "CaseTable.h"

#include <vector>

namespace voxelcore
{

/** The half width of the 95 % interval of a mean of n >= 2 normal values, in units of their standard deviation over the
 *  root of n: the quantile of Student's t at 0.975 with n - 1 degrees of freedom (Abramowitz and Stegun 26.7.3 and 4,
 *  turned round by halving). */
double
StudentHalfWidth(std::size_t n);

/** Of rows as labels.csv has them a row for each label and each of its measures `compare_...`: label, name, measure,
 *  cases, mean, ci95_low and ci95_high (Student's; none of a single case), sd (n - 1), median, min, max. Cases in which
 *  a measure does not exist do not count. */
std::vector<Row>
MeansOfComparisons(const std::vector<Row> & labels);

} // namespace voxelcore
