#pragma once
// Text taken apart, and numbers as text.

#include <string>
#include <string_view>
#include <vector>

namespace voxelcore
{

/** The parts between separators; one, which may be empty, where there is none. */
std::vector<std::string>
SplitText(std::string_view text, char separator);

/** As few digits as give the same number when read again. */
std::string
RoundTripText(double value);

/** `value` with so many decimals. */
std::string
DecimalText(double value, int decimals);

/** `value` with so many decimals; with more where fewer than two significant digits would show, so that only 0 reads as
 *  0. */
std::string
FixedText(double value, int decimals = 2);

/** A positive `value` in about two significant digits and without an exponent: "0.012", "3.4", "98", "120". */
std::string
RoughText(double value);

/** `value` with up to `digits` significant digits and no more than it needs. */
std::string
ShortText(double value, int digits = 9);

} // namespace voxelcore
