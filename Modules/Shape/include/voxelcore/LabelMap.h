#pragma once
// A segmented scan as VoxelCore sees it: geometry, and one voxel shape per label.

#include "voxelcore/CropRange.h"
#include "voxelcore/ImageGeometry.h"
#include "voxelcore/ShapeConnectivity.h"
#include "voxelcore/StoredVoxels.h"
#include "voxelcore/VoxelShape.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

/** One label of a scan. */
struct LabelShape
{
  std::int64_t  value = 0;
  std::string   name;       ///< from the file, from a list beside it, or "label-<value>"
  std::uint64_t voxels = 0; ///< how many carry it
  VoxelShape    shape;      ///< in its tight bounding box

  std::optional<Color> color{}; ///< where a .seg.nrrd gives one, or a list beside the scan

  Connectivity connectivity = Connectivity::Six; ///< by which ConnectLabels() made its voxels hang together
};

/** The labels of a scan, sorted by value. */
struct LabelMap
{
  ImageGeometry            geometry; ///< of the whole scan, also when only a part was read
  std::optional<CropRange> crop;     ///< the part that was asked for, its ends filled in
  std::string              format;   ///< "NRRD", "NIfTI-1", "NIfTI-2", "MetaImage", "TIFF", "TIFF slices", "PNG slices"
  std::string              pixelType; ///< as stored: "uint8", "int16", "float32", ...; "uint1" for packed bits
  std::vector<std::string> notes;     ///< what was assumed or converted, one sentence each; for the report
  std::vector<std::string> warnings;  ///< those of the notes a user must see, each behind the scan's name
  std::vector<LabelShape>  labels;
};

/** "label 4 (Precentral_L)" */
std::string
LabelText(std::int64_t value, const std::string & name);

/** What is said of several labels in one line; beyond five, how many more there are. */
class LabelTexts
{
public:
  /** `label` as LabelText() has it; nothing where `text` is empty. */
  void
  Add(const std::string & label, const std::string & text);

  bool
  IsEmpty() const
  {
    return m_Count == 0;
  }

  /** "label 4 (Precentral_L): ...; label 5 (...): ...; and those of 2 more labels" */
  std::string
  Text() const;

private:
  std::string   m_Text;
  std::uint64_t m_Count = 0;
};

} // namespace voxelcore
