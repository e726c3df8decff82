#include "vtkLambdaPruningFilter.h"

#include "vtkFilterWork.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Certified/Certified.h"
#include "voxelcore/Complex/ComplexTopology.h"
#include "voxelcore/Models/ModelPolyData.h"
#include "voxelcore/VoxelCore/CoreProvenance.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>

#include <cmath>
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
  const auto          setError = [this](unsigned long code) { this->SetErrorCode(code); };
  return vtkFilterWork(this, setError, vtkPolyData::GetData(outputs), [&] {
    if (!(this->Lambda >= 0) || !std::isfinite(this->Lambda))
    {
      throw voxelcore::UsageError("Lambda must be a length in mm, not negative");
    }
    voxelcore::MedialModel model = voxelcore::ModelFromPolyData(*input);
    if (!model.hasEdges)
    {
      throw voxelcore::InputError("the input lacks the measures of its edges; write it with --keep-edges");
    }
    std::vector<voxelcore::CorePruning> prunings;
    const voxelcore::Lambda             wanted{ this->Lambda,
                                    voxelcore::Lambda::Unit::Millimetre,
                                    voxelcore::RoundTripText(this->Lambda) + "mm" };
    const double                        share = 1 / static_cast<double>(std::max<std::size_t>(model.parts.size(), 1));
    double                              before = 0;
    // What an image's core was compared with is in its Provenance, if it has one; pruning keeps the topology it has.
    const std::vector<voxelcore::BodyPlace> places = voxelcore::RecordedPlaces(model.provenance);
    for (std::size_t i = 0; i < model.parts.size(); ++i)
    {
      voxelcore::ModelPart &    part = model.parts[i];
      voxelcore::CertifiedShape shape;
      shape.name = "label " + std::to_string(part.label);
      if (places.size() == model.parts.size())
      {
        shape.geometry = places[i].geometry;
        shape.box = places[i].box;
      }
      shape.topology = voxelcore::ComputeComplexTopology(part.core.cells);
      voxelcore::CertifiedCore whole;
      whole.numbers.complex = voxelcore::DescribeComplex(part.core, shape.topology);
      whole.core = std::move(part);
      auto pruned = voxelcore::PruneCertified(std::move(whole),
                                              shape,
                                              { wanted },
                                              vtkForwardProgress(this, before, before + share));
      part = std::move(pruned.front().core);
      prunings.push_back({ wanted.value > 0 ? wanted.text : "0", this->Lambda, pruned.front().numbers.complex });
      before += share;
    }
    voxelcore::ReportProgress(vtkForwardProgress(this, 0, 1), "done", 1);
    model.provenance = voxelcore::PrunedProvenanceJson(model.provenance, prunings);
    return voxelcore::MakePolyData(model, true);
  });
}
