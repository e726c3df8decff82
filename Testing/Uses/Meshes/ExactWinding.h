#pragma once
// Winding numbers by brute force, in whole numbers of any length: another way to what Voxelize decides. Centres are
// really moved by (e, e^2, e^3) with e = 2^-400 mm, and any of the three axes may be the ray's.

#include "voxelcore/Meshes/Voxelization.h"

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <vector>

namespace voxelcore::testing
{

class ExactWinding
{
public:
  ExactWinding(const TriangleMesh & mesh, const VoxelGrid & grid);

  /** Of the moved centre (i,j,k), by the ray from it up the axis. */
  int
  At(const std::array<std::int32_t, 3> & index, std::size_t axis) const;

private:
  using Integer = boost::multiprecision::cpp_int;
  using Point = std::array<Integer, 3>;

  Point
  MovedCentre(const std::array<std::int32_t, 3> & index) const;

  const TriangleMesh & m_Mesh;
  VoxelGrid            m_Grid;
  std::vector<Point>   m_Points;
};

} // namespace voxelcore::testing
