#include "Decimation.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkQuadricClustering.h>
#include <vtkQuadricDecimation.h>
#include <vtkStaticPointLocator.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace voxelcore
{

namespace
{

vtkSmartPointer<vtkPolyData>
ToVtk(const std::vector<std::array<float, 3>> & positions, const std::vector<std::array<std::uint32_t, 3>> & triangles)
{
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(static_cast<vtkIdType>(positions.size()));
  for (std::size_t point = 0; point < positions.size(); ++point)
  {
    points->SetPoint(static_cast<vtkIdType>(point), positions[point].data());
  }
  vtkNew<vtkCellArray> cells;
  for (const auto & triangle : triangles)
  {
    cells->InsertNextCell({ triangle[0], triangle[1], triangle[2] });
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

void
TakeFromVtk(vtkPolyData * data, ShownMesh & mesh)
{
  mesh.points.resize(static_cast<std::size_t>(data->GetNumberOfPoints()));
  for (vtkIdType point = 0; point < data->GetNumberOfPoints(); ++point)
  {
    double at[3];
    data->GetPoint(point, at);
    mesh.points[static_cast<std::size_t>(point)] = { static_cast<float>(at[0]),
                                                     static_cast<float>(at[1]),
                                                     static_cast<float>(at[2]) };
  }
  vtkCellArray * const cells = data->GetPolys();
  mesh.triangles.clear();
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    vtkIdType         count = 0;
    const vtkIdType * corners = nullptr;
    cells->GetCellAtId(cell, count, corners);
    if (count == 3)
    {
      mesh.triangles.push_back({ static_cast<std::uint32_t>(corners[0]),
                                 static_cast<std::uint32_t>(corners[1]),
                                 static_cast<std::uint32_t>(corners[2]) });
    }
  }
}

/** Drops points on nothing. */
void
Compact(ShownMesh & mesh)
{
  constexpr std::uint32_t    kUnused = 0xFFFFFFFFU;
  std::vector<std::uint32_t> number(mesh.points.size(), kUnused);
  ShownMesh                  small;
  const auto                 take = [&](std::uint32_t & point) {
    if (number[point] == kUnused)
    {
      number[point] = static_cast<std::uint32_t>(small.points.size());
      small.points.push_back(mesh.points[point]);
      if (!mesh.origin.empty())
      {
        small.origin.push_back(mesh.origin[point]);
      }
    }
    point = number[point];
  };
  for (auto & triangle : mesh.triangles)
  {
    std::for_each(triangle.begin(), triangle.end(), take);
  }
  for (auto & line : mesh.lines)
  {
    std::for_each(line.begin(), line.end(), take);
  }
  std::for_each(mesh.dots.begin(), mesh.dots.end(), take);
  mesh.points = std::move(small.points);
  mesh.origin = std::move(small.origin);
}

} // namespace

std::size_t
TriangleCount(const CellComplex & cells)
{
  return cells.faceVertices.size() - 2 * cells.FaceCount();
}

ShownMesh
Decimated(const LabelSurfaceMesh & mesh, std::size_t most)
{
  ShownMesh shown{ mesh.points, {}, mesh.triangles, {}, {} };
  if (mesh.triangles.size() > most)
  {
    vtkNew<vtkQuadricDecimation> decimate;
    decimate->SetInputData(ToVtk(mesh.points, mesh.triangles));
    decimate->SetTargetReduction(1 - static_cast<double>(most) / static_cast<double>(mesh.triangles.size()));
    decimate->Update();
    TakeFromVtk(decimate->GetOutput(), shown);
    Compact(shown);
  }
  return shown;
}

ShownMesh
Decimated(const MedialComplex & complex, std::size_t most)
{
  const CellComplex & cells = complex.cells;
  ShownMesh           shown;
  for (const auto & p : complex.positions)
  {
    shown.points.push_back({ static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]) });
  }
  shown.origin.resize(shown.points.size());
  std::iota(shown.origin.begin(), shown.origin.end(), 0U);
  std::vector<bool> onFace(cells.edges.size(), false);
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    const auto corners = cells.FaceVertices(face);
    for (std::size_t k = 2; k < corners.size(); ++k)
    {
      shown.triangles.push_back({ corners[0], corners[k - 1], corners[k] });
    }
    for (const ElementIndex edge : cells.FaceEdges(face))
    {
      onFace[edge] = true;
    }
  }
  const std::vector<std::array<float, 3>> original = shown.points;
  if (shown.triangles.size() > most)
  {
    const auto data = ToVtk(shown.points, shown.triangles);
    double     box[6];
    data->GetBounds(box);
    // A surface meets about n^2 of n^3 bins and leaves some two triangles in each: n from there, then by what came out.
    double                       wanted = std::sqrt(static_cast<double>(most) / 3);
    vtkNew<vtkQuadricClustering> cluster;
    for (int attempt = 0; attempt < 4; ++attempt)
    {
      const double longest = std::max({ box[1] - box[0], box[3] - box[2], box[5] - box[4], 1e-9 });
      const auto   divisions = [&](int axis) {
        return std::max(2, static_cast<int>(wanted * (box[2 * axis + 1] - box[2 * axis]) / longest));
      };
      cluster->SetInputData(data);
      cluster->AutoAdjustNumberOfDivisionsOff();
      cluster->SetNumberOfDivisions(divisions(0), divisions(1), divisions(2));
      cluster->UseInputPointsOn();
      cluster->CopyCellDataOff();
      cluster->Update();
      const auto now = static_cast<double>(cluster->GetOutput()->GetNumberOfPolys());
      if (now <= static_cast<double>(most) * 1.05)
      {
        break;
      }
      wanted *= 0.95 * std::sqrt(static_cast<double>(most) / now);
    }
    TakeFromVtk(cluster->GetOutput(), shown);
    vtkNew<vtkStaticPointLocator> locator;
    locator->SetDataSet(data);
    locator->BuildLocator();
    shown.origin.resize(shown.points.size());
    for (std::size_t point = 0; point < shown.points.size(); ++point)
    {
      const double at[3] = { shown.points[point][0], shown.points[point][1], shown.points[point][2] };
      shown.origin[point] = static_cast<std::uint32_t>(locator->FindClosestPoint(at));
    }
  }
  const auto add = [&](ElementIndex vertex) {
    shown.points.push_back(original[vertex]);
    shown.origin.push_back(vertex);
    return static_cast<std::uint32_t>(shown.points.size() - 1);
  };
  std::vector<bool> onEdge(cells.vertexCount, false);
  for (std::size_t edge = 0; edge < cells.edges.size(); ++edge)
  {
    const auto & ends = cells.edges[edge];
    onEdge[ends[0]] = onEdge[ends[1]] = true;
    if (!onFace[edge])
    {
      const std::uint32_t from = add(ends[0]);
      shown.lines.push_back({ from, add(ends[1]) });
    }
  }
  for (std::size_t vertex = 0; vertex < cells.vertexCount; ++vertex)
  {
    if (!onEdge[vertex])
    {
      shown.dots.push_back(add(static_cast<ElementIndex>(vertex)));
    }
  }
  Compact(shown);
  return shown;
}

ShownMesh
ShownCurves(const SkeletonGraph & curves)
{
  ShownMesh shown;
  for (const auto & p : curves.positions)
  {
    shown.points.push_back({ static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]) });
  }
  shown.origin.resize(shown.points.size());
  std::iota(shown.origin.begin(), shown.origin.end(), 0U);
  std::vector<bool> onSomething(shown.points.size(), false);
  for (std::size_t branch = 0; branch < curves.BranchCount(); ++branch)
  {
    const auto points = curves.Branch(branch);
    shown.lines.emplace_back(points.begin(), points.end());
    for (const ElementIndex point : points)
    {
      onSomething[point] = true;
    }
  }
  for (std::size_t face = 0; face < curves.FaceCount(); ++face)
  {
    const std::uint64_t from = curves.faceOffsets[face];
    for (std::uint64_t k = from; k < curves.faceOffsets[face + 1]; ++k)
    {
      onSomething[curves.faceVertices[k]] = true;
      if (k >= from + 2)
      {
        shown.triangles.push_back({ curves.faceVertices[from], curves.faceVertices[k - 1], curves.faceVertices[k] });
      }
    }
  }
  for (std::size_t point = 0; point < shown.points.size(); ++point)
  {
    if (!onSomething[point])
    {
      shown.dots.push_back(static_cast<std::uint32_t>(point));
    }
  }
  return shown;
}

} // namespace voxelcore
