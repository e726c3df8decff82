#include "voxelcore/Report/ResultRecords.h"

#include "VoxelCoreTesting/Shapes.h"

#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

/** A frame of beams three voxels wide: one loop. */
CertifiedResult
Ring(const ImageGeometry & geometry)
{
  const VoxelShape shape = testing::ShapeWhere({ 15, 15, 3 }, [](int x, int y, int) {
    return std::min({ x, y, 14 - x, 14 - y }) < 3;
  });
  CertifiedRequest request;
  request.skeleton = SkeletonRequest{};
  request.skeleton->standOut = ParseLambda("3vox");
  request.skeleton->smooth = ParseLambda("6vox");
  request.skeleton->branches.cutLoops = true;
  return ComputeCertified(shape, geometry, request);
}

TEST(ResultRecords, ASkeletonGoesToItsFileAndItsNumbersIntoTheRecord)
{
  ImageGeometry geometry;
  geometry.size = { 15, 15, 3 };
  CertifiedResult         result = Ring(geometry);
  const CertifiedSkeleton before = *result.skeleton;
  ASSERT_EQ(before.cuts.size(), 1U);
  LabelRecord record;
  record.label = 7;
  record.component = 2;
  record.name = "ring";
  const SkeletonPart part = TakeSkeleton(std::move(*result.skeleton), record);
  // The file's part is called as the record is, whatever the skeleton was called before.
  EXPECT_EQ(part.label, 7);
  EXPECT_EQ(part.component, 2);
  EXPECT_EQ(part.name, "ring");
  EXPECT_EQ(part.graph.positions, before.skeleton.graph.positions);
  EXPECT_EQ(part.graph.branchPoints, before.skeleton.graph.branchPoints);
  EXPECT_EQ(part.table.branches.size(), before.skeleton.table.branches.size());
  ASSERT_TRUE(record.skeleton.has_value());
  EXPECT_EQ(record.skeleton->topology, before.topology);
  EXPECT_EQ(record.skeleton->topology.betti[1], 1) << "of the shape";
  EXPECT_EQ(record.skeleton->numbers.cycles, 0) << "as written";
  EXPECT_EQ(record.skeleton->numbers.totalLength, before.skeleton.table.numbers.totalLength);
  ASSERT_EQ(record.skeleton->cuts.size(), 1U);
  EXPECT_EQ(record.skeleton->cuts[0].position, before.cuts[0].position);
  EXPECT_TRUE(record.skeleton->output.empty());
}

TEST(ResultRecords, AShapeThatWasRecordedIsTheShapeThatWasCertified)
{
  ImageGeometry geometry;
  geometry.size = { 40, 40, 40 };
  geometry.spacing = { 0.5, 0.5, 2 };
  geometry.origin = { -3, 1.0 / 3, 1e-9 };
  geometry.unit = SpatialUnit::Voxels;
  const CertifiedResult result = Ring(geometry);
  CoreReport            report;
  report.input.geometry = geometry;
  report.parameters.labels = { 4 };
  report.parameters.lambda = { "0" };
  report.parameters.weights = ComputeLatticeWeights(geometry);
  LabelRecord label;
  label.label = 4;
  label.name = "ring";
  label.shape = result.shape.topology;
  label.box = result.shape.box;
  label.pruned = { { result.cores[0].numbers, "a.vtp" } };
  report.labels = { label };
  // Through a file, as later jobs find it.
  const CoreReport     read = ParseProvenance(ProvenanceJson(report, { 0 }, 0), "a.vtp");
  const CertifiedShape shape = RecordedShape(read, read.labels.at(0));
  EXPECT_EQ(shape.name, "label 4 (ring)");
  EXPECT_EQ(shape.topology, result.shape.topology);
  EXPECT_EQ(shape.box.lower, result.shape.box.lower);
  EXPECT_EQ(shape.box.size, result.shape.box.size);
  EXPECT_EQ(shape.geometry.spacing, geometry.spacing);
  EXPECT_EQ(shape.geometry.origin, geometry.origin);
  EXPECT_EQ(shape.geometry.unit, SpatialUnit::Voxels);
  EXPECT_NO_THROW(RequireTopologyOf(shape, result.cores[0]));
}

} // namespace
} // namespace voxelcore
