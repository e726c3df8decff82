#include "voxelcore/VoxelCore/ExtractPart.h"

#include "VoxelCoreTesting/Cores.h"

#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

using testing::CoreOf;

TEST(ExtractPart, ElementsKeepTheirGeometryMeasuresAndOrder)
{
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, { 9, 6, 4 } });
  for (std::int32_t v = 0; v < 9 * 6 * 4; ++v)
  {
    shape.Insert(v % 9, v / 9 % 6, v / 54);
  }
  const MedialComplex core = CoreOf(shape);
  SimplePairCollapse  collapse(core.cells, core.vertexLambda, core.edgeLambda, core.faceLambda);
  collapse.CollapseBelow(1.5);
  PartElements        elements;
  const MedialComplex part = ExtractPart(core, collapse.Live(), elements);
  ASSERT_EQ(part.positions.size(), elements.vertices.size());
  ASSERT_EQ(part.cells.edges.size(), elements.edges.size());
  ASSERT_EQ(part.cells.FaceCount(), elements.faces.size());
  ASSERT_LT(part.cells.vertexCount, core.cells.vertexCount);
  ASSERT_GT(part.cells.FaceCount(), 0U);
  EXPECT_TRUE(std::is_sorted(elements.vertices.begin(), elements.vertices.end()));
  for (std::size_t i = 0; i < elements.vertices.size(); ++i)
  {
    EXPECT_EQ(part.positions[i], core.positions[elements.vertices[i]]);
    EXPECT_EQ(part.radius[i], core.radius[elements.vertices[i]]);
    EXPECT_EQ(part.vertexLambda[i], core.vertexLambda[elements.vertices[i]]);
  }
  for (std::size_t i = 0; i < elements.edges.size(); ++i)
  {
    const auto & ends = core.cells.edges[elements.edges[i]];
    EXPECT_EQ(elements.vertices[part.cells.edges[i][0]], ends[0]);
    EXPECT_EQ(elements.vertices[part.cells.edges[i][1]], ends[1]);
    EXPECT_EQ(part.edgeLambda[i], core.edgeLambda[elements.edges[i]]);
  }
  for (std::size_t i = 0; i < elements.faces.size(); ++i)
  {
    const auto corners = core.cells.FaceVertices(elements.faces[i]);
    const auto kept = part.cells.FaceVertices(i);
    ASSERT_EQ(kept.size(), corners.size());
    for (std::size_t k = 0; k < kept.size(); ++k)
    {
      EXPECT_EQ(elements.vertices[kept[k]], corners[k]);
    }
    EXPECT_EQ(part.faceLambda[i], core.faceLambda[elements.faces[i]]);
  }
  EXPECT_EQ(ExtractPart(core, collapse.Live()).positions, part.positions);
}

TEST(ExtractPart, InPlaceOfTheWholeItIsTheSame)
{
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, { 9, 6, 4 } });
  for (std::int32_t v = 0; v < 9 * 6 * 4; ++v)
  {
    shape.Insert(v % 9, v / 9 % 6, v / 54);
  }
  MedialComplex core = CoreOf(shape);
  core.tolerances = { core.vertexLambda, core.edgeLambda, core.faceLambda };
  SimplePairCollapse collapse(core.cells, core.vertexLambda, core.edgeLambda, core.faceLambda);
  collapse.CollapseBelow(1.5);
  const MedialComplex part = ExtractPart(core, collapse.Live());
  const MedialComplex kept = KeepPart(std::move(core), collapse.Live());
  testing::ExpectSameCore(kept, part);
  EXPECT_EQ(kept.tolerances.vertices, part.tolerances.vertices);
  EXPECT_EQ(kept.tolerances.edges, part.tolerances.edges);
  EXPECT_EQ(kept.tolerances.faces, part.tolerances.faces);
}

TEST(ExtractPart, APartsPartIsNamedInTheWhole)
{
  const PartElements part{ { 2, 5, 7 }, { 1, 4 }, { 9 } };
  PartElements       ofPart{ { 0, 2 }, { 1 }, {} };
  NameInWhole(part, ofPart);
  EXPECT_EQ(ofPart.vertices, (std::vector<ElementIndex>{ 2, 7 }));
  EXPECT_EQ(ofPart.edges, (std::vector<ElementIndex>{ 4 }));
  EXPECT_TRUE(ofPart.faces.empty());
}

} // namespace
} // namespace voxelcore
