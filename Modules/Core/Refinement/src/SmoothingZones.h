#pragma once
// How strongly each place near a boundary may be smoothed.

#include "BoundaryDepth.h"

namespace voxelcore
{

/** How much of a pass each voxel takes, 255 for all of it: the same for the eight of a cube of 2^3. */
class SmoothingZones
{
public:
  /** All of it everywhere. */
  explicit SmoothingZones(const BoundaryDepth & depth)
    : m_Depth(&depth)
    , m_Parts(depth.Grid().Count() * BrickGrid::kCells, 255)
  {}

  /** All where balls of `radius`, the depths' first or second, touch the boundary from inside and from outside, none
   *  where one is kept two units or more away from it, by another wall, an edge or a crease. */
  SmoothingZones(const BoundaryDepth & depth, double radius, std::size_t which);

  /** The same, but none only from `most` units on. */
  SmoothingZones(const BoundaryDepth & depth, double radius, std::size_t which, double most);

  bool
  Any() const;

  /** Flags for LeaveOutAroundMarks(). Voxels must have a depth. */
  void
  Mark(std::int32_t x, std::int32_t y, std::int32_t z);

  bool
  HasMarks() const
  {
    return !m_Marks.empty();
  }

  /** Those of other zones of the same depths, instead of its own. */
  void
  TakeMarks(const SmoothingZones & other)
  {
    m_Marks = other.m_Marks;
  }

  /** Takes away what lies within `near` units of a mark, at most 8, and by degrees to 2 units farther. Marks are gone
   *  then. */
  void
  LeaveOutAroundMarks(double near);

  /** Less what other zones of the same depths take. */
  void
  TakeAway(const SmoothingZones & other);

  /** The parts, 0 to 1, of a brick of 8^3 voxels (level 0) or cells (level 1), which must have depths. */
  void
  Fill(int level, const BrickGrid::Brick & brick, std::array<float, BrickGrid::kCells> & parts) const;

  /** Whether anything in such a brick takes a part. */
  bool
  AnyIn(int level, const BrickGrid::Brick & brick) const;

  /** Whether anything in it does not take all of a pass. */
  bool
  AnyLeftOutIn(int level, const BrickGrid::Brick & brick) const;

private:
  template <typename TTest>
  bool
  AnyPart(int level, const BrickGrid::Brick & brick, TTest test) const;
  /** Of the first voxel; rows of cells are those of a brick of 8^3 cells. */
  const std::uint8_t *
  PartsOf(int level, const BrickGrid::Brick & brick) const;

  const BoundaryDepth *         m_Depth;
  std::vector<std::uint8_t>     m_Parts;
  std::vector<BrickGrid::Flags> m_Marks;
};

} // namespace voxelcore
