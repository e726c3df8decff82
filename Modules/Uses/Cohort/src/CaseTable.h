#pragma once
// Reports as flat rows.

#include "voxelcore/Models/TableColumns.h"

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace voxelcore
{

using Row = nlohmann::ordered_json; ///< an object of plain values

/** Adds the plain values in `json` to `row`, keys joined by "_" and list items numbered from 0; of `leaveOut` none. */
void
Flatten(const nlohmann::ordered_json & json,
        const std::string &            prefix,
        const std::set<std::string> &  leaveOut,
        Row &                          row);

/** The union of the rows' keys, in the order in which they are first met, with the units that their names end in. */
std::vector<TextColumn>
ColumnsOf(const std::vector<Row> & rows);

/** CSV with these columns, empty where a row has no value. */
std::string
CsvTable(const std::vector<Row> & rows, const std::vector<TextColumn> & columns, HeadUnits units);

/** Of one value or more; of an even number the mean of the two in the middle. */
double
Median(std::vector<double> values);

/** Marks what stands out in a cohort. Rows of one label (`label` and `name`) are compared in volume, area, greatest
 *  radius, length, mean radius and numbers of branches, tips and junctions, plants also in their traits, maps also in
 *  their thickness. A value is an outlier when it lies more than 3.5 robust standard deviations (1.4826 times the
 *  median distance from the median; where that is 0, 1.2533 times the mean distance) from the median of at least five
 *  values (Iglewicz and Hoaglin 1993). Each row gets the key `outliers`: the names of these columns, each with + or -,
 *  separated by blanks. */
void
FindOutliers(std::vector<Row> & rows);

} // namespace voxelcore
