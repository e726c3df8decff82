#pragma once
// A fingerprint against mistakes and damage, not against malice.

#include <cstdint>

namespace voxelcore
{

/** Takes up words one by one. Each step is a bijection of the state: words that differ in one place never agree, others
 *  with a chance of 2^-64. The mixer is splitmix64's (Steele, Lea, Flood 2014). */
class Checksum
{
public:
  explicit Checksum(std::uint64_t seed = 0)
    : m_State(seed)
  {}

  void
  Add(std::uint64_t word)
  {
    std::uint64_t z = (m_State ^ word) + 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    m_State = z ^ (z >> 31);
  }

  std::uint64_t
  Value() const
  {
    return m_State;
  }

private:
  std::uint64_t m_State;
};

} // namespace voxelcore
