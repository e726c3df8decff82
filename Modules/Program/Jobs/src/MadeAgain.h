#pragma once
// Part of `voxelcore verify`: what cannot be checked without making it is made again.

#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Report/CoreReport.h"
#include "voxelcore/Verification/Verification.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

/** Tolerances, and the radii and measures of a refined core, follow from no property that a finished file could be
 *  checked for. They are made again from the scan and compared bit by bit. */
class MadeAgain
{
public:
  /** `volume` is the scan, read as `made` says; what is in the way is added to `notes`. */
  MadeAgain(const CoreReport &            made,
            const InputScan &             volume,
            const std::filesystem::path & scan,
            std::vector<std::string> &    notes);

  /** None where nothing needs it, or something is in the way. */
  std::optional<VerificationCheck>
  Check(const ModelPart &        part,
        const LabelShape &       label,
        const PrunedRecord &     pruned,
        const ProgressCallback & progress) const;

private:
  ModelPart
  MakeAgain(const LabelShape &       label,
            const PrunedRecord &     pruned,
            bool                     thickness, ///< with the array of that name
            const ProgressCallback & progress) const;

  const CoreReport &    m_Made;
  const ImageGeometry & m_Geometry;
  SurfaceSource         m_Surface;
  bool                  m_Needed = false;
};

} // namespace voxelcore
