#include "Models/Models/ModelFixtures.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Models/ModelPolyData.h"

#include <gtest/gtest.h>

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <iostream>

namespace voxelcore::testing
{
namespace
{

vtkSmartPointer<vtkPolyData>
Copy(vtkPolyData * data)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->DeepCopy(data);
  return copy;
}

TEST(ModelPolyData, ThereAndBackIsTheSameToTheLastBit)
{
  constexpr std::uint64_t firstSeed = 20261122;
  std::cout << "seeds from " << firstSeed << '\n';
  std::vector<MedialModel> models{ MixedModel(), MedialModel{} };
  for (std::uint64_t seed = firstSeed; seed < firstSeed + 20; ++seed)
  {
    models.push_back(RandomModel(seed, 4, 3));
  }
  for (MedialModel & model : models)
  {
    std::erase_if(model.parts, [](const ModelPart & part) { return part.core.cells.vertexCount == 0; });
    for (const auto unit : { SpatialUnit::Millimetres, SpatialUnit::Voxels })
    {
      model.unit = unit;
      const auto        data = MakePolyData(model, true);
      const MedialModel again = ModelFromPolyData(*data);
      EXPECT_TRUE(SameBits(again, model));
      EXPECT_EQ(again.unit, unit);
      EXPECT_TRUE(again.inLps);
    }
  }
}

TEST(ModelPolyData, IsWhatVtksReaderFindsInAFile)
{
  const TemporaryFolder folder;
  const MedialModel     model = MixedModel();
  for (const bool keepEdges : { false, true })
  {
    WriteModel(folder / "a.vtp", "a.vtp", model, { .triangles = false, .keepEdges = keepEdges });
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName((folder / "a.vtp").c_str());
    reader->Update();
    vtkPolyData * const read = reader->GetOutput();
    EXPECT_TRUE(SameBits(ModelFromPolyData(*read), ReadModel(folder / "a.vtp"))) << keepEdges;
    // The same arrays, no more and no less.
    const auto made = MakePolyData(model, keepEdges);
    EXPECT_EQ(read->GetNumberOfPoints(), made->GetNumberOfPoints());
    EXPECT_EQ(read->GetNumberOfCells(), made->GetNumberOfCells());
    for (const auto & [a, b] :
         std::vector<std::pair<vtkFieldData *, vtkFieldData *>>{ { read->GetPointData(), made->GetPointData() },
                                                                 { read->GetCellData(), made->GetCellData() },
                                                                 { read->GetFieldData(), made->GetFieldData() } })
    {
      ASSERT_EQ(a->GetNumberOfArrays(), b->GetNumberOfArrays()) << keepEdges;
      for (int i = 0; i < a->GetNumberOfArrays(); ++i)
      {
        EXPECT_NE(b->GetAbstractArray(a->GetAbstractArray(i)->GetName()), nullptr) << a->GetAbstractArray(i)->GetName();
      }
    }
    EXPECT_EQ(made->GetFieldData()->HasArray("EdgeLambda"), keepEdges ? 1 : 0);
  }
}

TEST(ModelPolyData, EdgesWhoseMeasuresAreNotKnownAreNotKept)
{
  const MedialModel read = ModelFromPolyData(*MakePolyData(MixedModel(), false));
  EXPECT_FALSE(read.hasEdges);
  EXPECT_THROW(MakePolyData(read, true), UsageError);
  EXPECT_TRUE(SameBits(ModelFromPolyData(*MakePolyData(read, false)), read));
}

TEST(ModelPolyData, OnlyTheSpaceMayBeMissing)
{
  const auto whole = MakePolyData(MixedModel(), true);
  for (const char * name : { "Radius", "Lambda" })
  {
    const auto data = Copy(whole);
    data->GetPointData()->RemoveArray(name);
    EXPECT_THROW(ModelFromPolyData(*data), InputError) << name;
  }
  for (const char * name : { "Label", "Lambda" })
  {
    const auto data = Copy(whole);
    data->GetCellData()->RemoveArray(name);
    EXPECT_THROW(ModelFromPolyData(*data), InputError) << name;
  }
  const auto data = Copy(whole);
  data->GetFieldData()->RemoveArray("SPACE");
  const MedialModel somewhere = ModelFromPolyData(*data);
  EXPECT_FALSE(somewhere.inLps);
  ASSERT_EQ(somewhere.parts.size(), 3U);
  EXPECT_TRUE(SameBits(somewhere.parts[0], MixedModel().parts[0]));
  vtkNew<vtkPolyData> foreign;
  EXPECT_THROW(ModelFromPolyData(*foreign), InputError) << "nothing of ours is in it";
}

} // namespace
} // namespace voxelcore::testing
