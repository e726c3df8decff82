#include "itkVoxelCoreFilter.h"

#include "itkEachLabel.h"
#include "itkThreadLimit.h"

#include <utility>

namespace itk
{
namespace
{

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
  : m_Tolerance(voxelcore::ParseTolerance(voxelcore::kUsualTolerance))
{
  this->SetNumberOfRequiredInputs(1);
}

void
VoxelCoreFilter::SetInput(const InputType * shapes)
{
  // ProcessObject does not know constness, and does not change its inputs' data.
  this->SetNthInput(0, const_cast<InputType *>(shapes));
}

void
VoxelCoreFilter::SetTolerance(const std::string & text)
{
  auto height = WithItkErrors(this->GetNameOfClass(), [&text] { return voxelcore::ParseTolerance(text); });
  if (height.text != m_Tolerance.text)
  {
    m_Tolerance = std::move(height);
    this->Modified();
  }
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

void
VoxelCoreFilter::GenerateData()
{
  const ThreadLimit         limit(*this);
  const InputType &         input = *this->GetInput();
  OutputType::PartContainer parts;
  WithItkErrors(this->GetNameOfClass(), [&] {
    EachLabel(this, input, [&](const voxelcore::LabelShape & label, const auto & progress) {
      auto request = RequestOf(label, m_WholeCore ? std::nullopt : std::optional(m_Tolerance), m_Refine);
      request.engine = m_Engine;
      auto result = voxelcore::ComputeCertified(label.shape, input.GetGeometry(), request, progress);
      result.cores.front().core.label = label.value;
      voxelcore::CoreOrigin origin = voxelcore::OriginOf(result, label.value, label.name, label.voxels);
      origin.connectivity = label.connectivity;
      parts.push_back(
        { std::move(origin), std::make_shared<const voxelcore::CertifiedCore>(std::move(result.cores.front())) });
    });
  });
  this->GetOutput()->SetParts(std::move(parts));
}

void
VoxelCoreFilter::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Engine: " << EngineName(m_Engine) << std::endl;
  os << indent << "WholeCore: " << (m_WholeCore ? "On" : "Off") << std::endl;
  os << indent << "Tolerance: " << m_Tolerance.text << std::endl;
  os << indent << "Refine: " << (m_Refine ? "On" : "Off") << std::endl;
}

} // namespace itk
