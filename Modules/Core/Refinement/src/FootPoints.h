#pragma once
// Where the balls of core vertices touch the estimated surface.

#include "SurfaceBends.h"

#include "voxelcore/Refinement/Refinement.h"

#include <algorithm>
#include <vector>

namespace voxelcore
{

/** A pair of boundary vertices that a core vertex lies between. */
using PointPair = std::array<std::uint32_t, 2>;

/** Where a ball about a core vertex touches. */
struct FootPoint
{
  std::uint32_t point = 0; ///< the boundary vertex it belongs to
  Vector3       position{};
  double        distance = 0;  ///< mm from the core vertex
  Vector3       normal{};      ///< of the surface
  bool          found = false; ///< false: the surface is not known there
};

/** Finds foot points; what is const is thread-safe. */
class FootPointFinder
{
public:
  /** Projects each boundary vertex onto the surface. */
  FootPointFinder(const RefinementInput & input, const ProgressCallback & progress);

  /** Finds how the surface bends about boundary vertices, of which the greatest ball that touches each has such a
   *  radius in mm, 0 for those that are not asked for: feet get there in fewer steps. */
  void
  FindBends(const std::vector<double> & radii);

  /** Of the surface, in voxels. */
  double
  Ripples() const
  {
    return m_Input.surface->Ripples();
  }

  /** Whether the foot points of a pair meet about `place`, by the places and normals of the surface at its boundary
   *  vertices alone: then the distance from `place` falls from either towards the other. */
  bool
  Meet(const Vector3 & place, const PointPair & pair) const;

  /** The foot points of a core vertex at `place` (mm along the lattice axes), one for each boundary vertex in `pairs`,
   *  by index; sought from where `footPoints` are, those of a place nearby, or none. They stay near their boundary
   *  vertex: so near that those of a pair cannot meet by passing each other. */
  void
  Find(const Vector3 & place, std::span<const PointPair> pairs, std::vector<FootPoint> & footPoints) const;

  /** The same, but each foot goes on to where it is nearest, however far that is from its boundary vertex: about a
   *  place beside the axis of a tube all foot points meet. */
  void
  Settle(const Vector3 & place, std::span<const PointPair> pairs, std::vector<FootPoint> & footPoints) const;

private:
  Vector3
  Place(std::uint32_t point) const;
  void
  Begin(std::span<const PointPair> pairs, std::vector<FootPoint> & footPoints) const;
  bool
  BendsAt(const Vector3 & place, const FootPoint & foot, double strides, DistanceBends & bends) const;
  double
  TryFoot(const Vector3 & place, const Vector3 & to, const SurfacePoint & foot, double distance, SurfacePoint & next)
    const;
  bool
  Falls(const Vector3 & place, std::uint32_t point, const FootPoint & to, double most) const;
  void
  Slide(const Vector3 & place, double most, FootPoint & foot) const;
  void
  Descend(const Vector3 & place, FootPoint & foot) const;

  const RefinementInput &   m_Input;
  std::vector<SurfacePoint> m_Anchors;
  std::vector<SurfaceBend>  m_Bends;
  double                    m_Voxel = 1; ///< mm: geometric mean of the spacing
  double                    m_Close;     ///< voxels: what distances are off by then goes as its square
};

inline const FootPoint &
NearestFoot(std::span<const FootPoint> footPoints)
{
  return *std::min_element(footPoints.begin(), footPoints.end(), [](const FootPoint & a, const FootPoint & b) {
    return a.distance < b.distance;
  });
}

/** The foot of a boundary vertex among those that Find() gave. */
template <typename TFeet>
auto &
FootPointOf(TFeet & footPoints, std::uint32_t point)
{
  std::size_t first = 0;
  for (std::size_t size = footPoints.size(); size > 1;)
  {
    const std::size_t half = size / 2;
    if (footPoints[first + half].point <= point)
    {
      first += half;
    }
    size -= half;
  }
  return footPoints[first];
}

} // namespace voxelcore
