// In place of DisplayFiles.cxx where module Display is not built.

#include "voxelcore/Jobs/DisplayFiles.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Jobs/DisplayTargets.h"

namespace voxelcore
{

void
RequirePages()
{
  throw UsageError(
    "--scene and --html are off in this build: it was made without VTK's rendering "
    "(-DVOXELCORE_DISPLAY=ON, with libvtk9-dev, brings them)");
}

LabelSurfaceMesh
SurfaceToShow(const VoxelShape &, const ImageGeometry &)
{
  throw UsageError(
    "--surface is off in this build: it was made without VTK's rendering (-DVOXELCORE_DISPLAY=ON, with "
    "libvtk9-dev, brings it)");
}

struct DisplayFiles::State
{};

DisplayFiles::DisplayFiles(const DisplayTargets & targets, const std::filesystem::path &, OutputTransaction &)
{
  if (targets.scene || targets.html)
  {
    RequirePages();
  }
}

DisplayFiles::~DisplayFiles() = default;

bool
DisplayFiles::AreAsked() const
{
  return false;
}

void
DisplayFiles::AddScan(const std::vector<EditedLabel> &, const ImageGeometry &)
{}

void
DisplayFiles::AddNetwork(const std::vector<LabelShape> &, const ImageGeometry &)
{}

void
DisplayFiles::AddLabel(const LabelRecord &, const ModelPart &, const SkeletonPart *)
{}

void
DisplayFiles::OpenByLabel()
{}

void
DisplayFiles::Finish(const CoreReport &, std::vector<std::string> &, const ProgressCallback &)
{}

} // namespace voxelcore
