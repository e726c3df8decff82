#pragma once
// `voxelcore skeleton --edits`, `--annotations`: a tree corrected by hand, and what a person needs to do so.

#include "voxelcore/Corrections/TreeEdits.h"
#include "voxelcore/Jobs/JobContext.h"
#include "voxelcore/Jobs/SkeletonJob.h"

#include <filesystem>
#include <optional>

namespace voxelcore
{

struct CorrectionsOptions
{
  SkeletonOptions                      making; ///< of one label of a scan, into one .vtp
  std::optional<std::filesystem::path> edits;  ///< annotations of an earlier run, or lines of a person's own
};

/** Makes the skeleton, does the edits to the body, and makes the skeleton of that, certified; the body is recorded by
 *  the voxels that changed. Edits that do not fit are told as warnings and left out. "OUT_annotations.csv" and
 *  "OUT_annotations.mrk.json" have a row for each branch and junction of the tree before it was edited, with what was
 *  said of it, and for each edit elsewhere: given to `edits` again, they give the same files.
 *  \throws UsageError, InputError, OutputError, CertificateError, Cancelled */
SkeletonResult
RunCorrectionsJob(const CorrectionsOptions & options, const JobContext & context = {});

} // namespace voxelcore
