#pragma once
// Where the body ends along the path of a branch.

#include "CurveBranches.h"

#include "voxelcore/Lattice/Vectors.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace voxelcore
{

/** Looks for the end of the body along the path of a branch. */
class EndSearch
{
public:
  /** Whether the ball at a place, of a radius, stands out of all others by at least so much. */
  using StandsOut = std::function<bool(const Vector3 & place, double radius, double least)>;

  EndSearch(const MedialComplex &       surface,
            const CurveFire &           fire,
            const std::vector<double> & surfaceTime,
            const BranchScale &         scale,
            CurveBranch &               branch)
    : m_Surface(surface)
    , m_Fire(fire)
    , m_SurfaceTime(surfaceTime)
    , m_Scale(scale)
    , m_Branch(branch)
    , m_Path(branch.path)
  {}

  /** False when the curve nowhere runs along the middle of the surface: it is the way into a corner. */
  bool
  Run();

  /** Whether the curve is the axis of a tube all along; false for one that joins another sooner than the window. */
  bool
  RunAsTube();

  /** Whether the curve is the axis of a round tube whose last ball stands out of all others by `standOut`. */
  bool
  RunAsEnd(double standOut, const StandsOut & standsOut);

  /** Whether the curve leads into a dome: a ball greater than the one it comes from, that stands out of all others by
   *  `standOut`. */
  bool
  RunAsDome(double standOut, const StandsOut & standsOut);

private:
  /** A place on the path: so much of the way from a vertex to the next. */
  struct PlaceOnPath
  {
    std::size_t vertex = 0;
    double      part = 0;
  };

  void
  EndAt(const PlaceOnPath & place);

  double
  Way(std::size_t from, std::size_t to) const;

  double
  Growth(std::size_t from, std::size_t to) const;

  /** The greatest radius where the fire goes on from the path's last place. */
  double
  RadiusBehind() const;

  bool
  IsRound(std::size_t from, std::size_t to) const;

  bool
  IsBulge(std::size_t from, std::size_t to) const;

  double
  FallsBehind(std::size_t start, std::size_t end) const;

  bool
  RunsAlong(std::size_t start, std::size_t end) const;

  /** From the first window on of which that holds. Short branches may end within one, where fire falls behind as far as
   *  it must over a whole one: in the middle of a plate times of the surface end, too. */
  template <typename Holds>
  bool
  FindFrom(double window, const Holds & holds);

  /** The last place on the path to which its own fire came. */
  std::size_t
  Last() const;

  // Where the fire of another branch took over, the ways before and after cannot be compared.
  bool
  GoesOn(std::size_t at) const;

  /** The first place on the path, from `start` on, that is as far from the path's end as the radius has grown since:
   *  there, whatever way the end lies, is the centre of the ball that closes a tube. The radius is a mean over
   *  `window`. */
  PlaceOnPath
  CapCentre(std::size_t start, double window) const;

  /** How much further from the end a point lies than it must. */
  double
  Excess(std::size_t from, double window) const;

  const MedialComplex &             m_Surface;
  const CurveFire &                 m_Fire;
  const std::vector<double> &       m_SurfaceTime;
  const BranchScale                 m_Scale;
  CurveBranch &                     m_Branch;
  const std::vector<ElementIndex> & m_Path;
};

} // namespace voxelcore
