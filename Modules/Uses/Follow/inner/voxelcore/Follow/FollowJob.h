#pragma once
// `voxelcore follow`: the same roots or vessels in scans over time.

#include "voxelcore/Follow/BranchIdentities.h"
#include "voxelcore/Jobs/JobContext.h"
#include "voxelcore/Jobs/SkeletonJob.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

struct FollowOptions
{
  std::vector<std::filesystem::path>   days;          ///< two or more, in order: scans, or skeletons
  SkeletonOptions                      making;        ///< how scans are read, and how their skeletons are made
  std::vector<double>                  times;         ///< of the days, rising; empty: 1, 2, ...
  std::optional<Lambda>                near;          ///< the least tolerance; none: a voxel's diagonal, of skeletons 0
  bool                                 still = false; ///< nothing has moved
  std::filesystem::path                output;        ///< a folder
  std::optional<std::filesystem::path> report{};      ///< .json
  bool                                 force = false;
  std::string                          command{}; ///< only recorded
};

struct FollowResult
{
  SpatialUnit              unit = SpatialUnit::Millimetres;
  std::vector<std::string> names; ///< of the files
  std::vector<double>      times;
  std::vector<FollowedDay> days;
  std::vector<FoundMotion> motions; ///< how the day before was found; `motion` is the day's into the space of the first
  std::vector<std::string> warnings;
};

/** Reads, follows, checks, writes into the folder: branches.csv, days.csv, columns.json, identities.vtp and a .rsml a
 *  day. \throws UsageError, InputError (also where too little of a day is found on the next), OutputError,
 *  CertificateError, Cancelled */
FollowResult
RunFollowJob(const FollowOptions & options, const JobContext & context = {});

/** Both tables as JSON. */
std::string
FollowJson(const FollowResult & result, const std::string & command);

/** A line a day. */
std::string
FollowText(const FollowResult & result);

} // namespace voxelcore
