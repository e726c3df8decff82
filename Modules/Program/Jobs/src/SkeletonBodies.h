#pragma once
// What a job about skeletons writes of the bodies around them.

#include "voxelcore/Jobs/CoreJob.h"
#include "voxelcore/Jobs/OutputTransaction.h"
#include "voxelcore/Shape/VoxelField.h"
#include "voxelcore/Vessels/SectionTables.h"

#include <filesystem>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace voxelcore
{

/** Keeps the bodies until their skeletons come. Of sections writes OUT_sections.csv, OUT_sections.vtp and
 *  OUT_lesions.csv; and the volumes that are asked for. */
class SkeletonBodies
{
public:
  /** Checks that all files can be written. \throws UsageError where a volume's extension is unknown; OutputError */
  SkeletonBodies(const std::filesystem::path & output,
                 const SkeletonTargets &       targets,
                 OutputTransaction &           transaction);

  /** Takes copies of the shapes of labels. `scan`: whose border may cut them. Surfaces are those of `estimates` where
   *  the skeletons are refined to more than labels.
   *  \throws InputError where lengths are in voxels and sections are asked for every so many mm */
  void
  Keep(const std::vector<EditedLabel> & labels,
       const CoreOptions &              options,
       const ImageGeometry &            geometry,
       const std::optional<VoxelBox> &  scan,
       const SurfaceSource &            estimates);

  /** Takes the finished skeleton of a label, and tells its record of lesions. */
  void
  Add(const SkeletonPart & part, SkeletonRecord & record);

  void
  Finish();

private:
  /** A body of which volumes are made. */
  struct Mapped
  {
    VoxelShape                 shape;
    VoxelField<std::uint32_t>  branches; ///< rows of the table of branches
    std::uint32_t              firstRow = 0;
    std::vector<std::uint32_t> orders; ///< of the branches
  };

  void
  AddSections(const SkeletonPart & part, VoxelShape shape, SkeletonRecord & record);
  void
  AddMaps(const SkeletonPart & part, const VoxelShape & shape);
  void
  WriteMaps();

  std::filesystem::path m_Stem;
  SkeletonTargets       m_Targets;
  OutputTransaction &   m_Transaction;

  std::map<std::pair<std::int64_t, std::int64_t>, VoxelShape> m_Shapes; ///< by label and component
  ImageGeometry                                               m_Geometry;
  std::optional<VoxelBox>                                     m_Scan;
  SurfaceSource                                               m_Surfaces; ///< none: the voxels tell
  SkeletonRequest                                             m_Request;
  std::vector<SectionsOfPart>                                 m_Sections;

  std::vector<Mapped>     m_Mapped;
  std::uint32_t           m_Rows = 0; ///< branches so far
  std::vector<LabelShape> m_Lines;    ///< where skeletons run; of a voxel that several hold, the first is written
};

} // namespace voxelcore
