#pragma once
// Lengths whose last bit is the same with every C library: std::hypot() is within a unit of it, and each differs.

#include <algorithm>
#include <cmath>

namespace voxelcore
{

/** sqrt(x^2 + y^2), to within one unit in the last place: the root, set right by what its rounding left.
 *  C. F. Borges, "An Improved Algorithm for hypot(a,b)", arXiv:1904.09481, 2019; the bits of glibc from 2.35 on. */
inline double
Hypot(double x, double y)
{
  const double larger = std::max(std::abs(x), std::abs(y));
  const double smaller = std::min(std::abs(x), std::abs(y));
  if (!(larger < 0x1p+511) || smaller < 0x1p-459) // squares could leave the range, or the smaller does not count
  {
    return smaller <= larger * 0x1p-54 ? larger + smaller : std::hypot(x, y);
  }
  if (smaller <= larger * 0x1p-54)
  {
    return larger + smaller;
  }
  const double root = std::sqrt(larger * larger + smaller * smaller);
  if (root <= 2 * smaller)
  {
    const double rest = root - smaller;
    return root - (larger * (2 * rest - larger) + (rest - 2 * (larger - smaller)) * rest) / (2 * root);
  }
  const double rest = root - larger;
  return root - (2 * rest * (larger - 2 * smaller) + ((4 * rest - smaller) * smaller + rest * rest)) / (2 * root);
}

/** sqrt(x^2 + y^2 + z^2) by their shares of the largest: the same bits as libstdc++'s. */
inline double
Hypot(double x, double y, double z)
{
  const double largest = std::max({ std::abs(x), std::abs(y), std::abs(z) });
  const auto   share = [&](double side) { return (side / largest) * (side / largest); };
  return largest == 0 ? 0 : largest * std::sqrt(share(x) + share(y) + share(z));
}

} // namespace voxelcore
