#pragma once
// What edits that add voxels have in common.

#include "voxelcore/Shape/ShapeBits.h"
#include "voxelcore/Shape/ShapeRuns.h"

#include "voxelcore/Shape/ShapeOperations.h"

#include <cstdint>
#include <utility>

namespace voxelcore
{

/** Calls work(word, word of the other) for all words of two shapes of one box; those of the first may be changed. */
template <typename TWork>
void
ForWords(VoxelShape & shape, const VoxelShape & other, const TWork & work)
{
  for (std::int32_t z = 0; z < shape.Box().size[2]; ++z)
  {
    for (std::int32_t y = 0; y < shape.Box().size[1]; ++y)
    {
      const auto row = shape.Row(y, z);
      const auto beside = other.Row(y, z);
      for (std::size_t word = 0; word < row.size(); ++word)
      {
        std::uint64_t bits = row[word];
        work(bits, beside[word]);
        row[word] = bits;
      }
    }
  }
}

/** Remembers a shape's numbers until voxels have been added. */
class Additions
{
public:
  explicit Additions(const VoxelShape & before)
    : m_Voxels(before.CountVoxels())
    , m_Components(CountComponents(VoxelRuns(before), false))
  {}

  /** Counts voxelsAdded and componentsJoined. */
  EditedShape
  To(VoxelShape shape) const
  {
    EditedShape edited;
    edited.voxelsAdded = shape.CountVoxels() - m_Voxels;
    if (edited.voxelsAdded > 0)
    {
      // What lies by itself in a gap becomes a component of its own: fewer is a lower bound of what was joined.
      const std::int64_t after = CountComponents(VoxelRuns(shape), false);
      edited.componentsJoined = after < m_Components ? static_cast<std::uint64_t>(m_Components - after) : 0;
    }
    edited.shape = Tightened(std::move(shape));
    return edited;
  }

private:
  std::uint64_t m_Voxels;
  std::int64_t  m_Components;
};

} // namespace voxelcore
