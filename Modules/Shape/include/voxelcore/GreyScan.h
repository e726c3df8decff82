#pragma once
// Grey scans told from label volumes, and the threshold that makes a shape of one.

#include "voxelcore/Error.h"
#include "voxelcore/LabelMap.h"

#include <cstdint>
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
  std::vector<double>        edges{};  ///< of the histogram's bins
  std::vector<std::uint64_t> counts{}; ///< of the voxels looked at, one less than edges
};

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
