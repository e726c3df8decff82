// Tolerances in files: one file serves every height.

#include "Models/Models/ModelFixtures.h"
#include "VoxelCoreTesting/Cores.h"

#include <gtest/gtest.h>

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkThreshold.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>

#include <set>

namespace voxelcore
{
namespace
{

using testing::TemporaryFolder;

using Place = std::array<double, 3>;
/** Places of the corners, in order. */
using Element = std::vector<Place>;

/** What is there, as places in space, whatever its numbering: with each cell its sides. */
struct Elements
{
  std::set<Element> vertices;
  std::set<Element> edges;
  std::set<Element> faces;

  void
  Add(const Element & corners)
  {
    const auto sorted = [](Element element) {
      std::sort(element.begin(), element.end());
      return element;
    };
    for (const Place & corner : corners)
    {
      vertices.insert({ corner });
    }
    for (std::size_t i = 0; i < corners.size() && corners.size() > 1; ++i)
    {
      edges.insert(sorted({ corners[i], corners[(i + 1) % corners.size()] }));
    }
    if (corners.size() > 2)
    {
      faces.insert(sorted(corners));
    }
  }
  bool
  operator==(const Elements &) const = default;
};

Elements
ElementsOf(const std::vector<ModelPart> & parts, double height)
{
  Elements elements;
  for (const ModelPart & part : parts)
  {
    const MedialComplex rest = PruneByTolerance(part.core, height);
    const auto          add = [&](std::span<const ElementIndex> corners) {
      Element element;
      for (const ElementIndex corner : corners)
      {
        element.push_back(rest.positions[corner]);
      }
      elements.Add(element);
    };
    for (ElementIndex vertex = 0; vertex < rest.cells.vertexCount; ++vertex)
    {
      add({ &vertex, 1 });
    }
    for (const auto & edge : rest.cells.edges)
    {
      add(edge);
    }
    for (std::size_t face = 0; face < rest.cells.FaceCount(); ++face)
    {
      add(rest.cells.FaceVertices(face));
    }
  }
  return elements;
}

/** As ParaView and Slicer do. */
Elements
Thresholded(vtkPolyData * data, double height)
{
  vtkNew<vtkThreshold> threshold;
  threshold->SetInputData(data);
  threshold->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Tolerance");
  threshold->SetThresholdFunction(vtkThreshold::THRESHOLD_UPPER);
  threshold->SetUpperThreshold(height);
  threshold->Update();
  vtkUnstructuredGrid * grid = threshold->GetOutput();
  Elements              elements;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    vtkNew<vtkIdList> ids;
    grid->GetCellPoints(cell, ids);
    Element element;
    for (const vtkIdType id : *ids)
    {
      Place place;
      grid->GetPoint(id, place.data());
      element.push_back(place);
    }
    elements.Add(element);
  }
  return elements;
}

template <typename Reader>
vtkSmartPointer<vtkPolyData>
ReadAllWithVtk(const std::filesystem::path & path)
{
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->ReadAllScalarsOn();
  reader->Update();
  return reader->GetOutput();
}

template <>
vtkSmartPointer<vtkPolyData>
ReadAllWithVtk<vtkXMLPolyDataReader>(const std::filesystem::path & path)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

/** Two labels side by side; what never goes has the height `end`, or with `own` a little more than all else of its
 *  label, as in certified cores. */
MedialModel
ModelWithTolerances(std::uint64_t seed, double end, bool own = false)
{
  MedialModel model;
  for (std::uint64_t i = 0; i < 2; ++i)
  {
    const auto volume = testing::RandomVolumes(seed + 1000 * i, 1).front();
    ModelPart  part{ static_cast<std::int64_t>(i + 1), testing::CoreWithTolerancesOf(volume.shape, volume.spacing) };
    for (auto & position : part.core.positions)
    {
      position[0] += 1000.0 * static_cast<double>(i);
    }
    double least = end;
    for (const double value : part.core.tolerances.vertices)
    {
      least = own && i > 0 && value < end ? std::max(least == end ? 0.0 : least, 1.01 * value) : least;
    }
    for (auto * values : { &part.core.tolerances.vertices, &part.core.tolerances.edges, &part.core.tolerances.faces })
    {
      for (double & value : *values)
      {
        value = std::min(value, least);
      }
    }
    model.parts.push_back(std::move(part));
  }
  return model;
}

TEST(ToleranceModel, AThresholdOnTheFileGivesTheResultOfEveryHeight)
{
  const TemporaryFolder folder;
  constexpr double      end = 500;
  for (std::uint64_t seed = 2000; seed < 2025; ++seed)
  {
    SCOPED_TRACE(seed);
    const MedialModel whole = ModelWithTolerances(seed, end, seed % 2 == 1);
    std::set<double>  heights{ 0, 0.3, end };
    for (const ModelPart & part : whole.parts)
    {
      for (std::size_t i = 0; i < part.core.tolerances.edges.size(); i += 1 + part.core.tolerances.edges.size() / 6)
      {
        heights.insert({ part.core.tolerances.edges[i], 1.01 * part.core.tolerances.edges[i] });
      }
    }
    heights.erase(heights.upper_bound(end), heights.end());
    // From the whole, and from a file that is pruned already.
    for (const double from : { 0.0, *std::next(heights.begin(), static_cast<std::ptrdiff_t>(heights.size() / 2)) })
    {
      MedialModel model;
      for (const ModelPart & part : whole.parts)
      {
        model.parts.push_back({ part.label, PruneByTolerance(part.core, from), part.component });
      }
      WriteModel(folder / "m.vtp", folder / "m.vtp", model);
      WriteModel(folder / "m.vtk", folder / "m.vtk", model);
      const auto xml = ReadAllWithVtk<vtkXMLPolyDataReader>(folder / "m.vtp");
      const auto legacy = ReadAllWithVtk<vtkPolyDataReader>(folder / "m.vtk");
      for (const double height : heights)
      {
        if (height >= from)
        {
          const Elements expected = ElementsOf(whole.parts, height);
          EXPECT_TRUE(Thresholded(xml, height) == expected) << "from " << from << " at " << height;
          EXPECT_TRUE(Thresholded(legacy, height) == expected) << "from " << from << " at " << height;
        }
      }
    }
  }
}

// Also without the measures of edges: heights are all there, and the measures of those that will ever stand alone.
TEST(ToleranceModel, AFileIsReadAsItWasWritten)
{
  const TemporaryFolder folder;
  for (std::uint64_t seed = 2100; seed < 2120; ++seed)
  {
    SCOPED_TRACE(seed);
    const MedialModel model = ModelWithTolerances(seed, 500);
    for (const ModelOptions options :
         { ModelOptions{ false, false }, ModelOptions{ false, true }, ModelOptions{ true, true } })
    {
      WriteModel(folder / "a.vtp", folder / "a.vtp", model, options);
      const MedialModel read = ReadModel(folder / "a.vtp");
      WriteModel(folder / "b.vtp", folder / "b.vtp", read, { false, options.keepEdges });
      EXPECT_EQ(testing::ReadAll(folder / "a.vtp"), testing::ReadAll(folder / "b.vtp"));
      for (std::size_t i = 0; i < model.parts.size(); ++i)
      {
        if (!options.triangles)
        {
          EXPECT_EQ(read.parts[i].core.tolerances.edges, model.parts[i].core.tolerances.edges);
        }
        WriteModel(folder / "c.vtp",
                   folder / "c.vtp",
                   { { { 1, PruneByTolerance(read.parts[i].core, 1.1) } }, {} },
                   { options.triangles, options.keepEdges });
        WriteModel(folder / "d.vtp",
                   folder / "d.vtp",
                   { { { 1, PruneByTolerance(model.parts[i].core, 1.1) } }, {} },
                   { options.triangles, options.keepEdges });
        EXPECT_EQ(testing::ReadAll(folder / "c.vtp"), testing::ReadAll(folder / "d.vtp"));
      }
    }
  }
}

} // namespace
} // namespace voxelcore
