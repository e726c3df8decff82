#include "voxelcore/PhantomJob.h"

#include "JobTools.h"
#include "voxelcore/Error.h"
#include "voxelcore/LabelVolume.h"

#include <utility>

namespace voxelcore
{

std::string
PhantomList()
{
  std::string text;
  for (const PhantomKind & kind : PhantomKinds())
  {
    text += std::string(kind.name) + ": " + std::string(kind.help) + "\n";
    if (!kind.options.empty())
    {
      text += "    " + std::string(kind.options) + "\n";
    }
  }
  return text;
}

std::string
RunPhantomJob(const PhantomJobOptions & options, const JobContext & context)
{
  OutputTransaction transaction(options.force, context.temporaries);
  transaction.CheckTarget(options.output);
  VoxelShape shape = CropToVoxels(MakePhantom(options.phantom, PartOfProgress(context.progress, "sampling", 0, 0.5)));
  const std::uint64_t voxels = shape.CountVoxels();
  if (voxels == 0)
  {
    throw UsageError("phantom " + options.phantom.kind + ": no voxel's centre lies in it; give a greater --size");
  }
  ImageGeometry geometry;
  std::string   sizeText;
  for (std::size_t k = 0; k < 3; ++k)
  {
    geometry.size[k] = options.phantom.size[k];
    sizeText += (k > 0 ? " x " : "") + std::to_string(options.phantom.size[k]);
  }
  geometry.spacing = options.phantom.spacing;
  std::vector<LabelShape> labels;
  labels.push_back({ 1, options.phantom.kind, voxels, std::move(shape) });
  ReportProgress(context.progress, "writing", 0.5);
  WriteLabelVolume(transaction.StageWithCompanions(options.output), geometry, labels);
  ReportProgress(context.progress, "done", 1);
  transaction.Commit();
  return options.output.string() + ": " + options.phantom.kind + ", " + sizeText + " voxels, " +
         std::to_string(voxels) + " of them in";
}

} // namespace voxelcore
