#include "vtkVoxelCoreFilter.h"

#include "voxelcore/Error.h"
#include "voxelcore/ModelPolyData.h"
#include "voxelcore/SpacingWeights.h"
#include "voxelcore/VoxelCore.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMatrix3x3.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <cmath>
#include <map>

vtkStandardNewMacro(vtkVoxelCoreFilter);

namespace
{

voxelcore::ImageGeometry
GeometryOf(vtkImageData & image)
{
  voxelcore::ImageGeometry geometry;
  int                      extent[6];
  image.GetExtent(extent);
  double first[3];
  image.TransformIndexToPhysicalPoint(extent[0], extent[2], extent[4], first);
  for (std::size_t a = 0; a < 3; ++a)
  {
    geometry.size[a] = image.GetDimensions()[a];
    geometry.spacing[a] = image.GetSpacing()[a];
    geometry.origin[a] = first[a];
  }
  std::copy_n(image.GetDirectionMatrix()->GetData(), 9, geometry.direction.begin());
  constexpr double kSkewDegrees = 0.0057; // axes orthonormal within 1e-4, as for files
  if (voxelcore::OrthonormalityDeviationDegrees(geometry) > kSkewDegrees)
  {
    throw voxelcore::InputError("the axes of the image are not orthonormal");
  }
  return geometry;
}

/** The shape of each label asked for. */
std::map<std::int64_t, voxelcore::VoxelShape>
ShapesOf(vtkImageData & image, vtkDataArray & values, std::int64_t wanted)
{
  const int * const                             size = image.GetDimensions();
  std::map<std::int64_t, voxelcore::VoxelShape> shapes;
  vtkIdType                                     place = 0;
  for (std::int32_t k = 0; k < size[2]; ++k)
  {
    for (std::int32_t j = 0; j < size[1]; ++j)
    {
      for (std::int32_t i = 0; i < size[0]; ++i, ++place)
      {
        const double value = values.GetComponent(place, 0);
        if (value == 0)
        {
          continue;
        }
        if (!(value > 0 && value < 9e15) || std::floor(value) != value)
        {
          throw voxelcore::InputError("the image holds a value that is no label: labels are whole numbers from 0");
        }
        const auto label = static_cast<std::int64_t>(value);
        if (wanted == 0 || label == wanted)
        {
          auto & shape =
            shapes.try_emplace(label, voxelcore::VoxelBox{ { 0, 0, 0 }, { size[0], size[1], size[2] } }).first->second;
          shape.Insert(i, j, k);
        }
      }
    }
  }
  return shapes;
}

} // namespace

void
vtkVoxelCoreFilter::PrintSelf(ostream & os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Label: " << this->Label << "\n";
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
  vtkPolyData * const  output = vtkPolyData::GetData(outputs);
  vtkDataArray * const values = image != nullptr ? image->GetPointData()->GetScalars() : nullptr;
  if (values == nullptr || values->GetNumberOfComponents() != 1)
  {
    vtkErrorMacro("the input needs point scalars of one component");
    return 0;
  }
  try
  {
    const voxelcore::ImageGeometry geometry = GeometryOf(*image);
    const auto                     weights = voxelcore::ComputeSpacingWeights(geometry.spacing);
    auto                           shapes = ShapesOf(*image, *values, this->Label);
    if (shapes.empty())
    {
      throw voxelcore::InputError("the label does not occur in the image");
    }
    voxelcore::MedialModel model;
    double                 done = 0;
    for (auto & [label, shape] : shapes)
    {
      const auto progress = [&](std::string_view, double fraction) {
        this->UpdateProgress((done + fraction) / static_cast<double>(shapes.size()));
        return this->GetAbortExecute() == 0;
      };
      model.parts.push_back(voxelcore::ToPhysical(
        voxelcore::ComputeVoxelCore(voxelcore::CropToVoxels(shape), weights, voxelcore::Engine::Auto, progress),
        geometry,
        label));
      shape = voxelcore::VoxelShape();
      ++done;
    }
    output->ShallowCopy(voxelcore::MakePolyData(model, true));
  }
  catch (const voxelcore::Cancelled &)
  {
    output->Initialize();
  }
  catch (const std::exception & error)
  {
    output->Initialize();
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}
