#ifndef itkLabelImageToVoxelShapeFilter_h
#define itkLabelImageToVoxelShapeFilter_h

#include "itkImageSink.h"
#include "itkVoxelShapeAssembler.h"
#include "itkVoxelShapeObject.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace itk
{

/** \class LabelImageToVoxelShapeFilter
 * \brief The voxel shape of each label of a 3-D image.
 *
 * Streams: with SetNumberOfStreamDivisions(n) the image is asked for in up to n slabs, one after the other, and what
 * stays in memory is one slab and the packed shapes. Any scalar pixel type is taken. Values are labels: whole numbers
 * from 0, the background, up; others are refused, as is a direction that is not orthonormal. Messages name parameters
 * as the command line does (`--labels` is SetLabels and so on).
 *
 * Lengths are mm, or voxels where the entry "Units" of the image's dictionary is "voxel", as LabelScanReader sets it.
 *
 * The image may start at any index: voxel (0,0,0) of the shapes is the first of its largest region.
 *
 * Unlike ImageSink's, Update does nothing when nothing changed. After a failure or an abort, its own or of a filter
 * upstream, it can be updated again without ResetPipeline.
 * \sa VoxelCoreFilter
 * \ingroup VoxelCore
 */
template <typename TInputImage>
class LabelImageToVoxelShapeFilter : public ImageSink<TInputImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(LabelImageToVoxelShapeFilter);

  using Self = LabelImageToVoxelShapeFilter;
  using Superclass = ImageSink<TInputImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;
  using typename Superclass::InputImagePixelType;
  using typename Superclass::InputImageRegionType;
  using typename Superclass::InputImageType;
  using OutputType = VoxelShapeObject;

  static_assert(TInputImage::ImageDimension == 3, "voxels are three-dimensional");
  static_assert(std::is_arithmetic_v<InputImagePixelType> && sizeof(InputImagePixelType) <= 8,
                "labels are single numbers");

  itkNewMacro(Self);
  itkTypeMacro(LabelImageToVoxelShapeFilter, ImageSink);

  OutputType *
  GetOutput();
  const OutputType *
  GetOutput() const;

  using Superclass::MakeOutput;
  DataObject::Pointer
  MakeOutput(ProcessObject::DataObjectPointerArraySizeType index) override;

  /** Which labels: "all" (unless set), or values separated by commas. */
  itkSetStringMacro(Labels);
  const std::string &
  GetLabels() const
  {
    return m_Labels;
  }
  /** One label alone. */
  void
  SetLabel(std::int64_t value)
  {
    this->SetLabels(std::to_string(value));
  }

  /** All labels chosen are one shape, label 1. */
  itkSetMacro(Binary, bool);
  itkGetConstMacro(Binary, bool);
  itkBooleanMacro(Binary);

  /** A grey image: lower <= value <= upper is one shape, label 1. */
  void
  SetThreshold(double lower, double upper);
  /** Values are labels again. */
  void
  RemoveThreshold();
  const std::optional<std::pair<double, double>> &
  GetThreshold() const
  {
    return m_Threshold;
  }

  /** Which voxels hang together: "6" (unless set), those that share a face; "26", those that touch over edges and
   *  corners, too, which the least change then makes share faces; "joined": pieces that touch are joined, and nothing
   *  else changes. With "6" a warning says where pieces touch. */
  itkSetStringMacro(Connectivity);
  const std::string &
  GetConnectivity() const
  {
    return m_Connectivity;
  }

  /** Take the nearest orthonormal direction where the image's is none, instead of refusing it. */
  itkSetMacro(Orthonormalize, bool);
  itkGetConstMacro(Orthonormalize, bool);
  itkBooleanMacro(Orthonormalize);

  /** Into how many slabs along the slowest axis to divide the input at most; 1 unless set. 0 is taken as 1. */
  void
  SetNumberOfStreamDivisions(unsigned int divisions) override;
  using Superclass::GetNumberOfStreamDivisions;

  /** Brings the output up to date. */
  void
  Update() override;
  void
  UpdateOutputInformation() override;
  void
  UpdateOutputData(DataObject * output) override;

protected:
  LabelImageToVoxelShapeFilter();
  ~LabelImageToVoxelShapeFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;
  void
  GenerateOutputInformation() override;
  unsigned int
  GetNumberOfInputRequestedRegions() override;
  void
  BeforeStreamedGenerateData() override;
  void
  StreamedGenerateData(unsigned int number) override;
  void
  AfterStreamedGenerateData() override;

  /** Not used: rows are packed in order, faster than they come from memory. */
  void
  ThreadedStreamedGenerateData(const InputImageRegionType &) override
  {}

private:
  void
  ThrowIfAborted() const;

  std::string                              m_Labels{ "all" };
  bool                                     m_Binary{ false };
  std::optional<std::pair<double, double>> m_Threshold;
  std::string                              m_Connectivity{ "6" };
  bool                                     m_Orthonormalize{ false };
  std::unique_ptr<VoxelShapeAssembler>     m_Assembler; ///< while streaming
};

} // namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#  include "itkLabelImageToVoxelShapeFilter.hxx"
#endif

#endif
