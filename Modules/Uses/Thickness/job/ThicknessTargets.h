#pragma once
// What the files of the job `thickness` are called, and whether they can be written.

#include "voxelcore/Jobs/LabelLoop.h"
#include "voxelcore/Jobs/OutputTransaction.h"
#include "voxelcore/Thickness/ThicknessJob.h"

#include <filesystem>
#include <string>
#include <vector>

namespace voxelcore
{

/** The map of a label, or with `what` a bound of it; the same for all labels unless the output is a folder. */
std::filesystem::path
ThicknessPath(const ThicknessOptions & options, const LabelRecord & label, const std::string & what);

std::filesystem::path
SeparationPath(const ThicknessOptions & options);

/** What can be told before the scan is read, of files whose folder is there. \throws UsageError, OutputError */
void
CheckThicknessTargets(const ThicknessOptions & options, const OutputTransaction & transaction);

/** What can be told once it is read. \throws UsageError, OutputError */
void
CheckThicknessVolumes(const ThicknessOptions &         options,
                      const ImageGeometry &            geometry,
                      const std::vector<EditedLabel> & labels,
                      const OutputTransaction &        transaction);

} // namespace voxelcore
