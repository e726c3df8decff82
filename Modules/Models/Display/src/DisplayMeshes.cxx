#include "DisplayMeshes.h"

#include "voxelcore/Display/LabelSurface.h"
#include "voxelcore/Models/ColorRange.h"
#include "voxelcore/Models/ModelPolyData.h"

#include <vtkAppendPolyData.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkGlyph3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataNormals.h>
#include <vtkSphereSource.h>
#include <vtkTubeFilter.h>
#include <vtkWindowedSincPolyDataFilter.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore
{

namespace
{

/** The shape's box and a layer of background around it, 1 in and 0 out; lattice coordinates. */
vtkSmartPointer<vtkImageData>
ShapeImage(const VoxelShape & shape)
{
  const VoxelBox &     box = shape.Box();
  vtkNew<vtkImageData> image;
  image->SetDimensions(box.size[0] + 2, box.size[1] + 2, box.size[2] + 2);
  image->SetOrigin(box.lower[0] - 0.5, box.lower[1] - 0.5, box.lower[2] - 0.5); // centres of voxels
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  auto * const voxels = static_cast<unsigned char *>(image->GetScalarPointer());
  std::fill_n(voxels, image->GetNumberOfPoints(), static_cast<unsigned char>(0));
  const std::size_t rowSize = static_cast<std::size_t>(box.size[0]) + 2;
  const std::size_t sliceSize = rowSize * (static_cast<std::size_t>(box.size[1]) + 2);
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const auto      row = shape.Row(y, z);
      unsigned char * to =
        voxels + (static_cast<std::size_t>(z) + 1) * sliceSize + (static_cast<std::size_t>(y) + 1) * rowSize + 1;
      for (std::size_t x = 0; x < static_cast<std::size_t>(box.size[0]); ++x)
      {
        to[x] = (row[x >> 6] >> (x & 63U)) & 1U;
      }
    }
  }
  return image;
}

void
AddShown(vtkPolyData * data, const std::vector<double> & values)
{
  vtkNew<vtkFloatArray> shown;
  shown->SetName(kShownArray);
  shown->SetNumberOfTuples(data->GetNumberOfPoints());
  for (vtkIdType point = 0; point < data->GetNumberOfPoints(); ++point)
  {
    const double value = values.empty() ? std::nan("") : values[static_cast<std::size_t>(point)];
    shown->SetValue(point, std::isfinite(value) ? static_cast<float>(value) : std::numeric_limits<float>::quiet_NaN());
  }
  data->GetPointData()->AddArray(shown);
  data->GetPointData()->SetActiveScalars(kShownArray);
}

} // namespace

LabelSurfaceMesh
LabelSurface(const VoxelShape & shape, const ImageGeometry & geometry)
{
  LabelSurfaceMesh mesh;
  if (shape.Box().size[0] == 0)
  {
    return mesh;
  }
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(ShapeImage(shape));
  contour->SetValue(0, 0.5);
  contour->ComputeNormalsOff();
  contour->ComputeScalarsOff();
  contour->Update();
  // Steps go with half a voxel at most; a part one voxel thick, which the filter would shrink to nothing, keeps a core.
  constexpr double kReach = 0.3;
  // Taubin's low-pass filter in lattice coordinates, where a voxel is a voxel along each axis: it does not shrink.
  vtkNew<vtkWindowedSincPolyDataFilter> smooth;
  smooth->SetInputConnection(contour->GetOutputPort());
  smooth->SetNumberOfIterations(20);
  smooth->SetPassBand(0.06);
  smooth->BoundarySmoothingOff();
  smooth->NonManifoldSmoothingOn();
  smooth->NormalizeCoordinatesOn();
  smooth->Update();
  vtkPolyData * const smoothed = smooth->GetOutput();
  vtkPolyData * const stepped = contour->GetOutput();
  mesh.points.reserve(static_cast<std::size_t>(smoothed->GetNumberOfPoints()));
  for (vtkIdType point = 0; point < smoothed->GetNumberOfPoints(); ++point)
  {
    Vector3 lattice{};
    smoothed->GetPoint(point, lattice.data());
    Vector3 before{};
    stepped->GetPoint(point, before.data());
    for (std::size_t k = 0; k < 3; ++k)
    {
      lattice[k] = std::clamp(lattice[k], before[k] - kReach, before[k] + kReach);
    }
    const Vector3 physical = LatticeToPhysical(geometry, lattice);
    mesh.points.push_back(
      { static_cast<float>(physical[0]), static_cast<float>(physical[1]), static_cast<float>(physical[2]) });
  }
  const bool   mirrored = IsLeftHanded(geometry);
  auto * const cells = smoothed->GetPolys();
  mesh.triangles.reserve(static_cast<std::size_t>(cells->GetNumberOfCells()));
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    vtkIdType         count = 0;
    const vtkIdType * corners = nullptr;
    cells->GetCellAtId(cell, count, corners);
    std::array<std::uint32_t, 3> triangle{ static_cast<std::uint32_t>(corners[0]),
                                           static_cast<std::uint32_t>(corners[1]),
                                           static_cast<std::uint32_t>(corners[2]) };
    if (mirrored)
    {
      std::swap(triangle[1], triangle[2]);
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

vtkSmartPointer<vtkPolyData>
SurfacePolyData(const LabelSurfaceMesh & mesh)
{
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.points.size()));
  for (std::size_t point = 0; point < mesh.points.size(); ++point)
  {
    points->SetPoint(static_cast<vtkIdType>(point), mesh.points[point].data());
  }
  vtkNew<vtkCellArray> cells;
  for (const auto & triangle : mesh.triangles)
  {
    cells->InsertNextCell({ triangle[0], triangle[1], triangle[2] });
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(data);
  normals->SplittingOff();
  normals->ConsistencyOff();
  normals->Update();
  return normals->GetOutput();
}

vtkSmartPointer<vtkPolyData>
MedialPolyData(const DisplayLabel & label, PictureColoring coloring)
{
  MedialModel model;
  model.parts = { label.medial };
  model.parts.front().core.tolerances = {}; // with them edges of faces would be lines, too, for thresholds
  model.parts.front().displacement.clear();
  const vtkSmartPointer<vtkPolyData> data = MakePolyData(model, false);
  AddShown(data, MedialValues(label, coloring));
  constexpr double           kSharpDegrees = 50;
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(data);
  normals->SetFeatureAngle(kSharpDegrees);
  normals->SplittingOn();
  normals->ConsistencyOn();
  normals->NonManifoldTraversalOff();
  normals->Update();
  return normals->GetOutput();
}

vtkSmartPointer<vtkPolyData>
CurvePolyData(const DisplayLabel & label, PictureColoring coloring, double scale, double least)
{
  const SkeletonGraph & graph = label.curves;
  vtkNew<vtkPoints>     points;
  vtkNew<vtkFloatArray> thickness;
  thickness->SetName("Tube");
  for (std::size_t point = 0; point < graph.positions.size(); ++point)
  {
    points->InsertNextPoint(graph.positions[point].data());
    thickness->InsertNextValue(static_cast<float>(std::max(least, scale * SectionRadii(graph)[point])));
  }
  vtkNew<vtkPolyData> all;
  all->SetPoints(points);
  AddShown(all, CurveValues(label, coloring));
  all->GetPointData()->AddArray(thickness);

  vtkNew<vtkCellArray> lines;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    lines->InsertNextCell(static_cast<int>(graph.Branch(branch).size()));
    for (const ElementIndex point : graph.Branch(branch))
    {
      lines->InsertCellPoint(point);
    }
  }
  vtkNew<vtkPolyData> curves;
  curves->ShallowCopy(all);
  curves->SetLines(lines);
  curves->GetPointData()->SetActiveScalars("Tube");
  vtkNew<vtkTubeFilter> tubes;
  tubes->SetInputData(curves);
  tubes->SetVaryRadiusToVaryRadiusByAbsoluteScalar();
  tubes->SetNumberOfSides(16);
  tubes->CappingOn();

  // Balls where branches meet or end close the gaps between tubes.
  vtkNew<vtkPoints>     nodePoints;
  vtkNew<vtkFloatArray> nodeShown;
  vtkNew<vtkFloatArray> nodeThickness;
  nodeShown->SetName(kShownArray);
  nodeThickness->SetName("Tube");
  auto * const shown = vtkFloatArray::SafeDownCast(all->GetPointData()->GetArray(kShownArray));
  for (const ElementIndex point : graph.nodePoints)
  {
    nodePoints->InsertNextPoint(graph.positions[point].data());
    nodeShown->InsertNextValue(shown->GetValue(point));
    nodeThickness->InsertNextValue(thickness->GetValue(point));
  }
  vtkNew<vtkPolyData> nodes;
  nodes->SetPoints(nodePoints);
  nodes->GetPointData()->AddArray(nodeShown);
  nodes->GetPointData()->AddArray(nodeThickness);
  nodes->GetPointData()->SetActiveScalars("Tube");
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(1);
  ball->SetThetaResolution(16);
  ball->SetPhiResolution(12);
  vtkNew<vtkGlyph3D> balls;
  balls->SetInputData(nodes);
  balls->SetSourceConnection(ball->GetOutputPort());
  balls->SetScaleModeToScaleByScalar();
  balls->SetColorModeToColorByScalar();
  balls->SetScaleFactor(1);

  vtkNew<vtkCellArray> faces;
  for (std::size_t face = 0; face < graph.FaceCount(); ++face)
  {
    faces->InsertNextCell(static_cast<int>(graph.faceOffsets[face + 1] - graph.faceOffsets[face]));
    for (std::uint64_t corner = graph.faceOffsets[face]; corner < graph.faceOffsets[face + 1]; ++corner)
    {
      faces->InsertCellPoint(graph.faceVertices[corner]);
    }
  }
  vtkNew<vtkPolyData> plates;
  plates->ShallowCopy(all);
  plates->SetPolys(faces);
  vtkNew<vtkPolyDataNormals> plateNormals;
  plateNormals->SetInputData(plates);

  vtkNew<vtkAppendPolyData> together;
  if (graph.BranchCount() > 0)
  {
    together->AddInputConnection(tubes->GetOutputPort());
  }
  if (!graph.nodePoints.empty())
  {
    together->AddInputConnection(balls->GetOutputPort());
  }
  if (graph.FaceCount() > 0)
  {
    together->AddInputConnection(plateNormals->GetOutputPort());
  }
  together->Update();
  together->GetOutput()->GetPointData()->SetActiveScalars(kShownArray);
  return together->GetOutput();
}

} // namespace voxelcore
