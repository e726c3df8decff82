#include "MeshFixtures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace voxelcore::testing
{
namespace
{

constexpr double kPi = std::numbers::pi;

void
AddQuad(TriangleMesh & mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d)
{
  mesh.triangles.push_back({ a, b, c });
  mesh.triangles.push_back({ a, c, d });
}

/** 24 voxels a side of 1 mm. */
VoxelGrid
UnitGrid()
{
  return { { 0, 0, 0 }, { 1, 1, 1 }, { 24, 24, 24 } };
}

} // namespace

TriangleMesh
BoxMesh(const Vector3 & lower, const Vector3 & upper)
{
  TriangleMesh mesh;
  for (unsigned corner = 0; corner < 8; ++corner)
  {
    mesh.points.push_back({ (corner & 1U) != 0 ? upper[0] : lower[0],
                            (corner & 2U) != 0 ? upper[1] : lower[1],
                            (corner & 4U) != 0 ? upper[2] : lower[2] });
  }
  AddQuad(mesh, 0, 4, 6, 2);
  AddQuad(mesh, 1, 3, 7, 5);
  AddQuad(mesh, 0, 1, 5, 4);
  AddQuad(mesh, 2, 6, 7, 3);
  AddQuad(mesh, 0, 2, 3, 1);
  AddQuad(mesh, 4, 5, 7, 6);
  return mesh;
}

TriangleMesh
OctahedronMesh(const Vector3 & centre, double radius)
{
  TriangleMesh mesh;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const double step : { radius, -radius })
    {
      mesh.points.push_back(centre);
      mesh.points.back()[axis] += step;
    }
  }
  for (std::uint32_t octant = 0; octant < 8; ++octant)
  {
    const std::uint32_t x = octant & 1U;
    const std::uint32_t y = 2 + ((octant >> 1U) & 1U);
    const std::uint32_t z = 4 + (octant >> 2U);
    const bool          isEven = (x + y + z) % 2 == 0;
    mesh.triangles.push_back(isEven ? std::array{ x, y, z } : std::array{ x, z, y });
  }
  return mesh;
}

TriangleMesh
StarMesh(const Vector3 & centre, double radius, int rings, double roughness, std::mt19937 & random)
{
  std::uniform_real_distribution<double> factor(1 - roughness, 1);
  TriangleMesh                           mesh;
  const int                              around = 2 * rings;
  const auto                             add = [&](double z, double r, double angle) {
    const double f = radius * factor(random);
    mesh.points.push_back(
      { centre[0] + f * r * std::cos(angle), centre[1] + f * r * std::sin(angle), centre[2] + f * z });
  };
  add(-1, 0, 0);
  for (int ring = 1; ring < rings; ++ring)
  {
    const double polar = kPi * ring / rings;
    for (int i = 0; i < around; ++i)
    {
      add(-std::cos(polar), std::sin(polar), 2 * kPi * i / around);
    }
  }
  add(1, 0, 0);
  const auto at = [around](int ring, int i) {
    return static_cast<std::uint32_t>(1 + (ring - 1) * around + i % around);
  };
  const auto top = static_cast<std::uint32_t>(mesh.points.size() - 1);
  for (int i = 0; i < around; ++i)
  {
    mesh.triangles.push_back({ 0, at(1, i + 1), at(1, i) });
    for (int ring = 1; ring + 1 < rings; ++ring)
    {
      AddQuad(mesh, at(ring, i), at(ring, i + 1), at(ring + 1, i + 1), at(ring + 1, i));
    }
    mesh.triangles.push_back({ at(rings - 1, i), at(rings - 1, i + 1), top });
  }
  return mesh;
}

TriangleMesh
TorusMesh(const Vector3 & centre, double radius, double tube, int around, int across)
{
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i)
  {
    for (int j = 0; j < across; ++j)
    {
      const double a = 2 * kPi * i / around;
      const double b = 2 * kPi * j / across;
      const double r = radius + tube * std::cos(b);
      mesh.points.push_back(
        { centre[0] + r * std::cos(a), centre[1] + r * std::sin(a), centre[2] + tube * std::sin(b) });
    }
  }
  const auto at = [=](int i, int j) { return static_cast<std::uint32_t>((i % around) * across + j % across); };
  for (int i = 0; i < around; ++i)
  {
    for (int j = 0; j < across; ++j)
    {
      AddQuad(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return mesh;
}

TriangleMesh
BlocksMesh(const Vector3 & lower, double cell, double density, std::mt19937 & random)
{
  constexpr int               side = 4;
  std::bernoulli_distribution chance(density);
  std::bernoulli_distribution coin(0.5);
  bool                        in[side + 2][side + 2][side + 2] = {};
  for (int x = 1; x <= side; ++x)
  {
    for (int y = 1; y <= side; ++y)
    {
      for (int z = 1; z <= side; ++z)
      {
        in[x][y][z] = chance(random) || (x == 2 && y == 2 && z == 2);
      }
    }
  }
  TriangleMesh mesh;
  for (int x = 0; x <= side + 1; ++x)
  {
    for (int y = 0; y <= side + 1; ++y)
    {
      for (int z = 0; z <= side + 1; ++z)
      {
        for (std::size_t axis = 0; axis < 3 && in[x][y][z]; ++axis)
        {
          for (const int step : { -1, 1 })
          {
            std::array<int, 3> next{ x, y, z };
            next[axis] += step;
            if (in[next[0]][next[1]][next[2]])
            {
              continue;
            }
            const std::size_t u = (axis + 1) % 3;
            const std::size_t v = (axis + 2) % 3;
            Vector3           corner[4];
            for (std::size_t c = 0; c < 4; ++c)
            {
              std::array<int, 3> place{ x, y, z };
              place[axis] += step > 0 ? 1 : 0;
              place[u] += c == 1 || c == 2 ? 1 : 0;
              place[v] += c >= 2 ? 1 : 0;
              for (std::size_t a = 0; a < 3; ++a)
              {
                corner[c][a] = lower[a] + cell * (place[a] - 1);
              }
            }
            const auto first = static_cast<std::uint32_t>(mesh.points.size());
            mesh.points.insert(mesh.points.end(), corner, corner + 4);
            const std::uint32_t turn = coin(random) ? 1 : 0;
            const auto          p = [&](std::uint32_t c) { return first + (c + turn) % 4; };
            step > 0 ? AddQuad(mesh, p(0), p(1), p(2), p(3)) : AddQuad(mesh, p(0), p(3), p(2), p(1));
          }
        }
      }
    }
  }
  return mesh;
}

TriangleMesh
Together(TriangleMesh first, const TriangleMesh & second, bool reversed)
{
  const auto offset = static_cast<std::uint32_t>(first.points.size());
  first.points.insert(first.points.end(), second.points.begin(), second.points.end());
  for (auto t : second.triangles)
  {
    if (reversed)
    {
      std::swap(t[1], t[2]);
    }
    first.triangles.push_back({ t[0] + offset, t[1] + offset, t[2] + offset });
  }
  return first;
}

TriangleMesh
Turned(TriangleMesh mesh, std::mt19937 & random)
{
  std::normal_distribution<double> normal;
  Vector3                          middle{ 0, 0, 0 };
  for (const Vector3 & p : mesh.points)
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      middle[a] += p[a] / static_cast<double>(mesh.points.size());
    }
  }
  std::array<double, 4> q{ normal(random), normal(random), normal(random), normal(random) };
  const double          length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (double & part : q)
  {
    part /= length;
  }
  const auto [w, x, y, z] = q;
  const double m[3][3] = { { 1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w) },
                           { 2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w) },
                           { 2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y) } };
  for (Vector3 & p : mesh.points)
  {
    const Vector3 d{ p[0] - middle[0], p[1] - middle[1], p[2] - middle[2] };
    for (std::size_t a = 0; a < 3; ++a)
    {
      p[a] = middle[a] + m[a][0] * d[0] + m[a][1] * d[1] + m[a][2] * d[2];
    }
  }
  return mesh;
}

std::vector<MeshCase>
ClosedMeshes(unsigned seed)
{
  std::mt19937          random(seed);
  std::vector<MeshCase> cases;
  const VoxelGrid       unit = UnitGrid();
  const auto            add = [&](const std::string & name, TriangleMesh mesh, const VoxelGrid & grid) {
    cases.push_back({ name, std::move(mesh), grid });
  };
  const auto fitted = [&](const std::string & name, TriangleMesh mesh, std::int64_t resolution) {
    const VoxelGrid grid = GridOfResolution(mesh, resolution);
    add(name, std::move(mesh), grid);
  };
  add("box, all faces on centres", BoxMesh({ 2.5, 3.5, 4.5 }, { 20.5, 17.5, 9.5 }), unit);
  add("box between centres", BoxMesh({ 2, 3, 4 }, { 20, 17, 9 }), unit);
  add("box, some faces on centres", BoxMesh({ 2.5, 3.25, 4.75 }, { 20.1, 17.5, 9.5 }), unit);
  add("box thinner than a voxel, on centres", BoxMesh({ 2.5, 3.5, 4.5 }, { 20.5, 17.5, 4.75 }), unit);
  add("octahedron, corners on centres", OctahedronMesh({ 12.5, 11.5, 10.5 }, 9), unit);
  add("octahedron, edges between centres", OctahedronMesh({ 12, 11.5, 10 }, 8), unit);
  add("octahedra that touch in a corner",
      Together(OctahedronMesh({ 6.5, 11.5, 11.5 }, 5), OctahedronMesh({ 16.5, 11.5, 11.5 }, 5)),
      unit);
  for (int i = 0; i < 4; ++i)
  {
    add("blocks with corners on centres " + std::to_string(i), BlocksMesh({ 2.5, 2.5, 2.5 }, 4, 0.5, random), unit);
  }
  for (int i = 0; i < 2; ++i)
  {
    add("blocks of cells like voxels " + std::to_string(i), BlocksMesh({ 3.5, 4, 5.5 }, 1, 0.6, random), unit);
    fitted("turned blocks " + std::to_string(i), Turned(BlocksMesh({ 1, 2, 3 }, 3, 0.5, random), random), 40);
  }
  for (int i = 0; i < 3; ++i)
  {
    fitted("rough star " + std::to_string(i), StarMesh({ 0.1, -7, 1.0 / 3 }, 10, 6 + 4 * i, 0.3 * i, random), 50);
    fitted("turned torus " + std::to_string(i), Turned(TorusMesh({ 1, 2, 3 }, 10, 2 + i, 40, 12), random), 60);
  }
  add("torus in the planes of centres", TorusMesh({ 11.5, 11.5, 11.5 }, 7, 3, 24, 12), unit);
  add("star in the planes of centres", StarMesh({ 11.5, 11.5, 11.5 }, 9, 8, 0, random), unit);
  add("shell",
      Together(BoxMesh({ 1.5, 1.5, 1.5 }, { 20.5, 20.5, 20.5 }), BoxMesh({ 5.5, 6, 7 }, { 12.5, 11, 9 }), true),
      unit);
  add("part within a part",
      Together(BoxMesh({ 1, 1, 1 }, { 20, 20, 20 }), OctahedronMesh({ 10.5, 10.5, 10.5 }, 5)),
      unit);
  add("parts that overlap",
      Together(BoxMesh({ 1.5, 1.5, 1.5 }, { 15, 15, 15 }), BoxMesh({ 7.5, 6, 7 }, { 20.5, 21, 22 })),
      unit);
  fitted("overlapping tori",
         Together(Turned(TorusMesh({ 0, 0, 0 }, 8, 2, 24, 10), random),
                  Turned(TorusMesh({ 1, 0, 0 }, 8, 2, 24, 10), random)),
         50);
  add("inside out", Together(TriangleMesh(), StarMesh({ 12, 12, 12 }, 9, 7, 0.2, random), true), unit);
  fitted("far from the origin", StarMesh({ 123456.7, -98765.4, 1e6 }, 3, 8, 0.2, random), 50);
  add("on thick slices", OctahedronMesh({ 6.25, 6.5, 12.5 }, 6), { { 0, 0.25, -1 }, { 0.5, 0.5, 2 }, { 24, 24, 12 } });
  return cases;
}

} // namespace voxelcore::testing
