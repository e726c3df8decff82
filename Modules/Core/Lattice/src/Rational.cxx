#include "voxelcore/Lattice/Rational.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

namespace voxelcore
{

int
BitLength(UInt128 value)
{
  const auto high = static_cast<std::uint64_t>(value >> 64);
  const auto low = static_cast<std::uint64_t>(value);
  return high != 0 ? 128 - std::countl_zero(high) : 64 - std::countl_zero(low);
}

double
RatioToDouble(UInt128 numerator, UInt128 denominator)
{
  constexpr UInt128 exact = UInt128{ 1 } << 53;
  if (numerator <= exact && denominator <= exact)
  {
    // Both are doubles, and IEEE division rounds the exact quotient once.
    return static_cast<double>(static_cast<std::uint64_t>(numerator)) /
           static_cast<double>(static_cast<std::uint64_t>(denominator));
  }
  if (numerator == 0)
  {
    return 0.0;
  }
  int exponent = BitLength(numerator) - BitLength(denominator);
  if (exponent >= 0)
  {
    denominator <<= exponent;
  }
  else
  {
    numerator <<= -exponent;
  }
  if (numerator < denominator)
  {
    numerator <<= 1;
    --exponent;
  }
  // The quotient now lies in [1, 2): 53 bits, one guard bit, and what is left is sticky.
  std::uint64_t quotient = 0;
  for (int bit = 0; bit < 54; ++bit)
  {
    quotient <<= 1;
    if (numerator >= denominator)
    {
      numerator -= denominator;
      quotient |= 1U;
    }
    numerator <<= 1;
  }
  const bool guard = (quotient & 1U) != 0;
  quotient >>= 1;
  if (guard && (numerator != 0 || (quotient & 1U) != 0))
  {
    ++quotient;
  }
  return std::ldexp(static_cast<double>(quotient), exponent - 52);
}

double
SignedRatioToDouble(Int128 numerator, UInt128 denominator)
{
  return numerator < 0 ? -RatioToDouble(static_cast<UInt128>(-numerator), denominator)
                       : RatioToDouble(static_cast<UInt128>(numerator), denominator);
}

int
CompareRatios(Int128 p1, Int128 q1, Int128 p2, Int128 q2)
{
  // Continued fractions: compare the integer parts, then the reciprocals of what remains the other way round.
  int sign = 1;
  for (;;)
  {
    Int128 whole1 = p1 / q1;
    Int128 rest1 = p1 % q1;
    Int128 whole2 = p2 / q2;
    Int128 rest2 = p2 % q2;
    if (rest1 < 0)
    {
      rest1 += q1;
      --whole1;
    }
    if (rest2 < 0)
    {
      rest2 += q2;
      --whole2;
    }
    if (whole1 != whole2)
    {
      return whole1 < whole2 ? -sign : sign;
    }
    if (rest1 == 0 || rest2 == 0)
    {
      return rest1 == rest2 ? 0 : (rest1 == 0 ? -sign : sign);
    }
    p1 = std::exchange(q1, rest1);
    p2 = std::exchange(q2, rest2);
    sign = -sign;
  }
}

} // namespace voxelcore
