#pragma once
// The body around the end of a branch.

#include "WayLine.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <optional>
#include <vector>

namespace voxelcore
{

/** How the end of a branch is looked at. Lengths in mm along the grid, depths from the tip as it was. */
struct EndLengths
{
  double radius = 0;
  double voxel = 0;
  double way = 0;        ///< of its whole line
  double deep = 0;       ///< so far below the tip the cap is no more
  double total = 0;      ///< so far below it the branch is looked at
  double skip = 0;       ///< so far below it the curve may run off the axis
  bool   isStub = false; ///< too little is left below the cap to measure the tube
  bool   isBar = false;  ///< that is so, and the other end is a tip as well
};

/** Voxels by their heights on an axis from within the branch, straight on from its base, which is at height 0 and
 *  `skip` below the tip. */
class BodyAtEnd
{
public:
  BodyAtEnd(const VoxelShape & shape, const Vector3 & spacing, const WayLine & line, const EndLengths & end)
    : m_Shape(shape)
    , m_Spacing(spacing)
    , m_End(end)
  {
    if (PlaceAxis(line))
    {
      TakeSamples();
    }
  }

  /** No axis was found, or nothing around it. */
  bool
  IsEmpty() const
  {
    return m_Samples.empty();
  }

  double
  VolumeAbove(double height) const;

  /** Where the axis ends outwards. */
  double
  Highest() const
  {
    return m_Beyond;
  }

  /** The place of a height on the axis of the voxels themselves, those above `from`. */
  std::optional<Vector3>
  PlaceAt(double height, double from) const;

private:
  struct Sample
  {
    Vector3 place;
    double  height; ///< above the base, outwards
  };

  bool
  PlaceAxis(const WayLine & line);
  /** Voxels around the axis that hang together with it. */
  void
  TakeSamples();
  /** The height of the nearest place of the axis; none beyond its ends or further away than a round body is thick. */
  std::optional<double>
  HeightOf(const Vector3 & place, double reach) const;

  const VoxelShape &   m_Shape;
  const Vector3        m_Spacing;
  const EndLengths     m_End;
  std::vector<Vector3> m_Axis; ///< from beyond the end inwards; the second is the base
  Vector3              m_Outwards{};
  double               m_Beyond = 0; ///< height of the axis' end
  int                  m_Stride = 1;
  std::vector<Sample>  m_Samples;
};

} // namespace voxelcore
