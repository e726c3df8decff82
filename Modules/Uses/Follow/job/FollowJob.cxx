#include "voxelcore/Follow/FollowJob.h"

#include "FollowTables.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Jobs/CoreJobSteps.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Models/TreeFiles.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

/** Of the day before, share of the length that must be found on a day, or its motion is not believed. Of other trees
 *  0.40 is found at most (RigidMotionGTest, 20 seeds), of the same on 273 days of follow.py 0.76 and more. */
constexpr double kLeastFound = 0.5;
constexpr double kFewFound = 0.8; ///< and below which a user is told
/** FoundMotion::spread above which a motion is uncertain. On those days it is 1.2 at most, but once 1.6, where the day
 *  before had one root with hardly a bend; of straight lines more. */
constexpr double kMostSpread = 1.5;

struct DayRead
{
  SkeletonGraph graph;
  SpatialUnit   unit = SpatialUnit::Millimetres;
  double        diagonal = 0; ///< of a voxel; 0 where there are none
};

DayRead
ReadDay(const fs::path &           path,
        const SkeletonOptions &    making,
        std::vector<std::string> & warnings,
        const ProgressCallback &   progress)
{
  DayRead day;
  if (IsTreePath(path) || IsFinishedCore(path, making.reading, making.resolution))
  {
    const SkeletonModel model = IsTreePath(path) ? ReadTreeFile(path) : ReadSkeletonVtp(path);
    WarnOfRounding(path, model.rounded, warnings);
    day.unit = model.unit;
    day.graph = MergedGraph(model);
  }
  else
  {
    InputScan scan =
      ReadScanOrMesh(path, making.reading, making.resolution, PartOfProgress(progress, "reading", 0, 0.2));
    warnings.insert(warnings.end(), scan.warnings.begin(), scan.warnings.end());
    if (scan.labels.size() != 1)
    {
      throw UsageError(path.string() + ": " + std::to_string(scan.labels.size()) +
                       " labels; choose one with --labels, or take all as one with --binary");
    }
    day.unit = scan.geometry.unit;
    day.diagonal = Length(scan.geometry.spacing);
    day.graph = SkeletonsOfMasks(std::move(scan.labels),
                                 scan.geometry,
                                 making,
                                 path.string(),
                                 PartOfProgress(progress, 0.2, 1))[0]
                  .graph;
  }
  constexpr double farthest = 1e15; // mm; squares of more than 1e150 overflow
  if (ranges::any_of(day.graph.positions, [](const Vector3 & place) { return !(Length(place) <= farthest); }))
  {
    throw InputError(path.string() + ": a point is more than 1e15 mm from the origin; correct its coordinates");
  }
  if (day.graph.BranchCount() == 0)
  {
    throw InputError(path.string() + ": has no branch to follow; choose another label, or leave this day out");
  }
  return day;
}

std::vector<double>
TimesOf(const FollowOptions & options)
{
  if (options.days.size() < 2)
  {
    throw UsageError("one day alone tells no growth; give the scans of two days or more");
  }
  std::vector<double> times = options.times;
  while (options.times.empty() && times.size() < options.days.size())
  {
    times.push_back(static_cast<double>(times.size() + 1));
  }
  const bool rises = ranges::adjacent_find(times, [](double a, double b) { return !(a < b); }) == times.end();
  if (times.size() != options.days.size() || !rises)
  {
    throw UsageError("--times: expected a time for each of the " + std::to_string(options.days.size()) +
                     " days, each later than the one before, such as 0,7,14");
  }
  return times;
}

void
Move(SkeletonGraph & graph, const RigidMotion & motion)
{
  for (auto * places : { &graph.positions, &graph.medial })
  {
    ranges::transform(*places, places->begin(), motion);
  }
}

/** Tells, or refuses, a motion that is not to be trusted. */
void
JudgeMotion(const FoundMotion & found, const fs::path & before, const fs::path & now, bool still, FollowResult & result)
{
  const std::string share = FixedText(100 * found.found, 1) + " % of the length of " + before.string() + " is found";
  if (found.found < kLeastFound)
  {
    throw InputError(now.string() + ": only " + share +
                     (still ? " where it was; leave out --motion none, or give a greater --near"
                            : " in it, however it is moved; check the order of the days, put one between, give a "
                              "greater --near, or align them and give --motion none"));
  }
  if (found.found < kFewFound)
  {
    result.warnings.push_back(now.string() + ": " + share +
                              " in it; look at identities.vtp before you use its numbers");
  }
  if (!still && found.spread > kMostSpread)
  {
    result.warnings.push_back(now.string() + ": its motion is uncertain by " + FixedText(found.spread * found.rms) +
                              " " + UnitName(result.unit) +
                              ", as its lines may slide or turn in themselves; align the days and give --motion none");
  }
}

} // namespace

FollowResult
RunFollowJob(const FollowOptions & options, const JobContext & given)
{
  const JobContext context = ForwardOnly(given);
  FollowResult     result;
  result.times = TimesOf(options);
  OutputTransaction transaction(options.force, context.temporaries);
  ranges::for_each(options.days, [&](const fs::path & day) { transaction.Protect(day); });
  transaction.MakeDirectory(options.output);
  const auto            place = [&](const std::string & name) { return options.output / name; };
  const auto            rsml = [&](std::size_t day) { return place("day-" + std::to_string(day + 1) + ".rsml"); };
  std::vector<fs::path> targets;
  for (const char * name : { "branches.csv", "days.csv", "columns.json", "identities.vtp" })
  {
    targets.push_back(place(name));
  }
  for (std::size_t day = 0; day < options.days.size(); ++day)
  {
    targets.push_back(rsml(day));
  }
  if (options.report)
  {
    targets.push_back(*options.report);
  }
  CheckTargets(transaction, targets);

  const double               each = 0.9 / static_cast<double>(options.days.size());
  std::vector<SkeletonGraph> graphs;
  double                     least = 0;
  for (const fs::path & path : options.days)
  {
    const double begin = each * static_cast<double>(graphs.size());
    DayRead      day = ReadDay(path,
                          options.making,
                          result.warnings,
                          NamedPartOfProgress(context.progress, path.filename().string(), begin, begin + each));
    if (graphs.empty())
    {
      result.unit = day.unit;
    }
    RequireSameUnit(options.days.front(), result.unit, path, day.unit);
    least = std::max(least, day.diagonal);
    graphs.push_back(std::move(day.graph));
    result.names.push_back(path.filename().string());
  }
  least = options.near ? PlainLength(*options.near, result.unit, "--near") : least;
  for (std::size_t day = 0; day < graphs.size() && !(least > 0); ++day)
  {
    if (!ranges::all_of(SectionRadii(graphs[day]), [](double radius) { return radius > 0; }))
    {
      throw InputError(options.days[day].string() +
                       ": has points without radii, so nothing says how near is near; give --near, such as 1mm");
    }
  }

  ReportProgress(context.progress, "following", 0.9);
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  result.motions.push_back({ {}, none, none, none });
  for (std::size_t day = 1; day < graphs.size(); ++day)
  {
    FoundMotion found = options.still ? MeasureMotion(graphs[day - 1], graphs[day], {}, least)
                                      : FindMotion(graphs[day - 1], graphs[day], least);
    JudgeMotion(found, options.days[day - 1], options.days[day], options.still, result);
    found.motion = found.motion.Inverse();
    Move(graphs[day], found.motion); // the day before is in the space of the first
    result.motions.push_back(found);
  }
  result.days = FollowBranches(std::move(graphs), options.making.stage.branches.root, least);
  std::vector<RigidMotion> motions;
  for (const FoundMotion & found : result.motions)
  {
    motions.push_back(found.motion);
  }
  RequireIdentities(result.days, motions, least);

  ReportProgress(context.progress, "writing", 0.95);
  const HeadUnits units = context.Heads(result.unit);
  WriteFollowedBranches(transaction.Stage(place("branches.csv")), result, units);
  WriteFollowedDays(transaction.Stage(place("days.csv")), result, units);
  WriteTextFile(transaction.Stage(place("columns.json")), FollowColumnsJson(result.unit));
  WriteIdentitiesVtp(transaction.Stage(place("identities.vtp")), result);
  for (std::size_t day = 0; day < result.days.size(); ++day)
  {
    WriteDayRsml(transaction.Stage(rsml(day)), result, day, options.days[day]);
  }
  if (options.report)
  {
    WriteTextFile(transaction.Stage(*options.report), FollowJson(result, options.command));
  }
  Finish(transaction, context);
  return result;
}

} // namespace voxelcore
