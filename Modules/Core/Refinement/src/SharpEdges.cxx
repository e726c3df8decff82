#include "SharpEdges.h"

#include <utility>

namespace voxelcore
{

std::optional<ZonesAtEdges>
FindZonesAtEdges(const BandField & field, const BoundaryDepth & depth, double radius, const SmoothingZones & thick)
{
  constexpr double onSurface = 1;
  constexpr double sharp = 2.4; // of radius by then: balls of radius 4 are rounder, edges of a box are not
  constexpr double near = 8;
  constexpr double most = 2.8; // from a ball that touches: walls from 2.5 off a right edge on
  SmoothingZones   flat = thick;
  field.MarkBends(onSurface, sharp, flat, true);
  if (!flat.HasMarks())
  {
    return std::nullopt;
  }
  SmoothingZones all(depth, radius, 0, most);
  SmoothingZones elsewhere = all;
  elsewhere.TakeMarks(flat);
  elsewhere.LeaveOutAroundMarks(near);
  flat.LeaveOutAroundMarks(near);
  SmoothingZones beside = all;
  beside.TakeAway(elsewhere);
  return ZonesAtEdges{ std::move(flat), std::move(beside), std::move(all) };
}

} // namespace voxelcore
