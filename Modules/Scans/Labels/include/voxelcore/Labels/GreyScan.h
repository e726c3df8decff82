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
  double                     proposed = 0; ///< ProposedThreshold(), with four digits
  double                     otsu = 0;     ///< threshold of Otsu (1979): the brighter class begins here
  std::vector<double>        edges{};      ///< of the histogram's bins
  std::vector<std::uint64_t> counts{};     ///< of the voxels looked at, one less than edges
};

/** The threshold that makes a shape of what is brighter than the background, however little it is, of values in
 *  ascending order: halfway between the two levels, and higher where noise of the background would come along, as gives
 *  the greatest expected Dice overlap with what is truly there. Padding, and air around what holds the object, are no
 *  background. Where nothing stands out, four deviations above all. 0 of no values.
 *
 *  Levels and noise are by the histogram alone, so that an object of a few ten thousandths of the voxels is found where
 *  noise leaves it, and one of half of them is cut where its boundary is. */
double
ProposedThreshold(std::span<const double> sorted);

/** "15:inf": what --threshold takes for the threshold proposed. */
std::string
ProposedRange(const GreyScan & grey);

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
