#include "SharpEdges.h"

namespace voxelcore
{

ZonesAtEdges
FindZonesAtEdges(const BandField & field, const BoundaryDepth & depth, double radius, const SmoothingZones & thick)
{
  constexpr double onSurface = 1;
  constexpr double sharp = 2.4; // of radius by then: balls of radius 4 are rounder, edges of a box are not
  constexpr double near = 8;
  constexpr double most = 2.8; // from a ball that touches: walls from 2.5 off a right edge on
  ZonesAtEdges     zones{ thick, thick, thick };
  field.MarkBends(onSurface, sharp, zones.flat, true);
  zones.any = zones.flat.HasMarks();
  if (zones.any)
  {
    zones.all = SmoothingZones(depth, radius, 0, most);
    SmoothingZones elsewhere = zones.all;
    elsewhere.TakeMarks(zones.flat);
    elsewhere.LeaveOutAroundMarks(near);
    zones.flat.LeaveOutAroundMarks(near);
    zones.beside = zones.all;
    zones.beside.TakeAway(elsewhere);
  }
  return zones;
}

} // namespace voxelcore
