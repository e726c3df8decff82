#pragma once
// How a broken promise is told.

#include "voxelcore/Base/Error.h"
#include "voxelcore/Lattice/TopologyNumbers.h"

#include <string>

namespace voxelcore
{

/** `problem` as a clause without a full stop. */
[[noreturn]] inline void
RefuseResult(const std::string & name, const std::string & problem)
{
  throw CertificateError(name + ": certificate failed: " + problem +
                         "; there is no result; this is a fault of VoxelCore, please report it with the scan");
}

/** `what`, as "its core", names the complex. \throws CertificateError when the numbers differ. */
inline void
RequireEqualTopology(const TopologyNumbers & shape,
                     const TopologyNumbers & complex,
                     const std::string &     what,
                     const std::string &     name)
{
  const auto text = [](const TopologyNumbers & numbers) {
    return std::to_string(numbers.euler) + "/" + std::to_string(numbers.betti[0]) + "/" +
           std::to_string(numbers.betti[1]) + "/" + std::to_string(numbers.betti[2]);
  };
  if (!(shape == complex))
  {
    RefuseResult(name, "the shape has chi/b0/b1/b2 " + text(shape) + ", " + what + " has " + text(complex));
  }
}

} // namespace voxelcore
