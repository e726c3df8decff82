#pragma once
// What tells the faces of a complex apart and puts them in order.

#include "voxelcore/Complex/CellComplex.h"

#include <array>
#include <limits>
#include <utility>

namespace voxelcore
{

/** The three smallest corners of a face, ascending. No two faces have the same three, as they share an edge at most. */
using FaceName = std::array<ElementIndex, 3>;

/** Before any corner is offered. */
inline constexpr FaceName kNoCorners{ std::numeric_limits<ElementIndex>::max(),
                                      std::numeric_limits<ElementIndex>::max(),
                                      std::numeric_limits<ElementIndex>::max() };

/** Takes a corner of the face in where it is among the smallest. Each corner is offered once. */
inline void
OfferCorner(FaceName & name, ElementIndex corner)
{
  for (ElementIndex & place : name)
  {
    if (corner < place)
    {
      std::swap(corner, place);
    }
  }
}

} // namespace voxelcore
