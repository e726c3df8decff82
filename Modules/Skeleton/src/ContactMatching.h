#pragma once
// Partners for arms that arrive at a contact among those that leave it.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** One choice of partners: per arriving arm the number of the leaving one, -1 for none. */
struct Matching
{
  std::vector<int> partner;
  double           value = 0;
};

/** The best and the next best value of a sum over pairs; no pair counts below 0. */
class Matcher
{
public:
  explicit Matcher(std::vector<std::vector<double>> values);

  Matching best;
  double   second = -1;

private:
  void
  Try(std::size_t row);

  void
  Greedy();

  std::vector<std::vector<double>> m_Values; ///< arriving x leaving
  std::vector<std::uint8_t>        m_Taken;
  Matching                         m_Now;
};

} // namespace voxelcore
