#include "ThicknessTargets.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Imaging/GreyVolume.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Jobs/LabelVolumes.h"
#include "voxelcore/Jobs/OutputNames.h"

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

/** The map, and its bounds where they are asked for. */
std::vector<fs::path>
VolumePaths(const ThicknessOptions & options, const LabelRecord & label)
{
  std::vector<fs::path> paths{ ThicknessPath(options, label, "") };
  if (options.bounds)
  {
    paths.push_back(ThicknessPath(options, label, "_lower"));
    paths.push_back(ThicknessPath(options, label, "_upper"));
  }
  return paths;
}

void
RequireExtensions(const ThicknessOptions & options)
{
  if (!IsFolderOutput(options.output))
  {
    RequireVolumePath(options.output);
  }
  if (options.table && options.table->extension() != ".csv")
  {
    throw UsageError("--table " + options.table->string() + ": unknown extension; give .csv");
  }
  for (const auto & target : { options.surface, options.medial })
  {
    if (target && target->extension() != ".vtp")
    {
      throw UsageError(target->string() + ": unknown extension; give .vtp");
    }
  }
}

} // namespace

fs::path
ThicknessPath(const ThicknessOptions & options, const LabelRecord & label, const std::string & what)
{
  if (!IsFolderOutput(options.output))
  {
    return what.empty() ? options.output : FileOutputPath(options.output, what);
  }
  return VolumeFolderPath(options.output, options.core.scan, label.label, label.component, "thickness" + what);
}

fs::path
SeparationPath(const ThicknessOptions & options)
{
  return IsFolderOutput(options.output) ? options.output / (ScanName(options.core.scan) + "_separation.nrrd")
                                        : FileOutputPath(options.output, "_separation");
}

void
CheckThicknessTargets(const ThicknessOptions & options, const OutputTransaction & transaction)
{
  RequireExtensions(options);
  std::vector<fs::path> targets = IsFolderOutput(options.output) ? std::vector<fs::path>() : VolumePaths(options, {});
  for (const auto & target : { options.core.report,
                               options.table,
                               options.surface,
                               options.medial,
                               options.core.display.html,
                               options.core.display.scene })
  {
    if (target)
    {
      targets.push_back(*target);
    }
  }
  if (options.table)
  {
    targets.push_back(FileOutputPath(*options.table, "_histogram"));
    targets.push_back(ColumnsBeside(*options.table));
  }
  if (options.separation != SeparationRegion::None)
  {
    targets.push_back(SeparationPath(options));
  }
  CheckTargets(transaction, targets);
}

void
CheckThicknessVolumes(const ThicknessOptions &         options,
                      const ImageGeometry &            geometry,
                      const std::vector<EditedLabel> & labels,
                      const OutputTransaction &        transaction)
{
  if (!IsFolderOutput(options.output))
  {
    RequireVolumeFits(options.output, geometry.size);
    return;
  }
  std::vector<fs::path> targets;
  for (const EditedLabel & one : labels)
  {
    const std::vector<fs::path> some = VolumePaths(options, DescribeLabel(one, geometry));
    targets.insert(targets.end(), some.begin(), some.end());
  }
  CheckTargets(transaction, targets);
}

} // namespace voxelcore
