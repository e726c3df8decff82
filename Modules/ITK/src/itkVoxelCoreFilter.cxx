#include "itkVoxelCoreFilter.h"

#include "itkErrors.h"
#include "itkThreadLimit.h"
#include "voxelcore/Certified.h"

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
    double total = 0;
    for (const voxelcore::LabelShape & label : input.GetLabels())
    {
      total += 1 + static_cast<double>(label.voxels);
    }
    double before = 0;
    for (const voxelcore::LabelShape & label : input.GetLabels())
    {
      const double                share = (1 + static_cast<double>(label.voxels)) / total;
      voxelcore::CertifiedRequest request;
      request.name = voxelcore::LabelText(label.value, label.name);
      request.lambdas = { voxelcore::Lambda() };
      if (!m_WholeCore)
      {
        request.tolerances = { m_Tolerance };
      }
      if (!m_Refine)
      {
        request.surface = voxelcore::SurfaceSource();
      }
      request.engine = m_Engine;
      voxelcore::CertifiedResult result = voxelcore::ComputeCertified(label.shape,
                                                                      input.GetGeometry(),
                                                                      request,
                                                                      ForwardProgress(this, before, before + share));
      result.cores.front().core.label = label.value;
      parts.push_back({ voxelcore::OriginOf(result, label.value, label.name, label.voxels),
                        std::make_shared<const voxelcore::CertifiedCore>(std::move(result.cores.front())) });
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
  os << indent << "WholeCore: " << (m_WholeCore ? "On" : "Off") << std::endl;
  os << indent << "Tolerance: " << m_Tolerance.text << std::endl;
  os << indent << "Refine: " << (m_Refine ? "On" : "Off") << std::endl;
}

} // namespace itk
