#pragma once
// One label of a segmented scan: its value, its name, its voxel shape.

#include "voxelcore/Shape/ShapeConnectivity.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace voxelcore
{

/** One label of a scan. */
struct LabelShape
{
  std::int64_t  value = 0;
  std::string   name;       ///< from the file, from a list beside it, or "label-<value>"
  std::uint64_t voxels = 0; ///< how many carry it
  VoxelShape    shape;      ///< in its tight bounding box

  std::optional<std::array<double, 3>>
    color{}; ///< red, green, blue from 0 to 1, where a .seg.nrrd gives one, or a list beside the scan

  Connectivity connectivity = Connectivity::Six; ///< by which ConnectLabels() made its voxels hang together
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
