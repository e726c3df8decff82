#include "itkLambdaPruningFilter.h"

#include "itkErrors.h"
#include "voxelcore/Certified/CertifiedCore.h"
#include "voxelcore/Labels/LabelMap.h"

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
  const InputType &         input = *this->GetInput();
  OutputType::PartContainer parts = input.GetParts();
  WithItkErrors(this->GetNameOfClass(), [&] {
    const voxelcore::ImageGeometry & geometry = input.GetGeometry();
    const auto                       weights = voxelcore::ComputeLatticeWeights(geometry);
    const auto                       work = [](const OutputType::Part & part) {
      return 1 + static_cast<double>(part.core->numbers.complex.edges);
    };
    double total = 0;
    for (const OutputType::Part & part : parts)
    {
      total += work(part);
    }
    double before = 0;
    for (OutputType::Part & part : parts)
    {
      const voxelcore::CoreOrigin &   origin = part.origin;
      const voxelcore::CertifiedShape shape{ voxelcore::LabelText(origin.label, origin.name),
                                             origin.shape,
                                             origin.box,
                                             geometry };
      const double                    after = before + work(part) / total;
      const auto                      progress = ForwardProgress(this, before, after);
      voxelcore::ReportProgress(progress, "prune", 0);
      if (voxelcore::LambdaInMillimetres(m_Lambda, weights, geometry.spacing, shape.box) > part.core->numbers.lambdaMm)
      {
        auto pruned = voxelcore::PruneCertified(*part.core, shape, { m_Lambda }, progress);
        part.core = std::make_shared<const voxelcore::CertifiedCore>(std::move(pruned.front()));
      }
      else
      {
        voxelcore::RequireTopologyOf(shape, *part.core);
      }
      before = after;
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
