#pragma once
// A scalar field on the voxels near a shape's boundary.

#include "BrickSums.h"
#include "SmoothingZones.h"

#include "voxelcore/Refinement/SurfaceEstimate.h"

namespace voxelcore
{

/** One value at the centre of each voxel near the boundary, and some beyond. Positive inside. What has no brick counts
 *  as far away: +Far() inside the shape, -Far() outside. */
class BandField
{
public:
  template <typename T>
  using Values = std::vector<T, Unset<T>>;

  /** No values yet. `sides` are those of a voxel, the shortest 1: the unit of distances and of `sigma`, the width of
   *  the Gaussian G, at most 1.5. `points` are the boundary vertices; what is within `reach` voxels of one has a
   *  value. */
  BandField(const VoxelShape &            shape,
            std::span<const LatticePoint> points,
            const Vector3 &               sides,
            double                        sigma,
            std::int32_t                  reach);

  /** No values yet, of those of another field's bricks that are wanted. */
  BandField(const VoxelShape & shape, const BandField & other, const std::vector<std::uint8_t> & wanted);

  /** Another width of G. */
  void
  SetWidth(double sigma);

  /** Signed distance to the boundary: to the nearest centre of the other kind less half the shortest side, clipped to
   *  +-`clip`, at most 5.5. Bricks that are `filled` are left as they are. */
  void
  FillDistances(const VoxelShape & shape, double clip, const std::vector<std::uint8_t> & filled = {});

  /** The same of the bricks in a cube of distances that are known, which are marked. */
  void
  TakeDistances(const BrickGrid::Brick &         tile,
                const BoundaryDepth::Distances & toIn,
                const BoundaryDepth::Distances & toOut,
                double                           clip,
                std::vector<std::uint8_t> &      filled);

  /** Grey values; Far() becomes their mean magnitude. */
  void
  FillGrey(const VoxelBox & scan, const GreyBoxRows & grey);

  /** K = (1 + w) G - w G G. With w = 1, in frequencies 1 - (sigma k)^4 / 4 + ..., bends of a linear field are
   *  flattened, and what is curved evenly keeps its place. Then 0 where the sign contradicts the label. With zones as
   *  far as these say. */
  void
  Smooth(float weight, const SmoothingZones * zones);

  /** The means of cells of 2^3 voxels, for passes with G at least twice as wide as a voxel where zones say so; cells
   *  have those of the depths' bricks that are changed or beside such. */
  BandField
  Halved(const VoxelShape & shape, const BoundaryDepth & depth, const SmoothingZones & zones) const;

  /** Adds what passes have changed in the means of cells, which are used up. The values are those that were halved. */
  void
  AddChange(const VoxelShape & shape, BandField halved);

  /** Turns values into coefficients for Evaluate(): those of the values after K once more. */
  void
  FindCoefficients(float weight);

  /** Planes of bricks along z, in which a part of all coefficients is found at a time. */
  struct Slab
  {
    std::size_t first = 0;
    std::size_t end = 0;
  };
  std::vector<Slab>
  Slabs() const;

  /** The slab that a voxel lies in. */
  bool
  IsIn(const Slab & slab, std::int32_t z) const
  {
    const std::int32_t plane = z >> 3;
    return plane >= PlaneAt(slab.first) && (slab.end + 1 == m_Planes.size() || plane < PlaneAt(slab.end));
  }

  /** Finds what Evaluate() needs of a slab, and within 6 voxels of it, but not far from bricks that have `changed`, if
   *  any are named. Slabs are to be taken in order, and values stay meanwhile; of a single slab so do the
   *  coefficients. */
  void
  FindCoefficients(float weight, const Slab & slab, const std::vector<std::uint8_t> & changed);

  /** The weight with which a step keeps its place where it is curved evenly, if voxels hold the mean of what is in them
   *  and are cubes of side 1. G moves a step of standard width s and curvature c by c s^2 times its slope, which goes
   *  as 1 / s: so (1 + w) s1 = w s2, with s1^2 = sigma^2 + 1/12 and s2^2 = 2 sigma^2 + 1/12. */
  static float
  StepWeight(double sigma);

  /** Values for later, of what zones are about to change, in half the memory. */
  struct Snapshot
  {
    std::vector<std::uint32_t> bricks;
    Values<std::int16_t>       values;
  };
  Snapshot
  Save(const SmoothingZones & zones) const;

  /** Bricks that zones leave out in part, and those within so many passes of them. */
  std::vector<std::uint8_t>
  LeftOut(const SmoothingZones & zones, int passes) const;

  /** Former values where zones are none, by degrees where they are in part. Returns of each brick whether what is
   *  evaluated in it may have changed. */
  std::vector<std::uint8_t>
  BlendWith(const Snapshot & former, const SmoothingZones & zones, float weight);
  std::vector<std::uint8_t>
  BlendWith(const BandField & former, const SmoothingZones & zones, float weight);

  const BrickGrid &
  Grid() const
  {
    return m_Grid;
  }

  /** Leaves the coefficients alone. */
  void
  DropValues();

  /** Marks the voxels at most `most` units off the surface where that has a radius of curvature under `radius`. */
  void
  MarkBends(double most, double radius, SmoothingZones & zones, bool convexAlone = false) const;

  /** Where the 8 x 4 x 4 coefficients around a place are that Evaluate() was last asked about: of places beside it they
   *  are mostly the same. For one field that does not change. */
  struct Spot
  {
    static constexpr std::uint32_t kApart = 8; ///< a corner from which the eight along x are in two bricks
    BrickGrid::Brick               home{};
    std::int32_t                   brick = BrickGrid::kOutside; ///< at home
    std::uint32_t                  corner = 0;                  ///< which of the bricks around it begin them, and half
    std::array<const float *, 4>   low{};  ///< of two bricks along y, then z: half a brick, with the first four along x
    std::array<const float *, 4>   high{}; ///< the same of the four behind these
  };

  /** Value and gradient (per voxel) at a place in lattice coordinates, by cubic B-splines; false where there is no
   *  brick. What interpolates values leaves ripples a voxel long on a surface. B-splines hardly do: they are a Gaussian
   *  of variance 1/3 nearly, which FindCoefficients() takes off its own. In BandFieldEvaluate.h. */
  bool
  Evaluate(const Vector3 & place, Spot & spot, double & value, Vector3 & gradient) const;

  double
  Far() const
  {
    return m_Far;
  }

private:
  BandField(BrickGrid grid, const Vector3 & sides, float far);

  template <typename TFormer>
  std::vector<std::uint8_t>
  Blend(const TFormer & formerOf, const SmoothingZones & zones, float weight);
  void
  FillFlags(const VoxelShape & shape);
  float
  HalfSide() const;

  static constexpr std::int32_t kSide = BrickGrid::kSide;
  static constexpr std::size_t  kVoxels = BrickGrid::kCells;

  struct Plane
  {
    std::uint32_t brick = 0; ///< the first
    std::uint32_t row = 0;
  };
  static Kernel
  Gauss(double variance);
  static Kernel
  Binomial(double variance, std::size_t mostRadius);
  void
  SetFar(float far);
  template <typename TUse>
  void
  SumTwice(const Kernels & first, const Kernels & second, const std::vector<std::uint8_t> & changed, TUse use);
  void
  FindCoefficientsOf(float weight, const std::vector<std::uint8_t> & bricks);
  bool
  HasAllCoefficients() const
  {
    return m_Coefficients.size() == m_Values.size();
  }
  /** In units of bricks. */
  std::int32_t
  PlaneAt(std::size_t plane) const
  {
    return m_Grid.At(m_Planes[plane].brick)[2];
  }
  void
  HalveBrick(const VoxelShape &       shape,
             const BrickGrid::Brick & at,
             float *                  means,
             BrickGrid::Flags &       in,
             BrickGrid::Flags &       out) const;
  void
  FindRowStarts();
  double
  CurvatureAt(std::size_t brick, std::size_t voxel) const;
  void
  FindBlocks(Spot & spot) const;
  const float *
  Block(const Values<float> & values, std::int32_t source) const
  {
    return source >= 0 ? values.data() + static_cast<std::size_t>(source) * kVoxels
                       : m_FarBlocks[source == BrickGrid::kInside ? 1 : 0].data();
  }

  BrickGrid                     m_Grid;
  Vector3                       m_Sides;
  Kernels                       m_Gauss;
  Kernels                       m_Binomial;      ///< as wide as m_Gauss
  Kernels                       m_GaussToSpline; ///< with B-splines after it as wide as m_Gauss
  int                           m_Level = 0;     ///< 1 where values are means of cells of 2^3 voxels
  std::vector<BrickGrid::Flags> m_In;            ///< whose value is never less than 0
  std::vector<BrickGrid::Flags> m_Out;           ///< whose value is never more than 0
  std::vector<std::uint32_t>    m_RowStarts;     ///< bricks with none before them along x
  std::vector<Plane>            m_Planes;        ///< along z, and an end
  Values<float>                 m_Values;
  Values<float>                 m_Coefficients;
  std::size_t                   m_FirstCoefficient = 0; ///< the brick that coefficients begin with
  Values<float>                 m_Once;                 ///< what SumTwice() works with
  float                         m_Far = 0;
  std::array<BrickValues, 2>    m_FarBlocks; ///< outside, inside
};

} // namespace voxelcore
