#include "voxelcore/Jobs/RenderJob.h"

#include "voxelcore/Base/Error.h"

#ifdef VOXELCORE_HAS_DISPLAY
#  include "DisplayLoading.h"
#  include "voxelcore/Jobs/JobTools.h"
#  include "voxelcore/Display/RenderPicture.h"

#  include <algorithm>
#  include <cstdio>
#endif

namespace voxelcore
{

#ifdef VOXELCORE_HAS_DISPLAY

namespace
{

PictureOptions
PictureOptionsOf(const RenderJobOptions & options)
{
  PictureOptions picture;
  picture.width = options.width;
  picture.height = options.height;
  picture.view = options.view == "front" ? PictureView::Front
                 : options.view == "top" ? PictureView::Top
                 : options.view == "iso" ? PictureView::Iso
                                         : PictureView::Auto;
  picture.coloring = options.coloring == "Lambda"             ? PictureColoring::Lambda
                     : options.coloring == "ErosionThickness" ? PictureColoring::ErosionThickness
                     : options.coloring == "Thickness"        ? PictureColoring::Thickness
                     : options.coloring == "Confidence"       ? PictureColoring::Confidence
                     : options.coloring == "Label"            ? PictureColoring::Label
                     : options.coloring == "SheetId"          ? PictureColoring::Label
                                                              : PictureColoring::Radius;
  picture.shrink = options.shrink;
  picture.range = options.range;
  picture.shares = { options.shares[0], options.shares[1] };
  picture.eachLabel = options.eachLabel;
  picture.dark = options.background == "dark";
  picture.tubes = options.tubes;
  picture.panels = options.panels;
  picture.frames = options.turntable;
  return picture;
}

std::vector<std::filesystem::path>
Targets(const RenderJobOptions & options)
{
  if (options.output.extension() != ".png")
  {
    throw UsageError(options.output.string() + ": unknown extension; pictures are written as .png");
  }
  if (options.turntable == 1)
  {
    return { options.output };
  }
  std::vector<std::filesystem::path> targets;
  for (int frame = 0; frame < options.turntable; ++frame)
  {
    char number[24];
    (void)std::snprintf(number, sizeof(number), "_%03d.png", frame);
    targets.push_back(options.output.parent_path() / (options.output.stem().string() + number));
  }
  return targets;
}

} // namespace

bool
HasDisplay()
{
  return true;
}

RenderResult
RunRenderJob(const RenderJobOptions & options, const JobContext & given)
{
  const JobContext  context = ForwardOnly(given);
  RenderResult      result;
  OutputTransaction transaction(options.force, context.temporaries);
  result.pictures = Targets(options);
  for (const auto & target : result.pictures)
  {
    transaction.CheckTarget(target);
  }
  DisplaySources sources;
  sources.files = options.files;
  sources.scan = options.scan;
  sources.labels = options.labels;
  sources.erosionThickness = options.coloring == "ErosionThickness";
  const DisplayContent content =
    LoadDisplayContent(sources, result.notes, result.warnings, PartOfProgress(context.progress, 0, 0.7));
  if (options.coloring == "Lambda")
  {
    for (const DisplayLabel & label : content.labels)
    {
      if (!label.curves.positions.empty())
      {
        throw UsageError("--color Lambda: curve skeletons have none; use Radius or ErosionThickness");
      }
    }
  }
  if (options.coloring == "SheetId" && !content.areSheets)
  {
    throw UsageError("--color SheetId: give a file of 'voxelcore sheets'");
  }
  if (options.coloring == "Thickness")
  {
    for (const DisplayLabel & label : content.labels)
    {
      if (label.medial.core.cells.vertexCount != label.medial.thickness.size())
      {
        throw UsageError("--color Thickness: '" + label.name +
                         "' was not measured; give a file of 'voxelcore thickness' or 'voxelcore sheets'");
      }
      if (!label.curves.positions.empty())
      {
        throw UsageError("--color Thickness: curve skeletons have none; use Radius");
      }
    }
  }
  if (options.coloring == "Confidence")
  {
    for (const DisplayLabel & label : content.labels)
    {
      if (label.confidence.empty() || label.medial.core.cells.vertexCount > 0)
      {
        throw UsageError("--color Confidence: '" + label.name +
                         "' has none; give skeletons alone, made with 'voxelcore skeleton --probability'");
      }
    }
  }
  PictureOptions picture = PictureOptionsOf(options);
  if (std::any_of(content.labels.begin(), content.labels.end(), [](const auto & label) { return !label.hasRadius; }))
  {
    const bool isMeasured = std::all_of(content.labels.begin(), content.labels.end(), [](const auto & label) {
      return !label.medial.thickness.empty();
    });
    if (options.coloring == "Radius")
    {
      picture.coloring = isMeasured ? PictureColoring::Thickness : PictureColoring::Label;
    }
    else if (options.coloring != "Label" && options.coloring != "Thickness")
    {
      throw UsageError("--color " + options.coloring + ": needs files with an array Radius; use " +
                       (isMeasured ? "Thickness" : "Label"));
    }
  }
  RenderPictures(
    content,
    picture,
    [&](int frame, const Picture & drawn) {
      WritePng(transaction.Stage(result.pictures[static_cast<std::size_t>(frame)]), drawn);
    },
    PartOfProgress(context.progress, 0.7, 1));
  Finish(transaction, context);
  return result;
}

#else

bool
HasDisplay()
{
  return false;
}

RenderResult
RunRenderJob(const RenderJobOptions &, const JobContext &)
{
  throw UsageError(
    "render is off in this build: it was made without VTK's rendering (-DVOXELCORE_DISPLAY=ON, with "
    "libvtk9-dev, brings it)");
}

#endif

} // namespace voxelcore
