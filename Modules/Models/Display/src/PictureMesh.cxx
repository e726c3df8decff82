#include "PictureMesh.h"

#include "DisplayMeshes.h"

#include <vtkActor.h>
#include <vtkCellData.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

namespace voxelcore
{
namespace
{

// Loose edges and vertices of a medial surface, in pixels of the picture: they are many, and would hide its faces.
constexpr float kLineWidth = 1.25F;
constexpr float kPointSize = 2.0F;

vtkSmartPointer<vtkActor>
MakeActor(vtkPolyData * mesh, const Color & color, vtkLookupTable * scale)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  mapper->SetScalarVisibility(scale != nullptr);
  if (scale != nullptr)
  {
    mapper->SelectColorArray(kShownArray);
    mapper->SetScalarModeToUsePointFieldData();
    mapper->SetLookupTable(scale);
    mapper->UseLookupTableScalarRangeOn();
    mapper->InterpolateScalarsBeforeMappingOn();
  }
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(color[0], color[1], color[2]);
  return actor;
}

} // namespace

void
AddMesh(vtkRenderer *    renderer,
        vtkPolyData *    mesh,
        const Color &    color,
        vtkLookupTable * scale,
        double           opacity,
        int              pixel)
{
  if (mesh == nullptr || opacity <= 0)
  {
    return;
  }
  if (mesh->GetNumberOfPolys() > 0)
  {
    vtkNew<vtkPolyData> polygons;
    polygons->ShallowCopy(mesh);
    polygons->SetVerts(nullptr);
    polygons->SetLines(nullptr);
    polygons->GetCellData()->Initialize(); // it was of all cells
    const auto          actor = MakeActor(polygons, color, scale);
    vtkProperty * const look = actor->GetProperty();
    look->SetOpacity(opacity);
    // Where colours mean lengths, shades must not make them darker ones.
    look->SetAmbient(scale != nullptr ? 0.45 : 0.3);
    look->SetDiffuse(scale != nullptr ? 0.62 : 0.75);
    look->SetSpecular(opacity < 0.3 ? 0.0 : 0.08);
    look->SetSpecularPower(20);
    renderer->AddActor(actor);
  }
  if (mesh->GetNumberOfLines() + mesh->GetNumberOfVerts() > 0)
  {
    // They have no normals: lit, they would be black.
    vtkNew<vtkPolyData> threads;
    threads->ShallowCopy(mesh);
    threads->SetPolys(nullptr);
    threads->GetCellData()->Initialize();
    threads->GetPointData()->SetNormals(nullptr);
    const auto          actor = MakeActor(threads, color, scale);
    vtkProperty * const look = actor->GetProperty();
    look->SetOpacity(opacity);
    look->LightingOff();
    look->SetLineWidth(kLineWidth * static_cast<float>(pixel));
    look->SetPointSize(kPointSize * static_cast<float>(pixel));
    renderer->AddActor(actor);
  }
}

} // namespace voxelcore
