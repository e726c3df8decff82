// Medial surfaces and skeletons that VTK read and saved again, in every form in which it writes: the same model comes
// back, or what lost digits is said.

#include "Models/Models/ModelFixtures.h"
#include "Models/Models/VtkMeshForms.h"
#include "VoxelCoreTesting/Messages.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Models/MedialModel.h"
#include "voxelcore/Models/SkeletonModel.h"

#include <gtest/gtest.h>

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkXMLPolyDataReader.h>

#include <random>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

/** What VTK reads in a file. */
vtkSmartPointer<vtkPolyData>
ReadByVtk(const std::filesystem::path & path)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  if (path.extension() == ".vtk")
  {
    vtkNew<vtkPolyDataReader> reader;
    reader->SetFileName(path.c_str());
    reader->ReadAllFieldsOn();
    reader->ReadAllScalarsOn();
    reader->ReadAllVectorsOn();
    reader->Update();
    data->ShallowCopy(reader->GetOutput());
    return data;
  }
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  data->ShallowCopy(reader->GetOutput());
  return data;
}

template <typename Array>
void
AddTo(vtkFieldData * fields, const char * name, int components, vtkIdType tuples)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  array->Fill(0.1);
  fields->AddArray(array);
}

/** What programs add: normals, colours, an active array, a field of their own. */
void
AddOthersArrays(vtkPolyData & data)
{
  AddTo<vtkFloatArray>(data.GetPointData(), "Normals", 3, data.GetNumberOfPoints());
  data.GetPointData()->SetActiveNormals("Normals");
  data.GetPointData()->SetActiveScalars("Radius");
  AddTo<vtkIntArray>(data.GetCellData(), "vtkOriginalCellIds", 1, data.GetNumberOfCells());
  AddTo<vtkDoubleArray>(data.GetFieldData(), "TimeValue", 1, 1);
}

/** The points, or every array of real numbers, in single precision. */
void
MakeSingle(vtkPolyData & data, bool arraysToo)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  points->DeepCopy(data.GetPoints());
  data.SetPoints(points);
  const std::array<vtkFieldData *, 3> all{ data.GetPointData(), data.GetCellData(), data.GetFieldData() };
  for (vtkFieldData * fields : all)
  {
    for (int i = 0; arraysToo && i < fields->GetNumberOfArrays(); ++i)
    {
      auto * const doubles = vtkDoubleArray::SafeDownCast(fields->GetAbstractArray(i));
      if (doubles != nullptr)
      {
        vtkNew<vtkFloatArray> floats;
        floats->DeepCopy(doubles);
        floats->SetName(doubles->GetName());
        fields->AddArray(floats); // in place of the one of that name
      }
    }
  }
}

/** Models with tolerances, edges, displacements, components. */
std::vector<MedialModel>
Models(std::uint64_t seed)
{
  std::vector<MedialModel> models{ MixedModel(), RandomModel(seed, 4, 3), RandomModel(seed + 1, 3, 1) };
  models[0].provenance = "{\"a\": \"line\\nand %20 \\\"quotes\\\"\"}";
  for (MedialModel & model : models)
  {
    model.provenance = model.provenance.empty() ? "{}" : model.provenance;
  }
  for (ModelPart & part : models[1].parts)
  {
    part.displacement.assign(part.core.cells.vertexCount, { 0.1, 1.0 / 3, -1.0 / 7 });
    part.thickness.assign(part.core.cells.vertexCount, 1.0 / 11);
  }
  models[1].refined = "labels";
  for (ModelPart & part : models[2].parts)
  {
    MedialComplex & core = part.core;
    core.tolerances = { std::vector<double>(core.cells.vertexCount, 0.3),
                        std::vector<double>(core.cells.edges.size(), 0.3),
                        std::vector<double>(core.cells.FaceCount(), 0.3) };
    for (std::size_t i = 0; i < core.tolerances.edges.size(); i += 5)
    {
      core.tolerances.edges[i] = 0.3 + 1e-12 * static_cast<double>(1 + i); // lost in single precision
    }
    for (std::size_t edge = 0; edge < core.tolerances.edges.size(); ++edge)
    {
      for (const ElementIndex end : core.cells.edges[edge])
      {
        core.tolerances.vertices[end] = std::max(core.tolerances.vertices[end], core.tolerances.edges[edge]);
      }
    }
  }
  return models;
}

std::map<std::string, std::string>
AllForms(vtkPolyData & data)
{
  auto forms = XmlFormsOf(data);
  forms.merge(LegacyFormsOf(data));
  return forms;
}

TEST(SavedAgain, AMedialSurfaceKeepsEveryBitInAllFormsButText)
{
  const unsigned seed = std::random_device()();
  RecordProperty("seed", std::to_string(seed));
  std::cout << "seed " << seed << "\n";
  const TemporaryFolder folder;
  for (const MedialModel & model : Models(seed))
  {
    for (const std::string written : { "a.vtp", "a.vtk" })
    {
      WriteModel(folder / written, written, model, { .triangles = false, .keepEdges = true });
      EXPECT_TRUE(SameBits(ReadModel(folder / written), model)) << written;
      const auto data = ReadByVtk(folder / written);
      AddOthersArrays(*data);
      for (const auto & [name, bytes] : AllForms(*data))
      {
        WriteAll(folder / name, bytes);
        MedialModel read;
        ASSERT_NO_THROW(read = ReadModel(folder / name, Precision::AsSaved)) << written << " as " << name;
        if (name.starts_with("text-")) // eleven digits
        {
          EXPECT_NE(read.rounded.find("text of few digits"), std::string::npos) << read.rounded;
          EXPECT_THROW(ReadModel(folder / name), InputError);
          EXPECT_EQ(read.parts.size(), model.parts.size());
          EXPECT_EQ(read.provenance, model.provenance);
          continue;
        }
        EXPECT_EQ(read.rounded, "") << name;
        EXPECT_TRUE(SameBits(read, model)) << written << " as " << name;
        EXPECT_EQ(read.provenance, model.provenance) << name;
      }
    }
  }
}

TEST(SavedAgain, SinglePrecisionIsReadAndSaid)
{
  const unsigned seed = std::random_device()();
  RecordProperty("seed", std::to_string(seed));
  std::cout << "seed " << seed << "\n";
  const TemporaryFolder folder;
  for (const MedialModel & model : Models(seed))
  {
    WriteModel(folder / "a.vtp", "a.vtp", model, { .triangles = false, .keepEdges = true });
    for (const bool arraysToo : { false, true })
    {
      const auto data = ReadByVtk(folder / "a.vtp");
      MakeSingle(*data, arraysToo);
      for (const auto & [name, bytes] : AllForms(*data))
      {
        WriteAll(folder / name, bytes);
        MedialModel read;
        ASSERT_NO_THROW(read = ReadModel(folder / name, Precision::AsSaved)) << name;
        EXPECT_NE(read.rounded.find("points"), std::string::npos) << read.rounded;
        EXPECT_EQ(read.rounded.find("Lambda") != std::string::npos, arraysToo || name.starts_with("text-"));
        const std::string message = MessageOf<InputError>([&, path = folder / name] { ReadModel(path); });
        EXPECT_NE(message.find("every digit is needed"), std::string::npos) << message;
        ASSERT_EQ(read.parts.size(), model.parts.size());
        for (std::size_t i = 0; i < read.parts.size(); ++i)
        {
          const MedialComplex & core = read.parts[i].core;
          const MedialComplex & exact = model.parts[i].core;
          ASSERT_EQ(core.positions.size(), exact.positions.size());
          EXPECT_EQ(core.cells.faceVertices, exact.cells.faceVertices);
          EXPECT_EQ(core.cells.edges, exact.cells.edges) << name;
          for (std::size_t v = 0; v < core.positions.size(); ++v)
          {
            for (std::size_t k = 0; k < 3; ++k)
            {
              EXPECT_NEAR(core.positions[v][k], exact.positions[v][k], 1e-5 * (1 + std::abs(exact.positions[v][k])));
            }
          }
        }
      }
    }
  }
}

TEST(SavedAgain, WhatIsLostIsNamed)
{
  const TemporaryFolder folder;
  WriteModel(folder / "a.vtp", "a.vtp", MixedModel(), {});
  for (const std::string lost : { "Radius", "Lambda", "Label", "Units", "SPACE" })
  {
    for (const auto & form : { std::string("base64-32.vtp"), std::string("binary-42.vtk") })
    {
      const auto data = ReadByVtk(folder / "a.vtp");
      data->GetPointData()->RemoveArray(lost.c_str());
      data->GetCellData()->RemoveArray(lost.c_str());
      data->GetFieldData()->RemoveArray(lost.c_str());
      WriteAll(folder / form, AllForms(*data).at(form));
      const std::string message = MessageOf<InputError>([&, path = folder / form] { ReadModel(path); });
      EXPECT_NE(message.find(lost), std::string::npos) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos);
    }
  }
}

TEST(SavedAgain, PointsThatSlicerSavedInRasAreRefused)
{
  const TemporaryFolder folder;
  WriteModel(folder / "a.vtk", "a.vtk", MixedModel(), {});
  std::string bytes = ReadAll(folder / "a.vtk");
  bytes.replace(bytes.find("SPACE=LPS"), 9, "SPACE=RAS");
  WriteAll(folder / "a.vtk", bytes);
  const std::string message = MessageOf<InputError>([&, path = folder / "a.vtk"] { ReadModel(path); });
  EXPECT_NE(message.find("in RAS; save it in LPS"), std::string::npos) << message;
}

SkeletonModel
RandomSkeleton(std::uint64_t seed)
{
  std::mt19937_64                        random(seed);
  std::uniform_real_distribution<double> real(0.1, 9);
  SkeletonModel                          model;
  model.provenance = "{}";
  for (std::int64_t label = 1; label <= 3; ++label)
  {
    SkeletonPart part;
    part.label = 10 * label;
    for (int i = 0; i < 12; ++i)
    {
      part.graph.positions.push_back({ real(random), -real(random), real(random) });
      part.graph.radius.push_back(real(random));
      part.graph.erosionThickness.push_back(i == 5 ? std::numeric_limits<double>::infinity() : real(random));
    }
    SortBranches(part.graph, { { 0, 1, 2, 3 }, { 3, 4, 5 }, { 3, 6, 7, 8, 9, 3 } }, true);
    part.table = MeasureBranches(part.graph);
    model.parts.push_back(part);
  }
  return model;
}

TEST(SavedAgain, ASkeletonIsTheSameInAllForms)
{
  const unsigned seed = std::random_device()();
  RecordProperty("seed", std::to_string(seed));
  std::cout << "seed " << seed << "\n";
  const TemporaryFolder folder;
  WriteSkeletonVtp(folder / "a.vtp", RandomSkeleton(seed));
  const SkeletonModel model = ReadSkeletonVtp(folder / "a.vtp");
  const auto          data = ReadByVtk(folder / "a.vtp");
  AddOthersArrays(*data);
  for (const auto & [name, bytes] : AllForms(*data))
  {
    WriteAll(folder / name, bytes);
    SkeletonModel read;
    ASSERT_NO_THROW(read = ReadSkeletonVtp(folder / name)) << name;
    EXPECT_EQ(read.rounded.empty(), !name.starts_with("text-")) << name;
    ASSERT_EQ(read.parts.size(), model.parts.size());
    for (std::size_t p = 0; p < read.parts.size(); ++p)
    {
      const SkeletonGraph & a = read.parts[p].graph;
      const SkeletonGraph & b = model.parts[p].graph;
      EXPECT_EQ(a.branchPoints, b.branchPoints) << name;
      EXPECT_EQ(a.nodeKinds, b.nodeKinds) << name;
      if (!name.starts_with("text-"))
      {
        EXPECT_EQ(a.positions, b.positions) << name;
        EXPECT_EQ(a.radius, b.radius) << name;
        EXPECT_EQ(a.erosionThickness, b.erosionThickness) << name;
        EXPECT_EQ(a.sectionRadius, b.sectionRadius) << name;
      }
    }
  }
}

/** Bits flipped, bytes lost or repeated: refused in one line, or read as a model. */
TEST(SavedAgain, DamagedFilesAreRefusedInOneLineOrRead)
{
  const unsigned seed = std::random_device()();
  RecordProperty("seed", std::to_string(seed));
  std::cout << "seed " << seed << "\n";
  std::mt19937_64       random(seed);
  const TemporaryFolder folder;
  WriteModel(folder / "a.vtp", "a.vtp", MixedModel(), { .triangles = false, .keepEdges = true });
  const auto forms = AllForms(*ReadByVtk(folder / "a.vtp"));
  int        refused = 0;
  int        runs = 0;
  for (int turn = 0; turn < 12; ++turn)
  {
    for (const auto & [name, whole] : forms)
    {
      std::string bytes = whole;
      for (std::uint64_t i = 1 + random() % 3; i > 0; --i)
      {
        const std::size_t place = random() % bytes.size();
        switch (random() % 3)
        {
          case 0:
            bytes[place] = static_cast<char>(bytes[place] ^ (1 << random() % 8));
            break;
          case 1:
            bytes.erase(place, 1 + random() % 20);
            break;
          default:
            bytes.insert(place, bytes.substr(random() % bytes.size(), 1 + random() % 20));
        }
      }
      const auto path = folder / ("bad" + std::filesystem::path(name).extension().string());
      WriteAll(path, bytes);
      ++runs;
      try
      {
        ReadModel(path, Precision::AsSaved);
      }
      catch (const InputError & error)
      {
        ++refused;
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      }
    }
  }
  EXPECT_GT(refused, runs / 4);
  EXPECT_LT(refused, runs);
}

} // namespace
