#pragma once
// A scalar field on the voxels near a shape's boundary, in bricks, so that memory follows the boundary.

#include "voxelcore/SurfaceEstimate.h"

#include <cstdint>
#include <vector>

namespace voxelcore
{

/** One value at the centre of each voxel near the boundary, and some beyond. Positive inside. What has no brick counts as
 *  far away: +Far() inside the shape, -Far() outside. */
class BandField
{
public:
  static constexpr std::int32_t kSide = 8;
  static constexpr std::size_t  kVoxels = 512;

  /** How much of a pass each voxel takes: 255, all of it. */
  using Parts = std::vector<std::uint8_t>;

  /** Values are 0. `sides` are those of a voxel, the shortest 1: the unit of distances and of `sigma`, the width of the
   *  Gaussian G, at most 1.5. What is within `reach` voxels of the boundary, at most 16, has a value. */
  BandField(const VoxelShape & shape, const Vector3 & sides, double sigma, std::int32_t reach);

  /** Another width of G. */
  void
  SetWidth(double sigma);

  /** Signed distance to the boundary: to the nearest centre of the other kind less half the shortest side, clipped to
   *  +-`clip` (at most the reach of the field). */
  void
  FillDistances(double clip);

  /** Distances clipped further. */
  void
  Clip(double clip);

  /** Grey values; Far() becomes their mean magnitude. */
  void
  FillGrey(const VoxelBox & scan, const GreyRows & rows);

  /** K = (1 + w) G - w G G. With w = 1, in frequencies 1 - (sigma k)^4 / 4 + ..., bends of a linear field are flattened,
   *  and what is curved evenly keeps its place. */
  void
  Smooth(float weight);

  /** The same where `parts` says so; with G twice as wide, of every other voxel, if `wide`. */
  void
  SmoothPart(float weight, bool wide, const Parts & parts);

  /** Smooth(), but values become coefficients of Evaluate(): to be called once, last. */
  void
  SmoothToCoefficients(float weight);

  /** The weight with which a step keeps its place where it is curved evenly, if voxels hold the mean of what is in them and
   *  are cubes of side 1. G moves a step of standard width s and curvature c by c s^2 times its slope, which goes as 1 / s: so
   *  (1 + w) s1 = w s2, with s1^2 = sigma^2 + 1/12 and s2^2 = 2 sigma^2 + 1/12. */
  static float
  StepWeight(double sigma);

  /** 0 where the sign contradicts the label. */
  void
  ClearContradictions();

  /** For a field of distances: all where balls of `radius` touch the boundary from inside and from outside, none where one
   *  is kept two units or more away from it, by another wall, an edge or a crease. */
  Parts
  FindThick(double radius) const;

  /** Takes away what lies within `near` units of where the surface has a radius of curvature under `radius`, and by degrees
   *  to 2 units farther. */
  void
  LeaveOutBends(Parts & parts, double radius, double near) const;

  /** Goes back to former values within `near` units of boundary vertices, and by degrees to 2 units farther. */
  void
  TakeBackAround(const std::vector<LatticePoint> & places, double near, const BandField & former);

  /** Value and gradient (per voxel) at a place in lattice coordinates, by cubic B-splines; false where there is no brick.
   *  What interpolates values leaves ripples a voxel long on a surface. B-splines hardly do: they are a Gaussian of variance
   *  1/3 nearly, which SmoothToCoefficients() takes off its own. */
  bool
  Evaluate(const Vector3 & place, double & value, Vector3 & gradient) const;

  double
  Far() const
  {
    return m_Far;
  }

private:
  static constexpr std::ptrdiff_t kManyBricks = 256; ///< fewer are not worth several threads that wait for each other
  static constexpr std::int32_t   kFarOutside = -1;
  static constexpr std::int32_t   kFarInside = -2;
  using Brick = std::array<std::int32_t, 3>;
  static constexpr std::int32_t kMostRadius = 8; ///< voxels
  struct Kernel
  {
    std::int32_t                       radius = 0;
    std::array<float, kMostRadius + 1> weights{}; ///< by distance from the centre
  };

  static constexpr std::int32_t
  BrickOf(std::int32_t voxel)
  {
    return voxel >> 3;
  }
  std::int32_t
  Find(const Brick & brick) const;
  using Kernels = std::array<Kernel, 3>;
  using Flags = std::array<std::uint8_t, 64>; ///< of a brick's voxels: a byte a row along x
  static Kernel
  Gauss(double variance, std::int32_t mostRadius);
  void
  FindBricks(const VoxelShape & shape, std::int32_t reach);
  void
  FillLabels(const VoxelShape & shape);
  void
  FillBrickDistances(std::size_t brick, double clip);
  std::array<std::uint64_t, 1600>
  GatherRows(const std::vector<Flags> & flags, bool farInside, bool farOutside, std::size_t brick) const;
  void
  LeaveOutAround(const std::vector<Flags> & flags, double near, Parts & parts) const;
  double
  CurvatureAt(std::size_t brick, std::size_t voxel) const;
  void
  Convolve(const Kernels & kernels, std::int32_t step, const std::vector<float> & from, std::size_t brick, float * to)
    const;
  /** (1 + weight) times what the first kernels make, less weight times what the second make of that; where `parts` says so, or
   *  everywhere. */
  void
  Smooth(float weight, const Kernels & first, const Kernels & second, std::int32_t step, const Parts * parts);
  /** At a voxel of a brick, or of none, by m_Neighbours. */
  float
  ValueAt(std::int32_t source, std::int32_t voxel) const
  {
    return source >= 0 ? m_Values[static_cast<std::size_t>(source) * kVoxels + static_cast<std::size_t>(voxel)]
                       : (source == kFarInside ? m_Far : -m_Far);
  }

  Vector3                                   m_Sides;
  Kernels                                   m_Gauss;
  Kernels                                   m_GaussWide;     ///< twice as wide, of every other voxel
  Kernels                                   m_GaussToSpline; ///< with B-splines after it as wide as m_Gauss
  std::vector<Brick>                        m_Bricks;        ///< in units of bricks, by (z, y, x)
  std::vector<std::uint32_t>                m_Table;         ///< open addressing: brick + 1, 0 for none
  std::vector<std::array<std::int32_t, 27>> m_Neighbours; ///< a brick, or on which side of the boundary there is none
  std::vector<Flags>                        m_Labels;
  std::vector<float>                        m_Values;
  float                                     m_Far = 0;
};

} // namespace voxelcore
