#include "voxelcore/Shape/BoundaryCounts.h"

#include "CubeCount.h"

#include "voxelcore/Base/CountBits.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

std::uint64_t
Count(Bits bits)
{
  return bits == 0 ? 0 : CountBits(bits);
}

/** Which of 64 voxels have how many boundary vertices, from the bits of their eight corners (corner c = x + 2 y + 4
 *  z). */
struct CornerSums
{
  Bits four = 0;
  Bits five = 0; ///< or more
  Bits eight = 0;
};

CornerSums
SumCorners(const std::array<Bits, 8> & corner)
{
  const auto add = [](Bits a, Bits b, Bits c) {
    return std::pair<Bits, Bits>{ a ^ b ^ c, (a & b) | (c & (a ^ b)) }; // sum and carry
  };
  const auto [sumA, carryA] = add(corner[0], corner[1], corner[2]);
  const auto [sumB, carryB] = add(corner[3], corner[4], corner[5]);
  const auto [sumC, carryC] = add(corner[6], corner[7], 0);
  const auto [ones, carryD] = add(sumA, sumB, sumC);
  const auto [sumE, carryE] = add(carryA, carryB, carryC);
  const auto [twos, carryF] = add(sumE, carryD, 0);
  const auto [fours, eights] = add(carryE, carryF, 0);
  return { fours & ~twos & ~ones, (fours & (twos | ones)) | eights, eights };
}

// The sets of four corners in one plane: the sides of a voxel (x low, x high, y low, ...), and six across it.
using Four = std::array<std::uint8_t, 4>;
constexpr std::array<Four, 6> kSides{
  { { 0, 2, 4, 6 }, { 1, 3, 5, 7 }, { 0, 1, 4, 5 }, { 2, 3, 6, 7 }, { 0, 1, 2, 3 }, { 4, 5, 6, 7 } }
};
constexpr std::array<Four, 6> kAcross{
  { { 0, 1, 6, 7 }, { 2, 3, 4, 5 }, { 0, 2, 5, 7 }, { 1, 3, 4, 6 }, { 0, 4, 3, 7 }, { 1, 5, 2, 6 } }
};

Bits
AllOf(const std::array<Bits, 8> & corner, const Four & four)
{
  return corner[four[0]] & corner[four[1]] & corner[four[2]] & corner[four[3]];
}

/** Takes a shape's layers of voxels one after the other, and an empty one at the end. */
class Counter
{
public:
  Counter(std::size_t rows, std::size_t words)
    : m_Below(rows, words)
    , m_Here(rows, words)
    , m_CornersBelow(rows, words)
    , m_Corners(rows, words)
    , m_Cubes15(15, rows, words)
    , m_Cubes17(17, rows, words)
  {
    for (auto & side : m_Flat)
    {
      side.assign(3, BitPlane(rows, words));
    }
  }

  /** The layer to overwrite and then to Add(). */
  BitPlane &
  Next()
  {
    return m_Here;
  }

  void
  Add()
  {
    m_Cubes15.Add(m_Here);
    m_Cubes17.Add(m_Here);
    MarkCorners();
    CountVoxels();
    CountEven();
    std::swap(m_Below, m_Here);
    std::swap(m_CornersBelow, m_Corners);
  }

  BoundaryCounts
  Counts() const
  {
    BoundaryCounts counts = m_Counts;
    counts.cubes15 = m_Cubes15.Places();
    counts.cubes17 = m_Cubes17.Places();
    return counts;
  }

private:
  std::ptrdiff_t
  Rows() const
  {
    return static_cast<std::ptrdiff_t>(m_Here.Rows());
  }

  /** The boundary vertices between the two layers: those whose eight voxels are neither all in nor all out. */
  void
  MarkCorners()
  {
    for (std::ptrdiff_t y = 0; y < Rows(); ++y)
    {
      const std::array<std::span<const Bits>, 4> rows{ std::as_const(m_Below).Row(y - 1),
                                                       std::as_const(m_Below).Row(y),
                                                       std::as_const(m_Here).Row(y - 1),
                                                       std::as_const(m_Here).Row(y) };
      const auto                                 corners = m_Corners.Row(y);
      for (std::size_t word = 0; word < corners.size(); ++word)
      {
        Bits any = 0;
        Bits all = ~Bits{ 0 };
        for (const auto & row : rows)
        {
          const Bits before = MovedUp(row, word, 1);
          any |= row[word] | before;
          all &= row[word] & before;
        }
        corners[word] = any & ~all;
        m_Counts.vertices += Count(any & ~all);
      }
    }
  }

  /** The voxels of the layer below, whose corners are all marked now. */
  void
  CountVoxels()
  {
    m_AnyFlat = {};
    for (std::ptrdiff_t y = 0; y < Rows(); ++y)
    {
      const auto                                 voxels = std::as_const(m_Below).Row(y);
      const std::array<std::span<const Bits>, 4> rows{ std::as_const(m_CornersBelow).Row(y),
                                                       std::as_const(m_CornersBelow).Row(y + 1),
                                                       std::as_const(m_Corners).Row(y),
                                                       std::as_const(m_Corners).Row(y + 1) };
      for (std::size_t word = 0; word < voxels.size(); ++word)
      {
        std::array<Bits, 6> sides{};
        if (voxels[word] != 0)
        {
          std::array<Bits, 8> corner;
          Bits                any = 0;
          for (std::size_t i = 0; i < 4; ++i)
          {
            corner[2 * i] = rows[i][word];
            corner[2 * i + 1] = MovedDown(rows[i], word, 1);
            any |= corner[2 * i] | corner[2 * i + 1];
          }
          m_Counts.voxels += Count(voxels[word]);
          if ((any & voxels[word]) != 0)
          {
            sides = CountBorder(voxels[word], any, corner);
          }
        }
        for (std::size_t k = 0; k < 6; ++k)
        {
          m_Flat[k].back().Row(y)[word] = sides[k];
          m_AnyFlat[k] = m_AnyFlat[k] || sides[k] != 0;
        }
      }
    }
  }

  /** Returns the voxels with one whole side on the boundary, and no more than that. */
  std::array<Bits, 6>
  CountBorder(Bits voxels, Bits any, const std::array<Bits, 8> & corner)
  {
    const CornerSums    sums = SumCorners(corner);
    const Bits          four = sums.four & voxels;
    std::array<Bits, 6> sides;
    Bits                flat = 0;
    for (std::size_t k = 0; k < 6; ++k)
    {
      sides[k] = four & AllOf(corner, kSides[k]);
      flat |= sides[k] | (four & AllOf(corner, kAcross[k]));
    }
    m_Counts.borderVoxels += Count(any & voxels);
    m_Counts.cellVoxels += Count((sums.five & voxels) | (four & ~flat));
    m_Counts.fullVoxels += Count(sums.eight & voxels);
    m_Counts.flatVoxels += Count(flat);
    return sides;
  }

  /** Of flat voxels those that have their like around them in the plane of their side. */
  void
  CountEven()
  {
    for (std::size_t k = 0; k < 6; ++k)
    {
      auto & layers = m_Flat[k];
      m_FlatLayers[k] = m_AnyFlat[k] ? m_FlatLayers[k] + 1 : 0;
      if (m_AnyFlat[k] && k / 2 != 0)
      {
        KeepAmidX(layers.back());
      }
      if (m_AnyFlat[k] && k / 2 != 1)
      {
        KeepAmidY(layers.back());
      }
      const bool withinLayer = k / 2 == 2;
      if (m_AnyFlat[k] && (withinLayer || m_FlatLayers[k] >= 3))
      {
        const auto & words = layers[2].Words();
        for (std::size_t word = 0; word < words.size(); ++word)
        {
          m_Counts.evenVoxels +=
            Count(withinLayer ? words[word] : words[word] & layers[1].Words()[word] & layers[0].Words()[word]);
        }
      }
      std::rotate(layers.begin(), layers.begin() + 1, layers.end());
    }
  }

  static void
  KeepAmidX(BitPlane & plane)
  {
    for (std::ptrdiff_t y = 0; y < static_cast<std::ptrdiff_t>(plane.Rows()); ++y)
    {
      const auto row = plane.Row(y);
      Bits       before = 0;
      for (std::size_t word = 0; word < row.size(); ++word)
      {
        const Bits here = row[word];
        row[word] = here & ((here << 1) | (before >> 63)) & MovedDown(row, word, 1);
        before = here;
      }
    }
  }

  void
  KeepAmidY(BitPlane & plane)
  {
    const std::vector<Bits> all = plane.Words();
    const std::size_t       words = plane.Row(0).size();
    // The first and the last row lie beyond the plane and are empty.
    for (std::size_t word = words; word + words < all.size(); ++word)
    {
      plane.Words()[word] = all[word] & all[word - words] & all[word + words];
    }
  }

  BoundaryCounts m_Counts;
  BitPlane       m_Below; ///< voxels
  BitPlane       m_Here;
  BitPlane       m_CornersBelow;
  BitPlane       m_Corners; ///< between the two layers

  std::array<std::vector<BitPlane>, 6> m_Flat; ///< per side: voxels of three layers that are flat there
  std::array<bool, 6>                  m_AnyFlat{};
  std::array<unsigned, 6>              m_FlatLayers{}; ///< per side: how many layers without a gap have any

  CubeCount m_Cubes15;
  CubeCount m_Cubes17;
};

} // namespace

BoundaryCounts
CountBoundary(const VoxelShape & shape)
{
  const auto & size = shape.Box().size;
  if (shape.WordsPerRow() == 0 || size[1] == 0 || size[2] == 0)
  {
    return {};
  }
  // There is one corner more than voxels along each axis.
  Counter counter(static_cast<std::size_t>(size[1]) + 1, static_cast<std::size_t>(size[0]) / 64 + 1);
  for (std::int32_t z = 0; z <= size[2]; ++z)
  {
    BitPlane & layer = counter.Next();
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      const auto to = layer.Row(y);
      if (z < size[2])
      {
        const auto from = shape.Row(y, z);
        std::copy(from.begin(), from.end(), to.begin());
      }
      else
      {
        std::fill(to.begin(), to.end(), Bits{ 0 });
      }
    }
    counter.Add();
  }
  return counter.Counts();
}

// Six for each voxel less two for each inner face.
std::uint64_t
CountBoundarySquares(const VoxelShape & shape)
{
  const auto &  size = shape.Box().size;
  std::uint64_t squares = 0;
  for (std::int32_t z = 0; z < size[2]; ++z)
  {
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      const auto    row = shape.Row(y, z);
      std::uint64_t before = 0;
      for (std::size_t word = 0; word < row.size(); ++word)
      {
        const std::uint64_t bits = row[word];
        const std::uint64_t left = bits << 1 | before >> 63;
        squares += 6 * CountBits(bits);
        squares -= 2 * CountBits(bits & left);
        squares -= y == 0 ? 0 : 2 * CountBits(bits & shape.Row(y - 1, z)[word]);
        squares -= z == 0 ? 0 : 2 * CountBits(bits & shape.Row(y, z - 1)[word]);
        before = bits;
      }
    }
  }
  return squares;
}

} // namespace voxelcore
