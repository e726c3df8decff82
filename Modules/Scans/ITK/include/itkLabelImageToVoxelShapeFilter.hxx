#ifndef itkLabelImageToVoxelShapeFilter_hxx
#define itkLabelImageToVoxelShapeFilter_hxx

#include "itkLabelImageToVoxelShapeFilter.h"

#include "itkMetaDataObject.h"

#include <algorithm>

namespace itk
{

template <typename TInputImage>
LabelImageToVoxelShapeFilter<TInputImage>::LabelImageToVoxelShapeFilter()
{
  this->SetNumberOfRequiredOutputs(1);
  this->SetNthOutput(0, this->MakeOutput(0));
}

template <typename TInputImage>
auto
LabelImageToVoxelShapeFilter<TInputImage>::GetOutput() -> OutputType *
{
  return static_cast<OutputType *>(this->GetPrimaryOutput());
}

template <typename TInputImage>
auto
LabelImageToVoxelShapeFilter<TInputImage>::GetOutput() const -> const OutputType *
{
  return static_cast<const OutputType *>(this->GetPrimaryOutput());
}

template <typename TInputImage>
DataObject::Pointer
LabelImageToVoxelShapeFilter<TInputImage>::MakeOutput(ProcessObject::DataObjectPointerArraySizeType)
{
  return OutputType::New().GetPointer();
}

template <typename TInputImage>
void
LabelImageToVoxelShapeFilter<TInputImage>::SetThreshold(double lower, double upper)
{
  const std::pair<double, double> threshold(lower, upper);
  if (m_Threshold != threshold)
  {
    m_Threshold = threshold;
    this->Modified();
  }
}

template <typename TInputImage>
void
LabelImageToVoxelShapeFilter<TInputImage>::RemoveThreshold()
{
  if (m_Threshold)
  {
    m_Threshold.reset();
    this->Modified();
  }
}

template <typename TInputImage>
void
LabelImageToVoxelShapeFilter<TInputImage>::SetNumberOfStreamDivisions(unsigned int divisions)
{
  Superclass::SetNumberOfStreamDivisions(std::max(1U, divisions));
}

template <typename TInputImage>
void
LabelImageToVoxelShapeFilter<TInputImage>::Update()
{
  // ImageSink's own runs every time: it has no output whose times could tell.
  this->GetOutput()->Update();
}

template <typename TInputImage>
void
LabelImageToVoxelShapeFilter<TInputImage>::UpdateOutputInformation()
{
  try
  {
    Superclass::UpdateOutputInformation();
  }
  catch (...)
  {
    // Else, after a failure upstream, it would take itself for busy and the next Update would do nothing.
    this->ResetPipeline();
    throw;
  }
}

template <typename TInputImage>
void
LabelImageToVoxelShapeFilter<TInputImage>::UpdateOutputData(DataObject * output)
{
  try
  {
    Superclass::UpdateOutputData(output);
  }
  catch (...)
  {
    // ImageSink tidies up only after its own failures, not after those of filters upstream.
    m_Assembler.reset();
    this->ResetPipeline();
    this->RestoreInputReleaseDataFlags();
    throw;
  }
}

template <typename TInputImage>
void
LabelImageToVoxelShapeFilter<TInputImage>::GenerateOutputInformation()
{
  const InputImageType *     image = this->GetInput();
  const InputImageRegionType region = image->GetLargestPossibleRegion();
  voxelcore::ImageGeometry   geometry;
  // Not the image's origin, which is where index (0,0,0) is, in the image or not.
  typename InputImageType::PointType first;
  image->TransformIndexToPhysicalPoint(region.GetIndex(), first);
  for (unsigned int row = 0; row < 3; ++row)
  {
    geometry.size[row] = static_cast<std::int64_t>(region.GetSize(row));
    geometry.spacing[row] = image->GetSpacing()[row];
    geometry.origin[row] = first[row];
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      geometry.direction[3 * row + axis] = image->GetDirection()(row, axis);
    }
  }
  std::string unit;
  if (ExposeMetaData(image->GetMetaDataDictionary(), "Units", unit))
  {
    geometry.unit = voxelcore::UnitNamed(unit).value_or(geometry.unit);
  }
  this->GetOutput()->SetGeometry(VoxelShapeAssembler::CheckGeometry(geometry, m_Orthonormalize));
  this->GetOutput()->SetStartIndex(region.GetIndex());
}

template <typename TInputImage>
unsigned int
LabelImageToVoxelShapeFilter<TInputImage>::GetNumberOfInputRequestedRegions()
{
  // The splitter divides the slowest axis that has more than one voxel. Rows must stay whole.
  const auto & size = this->GetInput()->GetLargestPossibleRegion().GetSize();
  return size[1] * size[2] == 1 ? 1 : Superclass::GetNumberOfInputRequestedRegions();
}

template <typename TInputImage>
void
LabelImageToVoxelShapeFilter<TInputImage>::BeforeStreamedGenerateData()
{
  Superclass::BeforeStreamedGenerateData();
  voxelcore::LabelChoice choice;
  choice.labels = m_Labels;
  choice.binary = m_Binary;
  choice.threshold = m_Threshold;
  m_Assembler = std::make_unique<VoxelShapeAssembler>(this->GetOutput()->GetGeometry(),
                                                      voxelcore::LabelAssembler::Pixel::Of<InputImagePixelType>(),
                                                      choice);
}

template <typename TInputImage>
void
LabelImageToVoxelShapeFilter<TInputImage>::StreamedGenerateData(unsigned int number)
{
  const InputImageType *     image = this->GetInput();
  const unsigned int         divisions = this->GetNumberOfInputRequestedRegions();
  const InputImageRegionType whole = image->GetLargestPossibleRegion();
  InputImageRegionType       slab = whole;
  // The region asked for, not the image's requested region: filters upstream may have enlarged that.
  this->GetRegionSplitter()->GetSplit(number, divisions, slab);
  if (!image->GetBufferedRegion().IsInside(slab))
  {
    itkExceptionMacro("the input did not bring the region it was asked for: " << slab);
  }
  // A region says what would be there; an image that was not allocated has no pixels of it.
  const auto * pixelsThere = image->GetPixelContainer();
  if (pixelsThere == nullptr || pixelsThere->Size() < image->GetBufferedRegion().GetNumberOfPixels())
  {
    itkExceptionMacro("the input has no pixels; call its Allocate() and fill it");
  }
  const auto rowsBefore = [&whole](const typename InputImageType::IndexType & index) {
    return static_cast<std::uint64_t>(index[1] - whole.GetIndex(1)) +
           static_cast<std::uint64_t>(index[2] - whole.GetIndex(2)) * whole.GetSize(1);
  };
  // Whole rows, and whole slices unless there is but one: all of the slab lies in one piece of the buffer.
  const std::size_t           rows = slab.GetSize(1) * slab.GetSize(2);
  const std::uint64_t         firstRow = rowsBefore(slab.GetIndex());
  const InputImagePixelType * pixels = image->GetBufferPointer() + image->ComputeOffset(slab.GetIndex());
  for (std::size_t row = 0; row < rows;)
  {
    this->ThrowIfAborted();
    const std::size_t now = std::min(m_Assembler->RowsAtATime(), rows - row);
    m_Assembler->AddRows(pixels + row * whole.GetSize(0), firstRow + row, now);
    row += now;
    this->UpdateProgress((static_cast<float>(number) + static_cast<float>(row) / static_cast<float>(rows)) /
                         static_cast<float>(divisions));
  }
}

template <typename TInputImage>
void
LabelImageToVoxelShapeFilter<TInputImage>::AfterStreamedGenerateData()
{
  Superclass::AfterStreamedGenerateData();
  // StreamingProcessObject leaves its loop without a word when it is aborted between two slabs.
  if (this->GetAbortGenerateData())
  {
    this->InvokeEvent(AbortEvent());
    this->ThrowIfAborted();
  }
  std::vector<std::string> warnings;
  this->GetOutput()->SetLabels(m_Assembler->TakeShapes(m_Connectivity, warnings));
  m_Assembler.reset();
  for (const std::string & warning : warnings)
  {
    itkWarningMacro(<< warning);
  }
  // It cleared them, and ReleaseInputs, which comes next, asks for them.
  this->RestoreInputReleaseDataFlags();
}

template <typename TInputImage>
void
LabelImageToVoxelShapeFilter<TInputImage>::ThrowIfAborted() const
{
  if (this->GetAbortGenerateData())
  {
    ProcessAborted aborted(__FILE__, __LINE__);
    aborted.SetLocation(this->GetNameOfClass());
    throw aborted;
  }
}

template <typename TInputImage>
void
LabelImageToVoxelShapeFilter<TInputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Labels: " << m_Labels << std::endl;
  os << indent << "Binary: " << (m_Binary ? "On" : "Off") << std::endl;
  os << indent << "Threshold: ";
  if (m_Threshold)
  {
    os << m_Threshold->first << " to " << m_Threshold->second << std::endl;
  }
  else
  {
    os << "none" << std::endl;
  }
  os << indent << "Connectivity: " << m_Connectivity << std::endl;
  os << indent << "Orthonormalize: " << (m_Orthonormalize ? "On" : "Off") << std::endl;
}

} // namespace itk

#endif
