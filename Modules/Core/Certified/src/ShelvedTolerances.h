#pragma once
// Tolerances of a core while nobody asks for them.

#include "voxelcore/Base/PackedNumbers.h"

#include "voxelcore/VoxelCore/MedialComplex.h"

#include <vector>

namespace voxelcore
{

/** Keeps those that reach a height; the others come back as 0. Most of a core is fringe. */
class ShelvedTolerances
{
public:
  ShelvedTolerances(ToleranceValues values, double height);

  ToleranceValues
  Take() &&;

private:
  struct Shelf
  {
    std::vector<bool>   reaches; ///< per element
    PackedArray<double> values;  ///< of those that do

    Shelf(std::vector<double> all, double height);

    std::vector<double>
    Take() &&;
  };

  Shelf m_Vertices;
  Shelf m_Edges;
  Shelf m_Faces;
};

} // namespace voxelcore
