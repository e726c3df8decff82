#ifndef itkMedialComplexSource_h
#define itkMedialComplexSource_h

#include "itkMedialComplexObject.h"
#include "itkProcessObject.h"

namespace itk
{

/** \class MedialComplexSource
 * \brief Base of filters whose output is a MedialComplexObject.
 *
 * After a failure or an abort, its own or of a filter upstream, it can be updated again without ResetPipeline.
 * \ingroup VoxelCore
 */
class MedialComplexSource : public ProcessObject
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(MedialComplexSource);

  using Self = MedialComplexSource;
  using Superclass = ProcessObject;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;
  using OutputType = MedialComplexObject;

  itkTypeMacro(MedialComplexSource, ProcessObject);

  OutputType *
  GetOutput();
  const OutputType *
  GetOutput() const;

  using Superclass::MakeOutput;
  DataObject::Pointer
  MakeOutput(DataObjectPointerArraySizeType index) override;

  void
  UpdateOutputInformation() override;
  void
  PropagateRequestedRegion(DataObject * output) override;
  void
  UpdateOutputData(DataObject * output) override;

protected:
  MedialComplexSource();
  ~MedialComplexSource() override = default;

private:
  template <typename TPass>
  void
  ResetOnFailure(const TPass & pass);
};

} // namespace itk

#endif
