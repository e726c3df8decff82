#pragma once
// Random numbers that mean the same on every machine: a seed in a failure message can be taken up anywhere.

#include <cstdint>

namespace voxelcore::testing
{

/** splitmix64 (Steele, Lea, Flood 2014). */
class Random
{
public:
  explicit Random(std::uint64_t seed)
    : m_State(seed)
  {}

  std::uint64_t
  Next()
  {
    m_State += 0x9E3779B97F4A7C15U;
    std::uint64_t z = m_State;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31);
  }

  /** low to high, both included; the bias of the remainder is below 2^-32 for ranges below 2^32. */
  std::int64_t
  Between(std::int64_t low, std::int64_t high)
  {
    return low + static_cast<std::int64_t>(Next() % static_cast<std::uint64_t>(high - low + 1));
  }

  /** 0 <= value < 1, a multiple of 2^-53. */
  double
  Unit()
  {
    return static_cast<double>(Next() >> 11) * 0x1p-53;
  }

  bool
  Chance(double probability)
  {
    return Unit() < probability;
  }

private:
  std::uint64_t m_State;
};

} // namespace voxelcore::testing
