#pragma once
// The diameter that a vessel would have without its lesions.

#include <optional>
#include <vector>

namespace voxelcore
{

/** Diameters along a branch, mm. */
struct CalibreAlong
{
  std::vector<double> arc; ///< ascending
  std::vector<double> diameter;
};

/** A straight line, as vessels taper, through those places that fit one best and make up half of the branch (least
 *  trimmed squares: Rousseeuw, J Am Stat Assoc 79 (1984), page 871), then through all that are near to it: within a
 *  twentieth of the diameter, or twice their scatter. So nearly half of a branch may be ill. Beyond the first and last
 *  of these places the diameter stays what it is there. */
struct HealthyCalibre
{
  double atStart = 0;
  double slope = 0;
  double first = 0;   ///< arc of the first healthy place
  double last = 0;    ///< the same of the last one
  double scatter = 0; ///< standard deviation of healthy diameters

  double
  At(double arc) const;
};

/** None of what is too short for a line: less than two diameters. */
std::optional<HealthyCalibre>
FitHealthyCalibre(const CalibreAlong & along);

} // namespace voxelcore
