#include "itkLocalThicknessImageFilter.h"

#include "itkEachLabel.h"
#include "itkThreadLimit.h"

#include <utility>

namespace itk
{
namespace
{

/** Writes the values of a label's voxels where they belong. */
void
FillIn(const voxelcore::CertifiedThickness & found, const voxelcore::ImageGeometry & geometry, float * image)
{
  const auto & box = found.shape.Box();
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const auto at = ((box.lower[2] + z) * geometry.size[1] + box.lower[1] + y) * geometry.size[0] + box.lower[0];
      voxelcore::WriteRow(found.shape, found.map, y, z, image + at);
    }
  }
}

} // namespace

LocalThicknessImageFilter::LocalThicknessImageFilter()
  : m_Tolerance(voxelcore::ParseTolerance(voxelcore::kUsualTolerance))
{
  this->SetNumberOfRequiredInputs(1);
}

void
LocalThicknessImageFilter::SetInput(const InputType * shapes)
{
  // ProcessObject does not know constness, and does not change its inputs' data.
  this->SetNthInput(0, const_cast<InputType *>(shapes));
}

auto
LocalThicknessImageFilter::GetInput() const -> const InputType *
{
  return static_cast<const InputType *>(this->GetPrimaryInput());
}

void
LocalThicknessImageFilter::SetTolerance(const std::string & text)
{
  auto height = WithItkErrors(this->GetNameOfClass(), [&text] { return voxelcore::ParseTolerance(text); });
  if (height.text != m_Tolerance.text)
  {
    m_Tolerance = std::move(height);
    this->Modified();
  }
}

void
LocalThicknessImageFilter::GenerateOutputInformation()
{
  const InputType &                input = *this->GetInput();
  const voxelcore::ImageGeometry & geometry = input.GetGeometry();
  OutputImageType &                output = *this->GetOutput();
  OutputImageType::SizeType        size{};
  OutputImageType::SpacingType     spacing;
  OutputImageType::PointType       origin;
  OutputImageType::DirectionType   direction;
  for (unsigned row = 0; row < 3; ++row)
  {
    size[row] = static_cast<SizeValueType>(geometry.size[row]);
    spacing[row] = geometry.spacing[row];
    origin[row] = geometry.origin[row];
    for (unsigned axis = 0; axis < 3; ++axis)
    {
      direction(row, axis) = geometry.direction[3 * row + axis];
      // ITK's origin is where index 0 would be, ours that of the first voxel.
      origin[row] -= direction(row, axis) * geometry.spacing[axis] * static_cast<double>(input.GetStartIndex()[axis]);
    }
  }
  output.SetLargestPossibleRegion({ input.GetStartIndex(), size });
  output.SetSpacing(spacing);
  output.SetOrigin(origin);
  output.SetDirection(direction);
}

void
LocalThicknessImageFilter::EnlargeOutputRequestedRegion(DataObject * output)
{
  output->SetRequestedRegionToLargestPossibleRegion();
}

void
LocalThicknessImageFilter::GenerateData()
{
  const ThreadLimit                limit(*this);
  const InputType &                input = *this->GetInput();
  const voxelcore::ImageGeometry & geometry = input.GetGeometry();
  OutputImageType &                output = *this->GetOutput();
  output.SetBufferedRegion(output.GetLargestPossibleRegion());
  output.Allocate(true);
  WithItkErrors(this->GetNameOfClass(), [&] {
    EachLabel(this, input, [&](const voxelcore::LabelShape & label, const auto & progress) {
      auto request = RequestOf(label, m_Tolerance, m_Refine);
      request.thickness = voxelcore::ThicknessRequest{};
      const auto result = voxelcore::ComputeCertified(label.shape, geometry, request, progress);
      FillIn(*result.thickness, geometry, output.GetBufferPointer());
    });
  });
}

void
LocalThicknessImageFilter::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << m_Tolerance.text << std::endl;
  os << indent << "Refine: " << (m_Refine ? "On" : "Off") << std::endl;
}

} // namespace itk
