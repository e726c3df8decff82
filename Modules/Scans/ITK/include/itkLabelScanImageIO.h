#ifndef itkLabelScanImageIO_h
#define itkLabelScanImageIO_h

#include "itkImageIOBase.h"
#include "itkIndex.h"

#include "voxelcore/Imaging/ScanRows.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace itk
{

/** \class LabelScanImageIO
 * \brief Reads scans by the strict rules of voxelcore::ReadLabelVolume, region by region.
 *
 * NRRD, NIfTI, MetaImage, TIFF stacks, and folders or patterns of slices. What ITK's own readers get
 * wrong without a word is read right here or refused with one line: files in micrometres, 4-D and colour files, skewed
 * axes, scaled values, segmentations in layers, slices out of order, data that are cut off. It says yes to every file
 * of its formats, also to those it then refuses, so that no laxer reader gets them.
 *
 * Values come as they are stored; scaled ones as double; those of a segmentation in layers as the numbers of its
 * labels, where no two overlap. ImageFileReader casts them to the pixel type of its image: LabelScanReader refuses what
 * that type cannot hold.
 *
 * The segments of a .seg.nrrd are in the MetaDataDictionary as Segment0_Name, Segment0_LabelValue (the value of its
 * pixels) and Segment0_Color, and so on.
 *
 * Where a file gives no voxel size, spacing is 1 and the entry "Units" of the dictionary "voxel"; else it is "mm".
 *
 * It streams: a region read takes as much memory as the region, and a few MB. Regions in the order of the file read it
 * once, also where it is compressed.
 *
 * One call of RegisterInFront() makes ImageFileReader take this class for its formats in this process. It does not
 * write.
 * \sa LabelScanReader
 * \ingroup VoxelCore
 */
class LabelScanImageIO : public ImageIOBase
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(LabelScanImageIO);

  using Self = LabelScanImageIO;
  using Superclass = ImageIOBase;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(LabelScanImageIO, ImageIOBase);

  /** Puts this class before all other readers that ITK's factories know. Again and again does no more than once. */
  static void
  RegisterInFront();

  /** How to read; those that say which values become shapes have no effect here. */
  void
  SetOptions(const voxelcore::ReadOptions & options);
  const voxelcore::ReadOptions &
  GetOptions() const
  {
    return m_Options;
  }

  /** After ReadImageInformation: what was assumed or converted, and what of it a user must see. */
  const std::vector<std::string> &
  GetNotes() const
  {
    return m_Notes;
  }
  const std::vector<std::string> &
  GetWarnings() const
  {
    return m_Warnings;
  }

  bool
  CanReadFile(const char * name) override;
  bool
  CanStreamRead() override
  {
    return true;
  }
  ImageIORegion
  GenerateStreamableReadRegionFromRequestedRegion(const ImageIORegion & requested) const override;
  /** \throws ExceptionObject with one line */
  void
  ReadImageInformation() override;
  /** \throws ExceptionObject with one line */
  void
  Read(void * buffer) override;
  using RowFunction = std::function<void(const std::byte * row, const Index<3> & first)>;
  /** Reads the region set, a few MB at a time; `take` gets its rows, one after the other.
   *  \throws ExceptionObject with one line */
  void
  ReadByRows(const RowFunction & take);

  bool
  CanWriteFile(const char *) override
  {
    return false;
  }
  void
  WriteImageInformation() override;
  void
  Write(const void * buffer) override;

protected:
  LabelScanImageIO();
  ~LabelScanImageIO() override;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  void
  DescribeSegments();

  voxelcore::ReadOptions               m_Options;
  std::vector<std::string>             m_Notes;
  std::vector<std::string>             m_Warnings;
  std::string                          m_OpenName;
  std::unique_ptr<voxelcore::ScanRows> m_Rows; ///< of the file of this name
};

} // namespace itk

#endif
