#pragma once
// What of a body stands out of its curves.

#include "CurveBranches.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace voxelcore
{

/** The balls of a surface beside the places on its curves that stay. Such a place reaches as far as fire on the
 *  surface had to come to it: in a tube that is its ball, in a plate the disc around it. A ball stands out when, seen
 *  from every place, it goes beyond that reach by more than `standOut` mm and is wider than a corner of 60 degrees
 *  would be there.
 *
 *  Of a dome less is asked, as fire in its neck reaches far into it. A dome is a ball that is greater than the one to
 *  whose place its fire led, greater than those of all places within kDomeGoesOn radii, and that goes beyond every
 *  place's ball by `standOut` and by kDomeOfRadius. It stands out where it goes beyond what places reach at all. */
class StandingOut
{
public:
  /** `stays`: per vertex 1 where it stays on the curves. Those that never burn stay. */
  StandingOut(const MedialComplex &             surface,
              const CurveFire &                 fire,
              const std::vector<double> &       surfaceTime,
              const std::vector<std::uint8_t> & stays,
              const BranchScale &               scale,
              double                            standOut);

  /** The ball that goes farthest beyond a corner, of equals the one that burned first. */
  std::optional<ElementIndex>
  Worst() const;

  /** More places that stay. */
  void
  Add(const std::vector<ElementIndex> & places);

private:
  struct Ball
  {
    ElementIndex vertex;
    bool         isDome;
    double       beyondCorner; ///< mm
  };

  double
  Reach(ElementIndex vertex) const;

  /** By how much a ball reaches out of a place's reach, or, with the way weighted against radii as in a corner, out of
   *  the corners in it, mm. */
  double
  Beyond(ElementIndex place, ElementIndex ball, double weight = 1) const;

  bool
  Holds(ElementIndex place, ElementIndex ball) const;

  /** By more than radii of one wall differ. */
  bool
  IsGreater(ElementIndex ball, ElementIndex place) const;

  /** Whether, beside a place, a ball is no dome. */
  bool
  HoldsDome(ElementIndex place, ElementIndex ball) const;

  const MedialComplex &       m_Surface;
  const std::vector<double> & m_SurfaceTime;
  const double                m_StandOut; ///< mm
  const double                m_Noise;    ///< mm by which radii and reaches differ on the grid
  std::vector<Ball>           m_Out;
};

} // namespace voxelcore
