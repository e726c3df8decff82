#pragma once
// Random numbers that are the same everywhere (Steele, Lea, Flood: "Fast splittable pseudorandom number generators").

#include <cstdint>

namespace voxelcore
{

/** Scatters the bits of a number. */
inline std::uint64_t
ScatterBits(std::uint64_t x)
{
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31);
}

class SplitMix64
{
public:
  /** A stream of its own for each pair of seed and stream number. */
  explicit SplitMix64(std::uint64_t seed, std::uint64_t stream = 0)
    : m_State(ScatterBits(seed + 0x9E3779B97F4A7C15U) ^ ScatterBits(~stream))
  {}
  std::uint64_t
  Next()
  {
    m_State += 0x9E3779B97F4A7C15U;
    return ScatterBits(m_State);
  }
  /** A multiple of 2^-53 in [0, 1). */
  double
  Uniform()
  {
    return static_cast<double>(Next() >> 11) * 0x1p-53;
  }
  double
  Uniform(double low, double high)
  {
    return low + (high - low) * Uniform();
  }

private:
  std::uint64_t m_State;
};

} // namespace voxelcore
