#include "ArrayLabels.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/TextFields.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <unistd.h>

namespace voxelcore
{
namespace
{

/** Rows j of the slices k. */
struct Slab
{
  std::int64_t firstJ, endJ, firstK, endK;
};

/** Copies a slab into whole rows, i fastest. Walks along the axis along which memory is dense, a tile of rows at a
 *  time, so that of both sides the cache lines at work stay in the cache. */
template <std::size_t TBytes>
void
Gather(const ArrayView & array, const Slab & slab, std::byte * rows)
{
  constexpr std::int64_t tile = 64;
  const std::int64_t     sizeI = array.size[0];
  const std::int64_t     rowsJ = slab.endJ - slab.firstJ;
  const auto             copy = [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    const std::byte *  from = array.data + i * array.stride[0] + j * array.stride[1] + k * array.stride[2];
    const std::int64_t at = ((k - slab.firstK) * rowsJ + (j - slab.firstJ)) * sizeI + i;
    std::memcpy(rows + static_cast<std::size_t>(at) * TBytes, from, TBytes);
  };
  const auto step = [&](std::size_t axis) { return std::abs(array.stride[axis]); };
  if (step(0) <= step(1) && step(0) <= step(2))
  {
    for (std::int64_t k = slab.firstK; k < slab.endK; ++k)
    {
      for (std::int64_t j = slab.firstJ; j < slab.endJ; ++j)
      {
        for (std::int64_t i = 0; i < sizeI; ++i)
        {
          copy(i, j, k);
        }
      }
    }
    return;
  }
  for (std::int64_t tileJ = slab.firstJ; tileJ < slab.endJ; tileJ += tile)
  {
    const std::int64_t endJ = std::min(slab.endJ, tileJ + tile);
    for (std::int64_t i = 0; i < sizeI; ++i)
    {
      for (std::int64_t j = tileJ; j < endJ; ++j)
      {
        for (std::int64_t k = slab.firstK; k < slab.endK; ++k)
        {
          copy(i, j, k);
        }
      }
    }
  }
}

void
GatherSlab(const ArrayView & array, const Slab & slab, std::vector<std::byte> & rows)
{
  const std::size_t bytes = array.pixel.bytes;
  const auto count = static_cast<std::size_t>((slab.endK - slab.firstK) * (slab.endJ - slab.firstJ) * array.size[0]);
  rows.resize(count * bytes);
  switch (bytes)
  {
    case 1:
      Gather<1>(array, slab, rows.data());
      break;
    case 2:
      Gather<2>(array, slab, rows.data());
      break;
    case 4:
      Gather<4>(array, slab, rows.data());
      break;
    default:
      Gather<8>(array, slab, rows.data());
      break;
  }
  if (array.swapped)
  {
    for (std::size_t value = 0; value < rows.size(); value += bytes)
    {
      std::reverse(rows.data() + value, rows.data() + value + bytes);
    }
  }
}

/** Whether the rows lie in memory as LabelAssembler wants them. */
bool
IsPlain(const ArrayView & array)
{
  const auto bytes = static_cast<std::ptrdiff_t>(array.pixel.bytes);
  return !array.swapped && array.stride[0] == bytes && array.stride[1] == bytes * array.size[0] &&
         array.stride[2] == bytes * array.size[0] * array.size[1] &&
         reinterpret_cast<std::uintptr_t>(array.data) % array.pixel.bytes == 0;
}

template <typename TValue>
float
ValueAt(const std::byte * place, bool swapped)
{
  std::array<std::byte, sizeof(TValue)> bytes;
  std::memcpy(bytes.data(), place, bytes.size());
  if (swapped)
  {
    std::reverse(bytes.begin(), bytes.end());
  }
  TValue value;
  std::memcpy(&value, bytes.data(), bytes.size());
  return static_cast<float>(static_cast<double>(value));
}

using ReadValue = float (*)(const std::byte *, bool);

ReadValue
ReaderOf(const LabelAssembler::Pixel & pixel)
{
  const auto whole = [&pixel](ReadValue ofSigned, ReadValue ofUnsigned) {
    return pixel.isSigned ? ofSigned : ofUnsigned;
  };
  switch (pixel.bytes)
  {
    case 1:
      return whole(ValueAt<std::int8_t>, ValueAt<std::uint8_t>);
    case 2:
      return whole(ValueAt<std::int16_t>, ValueAt<std::uint16_t>);
    case 4:
      return pixel.isReal ? ValueAt<float> : whole(ValueAt<std::int32_t>, ValueAt<std::uint32_t>);
    default:
      return pixel.isReal ? ValueAt<double> : whole(ValueAt<std::int64_t>, ValueAt<std::uint64_t>);
  }
}

/** numpy can show a few bytes as an array of any size (strides of 0), which would take days to read. A voxel of a shape
 *  takes a bit. */
void
RequireWithinMemory(const ArrayView & array)
{
  double voxels = 1;
  for (const std::int64_t size : array.size)
  {
    voxels *= static_cast<double>(size);
  }
  const double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (voxels / 8 > bytes)
  {
    throw InputError("the array: has " + Number(voxels) +
                     " voxels, more than this machine has bits of memory; give a " +
                     "part of it, or an array of its own size");
  }
}

} // namespace

void
ReadRow(const ArrayView & array, std::int32_t i, std::int32_t j, std::int32_t k, std::span<float> values)
{
  const ReadValue   read = ReaderOf(array.pixel);
  const std::byte * from = array.data + i * array.stride[0] + j * array.stride[1] + k * array.stride[2];
  for (std::size_t n = 0; n < values.size(); ++n)
  {
    values[n] = read(from + static_cast<std::ptrdiff_t>(n) * array.stride[0], array.swapped);
  }
}

void
RequireFiniteValues(const ArrayView & array, const VoxelBox & part)
{
  if (!array.pixel.isReal)
  {
    return;
  }
  std::vector<float> row(static_cast<std::size_t>(part.size[0]));
  for (std::int32_t k = part.lower[2]; k < part.lower[2] + part.size[2]; ++k)
  {
    for (std::int32_t j = part.lower[1]; j < part.lower[1] + part.size[1]; ++j)
    {
      ReadRow(array, part.lower[0], j, k, row);
      const auto at = std::find_if(row.begin(), row.end(), [](float value) { return !std::isfinite(value); });
      if (at != row.end())
      {
        throw InputError("the array: at (" + std::to_string(part.lower[0] + (at - row.begin())) + ", " +
                         std::to_string(j) + ", " + std::to_string(k) +
                         ") its value is no finite number; set it to one, such as numpy.nan_to_num does");
      }
    }
  }
}

std::vector<LabelShape>
LabelsOf(const ArrayView &        array,
         const ImageGeometry &    geometry,
         const LabelChoice &      options,
         const ProgressCallback & progress)
{
  RequireWithinMemory(array);
  LabelAssembler         assembler("the array", geometry, array.pixel, options);
  const auto             rowsAtATime = static_cast<std::int64_t>(assembler.RowsAtATime());
  const std::int64_t     stepJ = std::min(array.size[1], rowsAtATime);
  const std::int64_t     stepK = std::max<std::int64_t>(1, rowsAtATime / array.size[1]);
  const bool             plain = IsPlain(array);
  std::vector<std::byte> rows;
  for (std::int64_t k = 0; k < array.size[2]; k += stepK)
  {
    ReportProgress(progress, "reading", static_cast<double>(k) / static_cast<double>(array.size[2]));
    // Several whole slices, or a part of one.
    for (std::int64_t j = 0; j < array.size[1]; j += stepJ)
    {
      const Slab        slab{ j,
                       std::min(array.size[1], j + stepJ),
                       k,
                       stepJ < array.size[1] ? k + 1 : std::min(array.size[2], k + stepK) };
      const std::byte * from = array.data + j * array.stride[1] + k * array.stride[2];
      if (!plain)
      {
        GatherSlab(array, slab, rows);
        from = rows.data();
      }
      assembler.AddRows(from,
                        static_cast<std::uint64_t>(j + array.size[1] * k),
                        static_cast<std::size_t>((slab.endJ - slab.firstJ) * (slab.endK - slab.firstK)));
    }
  }
  return assembler.TakeShapes();
}

} // namespace voxelcore
