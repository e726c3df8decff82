#include "ItkPipelineFixtures.h"

#include "itkMedialComplexToMeshFilter.h"

#include "voxelcore/Certified/Certified.h"

#include <set>

using namespace voxelcore;
using namespace voxelcore::testing;

TEST(ItkMesh, HoldsEveryCellOfEveryCoreInItsPlaceWithRadiiAndLabels)
{
  Pipeline pipeline;
  pipeline.pruned->SetLambda("1.5vox");
  auto filter = itk::MedialComplexToMeshFilter<>::New();
  filter->SetInput(pipeline.pruned->GetOutput());
  filter->Update();
  const auto & mesh = *filter->GetOutput();

  std::size_t first = 0;
  std::size_t cell = 0;
  std::size_t lines = 0;
  const auto  expectCell = [&](std::vector<std::size_t> corners, std::int64_t label) {
    itk::MedialMesh::CellAutoPointer found;
    ASSERT_TRUE(mesh.GetCell(cell, found));
    ASSERT_EQ(found->GetNumberOfPoints(), corners.size());
    EXPECT_TRUE(std::equal(corners.begin(), corners.end(), found->PointIdsBegin()));
    double value = 0;
    ASSERT_TRUE(mesh.GetCellData(cell, &value));
    EXPECT_EQ(value, static_cast<double>(label));
    ++cell;
  };
  ASSERT_EQ(pipeline.pruned->GetOutput()->GetParts().size(), 2U);
  for (const auto & part : pipeline.pruned->GetOutput()->GetParts())
  {
    const MedialComplex & core = part.core->core.core;
    const CellComplex &   cells = core.cells;
    std::set<std::size_t> bare;
    for (std::size_t vertex = 0; vertex < cells.vertexCount; ++vertex)
    {
      bare.insert(vertex);
      const auto point = mesh.GetPoint(first + vertex);
      double     radius = 0;
      ASSERT_TRUE(mesh.GetPointData(first + vertex, &radius));
      EXPECT_EQ(radius, core.radius[vertex]);
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        EXPECT_EQ(point[axis], core.positions[vertex][axis]);
      }
    }
    for (const auto & edge : cells.edges)
    {
      bare.erase(edge[0]);
      bare.erase(edge[1]);
    }
    for (const std::size_t vertex : bare)
    {
      expectCell({ first + vertex }, part.origin.label);
    }
    const std::set<ElementIndex> ofFaces(cells.faceEdges.begin(), cells.faceEdges.end());
    for (std::size_t edge = 0; edge < cells.edges.size(); ++edge)
    {
      if (!ofFaces.contains(static_cast<ElementIndex>(edge)))
      {
        expectCell({ first + cells.edges[edge][0], first + cells.edges[edge][1] }, part.origin.label);
        ++lines;
      }
    }
    for (std::size_t face = 0; face < cells.FaceCount(); ++face)
    {
      std::vector<std::size_t> corners;
      for (const ElementIndex corner : cells.FaceVertices(face))
      {
        corners.push_back(first + corner);
      }
      expectCell(corners, part.origin.label);
    }
    EXPECT_GT(cells.FaceCount(), 0U);
    first += cells.vertexCount;
  }
  EXPECT_GT(lines, 0U);
  EXPECT_EQ(mesh.GetNumberOfPoints(), first);
  EXPECT_EQ(mesh.GetNumberOfCells(), cell);
}

TEST(ItkMesh, BranchesAsPathsLieInTheImageWhereTheSkeletonLies)
{
  Pipeline pipeline;
  auto     geometry = pipeline.shapes->GetGeometry();
  geometry.direction = { 0, 0.6, 0.8, 0, 0.8, -0.6, -1, 0, 0 };
  pipeline.shapes->SetGeometry(geometry);
  Placement placement{ pipeline.shapes->GetStartIndex(), geometry.spacing, {}, geometry.direction };
  // ITK's origin is where index 0 would be.
  ImageGeometry before = geometry;
  before.origin = LatticeToPhysical(geometry, { 0.5 - 4, 0.5 - 5, 0.5 - 6 });
  placement.origin = before.origin;
  const auto image = MakeImage<unsigned char>(
    { { 24, 24, 24 } },
    [](int, int, int) { return 0; },
    placement);

  std::size_t branches = 0;
  for (const LabelShape & label : pipeline.shapes->GetLabels())
  {
    CertifiedRequest request;
    request.lambdas = { Lambda() };
    request.skeleton.emplace();
    const auto   result = ComputeCertified(label.shape, geometry, request);
    const auto & graph = result.skeleton->skeleton.graph;
    const auto   paths = itk::PathsOfBranches(graph, *pipeline.shapes);
    ASSERT_EQ(paths.size(), graph.BranchCount());
    for (std::size_t branch = 0; branch < paths.size(); ++branch)
    {
      const auto points = graph.Branch(branch);
      const auto vertices = paths[branch]->GetVertexList();
      ASSERT_EQ(vertices->Size(), points.size());
      for (unsigned int n = 0; n < points.size(); ++n)
      {
        const auto place = image->TransformContinuousIndexToPhysicalPoint<double>(vertices->ElementAt(n));
        EXPECT_LT(place.EuclideanDistanceTo(itk::Point<double, 3>(graph.positions[points[n]].data())), 1e-9);
        EXPECT_TRUE(image->GetLargestPossibleRegion().IsInside(vertices->ElementAt(n)));
      }
    }
    branches += paths.size();
  }
  EXPECT_GT(branches, 5U);
}
