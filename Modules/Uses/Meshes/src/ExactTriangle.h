#pragma once
// A triangle against the centres of a grid, exactly: floating point where its error bound allows, else whole numbers of
// any length.

#include "voxelcore/Meshes/Voxelization.h"

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <memory>

namespace voxelcore
{

using BigInteger = boost::multiprecision::cpp_int;

/** Turns the coordinates of a mesh and of a grid's centres into integers of one unit, a power of two. */
class IntegerScale
{
public:
  IntegerScale(const TriangleMesh & mesh, const VoxelGrid & grid);

  BigInteger
  operator()(double value) const;

  /** Coordinate of the centres with this index. */
  BigInteger
  Centre(std::size_t axis, std::int64_t index) const
  {
    return m_Origin[axis] + (2 * index + 1) * m_HalfSpacing[axis];
  }

private:
  int                       m_Exponent = 0;
  std::array<BigInteger, 3> m_Origin;
  std::array<BigInteger, 3> m_HalfSpacing;
};

/** A mesh in the coordinates of a grid's indices, in which centres are whole numbers, and what these lack in
 *  precision. */
struct IndexMesh
{
  IndexMesh(const TriangleMesh & mesh, const VoxelGrid & grid);

  const TriangleMesh & mesh;
  IntegerScale         scale;
  std::vector<Vector3> points;
  double               error = 0; ///< of any coordinate, at most
};

/** One triangle seen along an axis. `inner` and `outer` are the other two axes, inner < outer. */
class ExactTriangle
{
public:
  ExactTriangle(const IndexMesh & mesh, const std::array<std::uint32_t, 3> & corners, std::size_t axis);

  /** Sign of the normal's component along the axis; 0: no ray crosses it. */
  int
  Facing() const
  {
    return m_Facing;
  }

  /** First and last index along `outer` of rays that may cross; empty when first > last. */
  std::array<std::int64_t, 2>
  OuterRange() const;

  /** The same along `inner` for one such index. */
  std::array<std::int64_t, 2>
  InnerRange(std::int64_t outer) const;

  /** Whether the ray through the moved centres (inner, outer) crosses. */
  bool
  IsCrossedBy(std::int64_t inner, std::int64_t outer) const;

  /** Index of the first moved centre on that ray beyond the triangle. */
  std::int64_t
  FirstBeyond(std::int64_t inner, std::int64_t outer) const;

private:
  /** Integers of the same triangle, made when they are needed. In the frame (inner, outer, axis). */
  struct Exact
  {
    std::array<std::array<BigInteger, 3>, 3> corner;
    std::array<BigInteger, 3>                normal;
  };
  const Exact &
  Integers() const;
  int
  SideOfEdge(std::size_t edge, std::int64_t inner, std::int64_t outer) const;
  bool
  IsBeyond(std::int64_t inner, std::int64_t outer, std::int64_t along) const;

  const IndexMesh &                    m_Mesh;
  std::array<std::uint32_t, 3>         m_Corners;
  std::array<std::size_t, 3>           m_Axes; ///< inner, outer, along
  std::array<std::array<double, 3>, 3> m_Point;
  std::array<double, 3>                m_Normal{};
  double                               m_Extent = 0; ///< no difference of coordinates that is used is greater
  double                               m_AreaError = 0;
  int                                  m_Facing = 0;
  mutable std::unique_ptr<Exact>       m_Exact;
};

} // namespace voxelcore
