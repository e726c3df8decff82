#include "SkeletonBodies.h"

#include "voxelcore/Jobs/LabelVolumes.h"

#include "voxelcore/Base/OutputFile.h"
#include "voxelcore/Imaging/GreyVolume.h"
#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Shape/LabelContacts.h"
#include "voxelcore/Vessels/BranchVoxels.h"
#include "voxelcore/VoxelCore/LambdaPruning.h"

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
  for (const auto & map : { m_Targets.branchMap, m_Targets.orderMap, m_Targets.skeletonMap })
  {
    if (map)
    {
      RequireVolumePath(*map);
      m_Transaction.CheckTarget(*map);
    }
  }
  if (!m_Targets.sections)
  {
    return;
  }
  for (const char * ending : { "_sections.csv", "_sections.vtp", "_lesions.csv" })
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
  if (m_Targets.sections)
  {
    RequireLengthIn(geometry.unit, *m_Targets.sections);
  }
  m_Geometry = geometry;
  m_Scan = scan;
  m_Request = *options.skeleton;
  if (m_Targets.sections && !options.refine.surface.empty() && options.refine.surface != "labels")
  {
    m_Surfaces = estimates;
  }
  for (const EditedLabel & one : labels)
  {
    m_Shapes.emplace(std::pair{ one.label.value, one.component }, one.label.shape);
  }
}

void
SkeletonBodies::Add(const SkeletonPart & part, SkeletonRecord & record)
{
  const auto found = m_Shapes.find({ part.label, part.component });
  VoxelShape shape = std::move(found->second);
  m_Shapes.erase(found);
  AddMaps(part, shape);
  if (m_Targets.sections)
  {
    AddSections(part, std::move(shape), record);
  }
}

void
SkeletonBodies::AddSections(const SkeletonPart & part, VoxelShape shape, SkeletonRecord & record)
{
  const VoxelBox box = shape.Box();
  if (m_Scan && m_Request.border != BorderEnds::Closed)
  {
    shape = UpToBorder(shape, m_Geometry, *m_Scan, m_Request).shape;
  }
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
  auto              sections = MeasureSections(part.graph, body, every);
  auto              lesions = FindLesions(part.graph, sections, body);
  record.lesions = lesions;
  m_Sections.push_back(NameSections(part, std::move(sections), std::move(lesions)));
}

void
SkeletonBodies::AddMaps(const SkeletonPart & part, const VoxelShape & shape)
{
  if (m_Targets.branchMap || m_Targets.orderMap)
  {
    Mapped & mapped = m_Mapped.emplace_back();
    mapped.branches = BranchOfVoxels(part.graph, shape, m_Geometry);
    mapped.shape = shape;
    mapped.firstRow = m_Rows;
    for (std::uint32_t & value : mapped.branches.values)
    {
      value = value > 0 ? m_Rows + value : 0;
    }
    for (const BranchRecord & branch : part.table.branches)
    {
      mapped.orders.push_back(static_cast<std::uint32_t>(branch.strahler));
    }
    m_Rows += static_cast<std::uint32_t>(part.table.branches.size());
  }
  if (!m_Targets.skeletonMap)
  {
    return;
  }
  for (const SkeletonPart & one : part.network ? PartsByLabel(part) : std::vector{ part })
  {
    VoxelShape lines(shape.Box());
    AddSkeletonVoxels(one.graph, shape, m_Geometry, lines);
    m_Lines.push_back({ one.label, one.name, lines.CountVoxels(), std::move(lines) });
  }
}

void
SkeletonBodies::WriteMaps()
{
  VolumeOfLabels<std::uint32_t> volume;
  for (const Mapped & mapped : m_Mapped)
  {
    volume.shapes.push_back(&mapped.shape);
    volume.values.push_back(&mapped.branches);
  }
  const auto write = [&](const fs::path & path) {
    WriteNumberVolume(m_Transaction.StageWithCompanions(path),
                      m_Geometry,
                      [&](std::int64_t k, std::span<std::uint32_t> slice) { FillSlice(volume, m_Geometry, k, slice); });
  };
  if (m_Targets.branchMap)
  {
    write(*m_Targets.branchMap);
  }
  if (m_Targets.orderMap)
  {
    for (Mapped & mapped : m_Mapped)
    {
      for (std::uint32_t & value : mapped.branches.values)
      {
        value = value > 0 ? mapped.orders[value - mapped.firstRow - 1] : 0;
      }
    }
    write(*m_Targets.orderMap);
  }
  if (m_Targets.skeletonMap)
  {
    WriteLabelVolume(m_Transaction.StageWithCompanions(*m_Targets.skeletonMap),
                     m_Geometry,
                     WithoutSharedVoxels(std::move(m_Lines)));
  }
}

void
SkeletonBodies::Finish()
{
  WriteMaps();
  if (!m_Targets.sections)
  {
    return;
  }
  const HeadUnits units = m_Targets.units ? HeadUnits(m_Geometry.unit) : HeadUnits();
  WriteSectionCsv(m_Transaction.Stage(WithEnding(m_Stem, "_sections.csv")), m_Sections, units);
  WriteSectionVtp(m_Transaction.Stage(WithEnding(m_Stem, "_sections.vtp")), m_Sections, m_Geometry.unit);
  WriteLesionCsv(m_Transaction.Stage(WithEnding(m_Stem, "_lesions.csv")), m_Sections, units);
}

} // namespace voxelcore
