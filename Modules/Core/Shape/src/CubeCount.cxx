#include "CubeCount.h"

#include "voxelcore/Base/CountBits.h"

#include <algorithm>

namespace voxelcore
{

CubeCount::CubeCount(unsigned side, std::size_t rows, std::size_t words)
  : m_Side(side)
  , m_Along(rows, words)
  , m_Layers(side, BitPlane(rows, words))
  , m_Filled(0)
{}

void
CubeCount::Add(const BitPlane & voxels)
{
  m_Layers.push_back(std::move(m_Layers.front()));
  m_Layers.pop_front();
  // Runs of 2, 4, 8, 16 voxels, then of `side`, first along x and then, as whole rows, along y.
  const auto doublings = [&](auto && step) {
    unsigned run = 1;
    for (; 2 * run <= m_Side; run *= 2)
    {
      step(run);
    }
    if (run < m_Side)
    {
      step(m_Side - run);
    }
  };
  const auto rows = static_cast<std::ptrdiff_t>(voxels.Rows());
  bool       any = false;
  for (std::ptrdiff_t y = 0; y < rows; ++y)
  {
    const auto from = voxels.Row(y);
    const auto to = m_Along.Row(y);
    std::copy(from.begin(), from.end(), to.begin());
    doublings([&](unsigned by) {
      // Ascending: what lies above is still as it was.
      for (std::size_t word = 0; word < to.size(); ++word)
      {
        to[word] &= MovedDown(to, word, by);
      }
    });
    any = any || std::any_of(to.begin(), to.end(), [](Bits bits) { return bits != 0; });
  }
  if (!any)
  {
    m_Filled = 0;
    return;
  }
  BitPlane & square = m_Layers.back();
  square.Words() = m_Along.Words();
  doublings([&](unsigned by) {
    for (std::ptrdiff_t y = 0; y < rows; ++y)
    {
      const auto to = square.Row(y);
      const auto above = square.Row(std::min(y + static_cast<std::ptrdiff_t>(by), rows)); // rows beyond are empty
      for (std::size_t word = 0; word < to.size(); ++word)
      {
        to[word] &= above[word];
      }
    }
  });
  if (++m_Filled < m_Side)
  {
    return;
  }
  for (std::size_t word = 0; word < square.Words().size(); ++word)
  {
    Bits all = square.Words()[word];
    for (std::size_t layer = 0; layer + 1 < m_Layers.size() && all != 0; ++layer)
    {
      all &= m_Layers[layer].Words()[word];
    }
    m_Places += CountBits(all);
  }
}

} // namespace voxelcore
