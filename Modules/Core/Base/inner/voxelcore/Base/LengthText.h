#pragma once
// Lengths as users write them: a number and a unit.

#include <functional>
#include <string>
#include <string_view>

namespace voxelcore
{

struct LengthText
{
  double      value = 0; ///< finite, not negative
  std::string unit;      ///< what follows the number; empty for none
  std::string text;      ///< as written, without blanks
};

/** Reads "1.5mm" and the like, blanks around the number and before the unit allowed. `refuse` is told why a text is
 *  none and must throw. */
LengthText
ReadLength(std::string_view text, const std::function<void(const char *)> & refuse);

/** \throws InputError, which says what to do instead of asking for a length in mm. */
[[noreturn]] void
RefuseMillimetres(const std::string & length);

} // namespace voxelcore
