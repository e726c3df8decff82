#pragma once
// Meshes to voxelize.

#include "voxelcore/Meshes/Voxelization.h"

#include <random>
#include <string>
#include <vector>

namespace voxelcore::testing
{

TriangleMesh
BoxMesh(const Vector3 & lower, const Vector3 & upper);

/** Corners on the axes. */
TriangleMesh
OctahedronMesh(const Vector3 & centre, double radius);

/** A sphere of `rings` x 2 `rings` whose radius is multiplied by random numbers from 1 - roughness to 1. */
TriangleMesh
StarMesh(const Vector3 & centre, double radius, int rings, double roughness, std::mt19937 & random);

TriangleMesh
TorusMesh(const Vector3 & centre, double radius, double tube, int around, int across);

/** The boundary of random cells of a block of 4^3, each a cube of side `cell`; squares are cut along random
 *  diagonals. */
TriangleMesh
BlocksMesh(const Vector3 & lower, double cell, double density, std::mt19937 & random);

/** Both; with `reversed` the second inside out. */
TriangleMesh
Together(TriangleMesh first, const TriangleMesh & second, bool reversed = false);

/** Turned by a random rotation about its middle. */
TriangleMesh
Turned(TriangleMesh mesh, std::mt19937 & random);

struct MeshCase
{
  std::string  name;
  TriangleMesh mesh;
  VoxelGrid    grid;
};

/** 30 closed meshes with grids, many with corners, edges and faces on centres. */
std::vector<MeshCase>
ClosedMeshes(unsigned seed);

} // namespace voxelcore::testing
