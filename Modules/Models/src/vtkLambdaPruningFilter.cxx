#include "vtkLambdaPruningFilter.h"

#include "vtkFilterWork.h"
#include "voxelcore/Certificate.h"
#include "voxelcore/ComplexTopology.h"
#include "voxelcore/CoreProvenance.h"
#include "voxelcore/LambdaPruning.h"
#include "voxelcore/ModelPolyData.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>

#include <array>
#include <charconv>
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
  // The rest is the certificate's.
  constexpr double    pruningEnds = 0.9;
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
    // The shortest text that reads as the same number.
    std::array<char, 32> text;
    const std::string    lambda(text.data(), std::to_chars(text.data(), text.data() + text.size(), this->Lambda).ptr);
    const double         share = 1 / static_cast<double>(std::max<std::size_t>(model.parts.size(), 1));
    double               before = 0;
    for (voxelcore::ModelPart & part : model.parts)
    {
      const auto progress = vtkForwardProgress(this, before, before + pruningEnds * share);
      voxelcore::ReportProgress(progress, "prune", 0);
      const voxelcore::TopologyNumbers topology = voxelcore::ComputeComplexTopology(part.core.cells);
      part.core = std::move(voxelcore::PruneByLambda(part.core, { this->Lambda }, progress).front());
      voxelcore::ReportProgress(progress, "certificate", 1);
      const voxelcore::TopologyNumbers left = voxelcore::ComputeComplexTopology(part.core.cells);
      voxelcore::RequireEqualTopology(topology, left, "its core pruned", part.label);
      prunings.push_back(
        { this->Lambda > 0 ? lambda + "mm" : "0", this->Lambda, voxelcore::DescribeComplex(part.core, left) });
      before += share;
    }
    voxelcore::ReportProgress(vtkForwardProgress(this, 0, 1), "done", 1);
    model.provenance = voxelcore::PrunedProvenanceJson(model.provenance, prunings);
    return voxelcore::MakePolyData(model, true);
  });
}
