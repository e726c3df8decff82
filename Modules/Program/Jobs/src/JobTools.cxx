#include "voxelcore/Jobs/JobTools.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Jobs/SystemFiles.h"
#include "voxelcore/Lattice/GridOffset.h"
#include "voxelcore/Lattice/SpacingWeights.h"

#include <chrono>
#include <cstdio>
#include <set>

namespace voxelcore
{

void
Finish(OutputTransaction & transaction, const JobContext & context)
{
  ReportProgress(context.progress, "done", 1);
  transaction.Commit();
  if (context.wrote)
  {
    context.wrote(transaction.Written());
  }
}

void
ProtectInputs(OutputTransaction & transaction, const CoreOptions & options)
{
  transaction.Protect(options.scan);
  if (!options.refine.grey.empty())
  {
    transaction.Protect(options.refine.grey);
  }
}

void
CheckTargets(const OutputTransaction & transaction, const std::vector<std::filesystem::path> & targets)
{
  std::set<std::filesystem::path> names;
  for (const std::filesystem::path & target : targets)
  {
    if (!names.insert(target.lexically_normal()).second)
    {
      throw UsageError(target.string() + ": two results would be written under this name");
    }
    transaction.CheckTarget(target);
    if (target.extension() == ".mhd")
    {
      transaction.CheckTarget(std::filesystem::path(target).replace_extension(".zraw")); // its voxels
    }
  }
}

SpacingWeights
ScanWeights(const ImageGeometry & geometry, const std::filesystem::path & scan)
{
  SpacingWeights weights;
  std::string    hint = " with --spacing X,Y,Z";
  try
  {
    weights = ComputeSpacingWeights(geometry.spacing);
    hint.clear();
    RequireDistinctPositions(geometry);
  }
  catch (const InputError & error)
  {
    throw InputError(scan.string() + ": " + error.what() + hint);
  }
  return weights;
}

void
RequireLengthsOf(const std::filesystem::path & scan, SpatialUnit unit, const CertifiedRequest & request)
{
  try
  {
    RequireLengthsIn(unit, request);
  }
  catch (const InputError & error)
  {
    throw InputError(scan.string() + ": " + error.what());
  }
}

void
RequireSameUnit(const std::filesystem::path & one,
                SpatialUnit                   unit,
                const std::filesystem::path & other,
                SpatialUnit                   otherUnit)
{
  if (unit != otherUnit)
  {
    const auto text = [](SpatialUnit of) { return of == SpatialUnit::Voxels ? "in voxels" : "in mm"; };
    throw InputError(one.string() + ": its lengths are " + text(unit) + ", those of " + other.string() + " " +
                     text(otherUnit) + "; give --spacing X,Y,Z where the scan without voxel size is read");
  }
}

void
RequireSamePlace(const ImageGeometry &         other,
                 const ImageGeometry &         labels,
                 const std::string &           option,
                 const std::filesystem::path & path)
{
  if (!HaveSameVoxels(other, labels, kSamePlace))
  {
    throw InputError(path.string() + ": " + option +
                     " must have the voxels of the segmentation: the same size, spacing, origin " +
                     "and direction; resample it");
  }
}

void
RequireFittingProvenance(bool fits, const std::filesystem::path & path)
{
  if (!fits)
  {
    throw InputError(path.string() + ": its field Provenance does not fit its cells; make the file again");
  }
}

bool
IsFinishedCore(const std::filesystem::path &       path,
               const ReadOptions &                 reading,
               const std::optional<std::int64_t> & resolution)
{
  return !resolution &&
         (path.extension() == ".vtp" || (path.extension() == ".vtk" && !reading.spacing && IsMeshFile(path)));
}

void
WarnOfRounding(const std::filesystem::path & path, const std::string & rounded, std::vector<std::string> & warnings)
{
  if (!rounded.empty())
  {
    warnings.push_back(path.string() + ": " + rounded +
                       ", as another program saved it; results are of these rounded numbers");
  }
}

std::string
ModificationTime(const std::filesystem::path & path)
{
  const std::chrono::sys_seconds    time{ std::chrono::seconds(LastChanged(path)) };
  const auto                        day = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day date(day);
  const std::chrono::hh_mm_ss       clock(time - day);
  char                              text[64];
  (void)std::snprintf(text,
                      sizeof(text),
                      "%04d-%02u-%02uT%02d:%02d:%02d",
                      static_cast<int>(date.year()),
                      static_cast<unsigned>(date.month()),
                      static_cast<unsigned>(date.day()),
                      static_cast<int>(clock.hours().count()),
                      static_cast<int>(clock.minutes().count()),
                      static_cast<int>(clock.seconds().count()));
  return text;
}

double
PlainLength(const Lambda & length, SpatialUnit unit, const std::string & option)
{
  RequireLengthIn(unit, length);
  if (length.unit == Lambda::Unit::Percent || (length.unit == Lambda::Unit::Voxel && unit == SpatialUnit::Millimetres))
  {
    throw UsageError(option + " " + length.text + ": expected a length in mm, such as 0.5mm");
  }
  return length.value;
}

} // namespace voxelcore
