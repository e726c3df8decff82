#include "voxelcore/Jobs/JobTools.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Lattice/GridOffset.h"
#include "voxelcore/Lattice/SpacingWeights.h"

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

} // namespace voxelcore
