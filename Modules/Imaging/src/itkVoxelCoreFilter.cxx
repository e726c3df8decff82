#include "itkVoxelCoreFilter.h"

#include "itkErrors.h"
#include "itkMultiThreaderBase.h"
#include "voxelcore/Certificate.h"
#include "voxelcore/ComplexTopology.h"
#include "voxelcore/ShapeTopology.h"
#include "voxelcore/VoxelCore.h"

#include <omp.h>

namespace itk
{
namespace
{

/** How many threads OpenMP gives this thread; what it was comes back in the end. */
class ThreadLimit
{
public:
  explicit ThreadLimit(ThreadIdType threads)
    : m_Before(omp_get_max_threads())
  {
    omp_set_num_threads(static_cast<int>(threads));
  }
  ThreadLimit(const ThreadLimit &) = delete;
  ThreadLimit &
  operator=(const ThreadLimit &) = delete;
  ~ThreadLimit()
  {
    omp_set_num_threads(m_Before);
  }

private:
  int m_Before;
};

const char *
EngineName(voxelcore::Engine engine)
{
  switch (engine)
  {
    case voxelcore::Engine::Lattice:
      return "lattice";
    case voxelcore::Engine::TetGen:
      return "tetgen";
    default:
      return "auto";
  }
}

} // namespace

VoxelCoreFilter::VoxelCoreFilter()
{
  this->SetNumberOfRequiredInputs(1);
}

void
VoxelCoreFilter::SetInput(const InputType * shapes)
{
  // ProcessObject does not know constness, and does not change its inputs' data.
  this->SetNthInput(0, const_cast<InputType *>(shapes));
}

auto
VoxelCoreFilter::GetInput() const -> const InputType *
{
  return static_cast<const InputType *>(this->GetPrimaryInput());
}

void
VoxelCoreFilter::VerifyPreconditions() ITKv5_CONST
{
  Superclass::VerifyPreconditions();
  if (!voxelcore::HasEngine(m_Engine))
  {
    itkExceptionMacro("this build has no engine " << EngineName(m_Engine) << "; leave it at auto");
  }
}

voxelcore::MedialComplex
VoxelCoreFilter::ComputeCore(const voxelcore::VoxelShape &       shape,
                             const voxelcore::SpacingWeights &   weights,
                             const voxelcore::ProgressCallback & progress) const
{
  return voxelcore::ComputeVoxelCore(shape, weights, m_Engine, progress);
}

void
VoxelCoreFilter::GenerateData()
{
  // Where in a label's work each stage ends, as the shares of time usually are.
  constexpr double  shapeEnds = 0.05;
  constexpr double  coreEnds = 0.95;
  const ThreadLimit limit(
    std::min(this->GetNumberOfWorkUnits(), this->GetMultiThreader()->GetMaximumNumberOfThreads()));
  const InputType &         input = *this->GetInput();
  OutputType::PartContainer parts;
  WithItkErrors(this->GetNameOfClass(), [&] {
    const voxelcore::SpacingWeights weights = voxelcore::ComputeLatticeWeights(input.GetGeometry());
    double                          total = 0;
    for (const voxelcore::LabelShape & label : input.GetLabels())
    {
      total += 1 + static_cast<double>(label.voxels);
    }
    double before = 0;
    for (const voxelcore::LabelShape & label : input.GetLabels())
    {
      const double share = (1 + static_cast<double>(label.voxels)) / total;
      const auto   part = [&](double from, double to) {
        return ForwardProgress(this, before + share * from, before + share * to);
      };
      voxelcore::ReportProgress(part(0, shapeEnds), "shape", 0);
      OutputType::Part result;
      result.label = label.value;
      result.name = label.name;
      result.box = label.shape.Box();
      result.shapeTopology = voxelcore::ComputeShapeTopology(label.shape);
      auto core = std::make_shared<const voxelcore::MedialComplex>(
        this->ComputeCore(label.shape, weights, part(shapeEnds, coreEnds)));
      voxelcore::ReportProgress(part(coreEnds, 1), "certificate", 0);
      result.complexTopology = voxelcore::ComputeComplexTopology(core->cells);
      voxelcore::RequireEqualTopology(result.shapeTopology, result.complexTopology, "its core", label.value);
      const voxelcore::MedialComplex placed = voxelcore::PlaceInLps(*core, input.GetGeometry());
      result.origin =
        voxelcore::DescribeOrigin(label.value, label.name, label.shape, result.shapeTopology, *core, placed);
      result.complex = std::move(core);
      parts.push_back(std::move(result));
      before += share;
    }
    voxelcore::ReportProgress(ForwardProgress(this, 0, 1), "done", 1);
  });
  this->GetOutput()->SetParts(std::move(parts));
}

void
VoxelCoreFilter::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Engine: " << EngineName(m_Engine) << std::endl;
}

} // namespace itk
