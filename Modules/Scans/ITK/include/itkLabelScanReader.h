#ifndef itkLabelScanReader_h
#define itkLabelScanReader_h

#include "itkImageSource.h"
#include "itkLabelScanImageIO.h"

#include <string>

namespace itk
{

/** \class LabelScanReader
 * \brief Reads a scan with LabelScanImageIO, and refuses values that its pixel type cannot hold.
 *
 * ImageFileReader casts: 70000 becomes 4464 in an image of unsigned short, -1 becomes 65535, 0.9999999 becomes 0. Here
 * the first such value is refused, with its voxel. An image of a floating-point type takes fractions at its precision,
 * and whole numbers exactly or not at all.
 *
 * It streams: only the requested region is read. A file that changed is read again after Modified().
 * \sa LabelScanImageIO, LabelImageToVoxelShapeFilter
 * \ingroup VoxelCore
 */
template <typename TOutputImage>
class LabelScanReader : public ImageSource<TOutputImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(LabelScanReader);

  using Self = LabelScanReader;
  using Superclass = ImageSource<TOutputImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;
  using PixelType = typename TOutputImage::PixelType;

  static_assert(TOutputImage::ImageDimension == 3, "scans are three-dimensional");
  static_assert(std::is_arithmetic_v<PixelType>, "labels are single numbers");

  itkNewMacro(Self);
  itkTypeMacro(LabelScanReader, ImageSource);

  /** A file, a folder of slices, or a pattern such as "slices/s_*.tif". */
  itkSetStringMacro(FileName);
  itkGetStringMacro(FileName);

  /** How to read; those that say which values become shapes have no effect here. */
  void
  SetOptions(const voxelcore::ReadOptions & options);

  /** After UpdateOutputInformation: what was assumed or converted, and what of it a user must see. */
  const std::vector<std::string> &
  GetNotes() const
  {
    return m_ImageIO->GetNotes();
  }
  const std::vector<std::string> &
  GetWarnings() const
  {
    return m_ImageIO->GetWarnings();
  }

protected:
  LabelScanReader() = default;
  ~LabelScanReader() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;
  void
  GenerateOutputInformation() override;
  void
  GenerateData() override;

private:
  template <typename TStored>
  void
  ReadValues();

  std::string               m_FileName;
  LabelScanImageIO::Pointer m_ImageIO{ LabelScanImageIO::New() };
};

} // namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#  include "itkLabelScanReader.hxx"
#endif

#endif
