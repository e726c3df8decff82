#include "vtkVoxelCoreFilter.h"

#include "vtkFilterWork.h"
#include "voxelcore/Base/SpatialUnit.h"
#include "voxelcore/Certified/Certified.h"
#include "voxelcore/Labels/LabelAssembler.h"
#include "voxelcore/Lattice/CheckedGeometry.h"
#include "voxelcore/Masks/ShapeEdits.h"
#include "voxelcore/Models/ModelPolyData.h"
#include "voxelcore/VoxelCore/CoreProvenance.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMatrix3x3.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkVoxelCoreFilter);

vtkVoxelCoreFilter::vtkVoxelCoreFilter() = default;
vtkVoxelCoreFilter::~vtkVoxelCoreFilter() = default;

namespace
{

/** What the image's field data say of its lengths. */
voxelcore::SpatialUnit
UnitOf(vtkImageData & image)
{
  auto * const words = vtkStringArray::SafeDownCast(image.GetFieldData()->GetAbstractArray("Units"));
  if (words == nullptr || words->GetNumberOfValues() < 1)
  {
    return voxelcore::SpatialUnit::Millimetres;
  }
  const auto unit = voxelcore::UnitNamed(words->GetValue(0));
  if (!unit)
  {
    throw voxelcore::InputError("the image's field Units must say mm or voxel, not '" + words->GetValue(0) + "'");
  }
  return *unit;
}

/** Where the image lies, moved by `matrix` where there is one. */
voxelcore::ImageGeometry
GeometryOf(vtkImageData & image, vtkMatrix4x4 * matrix, bool inVoxels)
{
  voxelcore::ImageGeometry geometry;
  geometry.unit = inVoxels ? voxelcore::SpatialUnit::Voxels : UnitOf(image);
  int extent[6];
  image.GetExtent(extent);
  double first[4] = { 0, 0, 0, 1 };
  image.TransformIndexToPhysicalPoint(extent[0], extent[2], extent[4], first);
  for (std::size_t a = 0; a < 3; ++a)
  {
    geometry.size[a] = image.GetDimensions()[a];
    geometry.spacing[a] = image.GetSpacing()[a];
  }
  std::copy_n(image.GetDirectionMatrix()->GetData(), 9, geometry.direction.begin());
  if (matrix != nullptr)
  {
    if (matrix->GetElement(3, 0) != 0 || matrix->GetElement(3, 1) != 0 || matrix->GetElement(3, 2) != 0 ||
        matrix->GetElement(3, 3) != 1)
    {
      throw voxelcore::InputError("the last row of the matrix must be 0 0 0 1");
    }
    matrix->MultiplyPoint(first, first);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      double way[4] = { 0, 0, 0, 0 };
      for (std::size_t row = 0; row < 3; ++row)
      {
        way[row] = geometry.direction[3 * row + axis];
      }
      matrix->MultiplyPoint(way, way);
      // The matrix may hold lengths, too: NIfTI's sform does.
      const double length = std::hypot(way[0], way[1], way[2]);
      geometry.spacing[axis] *= length;
      for (std::size_t row = 0; row < 3; ++row)
      {
        geometry.direction[3 * row + axis] = way[row] / length;
      }
    }
  }
  std::copy_n(first, 3, geometry.origin.begin());
  return voxelcore::CheckedGeometry("the image", geometry, false);
}

/** The shapes of the labels in an image's values, which lie along i, then j, then k. */
std::vector<voxelcore::LabelShape>
ShapesOf(vtkDataArray & values, const voxelcore::ImageGeometry & geometry, std::int64_t wanted)
{
  voxelcore::LabelAssembler::Pixel pixel{};
  switch (values.GetDataType())
  {
    vtkTemplateMacro(pixel = voxelcore::LabelAssembler::Pixel::Of<VTK_TT>());
    default:
      throw voxelcore::InputError("the image's values are no numbers");
  }
  voxelcore::LabelChoice choice;
  choice.labels = wanted == 0 ? "all" : std::to_string(wanted);
  voxelcore::LabelAssembler assembler("the image", geometry, pixel, choice);
  assembler.AddRows(values.GetVoidPointer(0), 0, static_cast<std::size_t>(geometry.size[1] * geometry.size[2]));
  return assembler.TakeShapes();
}

} // namespace

void
vtkVoxelCoreFilter::PrintSelf(ostream & os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Label: " << this->Label << "\n";
  os << indent << "Connectivity: " << this->Connectivity << "\n";
  os << indent << "WholeCore: " << (this->WholeCore ? "On" : "Off") << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "Refine: " << (this->Refine ? "On" : "Off") << "\n";
  os << indent << "ImageIsInLPS: " << (this->ImageIsInLPS ? "On" : "Off") << "\n";
  os << indent << "LengthsInVoxels: " << (this->LengthsInVoxels ? "On" : "Off") << "\n";
  os << indent << "ImageToLPSMatrix:" << (this->ImageToLPS ? "\n" : " (none)\n");
  if (this->ImageToLPS)
  {
    this->ImageToLPS->PrintSelf(os, indent.GetNextIndent());
  }
}

vtkMatrix4x4 *
vtkVoxelCoreFilter::GetImageToLPSMatrix()
{
  return this->ImageToLPS;
}

void
vtkVoxelCoreFilter::SetImageToLPSMatrix(vtkMatrix4x4 * matrix)
{
  vtkSmartPointer<vtkMatrix4x4> copy;
  if (matrix != nullptr)
  {
    copy = vtkSmartPointer<vtkMatrix4x4>::New();
    copy->DeepCopy(matrix);
  }
  const bool same = copy && this->ImageToLPS
                      ? std::equal(copy->GetData(), copy->GetData() + 16, this->ImageToLPS->GetData())
                      : !copy && !this->ImageToLPS;
  if (!same)
  {
    this->ImageToLPS = copy;
    this->Modified();
  }
}

void
vtkVoxelCoreFilter::SetImageToRASMatrix(vtkMatrix4x4 * matrix)
{
  if (matrix == nullptr)
  {
    this->SetImageToLPSMatrix(nullptr);
    return;
  }
  vtkNew<vtkMatrix4x4> turned;
  turned->DeepCopy(matrix);
  for (int column = 0; column < 4; ++column)
  {
    turned->SetElement(0, column, -matrix->GetElement(0, column));
    turned->SetElement(1, column, -matrix->GetElement(1, column));
  }
  this->SetImageToLPSMatrix(turned);
}

int
vtkVoxelCoreFilter::FillInputPortInformation(int, vtkInformation * information)
{
  information->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int
vtkVoxelCoreFilter::RequestUpdateExtent(vtkInformation *, vtkInformationVector ** inputs, vtkInformationVector *)
{
  vtkInformation * const input = inputs[0]->GetInformationObject(0); // a core needs all of the image
  input->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(),
             input->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()),
             6);
  return 1;
}

int
vtkVoxelCoreFilter::RequestData(vtkInformation *, vtkInformationVector ** inputs, vtkInformationVector * outputs)
{
  vtkImageData * const image = vtkImageData::GetData(inputs[0]);
  const auto           setError = [this](unsigned long code) { this->SetErrorCode(code); };
  return vtkFilterWork(this, setError, vtkPolyData::GetData(outputs), [&] {
    vtkDataArray * const values = image->GetPointData()->GetScalars();
    if (values == nullptr || values->GetNumberOfComponents() != 1 ||
        values->GetNumberOfTuples() != image->GetNumberOfPoints())
    {
      throw voxelcore::InputError("the input needs point scalars of one component");
    }
    const voxelcore::ImageGeometry geometry = GeometryOf(*image, this->ImageToLPS, this->LengthsInVoxels);
    auto                           shapes = ShapesOf(*values, geometry, this->Label);
    for (const std::string & warning :
         voxelcore::ConnectLabels(shapes, geometry, voxelcore::RequireConnectivity(this->Connectivity), "the image"))
    {
      vtkWarningMacro(<< warning);
    }
    voxelcore::MedialModel model;
    model.unit = geometry.unit;
    model.inLps = this->ImageToLPS || this->ImageIsInLPS || !image->GetDirectionMatrix()->IsIdentity();
    std::vector<voxelcore::CoreOrigin>  origins;
    std::vector<voxelcore::CorePruning> prunings;
    const double                        share = 1 / static_cast<double>(shapes.size());
    double                              before = 0;
    for (voxelcore::LabelShape & label : shapes)
    {
      voxelcore::CertifiedRequest request;
      request.name = voxelcore::LabelText(label.value, label.name);
      request.lambdas = { voxelcore::Lambda() };
      if (!this->WholeCore)
      {
        request.tolerances = { voxelcore::ParseTolerance(this->Tolerance) };
      }
      if (!this->Refine)
      {
        request.surface = voxelcore::SurfaceSource();
      }
      voxelcore::CertifiedResult result = voxelcore::ComputeCertified(std::move(label.shape),
                                                                      geometry,
                                                                      request,
                                                                      vtkForwardProgress(this, before, before + share));
      model.parts.push_back(std::move(result.cores.front().core));
      model.parts.back().label = label.value;
      origins.push_back(voxelcore::OriginOf(result, label.value, label.name, label.voxels));
      origins.back().connectivity = label.connectivity;
      prunings.push_back(voxelcore::PruningOf(result.cores.front().numbers));
      model.refined = prunings.back().refined;
      before += share;
    }
    voxelcore::ReportProgress(vtkForwardProgress(this, 0, 1), "done", 1);
    model.provenance = voxelcore::CoreProvenanceJson(geometry, origins, prunings, true);
    return voxelcore::MakePolyData(model, true);
  });
}
