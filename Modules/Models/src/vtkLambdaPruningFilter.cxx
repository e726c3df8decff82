#include "vtkLambdaPruningFilter.h"

#include "voxelcore/Error.h"
#include "voxelcore/LambdaPruning.h"
#include "voxelcore/ModelPolyData.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <utility>

vtkStandardNewMacro(vtkLambdaPruningFilter);

void
vtkLambdaPruningFilter::PrintSelf(ostream & os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Lambda: " << this->Lambda << "\n";
}

int
vtkLambdaPruningFilter::RequestData(vtkInformation *, vtkInformationVector ** inputs, vtkInformationVector * outputs)
{
  vtkPolyData * const input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData * const output = vtkPolyData::GetData(outputs);
  try
  {
    if (!(this->Lambda >= 0))
    {
      throw voxelcore::UsageError("Lambda is negative");
    }
    voxelcore::MedialModel model = voxelcore::ModelFromPolyData(*input);
    if (!model.hasEdges)
    {
      throw voxelcore::InputError("the input lacks the measures of its edges; write it with --keep-edges");
    }
    model.provenance.clear(); // it told of another lambda
    const auto count = static_cast<double>(model.parts.size());
    double     done = 0;
    for (voxelcore::ModelPart & part : model.parts)
    {
      const auto progress = [&](std::string_view, double fraction) {
        this->UpdateProgress((done + fraction) / count);
        return this->GetAbortExecute() == 0;
      };
      part.core = std::move(voxelcore::PruneByLambda(part.core, { this->Lambda }, progress).front());
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
