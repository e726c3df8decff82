#include "voxelcore/Masks/ShapeDenoising.h"

#include "FilteredShape.h"
#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

using Word = std::uint64_t;

constexpr double kWidestInFinest = 1.3;

// Weights are whole numbers, so that sums are the same in any order: along each axis they add up to 512.
constexpr std::int32_t kWhole = 512;

// What stands before G, G G and G G G.
constexpr std::array<std::int32_t, 3> kFactors{ 3, -3, 1 };

// Rows along y and z that are weighed at a time; along x it is a word.
constexpr std::int32_t kTile = 16;
constexpr std::int32_t kBits = 64;

std::vector<double>
Gaussian(double deviation)
{
  const int           reach = std::max(1, static_cast<int>(std::ceil(3 * deviation)));
  std::vector<double> weights;
  double              sum = 0;
  for (int i = -reach; i <= reach; ++i)
  {
    weights.push_back(std::exp(-0.5 * i * i / (deviation * deviation)));
    sum += weights.back();
  }
  for (double & weight : weights)
  {
    weight /= sum;
  }
  return weights;
}

std::vector<double>
Convolved(const std::vector<double> & a, const std::vector<double> & b)
{
  std::vector<double> both(a.size() + b.size() - 1, 0);
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    for (std::size_t k = 0; k < b.size(); ++k)
    {
      both[i + k] += a[i] * b[k];
    }
  }
  return both;
}

/** From the middle outwards, as whole numbers; the middle takes what rounding leaves. */
std::vector<std::int32_t>
HalfOf(const std::vector<double> & weights)
{
  const std::size_t         middle = weights.size() / 2;
  std::vector<std::int32_t> half(1, kWhole);
  for (std::size_t i = 1; i <= middle; ++i)
  {
    const auto weight = static_cast<std::int32_t>(std::lround(kWhole * weights[middle + i]));
    if (weight == 0)
    {
      break;
    }
    half.push_back(weight);
    half[0] -= 2 * weight;
  }
  return half;
}

class Denoising
{
public:
  Denoising(const VoxelShape & shape, const Vector3 & spacing)
    : m_Shape(shape)
    , m_Size(shape.Box().size)
  {
    const double volume = spacing[0] * spacing[1] * spacing[2];
    const double deviation =
      std::min(std::cbrt(volume), kWidestInFinest * *std::min_element(spacing.begin(), spacing.end()));
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::vector<double> once = Gaussian(deviation / spacing[axis]);
      std::vector<double>       power = once;
      for (auto & kernel : m_Kernels)
      {
        kernel[axis] = HalfOf(power);
        m_Reach = std::max(m_Reach, static_cast<std::int32_t>(kernel[axis].size()) - 1);
        power = Convolved(power, once);
      }
    }
    m_Rows = kTile + 2 * m_Reach;
    m_Width = kBits + 2 * m_Reach;
  }

  /** What one thread works with. */
  struct Memory
  {
    std::vector<std::int32_t> bits; ///< a row of the tile and what is around it: 0 or 1
    std::vector<std::int32_t> alongX;
    std::vector<std::int32_t> alongY;
    std::vector<std::int32_t> field;
  };

  /** Writes the rows from y and z on of a word. */
  void
  Tile(std::int32_t y, std::int32_t z, std::size_t word, Memory & memory, VoxelShape & to) const
  {
    const Word like = Alike(y, z, word);
    if (like == 0)
    {
      return;
    }
    if (like != ~Word{ 0 })
    {
      TakeBits(y, z, word, memory);
      memory.field.assign(static_cast<std::size_t>(kTile * kTile * kBits), 0);
      for (std::size_t power = 0; power < kFactors.size(); ++power)
      {
        Weigh(power, memory);
      }
    }
    const auto left = m_Size[0] - static_cast<std::int32_t>(word) * kBits;
    const Word mask = left < kBits ? (Word{ 1 } << left) - 1 : ~Word{ 0 };
    for (std::int32_t dz = 0; dz < std::min(kTile, m_Size[2] - z); ++dz)
    {
      for (std::int32_t dy = 0; dy < std::min(kTile, m_Size[1] - y); ++dy)
      {
        to.Row(y + dy, z + dz)[word] = (like == ~Word{ 0 } ? like : Majority(memory, dy, dz)) & mask;
      }
    }
  }

private:
  /** 0 or all bits where a tile and all around it is alike; 1 where it is not. */
  Word
  Alike(std::int32_t y, std::int32_t z, std::size_t word) const
  {
    Word any = 0;
    Word all = ~Word{ 0 };
    for (std::int32_t nz = z - m_Reach; nz < z + kTile + m_Reach; ++nz)
    {
      for (std::int32_t ny = y - m_Reach; ny < y + kTile + m_Reach; ++ny)
      {
        for (std::size_t nw = word; nw < word + 3; ++nw)
        {
          const Word part = WordAt(ny, nz, nw);
          any |= part;
          all &= part;
        }
        if (any != 0 && all != ~Word{ 0 })
        {
          return 1;
        }
      }
    }
    return any;
  }

  /** The word before `after`; 0 outside. */
  Word
  WordAt(std::int32_t y, std::int32_t z, std::size_t after) const
  {
    const bool isIn = y >= 0 && y < m_Size[1] && z >= 0 && z < m_Size[2] && after > 0 && after <= m_Shape.WordsPerRow();
    return isIn ? m_Shape.Row(y, z)[after - 1] : 0;
  }

  void
  TakeBits(std::int32_t y, std::int32_t z, std::size_t word, Memory & memory) const
  {
    memory.bits.clear();
    memory.bits.reserve(static_cast<std::size_t>(m_Rows) * m_Rows * m_Width);
    for (std::int32_t nz = z - m_Reach; nz < z + kTile + m_Reach; ++nz)
    {
      for (std::int32_t ny = y - m_Reach; ny < y + kTile + m_Reach; ++ny)
      {
        for (std::int32_t x = kBits - m_Reach; x < 2 * kBits + m_Reach; ++x)
        {
          const Word part = WordAt(ny, nz, word + static_cast<std::size_t>(x / kBits));
          memory.bits.push_back(static_cast<std::int32_t>(part >> (x % kBits) & 1));
        }
      }
    }
  }

  /** Adds one of the three fields, times its factor. */
  void
  Weigh(std::size_t power, Memory & memory) const
  {
    const auto &      kernel = m_Kernels[power];
    const std::size_t rows = static_cast<std::size_t>(m_Rows);
    memory.alongX.assign(rows * rows * kBits, 0);
    for (std::size_t row = 0; row < rows * rows; ++row)
    {
      const std::int32_t * from = memory.bits.data() + row * static_cast<std::size_t>(m_Width) + m_Reach;
      Sum(kernel[0], from, 1, memory.alongX.data() + row * kBits);
    }
    memory.alongY.assign(rows * kTile * kBits, 0);
    for (std::size_t z = 0; z < rows; ++z)
    {
      for (std::size_t y = 0; y < kTile; ++y)
      {
        const std::int32_t * from = memory.alongX.data() + (z * rows + y + static_cast<std::size_t>(m_Reach)) * kBits;
        Sum(kernel[1], from, kBits, memory.alongY.data() + (z * kTile + y) * kBits);
      }
    }
    std::array<std::int32_t, kBits> sums;
    for (std::size_t row = 0; row < kTile * kTile; ++row)
    {
      sums.fill(0);
      const auto * from = memory.alongY.data() + (row + static_cast<std::size_t>(m_Reach) * kTile) * kBits;
      Sum(kernel[2], from, kTile * kBits, sums.data());
      for (std::size_t x = 0; x < kBits; ++x)
      {
        memory.field[row * kBits + x] += kFactors[power] * sums[x];
      }
    }
  }

  /** Adds to 64 sums what lies about 64 values, whose neighbours lie `step` apart. */
  static void
  Sum(const std::vector<std::int32_t> & half, const std::int32_t * from, std::ptrdiff_t step, std::int32_t * sums)
  {
    for (std::int32_t x = 0; x < kBits; ++x)
    {
      sums[x] += half[0] * from[x];
    }
    for (std::size_t i = 1; i < half.size(); ++i)
    {
      const std::int32_t * before = from - static_cast<std::ptrdiff_t>(i) * step;
      const std::int32_t * after = from + static_cast<std::ptrdiff_t>(i) * step;
      for (std::int32_t x = 0; x < kBits; ++x)
      {
        sums[x] += half[i] * (before[x] + after[x]);
      }
    }
  }

  static Word
  Majority(const Memory & memory, std::int32_t y, std::int32_t z)
  {
    const std::int32_t * field = memory.field.data() + static_cast<std::size_t>((z * kTile + y) * kBits);
    Word                 in = 0;
    for (std::int32_t x = 0; x < kBits; ++x)
    {
      in |= static_cast<Word>(field[x] > kWhole * kWhole * (kWhole / 2)) << x;
    }
    return in;
  }

  const VoxelShape &                                      m_Shape;
  std::array<std::int32_t, 3>                             m_Size;
  std::array<std::array<std::vector<std::int32_t>, 3>, 3> m_Kernels; ///< G and its powers, along each axis
  std::int32_t                                            m_Reach = 0;
  std::int32_t                                            m_Rows = 0;  ///< of a tile with what is around it
  std::int32_t                                            m_Width = 0; ///< the same along x
};

} // namespace

EditedShape
DenoiseShape(const VoxelShape & shape, const Vector3 & spacing, const ProgressCallback & progress)
{
  VoxelShape      result(shape.Box());
  const auto      size = shape.Box().size;
  const Denoising denoising(shape, spacing);
  for (std::int32_t z = 0; z < size[2]; z += kTile)
  {
    ReportProgress(progress, "denoising", static_cast<double>(z) / size[2]);
    FirstFailure failure;
#pragma omp parallel
    {
      Denoising::Memory memory;
#pragma omp for schedule(dynamic, 1)
      for (std::int32_t y = 0; y < size[1]; y += kTile)
      {
        failure.Guard(static_cast<std::size_t>(y), [&] {
          for (std::size_t word = 0; word < shape.WordsPerRow(); ++word)
          {
            denoising.Tile(y, z, word, memory, result);
          }
        });
      }
    }
    failure.Rethrow();
  }
  return FilteredShape(shape, std::move(result));
}

} // namespace voxelcore
