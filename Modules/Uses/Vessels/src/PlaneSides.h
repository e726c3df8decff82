#pragma once
// On which side of a body's surface the corners of squares in a plane are.

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Refinement/SurfaceEstimate.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <vector>

namespace voxelcore
{

using Vector2 = std::array<double, 2>;
using PlaneNode = std::array<std::int32_t, 2>;

/** A plane through a place on a branch, across that, cut into squares. Places are in mm along the axes of the grid;
 *  those in the plane are in sides of squares. */
struct SectionPlane
{
  Vector3                origin{};
  Vector3                axis{};   ///< unit length
  std::array<Vector3, 2> across{}; ///< unit vectors in the plane
  double                 step = 0; ///< side of a square where voxels are cubes, mm

  /** With vectors across that follow the axis right-handed. */
  SectionPlane(const Vector3 & origin, const Vector3 & axis, double step);

  /** The place so far from the origin across, in mm. */
  Vector3
  At(const Vector2 & way) const;
};

class PlaneSides
{
public:
  virtual ~PlaneSides() = default;

  /** Positive inside, negative outside; how much says nothing far from the surface. */
  virtual double
  At(const PlaneNode & node) = 0;

  /** How far on the way from a corner inside to the next one, outside, the surface passes, from 0 to 1. */
  virtual double
  Crossing(const PlaneNode & in, const PlaneNode & out) = 0;

  virtual Vector3
  Place(const Vector2 & inPlane) const = 0;
};

/** Of a surface that is known better than its voxels, from grey values or a mesh. Between eight voxels that are all in,
 *  or all out, nothing is looked up. */
class SidesOfSurface : public PlaneSides
{
public:
  SidesOfSurface(const VoxelShape &      shape,
                 const SurfaceEstimate & surface,
                 const Vector3 &         spacing,
                 const SectionPlane &    plane);

  double
  At(const PlaneNode & node) override;
  double
  Crossing(const PlaneNode & in, const PlaneNode & out) override;
  Vector3
  Place(const Vector2 & inPlane) const override;

private:
  Vector3
  Corner(const PlaneNode & node) const;

  const VoxelShape *      m_Shape;
  const SurfaceEstimate * m_Surface;
  Vector3                 m_Spacing;
  SectionPlane            m_Plane;
  double                  m_Reach;
};

/** Of voxels alone. A voxel counts as 1 or -1 at its centre, weighed by how far it is along the branch and across it,
 *  in voxels: the sum's sign is the side. Across, a side that is curved evenly keeps its place; along, what changes as
 *  a polynomial of the third degree. So round and tapered tubes, stenoses and bends keep their size, where the smooth
 *  surface of thin tubes lies too far out by up to a fifth of a voxel. Of a branch oblique to the grid, each slice of
 *  voxels tells where between others the side is.
 *
 *  Voxels within reach along the branch are dealt out to the four corners around their places in the plane, then summed
 *  with a kernel that is a product. In thick slices squares lie askew, so that they are squares in voxels. */
class SidesOfVoxels : public PlaneSides
{
public:
  /** `reach`: as far from the origin, mm, sides are asked for in all likelihood. */
  SidesOfVoxels(const VoxelShape & shape, const Vector3 & spacing, const SectionPlane & plane, double reach);

  double
  At(const PlaneNode & node) override;
  double
  Crossing(const PlaneNode & in, const PlaneNode & out) override;
  Vector3
  Place(const Vector2 & inPlane) const override;

private:
  std::size_t
  Index(const PlaneNode & node) const;
  void
  Fill();
  void
  DealOut(std::vector<double> & sums, std::vector<double> & weights) const;
  void
  Smooth(std::vector<double> & values) const;

  const VoxelShape *     m_Shape;
  Vector3                m_Spacing;
  SectionPlane           m_Plane;
  Vector3                m_Origin; ///< in lattice coordinates, as all that follows
  Vector3                m_Axis;
  std::array<Vector3, 2> m_Across;
  double                 m_Step;
  std::int32_t           m_Edge; ///< so many corners are too near to the edge of what is known
  std::int32_t           m_Half; ///< corners to each side of the origin
  std::vector<double>    m_Sides;
};

} // namespace voxelcore
