#ifndef itkLabelScanReader_hxx
#define itkLabelScanReader_hxx

#include "itkLabelScanReader.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace itk
{
namespace Detail
{

/** Whether an image of TPixel can hold a stored value. */
template <typename TPixel, typename TStored>
bool
CanHold(TStored value)
{
  if constexpr (std::is_integral_v<TStored> && std::is_integral_v<TPixel>)
  {
    return value >= 0 ? static_cast<unsigned long long>(value) <=
                          static_cast<unsigned long long>(std::numeric_limits<TPixel>::max())
                      : static_cast<long long>(value) >= static_cast<long long>(std::numeric_limits<TPixel>::min());
  }
  else if constexpr (std::is_integral_v<TPixel>)
  {
    // Both bounds are powers of two, or 0, and so exact.
    const double above = std::ldexp(1.0, std::numeric_limits<TPixel>::digits);
    return value == std::floor(value) && value < above && value >= (std::is_signed_v<TPixel> ? -above : 0.0);
  }
  else if constexpr (std::is_integral_v<TStored>)
  {
    const auto pixel = static_cast<TPixel>(value);
    return pixel < std::ldexp(TPixel(1), std::numeric_limits<TStored>::digits) && static_cast<TStored>(pixel) == value;
  }
  else
  {
    const auto pixel = static_cast<TPixel>(value);
    return value != std::floor(value) || !std::isfinite(value) || static_cast<TStored>(pixel) == value;
  }
}

} // namespace Detail

template <typename TOutputImage>
void
LabelScanReader<TOutputImage>::SetOptions(const voxelcore::ReadOptions & options)
{
  m_ImageIO->SetOptions(options);
  this->Modified();
}

template <typename TOutputImage>
void
LabelScanReader<TOutputImage>::GenerateOutputInformation()
{
  m_ImageIO->SetFileName(m_FileName);
  m_ImageIO->ReadImageInformation();
  TOutputImage *                       image = this->GetOutput();
  typename TOutputImage::SizeType      size;
  typename TOutputImage::SpacingType   spacing;
  typename TOutputImage::PointType     origin;
  typename TOutputImage::DirectionType direction;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    size[axis] = m_ImageIO->GetDimensions(axis);
    spacing[axis] = m_ImageIO->GetSpacing(axis);
    origin[axis] = m_ImageIO->GetOrigin(axis);
    for (unsigned int row = 0; row < 3; ++row)
    {
      direction(row, axis) = m_ImageIO->GetDirection(axis)[row];
    }
  }
  image->SetLargestPossibleRegion(typename TOutputImage::RegionType(size));
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  image->SetDirection(direction);
  image->SetMetaDataDictionary(m_ImageIO->GetMetaDataDictionary());
}

template <typename TOutputImage>
template <typename TStored>
void
LabelScanReader<TOutputImage>::ReadValues()
{
  TOutputImage *      image = this->GetOutput();
  const SizeValueType size = image->GetBufferedRegion().GetSize(0);
  const auto          rows = static_cast<float>(image->GetBufferedRegion().GetNumberOfPixels() / size);
  PixelType *         pixel = image->GetBufferPointer();
  float               done = 0;
  m_ImageIO->ReadByRows([&](const std::byte * row, const Index<3> & first) {
    for (SizeValueType x = 0; x < size; ++x, ++pixel)
    {
      TStored value;
      std::memcpy(&value, row + x * sizeof(TStored), sizeof(TStored));
      if (!Detail::CanHold<PixelType>(value))
      {
        itkExceptionMacro(<< m_FileName << ": value " << +value << " at voxel (" << first[0] + static_cast<long>(x)
                          << "," << first[1] << "," << first[2]
                          << ") does not fit the image's pixels; read it into a wider type");
      }
      *pixel = static_cast<PixelType>(value);
    }
    this->UpdateProgress(++done / rows);
    if (this->GetAbortGenerateData())
    {
      ProcessAborted aborted(__FILE__, __LINE__);
      aborted.SetLocation(this->GetNameOfClass());
      throw aborted;
    }
  });
}

template <typename TOutputImage>
void
LabelScanReader<TOutputImage>::GenerateData()
{
  this->UpdateProgress(0.0F);
  this->AllocateOutputs();
  const auto &  buffered = this->GetOutput()->GetBufferedRegion();
  ImageIORegion region(3);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    region.SetIndex(axis, buffered.GetIndex(axis));
    region.SetSize(axis, buffered.GetSize(axis));
  }
  m_ImageIO->SetIORegion(region);
  switch (m_ImageIO->GetComponentType())
  {
    case IOComponentEnum::UCHAR:
      return this->ReadValues<unsigned char>();
    case IOComponentEnum::CHAR:
      return this->ReadValues<signed char>();
    case IOComponentEnum::USHORT:
      return this->ReadValues<unsigned short>();
    case IOComponentEnum::SHORT:
      return this->ReadValues<short>();
    case IOComponentEnum::UINT:
      return this->ReadValues<unsigned int>();
    case IOComponentEnum::INT:
      return this->ReadValues<int>();
    case IOComponentEnum::ULONGLONG:
      return this->ReadValues<unsigned long long>();
    case IOComponentEnum::LONGLONG:
      return this->ReadValues<long long>();
    case IOComponentEnum::FLOAT:
      return this->ReadValues<float>();
    default:
      return this->ReadValues<double>();
  }
}

template <typename TOutputImage>
void
LabelScanReader<TOutputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << m_FileName << std::endl;
  os << indent << "ImageIO: " << std::endl;
  m_ImageIO->Print(os, indent.GetNextIndent());
}

} // namespace itk

#endif
