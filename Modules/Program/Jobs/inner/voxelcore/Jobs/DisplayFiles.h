#pragma once
// What a job writes for looking at: a scene of 3D Slicer, a page for browsers.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Jobs/DisplayTargets.h"
#include "voxelcore/Jobs/OutputTransaction.h"
#include "voxelcore/Masks/ShapeEdits.h"
#include "voxelcore/Models/DisplayContent.h"
#include "voxelcore/Models/SkeletonModel.h"
#include "voxelcore/Report/CoreReport.h"

#include <memory>

namespace voxelcore
{

/** The surface of a label as it is shown. \throws UsageError where this build cannot make it */
LabelSurfaceMesh
SurfaceToShow(const VoxelShape & shape, const ImageGeometry & geometry);

/** Gathers labels while they are computed and writes them at the end. Does nothing where nothing is asked for. */
class DisplayFiles
{
public:
  /** \throws UsageError for an unknown extension, and for what this build cannot write; OutputError */
  DisplayFiles(const DisplayTargets & targets, const std::filesystem::path & input, OutputTransaction & transaction);
  DisplayFiles(const DisplayFiles &) = delete;
  DisplayFiles &
  operator=(const DisplayFiles &) = delete;
  ~DisplayFiles();

  bool
  AreAsked() const;

  /** Before the labels are worked on, which takes their shapes. */
  void
  AddScan(const std::vector<EditedLabel> & labels, const ImageGeometry & geometry);

  /** The same for the labels of a network. */
  void
  AddNetwork(const std::vector<LabelShape> & labels, const ImageGeometry & geometry);

  /** Either part may be empty; a network is shown label by label. */
  void
  AddLabel(const LabelRecord & record, const ModelPart & surface, const SkeletonPart * skeleton);

  /** The page opens in the labels' colours. */
  void
  OpenByLabel();

  void
  Finish(const CoreReport & report, std::vector<std::string> & notes, const ProgressCallback & progress);

private:
  struct State;
  std::unique_ptr<State> m_State;
};

} // namespace voxelcore
