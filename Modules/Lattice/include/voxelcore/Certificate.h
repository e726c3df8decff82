#pragma once
// The certificate of topology, for filters: two counts that must agree.

#include "voxelcore/Error.h"
#include "voxelcore/TopologyNumbers.h"

#include <string>

namespace voxelcore
{

/** `what`, as "its core", and the label name the complex in the message.
 *  \throws CertificateError when a complex has not the topology of its shape. */
inline void
RequireEqualTopology(const TopologyNumbers & shape,
                     const TopologyNumbers & complex,
                     const char *            what,
                     std::int64_t            label)
{
  const auto text = [](const TopologyNumbers & numbers) {
    return std::to_string(numbers.euler) + "/" + std::to_string(numbers.betti[0]) + "/" +
           std::to_string(numbers.betti[1]) + "/" + std::to_string(numbers.betti[2]);
  };
  if (!(shape == complex))
  {
    throw CertificateError("label " + std::to_string(label) + ": certificate failed: the shape has chi/b0/b1/b2 " +
                           text(shape) + ", " + what + " has " + text(complex) + "; there is no output");
  }
}

} // namespace voxelcore
