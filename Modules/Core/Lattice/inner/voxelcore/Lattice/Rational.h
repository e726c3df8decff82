#pragma once
// Exact fractions rounded once: the doubles every machine agrees on.

namespace voxelcore
{

using Int128 = __int128;
using UInt128 = unsigned __int128;

/** The double nearest to numerator / denominator (ties to even). numerator < 2^126, 0 < denominator < 2^126. */
double
RatioToDouble(UInt128 numerator, UInt128 denominator);

/** The same for a signed numerator. */
double
SignedRatioToDouble(Int128 numerator, UInt128 denominator);

/** Sign of p1 / q1 - p2 / q2, exactly, for q1, q2 > 0; no product is formed, so all 127 bits may be used. */
int
CompareRatios(Int128 p1, Int128 q1, Int128 p2, Int128 q2);

/** Number of bits of a non-negative number; 0 for 0. */
int
BitLength(UInt128 value);

} // namespace voxelcore
