#include "Models/Models/ModelFixtures.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Complex/ComplexTopology.h"
#include "voxelcore/VoxelCore/VoxelCore.h"

#include <gtest/gtest.h>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>
#include <limits>
#include <set>
#include <utility>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

template <typename ReaderType>
vtkSmartPointer<vtkPolyData>
ReadWithVtk(const std::filesystem::path & path)
{
  vtkNew<ReaderType> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

std::string
FieldText(vtkPolyData * data, const char * name)
{
  auto * array = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name));
  return array ? std::string(array->GetValue(0)) : "(none)";
}

std::vector<vtkIdType>
CellPoints(vtkPolyData * data, vtkIdType cell)
{
  vtkNew<vtkIdList> ids;
  data->GetCellPoints(cell, ids);
  return { ids->begin(), ids->end() };
}

/** What section 7 of the design promises, on MixedModel with its edges kept. */
void
CheckMixedPolyData(vtkPolyData * data, const MedialModel & model)
{
  ASSERT_EQ(data->GetNumberOfPoints(), 13);
  ASSERT_EQ(data->GetNumberOfVerts(), 3);
  ASSERT_EQ(data->GetNumberOfLines(), 2);
  ASSERT_EQ(data->GetNumberOfPolys(), 2);
  const std::vector<std::vector<vtkIdType>> cells{ { 5 },      { 9 },          { 10 },           { 3, 4 },
                                                   { 11, 12 }, { 0, 1, 2, 3 }, { 1, 2, 6, 7, 8 } };
  auto *                                    label = data->GetCellData()->GetArray("Label");
  auto *                                    lambda = data->GetCellData()->GetArray("Lambda");
  ASSERT_TRUE(label && lambda);
  EXPECT_EQ(label->GetDataTypeSize(), 8);
  const std::vector<int>    labels{ 3, 7, 7, 3, 300, 3, 3 };
  const MedialComplex &     first = model.parts[0].core;
  const MedialComplex &     second = model.parts[1].core;
  const std::vector<double> lambdas{ first.vertexLambda[5],
                                     second.vertexLambda[0],
                                     second.vertexLambda[1],
                                     first.edgeLambda[5],
                                     model.parts[2].core.edgeLambda[0],
                                     first.faceLambda[0],
                                     first.faceLambda[1] };
  ASSERT_EQ(first.cells.edges[5], (std::array<ElementIndex, 2>{ 2, 6 })) << "the fixture changed";
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
  {
    const auto id = static_cast<vtkIdType>(cell);
    EXPECT_EQ(CellPoints(data, id), cells[cell]);
    EXPECT_EQ(label->GetTuple1(id), labels[cell]);
    if (cell != 3)
    {
      EXPECT_EQ(lambda->GetTuple1(id), lambdas[cell]);
    }
  }
  for (std::size_t edge = 0; edge < first.cells.edges.size(); ++edge)
  {
    if (first.cells.edges[edge] == std::array<ElementIndex, 2>{ 3, 4 })
    {
      EXPECT_EQ(lambda->GetTuple1(3), first.edgeLambda[edge]);
    }
  }
  auto *    radius = data->GetPointData()->GetArray("Radius");
  auto *    pointLambda = data->GetPointData()->GetArray("Lambda");
  vtkIdType point = 0;
  ASSERT_TRUE(radius && pointLambda);
  for (const ModelPart & part : model.parts)
  {
    for (std::size_t v = 0; v < part.core.cells.vertexCount; ++v, ++point)
    {
      EXPECT_EQ(radius->GetTuple1(point), part.core.radius[v]);
      EXPECT_EQ(pointLambda->GetTuple1(point), part.core.vertexLambda[v]);
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_EQ(data->GetPoint(point)[axis], part.core.positions[v][static_cast<std::size_t>(axis)]);
      }
    }
  }
  EXPECT_EQ(FieldText(data, "SPACE"), "LPS");
  EXPECT_EQ(FieldText(data, "Units"), "mm");
  EXPECT_EQ(FieldText(data, "Provenance"), model.provenance);
  auto * edgeVertices = data->GetFieldData()->GetArray("EdgeVertices");
  auto * edgeLambda = data->GetFieldData()->GetArray("EdgeLambda");
  ASSERT_TRUE(edgeVertices && edgeLambda);
  EXPECT_EQ(edgeVertices->GetNumberOfComponents(), 2);
  EXPECT_EQ(edgeVertices->GetNumberOfTuples(), 8); // 4 + 5, one shared
  EXPECT_EQ(edgeLambda->GetNumberOfTuples(), 8);
  for (vtkIdType i = 0; i < 8; ++i)
  {
    const std::array<ElementIndex, 2> ends{ static_cast<ElementIndex>(edgeVertices->GetComponent(i, 0)),
                                            static_cast<ElementIndex>(edgeVertices->GetComponent(i, 1)) };
    const auto                        found = std::find(first.cells.edges.begin(), first.cells.edges.end(), ends);
    ASSERT_NE(found, first.cells.edges.end());
    EXPECT_EQ(edgeLambda->GetTuple1(i), first.edgeLambda[static_cast<std::size_t>(found - first.cells.edges.begin())]);
  }
}

} // namespace

TEST(MedialModel, VtpHoldsCellsAndArraysAsDesigned)
{
  const TemporaryFolder folder;
  const MedialModel     model = MixedModel();
  const ModelOmissions  omissions =
    WriteModel(folder / "a.vtp", "a.vtp", model, { .triangles = false, .keepEdges = true });
  EXPECT_EQ(omissions.vertices + omissions.edges + omissions.labels, 0U);
  CheckMixedPolyData(ReadWithVtk<vtkXMLPolyDataReader>(folder / "a.vtp"), model);
}

TEST(MedialModel, LegacyVtkHoldsTheSameAndSaysItsSpaceInTheSecondLine)
{
  const TemporaryFolder folder;
  const MedialModel     model = MixedModel();
  WriteModel(folder / "a.vtk", "a.vtk", model, { .triangles = false, .keepEdges = true });
  CheckMixedPolyData(ReadWithVtk<vtkPolyDataReader>(folder / "a.vtk"), model);
  const std::string bytes = ReadAll(folder / "a.vtk");
  EXPECT_EQ(bytes.rfind("# vtk DataFile Version 4.2\n", 0), 0U);
  const std::string second = bytes.substr(27, bytes.find('\n', 27) - 27);
  EXPECT_NE(second.find("SPACE=LPS"), std::string::npos) << second;
}

TEST(MedialModel, ReadsBackEveryBit)
{
  const TemporaryFolder folder;
  for (const bool keepEdges : { true, false })
  {
    MedialModel model = MixedModel();
    model.parts[1].core.positions[0] = { -0.0, std::numeric_limits<double>::denorm_min(), 1e11 / 3 };
    WriteModel(folder / "a.vtp", "a.vtp", model, { .triangles = false, .keepEdges = keepEdges });
    const MedialModel read = ReadModel(folder / "a.vtp");
    EXPECT_EQ(read.hasEdges, keepEdges);
    if (!keepEdges)
    {
      for (std::size_t edge = 0; edge < model.parts[0].core.edgeLambda.size(); ++edge)
      {
        const bool loose = model.parts[0].core.cells.edges[edge] == std::array<ElementIndex, 2>{ 3, 4 };
        EXPECT_EQ(std::isnan(read.parts[0].core.edgeLambda[edge]), !loose);
        if (!loose)
        {
          model.parts[0].core.edgeLambda[edge] = read.parts[0].core.edgeLambda[edge];
        }
      }
      model.hasEdges = false;
    }
    EXPECT_TRUE(SameBits(read, model));
    WriteModel(folder / "b.vtp", "b.vtp", read, { .triangles = false, .keepEdges = keepEdges });
    EXPECT_EQ(ReadAll(folder / "a.vtp"), ReadAll(folder / "b.vtp"));
  }
}

TEST(MedialModel, RandomModelsReadBackEveryBit)
{
  const TemporaryFolder folder;
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const MedialModel model = RandomModel(seed, 2 + static_cast<int>(seed % 7), 1 + static_cast<int>(seed % 4));
    WriteModel(folder / "a.vtp", "x.VTP", model, { .triangles = false, .keepEdges = true });
    const MedialModel read = ReadModel(folder / "a.vtp");
    ASSERT_TRUE(SameBits(read, model));
    WriteModel(folder / "b.vtp", "b.vtp", read, { .triangles = false, .keepEdges = true });
    ASSERT_EQ(ReadAll(folder / "a.vtp"), ReadAll(folder / "b.vtp"));
  }
}

TEST(MedialModel, ComponentsOfALabelAreToldApart)
{
  const TemporaryFolder folder;
  MedialModel           model = RandomModel(5, 4, 4);
  for (std::size_t i = 0; i < model.parts.size(); ++i)
  {
    model.parts[i].label = i < 3 ? 7 : 8;
    model.parts[i].component = i < 3 ? static_cast<std::int64_t>(i) + 1 : 1;
  }
  WriteModel(folder / "a.vtp", "a.vtp", model, { .triangles = false, .keepEdges = true });
  EXPECT_TRUE(SameBits(ReadModel(folder / "a.vtp"), model));
  const auto data = ReadWithVtk<vtkXMLPolyDataReader>(folder / "a.vtp");
  auto *     label = data->GetCellData()->GetArray("Label");
  auto *     component = data->GetCellData()->GetArray("Component");
  ASSERT_TRUE(label && component);
  ASSERT_EQ(component->GetNumberOfTuples(), data->GetNumberOfCells());
  std::set<std::pair<double, double>> seen;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    seen.insert({ label->GetTuple1(cell), component->GetTuple1(cell) });
  }
  EXPECT_EQ(seen, (std::set<std::pair<double, double>>{ { 7, 1 }, { 7, 2 }, { 7, 3 }, { 8, 1 } }));

  // In triangles, too; and files of whole labels do not have the array.
  WriteModel(folder / "t.vtp", "t.vtp", model, { .triangles = true, .keepEdges = false });
  const MedialModel triangles = ReadModel(folder / "t.vtp");
  ASSERT_EQ(triangles.parts.size(), 4U);
  EXPECT_EQ(triangles.parts[2].component, 3);
  WriteModel(folder / "w.vtp", "w.vtp", MixedModel());
  EXPECT_FALSE(ReadWithVtk<vtkXMLPolyDataReader>(folder / "w.vtp")->GetCellData()->HasArray("Component"));

  std::swap(model.parts[0], model.parts[1]);
  EXPECT_THROW(WriteModel(folder / "x.vtp", "x.vtp", model), Error);
  model.parts[1] = model.parts[0];
  EXPECT_THROW(WriteModel(folder / "x.vtp", "x.vtp", model), Error);
}

TEST(MedialModel, OneElementAloneIsEnough)
{
  const TemporaryFolder folder;
  for (const MedialComplex & core :
       { MakeCore(1, {}, {}), MakeCore(2, { { 0, 1 } }, {}), MakeCore(3, {}, { { 0, 1, 2 } }), MakeCore(0, {}, {}) })
  {
    MedialModel model;
    if (core.cells.vertexCount > 0)
    {
      model.parts.push_back({ -4, core });
    }
    WriteModel(folder / "a.vtp", "a.vtp", model, { .triangles = false, .keepEdges = true });
    EXPECT_TRUE(SameBits(ReadModel(folder / "a.vtp"), model));
  }
}

TEST(MedialModel, KeepingEdgesChangesNothingWhereNoEdgeLiesOnAFace)
{
  const TemporaryFolder folder;
  MedialModel           model;
  model.parts.push_back({ 1, MakeCore(3, { { 0, 1 }, { 1, 2 } }, {}) });
  WriteModel(folder / "a.vtp", "a.vtp", model, { .triangles = false, .keepEdges = true });
  WriteModel(folder / "b.vtp", "b.vtp", model);
  EXPECT_EQ(ReadAll(folder / "a.vtp"), ReadAll(folder / "b.vtp"));
  EXPECT_TRUE(ReadModel(folder / "b.vtp").hasEdges);
}

TEST(MedialModel, EdgeMeasuresThatAreNotKnownAreNotWritten)
{
  const TemporaryFolder folder;
  WriteModel(folder / "a.vtp", "a.vtp", MixedModel());
  const MedialModel read = ReadModel(folder / "a.vtp");
  EXPECT_THROW(WriteModel(folder / "b.vtp", "b.vtp", read, { .triangles = false, .keepEdges = true }), UsageError);
  EXPECT_FALSE(std::filesystem::exists(folder / "b.vtp"));
}

TEST(MedialModel, TrianglesAreFansAndFormACoreOfTheirOwn)
{
  const TemporaryFolder folder;
  const MedialModel     model = MixedModel();
  WriteModel(folder / "a.vtp", "a.vtp", model, { .triangles = true, .keepEdges = true });
  const MedialModel     read = ReadModel(folder / "a.vtp");
  const MedialComplex & before = model.parts[0].core;
  const MedialComplex & core = read.parts[0].core;
  EXPECT_TRUE(read.hasEdges);
  EXPECT_EQ(core.cells.faceVertices, (std::vector<ElementIndex>{ 0, 1, 2, 0, 2, 3, 1, 2, 6, 1, 6, 7, 1, 7, 8 }));
  EXPECT_EQ(core.cells.edges.size(), before.cells.edges.size() + 3); // a diagonal in the square, two in the pentagon
  for (std::size_t edge = 0; edge < core.cells.edges.size(); ++edge)
  {
    const auto   ends = core.cells.edges[edge];
    const auto   old = std::find(before.cells.edges.begin(), before.cells.edges.end(), ends);
    const double expected = old != before.cells.edges.end()
                              ? before.edgeLambda[static_cast<std::size_t>(old - before.cells.edges.begin())]
                              : before.faceLambda[ends == std::array<ElementIndex, 2>{ 0, 2 } ? 0 : 1];
    EXPECT_EQ(core.edgeLambda[edge], expected);
  }
  const auto & f = before.faceLambda;
  EXPECT_EQ(core.faceLambda, (std::vector<double>{ f[0], f[0], f[1], f[1], f[1] }));
}

TEST(MedialModel, ARealCoreReadsBackEveryBitAndKeepsItsTopologyInTriangles)
{
  // A block 9 x 8 x 6 with a hole through it and a cavity.
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, { 9, 8, 6 } });
  for (std::int32_t z = 0; z < 6; ++z)
  {
    for (std::int32_t y = 0; y < 8; ++y)
    {
      for (std::int32_t x = 0; x < 9; ++x)
      {
        const bool hole = (x == 2 || x == 3) && y == 3;
        const bool cavity = x == 6 && y == 4 && z == 3;
        if (!hole && !cavity)
        {
          shape.Insert(x, y, z);
        }
      }
    }
  }
  ImageGeometry geometry;
  geometry.spacing = { 0.7, 0.9, 2.1 };
  geometry.origin = { -31.4, 8.25, 100 };
  geometry.direction = { -1, 0, 0, 0, 1, 0, 0, 0, 1 };
  const MedialComplex core = ComputeVoxelCore(shape, ComputeSpacingWeights(geometry.spacing));
  ASSERT_GT(core.cells.FaceCount(), 50U);
  MedialModel model;
  model.parts.push_back(ToPhysical(core, geometry, 17));

  const TemporaryFolder folder;
  WriteModel(folder / "a.vtp", "a.vtp", model, { .triangles = false, .keepEdges = true });
  EXPECT_TRUE(SameBits(ReadModel(folder / "a.vtp"), model));
  WriteModel(folder / "b.vtp", "b.vtp", model, { .triangles = true, .keepEdges = true });
  const MedialModel triangles = ReadModel(folder / "b.vtp");
  EXPECT_GT(triangles.parts[0].core.cells.FaceCount(), core.cells.FaceCount());
  const TopologyNumbers expected{ 1 - 1 + 1, { 1, 1, 1 } };
  EXPECT_EQ(ComputeComplexTopology(core.cells), expected);
  EXPECT_EQ(ComputeComplexTopology(triangles.parts[0].core.cells), expected);
}

TEST(MedialModel, PolygonNormalsPointTheSameWayInEveryGeometry)
{
  // A square in the plane x = 2 whose normal points to greater x, from the lesser to the greater boundary vertex.
  const auto square = [] {
    MedialComplex core = MakeCore(4, {}, { { 0, 2, 3, 1 } });
    core.positions = { { 2, 1, 1 }, { 2, 1, 3 }, { 2, 2, 1 }, { 2, 2, 3 } };
    return core;
  };
  for (const std::array<double, 9> & direction : { std::array<double, 9>{ 1, 0, 0, 0, 1, 0, 0, 0, 1 },
                                                   std::array<double, 9>{ -1, 0, 0, 0, 1, 0, 0, 0, 1 },
                                                   std::array<double, 9>{ 0, 1, 0, 1, 0, 0, 0, 0, 1 },
                                                   std::array<double, 9>{ 0, 0, 1, 1, 0, 0, 0, 1, 0 },
                                                   std::array<double, 9>{ 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, -1 } })
  {
    ImageGeometry geometry;
    geometry.spacing = { 0.5, 2, 3 };
    geometry.origin = { -10, 4, 7 };
    geometry.direction = direction;
    const ModelPart     part = ToPhysical(square(), geometry, 6);
    const CellComplex & cells = part.core.cells;
    EXPECT_EQ(part.label, 6);
    const Vector3 lesser = LatticeToPhysical(geometry, { 1, 2, 2 });
    const Vector3 greater = LatticeToPhysical(geometry, { 3, 2, 2 });
    const auto    corners = cells.FaceVertices(0);
    EXPECT_EQ(corners[0], 0U);
    Vector3 u{};
    Vector3 w{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      u[axis] = part.core.positions[corners[1]][axis] - part.core.positions[corners[0]][axis];
      w[axis] = part.core.positions[corners[2]][axis] - part.core.positions[corners[0]][axis];
    }
    const double along = (u[1] * w[2] - u[2] * w[1]) * (greater[0] - lesser[0]) +
                         (u[2] * w[0] - u[0] * w[2]) * (greater[1] - lesser[1]) +
                         (u[0] * w[1] - u[1] * w[0]) * (greater[2] - lesser[2]);
    EXPECT_GT(along, 0);
    for (std::size_t i = 0; i < 4; ++i) // each edge still joins its corner and the next
    {
      const auto edge = cells.edges[cells.FaceEdges(0)[i]];
      EXPECT_EQ(edge[0], std::min(corners[i], corners[(i + 1) % 4]));
      EXPECT_EQ(edge[1], std::max(corners[i], corners[(i + 1) % 4]));
    }
    EXPECT_EQ(part.core.positions[3], LatticeToPhysical(geometry, { 2, 2, 3 }));
  }
}
