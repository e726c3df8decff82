#pragma once
// Grey scans told from label volumes, and the threshold that makes a shape of one.

#include "voxelcore/Base/Error.h"
#include "voxelcore/Labels/LabelMap.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace voxelcore
{

/** What a look at up to two million of a scan's voxels, in rows spread over it, found. */
struct GreyScan
{
  std::uint64_t              distinct = 0; ///< values other than 0; counted up to 65536
  double                     equal = 0;    ///< of neighbours, the share that are equal; median over the values
  double                     lowest = 0;   ///< value; of all voxels
  double                     highest = 0;
  double                     otsu = 0; ///< threshold of Otsu (1979): the brighter class begins here
  double                     half = 0; ///< HalfwayThreshold()
  std::vector<double>        edges{};  ///< of the histogram's bins
  std::vector<std::uint64_t> counts{}; ///< of the voxels looked at, one less than edges
};

/** Halfway between a scan's background and what little is brighter in it, such as roots, which Otsu's method misses
 *  when they are a hundredth of the voxels. The background is the median; what lies five standard deviations above it
 *  (by the dark side) is brighter, and counts as its upper quartile. Where that is more than 0.3 of the voxels, it is
 *  looked at in the same way by itself: then the dark is the air around a pot, say. With strong noise the halfway value
 *  may lie below five deviations; it is never below three. Values in ascending order; their last where nothing is
 *  brighter. */
double
HalfwayThreshold(std::span<const double> sorted);

/** "15:inf": what --threshold takes to choose the brighter class. */
std::string
OtsuRange(const GreyScan & grey);

/** "looks like a grey scan (1290 values from 1 to 1300, neighbouring voxels are rarely equal)" */
std::string
GreyScanText(const GreyScan & grey);

/** Thrown by ReadLabelVolume() and LabelAssembler where LabelChoice::refuseGrey is set. */
class GreyScanError : public InputError
{
public:
  GreyScanError(const std::string & message, GreyScan found)
    : InputError(message)
    , grey(std::move(found))
  {}

  GreyScan grey;
  LabelMap scan; ///< without labels; filled in by ReadLabelVolume()
};

} // namespace voxelcore
