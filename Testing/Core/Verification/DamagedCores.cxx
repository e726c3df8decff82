#include "Core/Verification/DamagedCores.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace voxelcore::testing
{

VerificationCase
GoodCase(double threshold)
{
  return MakeCase(EllipsoidWithRod(), { 0.5, 0.5, 1.0 }, threshold);
}

Names
Failures(const VerificationCase & subject)
{
  const VerificationReport report = Verify(subject);
  for (const VerificationCheck & check : report.checks)
  {
    EXPECT_EQ(check.passed, check.firstOffender.empty()) << check.name;
    if (!check.passed && !check.firstOffender.empty())
    {
      EXPECT_TRUE(check.firstOffender[0] >= 'A' && check.firstOffender[0] <= 'Z') << check.firstOffender;
      EXPECT_EQ(check.firstOffender.back(), '.') << check.firstOffender;
    }
  }
  EXPECT_EQ(report.passed, FailedChecks(report).empty());
  return FailedChecks(report);
}

void
ExpectFails(const VerificationCase & subject, const Names & checks)
{
  const Names failed = Failures(subject);
  for (const std::string & check : checks)
  {
    EXPECT_TRUE(std::find(failed.begin(), failed.end(), check) != failed.end())
      << check << " did not fail, but " << ::testing::PrintToString(failed);
  }
}

std::size_t
FaceWithCorners(const CellComplex & cells, std::size_t corners)
{
  for (std::size_t f = 0; f < cells.FaceCount(); ++f)
  {
    if (cells.FaceVertices(f).size() >= corners)
    {
      return f;
    }
  }
  ADD_FAILURE() << "no face with " << corners << " corners";
  return 0;
}

std::size_t
EdgeWithoutFace(const CellComplex & cells)
{
  std::vector<bool> onFace(cells.edges.size(), false);
  for (const ElementIndex edge : cells.faceEdges)
  {
    onFace[edge] = true;
  }
  const auto found = std::find(onFace.begin(), onFace.end(), false);
  EXPECT_TRUE(found != onFace.end());
  return static_cast<std::size_t>(found - onFace.begin());
}

void
Keep(MedialComplex & core, const LiveElements & live)
{
  std::vector<ElementIndex> vertices;
  std::vector<ElementIndex> edges;
  std::vector<ElementIndex> faces;
  core.cells = ExtractLive(core.cells, live, vertices, edges, faces);
  const auto gather = [](auto & values, const std::vector<ElementIndex> & ids) {
    auto kept = values;
    kept.clear();
    for (const ElementIndex id : ids)
    {
      kept.push_back(values[id]);
    }
    values = kept;
  };
  gather(core.positions, vertices);
  gather(core.radius, vertices);
  gather(core.vertexLambda, vertices);
  gather(core.edgeLambda, edges);
  gather(core.faceLambda, faces);
}

LiveElements
AllOf(const CellComplex & cells)
{
  return { std::vector<std::uint8_t>(cells.vertexCount, 1),
           std::vector<std::uint8_t>(cells.edges.size(), 1),
           std::vector<std::uint8_t>(cells.FaceCount(), 1) };
}

void
AppendFace(MedialComplex & core, const std::vector<ElementIndex> & corners, double lambda)
{
  CellComplex & cells = core.cells;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const ElementIndex next = corners[(i + 1) % corners.size()];
    const std::array   ends{ std::min(corners[i], next), std::max(corners[i], next) };
    const auto         edge = std::find(cells.edges.begin(), cells.edges.end(), ends);
    ASSERT_TRUE(edge != cells.edges.end());
    cells.faceVertices.push_back(corners[i]);
    cells.faceEdges.push_back(static_cast<ElementIndex>(edge - cells.edges.begin()));
  }
  cells.faceOffsets.push_back(cells.faceVertices.size());
  core.faceLambda.push_back(lambda);
}

void
ReversePolygon(CellComplex & cells, std::size_t face)
{
  const auto first = static_cast<std::ptrdiff_t>(cells.faceOffsets[face]);
  const auto last = static_cast<std::ptrdiff_t>(cells.faceOffsets[face + 1]);
  std::reverse(cells.faceVertices.begin() + first + 1, cells.faceVertices.begin() + last);
  // The edge from each corner to the next moves along.
  std::reverse(cells.faceEdges.begin() + first, cells.faceEdges.begin() + last);
}

} // namespace voxelcore::testing
