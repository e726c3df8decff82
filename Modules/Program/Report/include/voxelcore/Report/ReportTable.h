#pragma once
// A report as a table for people: a row per label.

#include "voxelcore/Models/TableHead.h"
#include "voxelcore/Report/CoreReport.h"

#include <string>
#include <vector>

namespace voxelcore
{

/** Rows of cells as lines: columns as wide as their widest cell (in characters of UTF-8), the second left-aligned, the
 *  others right-aligned. The first row is the head. */
std::string
FormatTable(const std::vector<std::vector<std::string>> & rows);

/** label, name, voxels, boundary vertices, core faces, pruned faces (a column per lambda), chi/b0/b1/b2 of the shape
 *  and of the core, certificate, seconds; below a line of totals. */
std::string
ReportTable(const CoreReport & report);

/** A row per label that has a skeleton: label, name, branches, tips, junctions, cycles, length, mean radius,
 *  chi/b0/b1/b2 of the shape and of the skeleton, certificate. */
std::string
SkeletonTable(const CoreReport & report);

/** "-2/1/3/0": Euler number and Betti numbers. */
std::string
TopologyText(const TopologyNumbers & topology);

/** The labels of a report as .csv, a row for each and result: label, name, component, lambda or tolerance, voxels,
 *  volume_mm3, vertices, edges, faces, area_mm2, max_radius_mm, b0, b1, b2. */
std::string
LabelTableCsv(const CoreReport & report, HeadUnits units = {});

/** What its columns mean, as JSON. */
std::string
LabelTableColumnsJson(const CoreReport & report);

} // namespace voxelcore
