#include "itkMedialComplexSource.h"

namespace itk
{

MedialComplexSource::MedialComplexSource()
{
  this->SetNumberOfRequiredOutputs(1);
  this->SetNthOutput(0, this->MakeOutput(0));
}

auto
MedialComplexSource::GetOutput() -> OutputType *
{
  return static_cast<OutputType *>(this->GetPrimaryOutput());
}

auto
MedialComplexSource::GetOutput() const -> const OutputType *
{
  return static_cast<const OutputType *>(this->GetPrimaryOutput());
}

DataObject::Pointer
MedialComplexSource::MakeOutput(DataObjectPointerArraySizeType)
{
  return OutputType::New().GetPointer();
}

template <typename TPass>
void
MedialComplexSource::ResetOnFailure(const TPass & pass)
{
  try
  {
    pass();
  }
  catch (...)
  {
    // ProcessObject does so only after failures of its own work. After one upstream it would take itself for busy, and
    // the next Update would do nothing, without a word.
    this->ResetPipeline();
    throw;
  }
}

void
MedialComplexSource::UpdateOutputInformation()
{
  this->ResetOnFailure([this] { Superclass::UpdateOutputInformation(); });
}

void
MedialComplexSource::PropagateRequestedRegion(DataObject * output)
{
  this->ResetOnFailure([this, output] { Superclass::PropagateRequestedRegion(output); });
}

void
MedialComplexSource::UpdateOutputData(DataObject * output)
{
  this->ResetOnFailure([this, output] { Superclass::UpdateOutputData(output); });
}

} // namespace itk
