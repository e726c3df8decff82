#include "itkLabelScanImageIO.h"

#include "itkErrors.h"
#include "itkMetaDataObject.h"
#include "itkObjectFactoryBase.h"
#include "itkVersion.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <locale>
#include <mutex>
#include <sstream>

namespace itk
{
namespace
{

constexpr const char * kWhere = "LabelScanImageIO";

class LabelScanImageIOFactory : public ObjectFactoryBase
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(LabelScanImageIOFactory);

  using Self = LabelScanImageIOFactory;
  using Superclass = ObjectFactoryBase;
  using Pointer = SmartPointer<Self>;

  itkFactorylessNewMacro(Self);
  itkTypeMacro(LabelScanImageIOFactory, ObjectFactoryBase);

  const char *
  GetITKSourceVersion() const override
  {
    return ITK_SOURCE_VERSION;
  }
  const char *
  GetDescription() const override
  {
    return "VoxelCore's strict reader of scans";
  }

protected:
  LabelScanImageIOFactory()
  {
    this->RegisterOverride("itkImageIOBase",
                           "itkLabelScanImageIO",
                           "VoxelCore's strict reader of scans",
                           true,
                           CreateObjectFunction<LabelScanImageIO>::New());
  }
  ~LabelScanImageIOFactory() override = default;
};

IOComponentEnum
ComponentOf(voxelcore::PixelType type)
{
  using voxelcore::PixelType;
  switch (type)
  {
    case PixelType::UInt8:
      return IOComponentEnum::UCHAR;
    case PixelType::Int8:
      return IOComponentEnum::CHAR;
    case PixelType::UInt16:
      return IOComponentEnum::USHORT;
    case PixelType::Int16:
      return IOComponentEnum::SHORT;
    case PixelType::UInt32:
      return IOComponentEnum::UINT;
    case PixelType::Int32:
      return IOComponentEnum::INT;
    case PixelType::UInt64:
      return IOComponentEnum::ULONGLONG;
    case PixelType::Int64:
      return IOComponentEnum::LONGLONG;
    case PixelType::Float32:
      return IOComponentEnum::FLOAT;
    case PixelType::Float64:
      break;
  }
  return IOComponentEnum::DOUBLE;
}

} // namespace

LabelScanImageIO::LabelScanImageIO()
{
  this->SetNumberOfDimensions(3);
  for (const char * extension :
       { ".nrrd", ".nhdr", ".nii", ".nii.gz", ".hdr", ".img", ".mha", ".mhd", ".tif", ".tiff", ".lsm" })
  {
    this->AddSupportedReadExtension(extension);
  }
}

LabelScanImageIO::~LabelScanImageIO() = default;

void
LabelScanImageIO::RegisterInFront()
{
  static std::once_flag once;
  std::call_once(once, [] {
    ObjectFactoryBase::RegisterFactory(LabelScanImageIOFactory::New(),
                                       ObjectFactoryEnums::InsertionPosition::INSERT_AT_FRONT);
  });
}

void
LabelScanImageIO::SetOptions(const voxelcore::ReadOptions & options)
{
  m_Options = options;
  m_Rows.reset();
  this->Modified();
}

bool
LabelScanImageIO::CanReadFile(const char * name)
{
  return voxelcore::IsScanFormat(name);
}

ImageIORegion
LabelScanImageIO::GenerateStreamableReadRegionFromRequestedRegion(const ImageIORegion & requested) const
{
  return this->GetUseStreamedReading() ? requested
                                       : Superclass::GenerateStreamableReadRegionFromRequestedRegion(requested);
}

void
LabelScanImageIO::ReadImageInformation()
{
  m_Rows.reset();
  WithItkErrors(kWhere, [this] { m_Rows = std::make_unique<voxelcore::ScanRows>(this->GetFileName(), m_Options); });
  m_OpenName = this->GetFileName();
  const voxelcore::ImageGeometry & geometry = m_Rows->Geometry();
  this->SetNumberOfDimensions(3);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    this->SetDimensions(axis, static_cast<SizeValueType>(geometry.size[axis]));
    this->SetSpacing(axis, geometry.spacing[axis]);
    this->SetOrigin(axis, geometry.origin[axis]);
    this->SetDirection(
      axis,
      std::vector<double>{ geometry.direction[axis], geometry.direction[3 + axis], geometry.direction[6 + axis] });
  }
  this->SetPixelType(IOPixelEnum::SCALAR);
  this->SetNumberOfComponents(1);
  this->SetComponentType(ComponentOf(m_Rows->Type()));
  this->DescribeSegments();
  EncapsulateMetaData<std::string>(this->GetMetaDataDictionary(), "Units", voxelcore::UnitName(geometry.unit));
  m_Notes = m_Rows->Notes();
  m_Warnings = m_Rows->Warnings();
}

void
LabelScanImageIO::DescribeSegments()
{
  MetaDataDictionary dictionary;
  std::size_t        number = 0;
  for (const voxelcore::Segment & segment : m_Rows->Segments())
  {
    const std::string key = "Segment" + std::to_string(number++) + "_";
    EncapsulateMetaData<std::string>(dictionary, key + "Name", segment.name);
    EncapsulateMetaData<std::string>(dictionary, key + "LabelValue", std::to_string(segment.value));
    if (segment.color)
    {
      std::ostringstream color;
      color.imbue(std::locale::classic());
      color << (*segment.color)[0] << ' ' << (*segment.color)[1] << ' ' << (*segment.color)[2];
      EncapsulateMetaData<std::string>(dictionary, key + "Color", color.str());
    }
  }
  this->SetMetaDataDictionary(dictionary);
}

void
LabelScanImageIO::ReadByRows(const RowFunction & take)
{
  if (!m_Rows || m_OpenName != this->GetFileName())
  {
    this->ReadImageInformation();
  }
  const auto & scan = m_Rows->Geometry().size;
  // An image of fewer dimensions wants the first slice or row.
  std::array<std::uint64_t, 3> first{ 0, 0, 0 };
  std::array<std::uint64_t, 3> size{ 1, 1, 1 };
  const ImageIORegion &        region = this->GetIORegion();
  for (unsigned int axis = 0; axis < std::min(3U, region.GetImageDimension()); ++axis)
  {
    first[axis] = static_cast<std::uint64_t>(region.GetIndex(axis));
    size[axis] = region.GetSize(axis);
    if (region.GetIndex(axis) < 0 || first[axis] + size[axis] > static_cast<std::uint64_t>(scan[axis]))
    {
      itkExceptionMacro("a region beyond the scan was asked for: " << region);
    }
  }
  const auto        sizeY = static_cast<std::uint64_t>(scan[1]);
  const std::size_t offset = first[0] * voxelcore::PixelBytes(m_Rows->Type());
  const auto        takeRow = [&](const std::byte * row, std::uint64_t number) {
    take(row + offset,
         { { static_cast<IndexValueType>(first[0]),
             static_cast<IndexValueType>(number % sizeY),
             static_cast<IndexValueType>(number / sizeY) } });
  };
  // Whole slices are one run of rows.
  const bool          whole = size[1] == sizeY;
  const std::uint64_t runs = whole ? 1 : size[2];
  WithItkErrors(kWhere, [&] {
    for (std::uint64_t run = 0; run < runs; ++run)
    {
      m_Rows->Read((first[2] + run) * sizeY + first[1], size[1] * (whole ? size[2] : 1), takeRow);
    }
  });
}

void
LabelScanImageIO::Read(void * buffer)
{
  auto *            to = static_cast<std::byte *>(buffer);
  const std::size_t bytes = this->GetIORegion().GetSize(0) * this->GetComponentSize();
  this->ReadByRows([&](const std::byte * row, const Index<3> &) {
    std::memcpy(to, row, bytes);
    to += bytes;
  });
}

void
LabelScanImageIO::WriteImageInformation()
{
  itkExceptionMacro("this class only reads; write with voxelcore::WriteLabelVolume or another ImageIO");
}

void
LabelScanImageIO::Write(const void *)
{
  this->WriteImageInformation();
}

void
LabelScanImageIO::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  for (const std::string & note : m_Notes)
  {
    os << indent << "Note: " << note << std::endl;
  }
  for (const std::string & warning : m_Warnings)
  {
    os << indent << "Warning: " << warning << std::endl;
  }
}

} // namespace itk
