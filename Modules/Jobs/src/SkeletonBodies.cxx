#include "SkeletonBodies.h"

#include "voxelcore/Error.h"
#include "voxelcore/LambdaPruning.h"
#include "voxelcore/OutputFile.h"
#include "voxelcore/OutputNames.h"
#include "voxelcore/SpacingWeights.h"

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

fs::path
WithEnding(const fs::path & stem, const char * ending)
{
  return stem.string() + ending;
}

} // namespace

SkeletonBodies::SkeletonBodies(const fs::path &        output,
                               const SkeletonTargets & targets,
                               OutputTransaction &     transaction)
  : m_Stem(output.parent_path() / output.stem())
  , m_Targets(targets)
  , m_Transaction(transaction)
{
  if (IsFolderOutput(output))
  {
    throw UsageError("--sections: all labels go into one table; give -o OUT.vtp or OUT.csv instead of a folder");
  }
  for (const char * ending : { "_sections.csv", "_sections.vtp", "_sections.json" })
  {
    m_Transaction.CheckTarget(WithEnding(m_Stem, ending));
  }
}

void
SkeletonBodies::Keep(const std::vector<EditedLabel> & labels,
                     const CoreOptions &              options,
                     const ImageGeometry &            geometry,
                     const std::optional<VoxelBox> &  scan,
                     const SurfaceSource &            estimates)
{
  RequireLengthIn(geometry.unit, *m_Targets.sections);
  m_Geometry = geometry;
  m_Scan = scan;
  m_Request = *options.skeleton;
  if (!options.refine.surface.empty() && options.refine.surface != "labels")
  {
    m_Surfaces = estimates;
  }
  for (const EditedLabel & one : labels)
  {
    m_Shapes.emplace(std::pair{ one.label.value, one.component }, one.label.shape);
  }
}

void
SkeletonBodies::Add(const SkeletonPart & part)
{
  const auto       found = m_Shapes.find({ part.label, part.component });
  const VoxelBox   box = found->second.Box();
  const VoxelShape shape = m_Scan && m_Request.border != BorderEnds::Closed
                             ? UpToBorder(found->second, m_Geometry, *m_Scan, m_Request).shape
                             : std::move(found->second);
  m_Shapes.erase(found);
  SurfaceSource::Estimate surface;
  if (m_Surfaces)
  {
    surface = m_Surfaces(shape, {}, {});
  }
  std::optional<double> every;
  if (m_Targets.sections->value > 0)
  {
    const Vector3 & spacing = m_Geometry.spacing;
    every = LambdaInMillimetres(*m_Targets.sections, ComputeSpacingWeights(spacing), spacing, box);
  }
  const SectionBody body{ &shape, surface.get(), m_Geometry, m_Scan };
  m_Sections.push_back(NameSections(part, MeasureSections(part.graph, body, every)));
}

void
SkeletonBodies::Finish()
{
  WriteSectionCsv(m_Transaction.Stage(WithEnding(m_Stem, "_sections.csv")), m_Sections);
  WriteSectionVtp(m_Transaction.Stage(WithEnding(m_Stem, "_sections.vtp")), m_Sections, m_Geometry.unit);
  WriteTextFile(m_Transaction.Stage(WithEnding(m_Stem, "_sections.json")), SectionColumnsJson(m_Geometry.unit));
}

} // namespace voxelcore
