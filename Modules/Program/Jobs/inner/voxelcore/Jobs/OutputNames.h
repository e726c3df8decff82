#pragma once
// What result files are called.

#include "voxelcore/VoxelCore/LambdaPruning.h"
#include "voxelcore/VoxelCore/TolerancePruning.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace voxelcore
{

/** Whether `-o` means a folder: it ends in a slash or is one already. */
bool
IsFolderOutput(const std::filesystem::path & output);

/** A scan's name without folder and extensions: "aal" of "/data/aal.nii.gz"; characters that shells or other systems
 *  dislike in names become "_". */
std::string
ScanName(const std::filesystem::path & scan);

/** "0", "1mm", "2.5vox", "2.5pct". */
std::string
LambdaTag(const Lambda & lambda);

/** Comma-separated thresholds; a bare number gets its unit, mm. In the order given.
 *  \throws UsageError for one that is empty, wrong, or given twice. */
std::vector<Lambda>
ParseLambdas(std::string_view text);

/** The same for tolerances. */
std::vector<Tolerance>
ParseTolerances(std::string_view text);

/** What tells the results of a run apart in their names: "" for a single one, else "_lambda-1mm" and so on, or, with
 *  tolerances (then there is one lambda), "_tolerance-1.2diag" and so on. */
std::vector<std::string>
ResultSuffixes(const std::vector<Lambda> & lambdas, const std::vector<Tolerance> & tolerances = {});

/** "OUT<suffix>.vtp" for "OUT.vtp", "OUT<suffix>.nii.gz" for "OUT.nii.gz". */
std::filesystem::path
FileOutputPath(const std::filesystem::path & output, const std::string & suffix);

/** "<folder>/<scan>_label-<value>_medial<suffix>.vtp"; of a component (not 0)
 *  "..._label-<value>_component-<n>_medial...". */
std::filesystem::path
FolderOutputPath(const std::filesystem::path & folder,
                 const std::filesystem::path & scan,
                 std::int64_t                  label,
                 const std::string &           suffix,
                 std::int64_t                  component = 0);

/** "<folder>/<scan>_label-<value>_skeleton.vtp", of a component (not 0) "..._label-<value>_component-<n>_skeleton.vtp".
 *  Of a core's file, "<scan>_label-<value>_medial.vtp", what comes before "_label-" or "_medial" counts as the scan's
 *  name. */
std::filesystem::path
SkeletonFolderPath(const std::filesystem::path & folder,
                   const std::filesystem::path & input,
                   std::int64_t                  label,
                   std::int64_t                  component = 0);

/** "<folder>/<scan>_label-<value>_<what>.nrrd", of a component (not 0)
 *  "..._label-<value>_component-<n>_<what>.nrrd". */
std::filesystem::path
VolumeFolderPath(const std::filesystem::path & folder,
                 const std::filesystem::path & scan,
                 std::int64_t                  label,
                 std::int64_t                  component,
                 const std::string &           what);

/** "<folder>/<scan>_skeleton.vtp": tables of all labels of a folder are named after it. */
std::filesystem::path
SkeletonTablesPath(const std::filesystem::path & folder, const std::filesystem::path & input);

/** Where `core` writes the skeletons to: "OUT_skeleton.vtp" for "OUT.vtp" and for "OUT_medial.vtp", a folder for a
 *  folder. */
std::filesystem::path
SkeletonBesideCore(const std::filesystem::path & output);

} // namespace voxelcore
