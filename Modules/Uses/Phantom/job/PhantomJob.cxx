#include "voxelcore/Phantom/PhantomJob.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Imaging/GreyVolume.h"
#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Roots/RootFiles.h"

#include <cstdio>
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

namespace
{

/** The centre lines where they lie in the volume that is written. */
std::string
CentreLinesText(const PhantomOptions & options, const ImageGeometry & geometry)
{
  constexpr double kMicrometres = 1000;
  std::string      text =
    "# VoxelCore phantom root: true centre lines\n# micrometres, LPS axes; type: order of the branch\n";
  const auto lines = RootCentreLines(options);
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    const Vector3 p = LatticeToPhysical(geometry, lines[i].position);
    char          row[200];
    (void)std::snprintf(row,
                        sizeof(row),
                        "%zu %d %.9g %.9g %.9g %.9g %lld\n",
                        i + 1,
                        static_cast<int>(lines[i].order),
                        kMicrometres * p[0],
                        kMicrometres * p[1],
                        kMicrometres * p[2],
                        kMicrometres * lines[i].radius,
                        static_cast<long long>(lines[i].parent < 0 ? -1 : lines[i].parent + 1));
    text += row;
  }
  return text;
}

/** The same as RSML, with the numbers its roots have. */
RootModel
TrueRoots(const PhantomOptions & options, const ImageGeometry & geometry)
{
  RootModel                model;
  std::vector<std::size_t> within; // its axis
  const auto               lines = RootCentreLines(options);
  for (const CentreLinePoint & point : lines)
  {
    if (static_cast<std::size_t>(point.branch) == model.roots.axes.size())
    {
      RootAxis axis;
      axis.level = point.order;
      if (point.parent >= 0)
      {
        const auto before = static_cast<std::size_t>(point.parent);
        axis.parent = static_cast<ElementIndex>(lines[before].branch);
        axis.parentPoint = within[before];
        ++model.roots.axes[axis.parent].children;
      }
      model.roots.axes.push_back(axis);
    }
    RootAxis & axis = model.roots.axes[static_cast<std::size_t>(point.branch)];
    within.push_back(axis.points.size());
    axis.points.push_back(static_cast<ElementIndex>(model.graph.positions.size()));
    model.graph.positions.push_back(LatticeToPhysical(geometry, point.position));
    model.graph.radius.push_back(point.radius);
  }
  model.name = "phantom root, seed " + std::to_string(options.seed);
  model.traits = MeasureRoots(model.graph, model.roots);
  return model;
}

/** Each gives what was made, in words. */
std::string
WriteBodies(const PhantomJobOptions & options,
            const ImageGeometry &     geometry,
            OutputTransaction &       transaction,
            const JobContext &        context)
{
  std::vector<LabelShape> labels;
  std::uint64_t           voxels = 0;
  for (VoxelShape & shape : MakePhantomBodies(options.phantom, PartOfProgress(context.progress, "sampling", 0, 0.5)))
  {
    const std::uint64_t count = shape.CountVoxels();
    const auto          value = static_cast<std::int64_t>(labels.size()) + 1;
    voxels += count;
    labels.push_back({ value, options.phantom.kind, count, std::move(shape) });
  }
  if (voxels == 0)
  {
    throw UsageError("phantom " + options.phantom.kind + ": no voxel's centre lies in it; give a greater --size");
  }
  ReportProgress(context.progress, "writing", 0.5);
  WriteLabelVolume(transaction.StageWithCompanions(options.output), geometry, labels);
  return std::to_string(voxels) + " of them in" +
         (labels.size() > 1 ? ", " + std::to_string(labels.size()) + " labels" : "");
}

std::string
WriteScan(const PhantomJobOptions & options,
          const ImageGeometry &     geometry,
          OutputTransaction &       transaction,
          const JobContext &        context)
{
  RootScanOptions request = *options.scan;
  request.root = options.phantom;
  const RootScan scan = MakeRootScan(request, PartOfProgress(context.progress, "sampling", 0, 0.5));
  ReportProgress(context.progress, "writing", 0.5);
  WriteGreyVolume(transaction.StageWithCompanions(options.output), geometry, scan.values);
  const auto count = [](std::size_t n, const char * what) {
    return ", " + std::to_string(n) + " " + what + (n == 1 ? "" : "s");
  };
  return "grey values: air " + std::to_string(kRootScanAir) + ", root " + std::to_string(kRootScanRoot) +
         count(scan.contacts.size(), "contact") + count(scan.holes.size(), "hole") + count(scan.breaks.size(), "break");
}

} // namespace

std::string
RunPhantomJob(const PhantomJobOptions & options, const JobContext & given)
{
  const JobContext  context = ForwardOnly(given);
  OutputTransaction transaction(options.force, context.temporaries);
  RequireVolumePath(options.output);
  transaction.CheckTarget(options.output);
  if (options.centreLines)
  {
    const std::filesystem::path extension = options.centreLines->extension();
    if (options.phantom.kind != "root" || (extension != ".swc" && extension != ".rsml"))
    {
      throw UsageError("--centre-lines: only the kind root has them, and they are written as .swc or .rsml");
    }
    transaction.CheckTarget(*options.centreLines);
  }
  ImageGeometry geometry;
  std::string   sizeText;
  for (std::size_t k = 0; k < 3; ++k)
  {
    geometry.size[k] = options.phantom.size[k];
    sizeText += (k > 0 ? " x " : "") + std::to_string(options.phantom.size[k]);
  }
  geometry.spacing = options.phantom.spacing;
  const std::string what = options.scan ? WriteScan(options, geometry, transaction, context)
                                        : WriteBodies(options, geometry, transaction, context);
  if (options.centreLines && options.centreLines->extension() == ".rsml")
  {
    // What is made of numbers has no date.
    WriteRsml(transaction.Stage(*options.centreLines),
              TrueRoots(options.phantom, geometry),
              { "1970-01-01T00:00:00", "VoxelCore " + VoxelCoreVersion(), {} });
  }
  else if (options.centreLines)
  {
    WriteTextFile(transaction.Stage(*options.centreLines), CentreLinesText(options.phantom, geometry));
  }
  Finish(transaction, context);
  return options.output.string() + ": " + options.phantom.kind + ", " + sizeText + " voxels, " + what;
}

} // namespace voxelcore
