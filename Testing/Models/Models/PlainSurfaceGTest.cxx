// Surfaces without a record, as other programs save them.

#include "voxelcore/Models/PlainSurface.h"

#include "Models/Models/ModelFixtures.h"
#include "Models/Models/VtkMeshForms.h"
#include "voxelcore/Base/Error.h"

#include <gtest/gtest.h>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

TEST(PlainSurface, EveryFormShowsPolygonsStripsAndLines)
{
  const TemporaryFolder folder;
  auto                  forms = XmlForms();
  forms.insert(LegacyForms().begin(), LegacyForms().end());
  for (const auto & [name, bytes] : forms)
  {
    WriteAll(folder / name, bytes);
    const auto plain = ReadPlainSurface(folder / name);
    ASSERT_TRUE(plain) << name;
    EXPECT_FALSE(plain->hasRadius);
    EXPECT_EQ(plain->surface.cells.FaceCount(), 12U + 6U) << name; // squares, and two strips of four and two triangles
    EXPECT_EQ(plain->surface.positions.size(), plain->surface.cells.vertexCount);
    // All but the corner on no cell but a vertex; the line 0-1-2 lies on squares.
    EXPECT_EQ(plain->surface.cells.vertexCount, 24U) << name;
  }
}

TEST(PlainSurface, MeshesAreTriangles)
{
  const TemporaryFolder folder;
  WriteAll(folder / "a.off", "OFF\n5 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n9 9 9\n4 0 1 2 3\n3 0 0 1\n");
  const auto plain = ReadPlainSurface(folder / "a.off");
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->surface.cells.FaceCount(), 2U);
  EXPECT_EQ(plain->surface.cells.vertexCount, 4U);
}

TEST(PlainSurface, FilesWithARecordAreNotPlain)
{
  const TemporaryFolder folder;
  MedialModel           model = MixedModel();
  WriteModel(folder / "a.vtp", "a.vtp", model);
  const bool hasRecord = !model.provenance.empty();
  const auto without = ReadPlainSurface(folder / "a.vtp");
  EXPECT_EQ(without.has_value(), !hasRecord);
  model.provenance = "{}";
  WriteModel(folder / "a.vtp", "a.vtp", model);
  WriteModel(folder / "a.vtk", "a.vtk", model);
  EXPECT_FALSE(ReadPlainSurface(folder / "a.vtp"));
  EXPECT_FALSE(ReadPlainSurface(folder / "a.vtk"));
  model.provenance.clear();
  WriteModel(folder / "a.vtp", "a.vtp", model);
  const auto plain = ReadPlainSurface(folder / "a.vtp");
  ASSERT_TRUE(plain);
  EXPECT_TRUE(plain->hasRadius);
  EXPECT_GT(plain->surface.radius.front(), 0);
}

TEST(PlainSurface, WhatShowsNothingIsRefused)
{
  const TemporaryFolder folder;
  WriteAll(folder / "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 0 1\n");
  EXPECT_THROW(ReadPlainSurface(folder / "a.off"), InputError);
  EXPECT_THROW(ReadPlainSurface(folder / "none.vtk"), InputError);
  WriteAll(folder / "a.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 1 float\n0 0 0\n");
  EXPECT_THROW(ReadPlainSurface(folder / "a.vtk"), InputError);
}

} // namespace
