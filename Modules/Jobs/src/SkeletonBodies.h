#pragma once
// What a job about skeletons writes of the bodies around them.

#include "voxelcore/CoreJob.h"
#include "voxelcore/OutputTransaction.h"
#include "voxelcore/SectionTables.h"

#include <filesystem>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace voxelcore
{

/** Keeps the bodies until their skeletons come. Writes OUT_sections.csv, OUT_sections.vtp and OUT_sections.json, which
 *  explains the columns. */
class SkeletonBodies
{
public:
  /** Checks that all files can be written. \throws UsageError for an output folder; OutputError */
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

  /** Takes the finished skeleton of a label. */
  void
  Add(const SkeletonPart & part);

  void
  Finish();

private:
  std::filesystem::path m_Stem;
  SkeletonTargets       m_Targets;
  OutputTransaction &   m_Transaction;

  std::map<std::pair<std::int64_t, std::int64_t>, VoxelShape> m_Shapes; ///< by label and component
  ImageGeometry                                               m_Geometry;
  std::optional<VoxelBox>                                     m_Scan;
  SurfaceSource                                               m_Surfaces; ///< none: the voxels tell
  SkeletonRequest                                             m_Request;
  std::vector<SectionsOfPart>                                 m_Sections;
};

} // namespace voxelcore
