#include "itkLambdaPruningFilter.h"

#include "itkErrors.h"
#include "voxelcore/Certificate.h"
#include "voxelcore/ComplexTopology.h"

#include <charconv>

namespace itk
{

LambdaPruningFilter::LambdaPruningFilter()
  : m_Lambda(voxelcore::ParseLambda("1.5vox"))
{
  this->SetNumberOfRequiredInputs(1);
}

void
LambdaPruningFilter::SetInput(const InputType * cores)
{
  // ProcessObject does not know constness, and does not change its inputs' data.
  this->SetNthInput(0, const_cast<InputType *>(cores));
}

auto
LambdaPruningFilter::GetInput() const -> const InputType *
{
  return static_cast<const InputType *>(this->GetPrimaryInput());
}

void
LambdaPruningFilter::SetLambda(const std::string & text)
{
  voxelcore::Lambda lambda = WithItkErrors(this->GetNameOfClass(), [&text] { return voxelcore::ParseLambda(text); });
  if (lambda.text != m_Lambda.text)
  {
    m_Lambda = std::move(lambda);
    this->Modified();
  }
}

void
LambdaPruningFilter::SetLambda(double millimetres)
{
  // The shortest text that reads as the same number.
  std::array<char, 32> text;
  const auto           end = std::to_chars(text.data(), text.data() + text.size(), millimetres).ptr;
  this->SetLambda(std::string(text.data(), end) + "mm");
}

void
LambdaPruningFilter::GenerateData()
{
  // The rest is the certificate's.
  constexpr double          pruningEnds = 0.9;
  const InputType &         input = *this->GetInput();
  OutputType::PartContainer parts = input.GetParts();
  WithItkErrors(this->GetNameOfClass(), [&] {
    const auto &                    spacing = input.GetGeometry().spacing;
    const voxelcore::SpacingWeights weights = voxelcore::ComputeLatticeWeights(input.GetGeometry());
    double                          total = 0;
    for (const OutputType::Part & part : parts)
    {
      total += 1 + static_cast<double>(part.complex->cells.edges.size());
    }
    double before = 0;
    for (OutputType::Part & part : parts)
    {
      const double share = (1 + static_cast<double>(part.complex->cells.edges.size())) / total;
      const double lambda = voxelcore::LambdaInMillimetres(m_Lambda, weights, spacing, part.box);
      const auto   progress = ForwardProgress(this, before, before + pruningEnds * share);
      voxelcore::ReportProgress(progress, "prune", 0);
      if (lambda > part.lambda)
      {
        part.complex = std::make_shared<const voxelcore::MedialComplex>(
          std::move(voxelcore::PruneByLambda(*part.complex, { lambda }, progress).front()));
        part.lambda = lambda;
        part.lambdaText = m_Lambda.text;
        voxelcore::ReportProgress(progress, "certificate", 1);
        part.complexTopology = voxelcore::ComputeComplexTopology(part.complex->cells);
      }
      voxelcore::RequireEqualTopology(part.shapeTopology, part.complexTopology, "its core pruned", part.label);
      before += share;
    }
    voxelcore::ReportProgress(ForwardProgress(this, 0, 1), "done", 1);
  });
  this->GetOutput()->SetParts(std::move(parts));
}

void
LambdaPruningFilter::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Lambda: " << m_Lambda.text << std::endl;
}

} // namespace itk
