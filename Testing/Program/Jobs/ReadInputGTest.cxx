#include "JobFolder.h"

#include "voxelcore/Jobs/ReadInput.h"

namespace voxelcore::testing
{
namespace
{

using ReadInput = JobFolder;

TEST_F(ReadInput, AMeshIsAVolumeOfOneLabelInItsBox)
{
  BoxMesh("part.off");
  const MeshVolume made = VoxelizeMeshFile(At("part.off"), 12, {});
  const auto &     geometry = made.volume.geometry;
  EXPECT_EQ(geometry.size, (std::array<std::int64_t, 3>{ 4, 8, 12 })) << "12 along the longest side, of 6 mm";
  EXPECT_EQ(geometry.spacing, (Vector3{ 0.5, 0.5, 0.5 }));
  EXPECT_EQ(geometry.origin, (Vector3{ 1.25, 2.25, 3.25 })) << "the centre of the first voxel";
  ASSERT_EQ(made.volume.labels.size(), 1U);
  EXPECT_EQ(made.volume.labels[0].value, 1);
  EXPECT_EQ(made.volume.labels[0].name, "part");
  EXPECT_EQ(made.volume.labels[0].voxels, 4U * 8 * 12) << "all of it";
  EXPECT_EQ(made.findings.openEdges, 0U);
  EXPECT_EQ(made.doubtful, 0U);
  EXPECT_EQ(made.mesh->points.size(), 8U);
  const MeshVolume coarse = VoxelizeMeshFile(At("part.off"), {}, Vector3{ 1, 2, 3 });
  EXPECT_EQ(coarse.volume.geometry.size, (std::array<std::int64_t, 3>{ 2, 2, 2 }));
}

TEST_F(ReadInput, EitherAResolutionOrASpacingIsNeeded)
{
  BoxMesh("part.off");
  EXPECT_THROW(VoxelizeMeshFile(At("part.off"), {}, {}), UsageError);
  EXPECT_THROW(VoxelizeMeshFile(At("part.off"), 8, Vector3{ 1, 1, 1 }), UsageError);
  WriteAll(At("open.off"), "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_THROW(VoxelizeMeshFile(At("open.off"), 8, {}), InputError) << "it bounds nothing";
  EXPECT_THROW(VoxelizeMeshFile(At("none.off"), 8, {}), InputError);
  EXPECT_THROW(VoxelizeMeshFile(At("part.off"), 8, {}, {}, [](std::string_view, double) { return false; }), Cancelled);
}

TEST_F(ReadInput, ScansAndMeshesAreToldApartAndSoAreTheirOptions)
{
  BoxMesh("part.off");
  Phantom("ball", "a.nrrd");
  const InputScan scan = ReadScanOrMesh(At("a.nrrd"), {}, {});
  EXPECT_FALSE(scan.mesh);
  EXPECT_EQ(scan.labels.at(0).voxels, ReadLabelVolume(At("a.nrrd"), {}).labels.at(0).voxels);
  const InputScan mesh = ReadScanOrMesh(At("part.off"), {}, 6);
  ASSERT_TRUE(mesh.mesh);
  EXPECT_EQ(mesh.mesh->triangles.size(), 12U);
  EXPECT_EQ(mesh.labels.at(0).voxels, 2U * 4 * 6);
  ReadOptions spaced;
  spaced.spacing = Vector3{ 1, 1, 1 };
  EXPECT_EQ(ReadScanOrMesh(At("part.off"), spaced, {}).labels.at(0).voxels, 2U * 4 * 6);
  EXPECT_THROW(ReadScanOrMesh(At("a.nrrd"), {}, 6), UsageError) << "a scan has its voxels";
  const auto refused = [&](const auto & change) {
    ReadOptions options;
    change(options);
    EXPECT_THROW(ReadScanOrMesh(At("part.off"), options, 6), UsageError);
  };
  refused([](ReadOptions & options) { options.labels = "2"; });
  refused([](ReadOptions & options) { options.binary = true; });
  refused([](ReadOptions & options) { options.threshold = { 0, 1 }; });
  refused([](ReadOptions & options) { options.crop = CropRange{ { 0, 0, 0 }, { 1, 1, 1 } }; });
  refused([](ReadOptions & options) { options.volume = 0; });
  refused([](ReadOptions & options) { options.niftiForm = "sform"; });
}

TEST_F(ReadInput, AnImageInAVtkFileIsNoMesh)
{
  WriteAll(At("image.vtk"),
           "# vtk DataFile Version 3.0\nimage\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 2\n"
           "ORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA 8\nSCALARS s unsigned_char 1\nLOOKUP_TABLE default\n"
           "1 1 1 1 1 1 1 1\n");
  WriteAll(At("mesh.vtk"),
           "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n"
           "POLYGONS 1 4\n3 0 1 2\n");
  EXPECT_FALSE(IsMeshFile(At("image.vtk")));
  EXPECT_TRUE(IsMeshFile(At("mesh.vtk")));
  EXPECT_TRUE(IsMeshFile("anything.STL"));
  EXPECT_FALSE(IsMeshFile("anything.nrrd"));
}

TEST_F(ReadInput, ResolutionsAreWholeNumbersEachOnce)
{
  EXPECT_EQ(ParseResolutions("256"), (std::vector<std::int64_t>{ 256 }));
  EXPECT_EQ(ParseResolutions("512,1,1048576"), (std::vector<std::int64_t>{ 512, 1, 1048576 }));
  for (const char * text : { "", ",", "0", "-1", "1,", ",1", "1,,2", "1,1", "1048577", "2.5", "64 ", "1e3", "x" })
  {
    EXPECT_THROW(ParseResolutions(text), UsageError) << text;
  }
}

} // namespace
} // namespace voxelcore::testing
