#include "itkLabelScanImageIO.h"

#include "ScanRows.h"
#include "itkErrors.h"
#include "itkObjectFactoryBase.h"
#include "itkVersion.h"
#include "voxelcore/LabelNaming.h"
#include "voxelcore/ScaledValue.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <mutex>

namespace itk
{
namespace
{

constexpr const char * kWhere = "LabelScanImageIO";
constexpr std::size_t  kBlockBytes = 1U << 20;

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

struct LabelScanImageIO::State
{
  State(const std::string & name, const voxelcore::ReadOptions & options)
    : rows(name, options)
    , naming(rows.Scan(), {})
  {
    for (const voxelcore::Segment & segment : rows.Scan().segments)
    {
      numbers[{ segment.layer, segment.value }] = naming.Identify(segment.layer, segment.value).value;
    }
  }

  voxelcore::PixelType
  PixelType() const
  {
    const voxelcore::ScanFile & scan = rows.Scan();
    return scan.HasLayers() ? voxelcore::PixelType::Int64
                            : (scan.IsScaled() ? voxelcore::PixelType::Float64 : scan.type);
  }

  std::int64_t
  NumberOf(std::size_t layer, double value, std::int64_t x, std::uint64_t row)
  {
    const voxelcore::ScanFile & scan = rows.Scan();
    const auto                  sizeY = static_cast<std::uint64_t>(scan.geometry.size[1]);
    const auto                  refuse = [&](const char * what) {
      voxelcore::RefuseInput(scan.path,
                             voxelcore::Text("value ",
                                             voxelcore::Number(value),
                                             " of layer ",
                                             layer,
                                             " at voxel (",
                                             x,
                                             ",",
                                             row % sizeY,
                                             ",",
                                             row / sizeY,
                                             ") ",
                                             what),
                             "name it in 3D Slicer, or read the file with voxelcore::ReadLabelVolume");
    };
    if (!(value > 0) || value != std::floor(value) || value > 9007199254740992.0)
    {
      refuse("is no label");
    }
    const auto [place, isNew] = numbers.try_emplace({ layer, static_cast<std::int64_t>(value) }, 0);
    if (isNew)
    {
      place->second = naming.Identify(layer, place->first.second).value;
      if (place->second != place->first.second)
      {
        refuse("belongs to no segment, and other segments have its number");
      }
    }
    return place->second;
  }

  /** One row of layers as the numbers of their labels. */
  void
  MergeLayers(const std::byte * stored, std::uint64_t row, std::int64_t * merged)
  {
    const voxelcore::ScanFile & scan = rows.Scan();
    const std::size_t           bytes = voxelcore::PixelBytes(scan.type);
    std::fill_n(merged, scan.geometry.size[0], 0);
    for (std::int64_t x = 0; x < scan.geometry.size[0]; ++x)
    {
      for (std::size_t layer = 0; layer < scan.interleaved; ++layer, stored += bytes)
      {
        const double value = voxelcore::StoredValue(stored, scan.type);
        if (value == 0)
        {
          continue;
        }
        const std::int64_t number = NumberOf(layer, value, x, row);
        if (merged[x] != 0)
        {
          const auto sizeY = static_cast<std::uint64_t>(scan.geometry.size[1]);
          voxelcore::RefuseInput(
            scan.path,
            voxelcore::Text("two segments overlap at voxel (", x, ",", row % sizeY, ",", row / sizeY, ")"),
            "an image holds one value a voxel; read the file with voxelcore::ReadLabelVolume");
        }
        merged[x] = number;
      }
    }
  }

  /** One row as PixelType() has it; `work` is room for it. */
  const std::byte *
  Delivered(const std::byte * stored, std::uint64_t row, std::vector<std::byte> & work)
  {
    const voxelcore::ScanFile & scan = rows.Scan();
    const auto                  sizeX = static_cast<std::size_t>(scan.geometry.size[0]);
    const std::size_t           bytes = voxelcore::PixelBytes(scan.type);
    if (!scan.HasLayers() && !scan.IsScaled() && scan.interleaved == 1)
    {
      return stored;
    }
    work.resize(sizeX * voxelcore::PixelBytes(PixelType()));
    if (scan.HasLayers())
    {
      MergeLayers(stored, row, reinterpret_cast<std::int64_t *>(work.data()));
      return work.data();
    }
    stored += static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, scan.component)) * bytes;
    for (std::size_t x = 0; x < sizeX; ++x, stored += scan.interleaved * bytes)
    {
      if (scan.IsScaled())
      {
        const double value = voxelcore::ScaledValue(scan, voxelcore::StoredValue(stored, scan.type));
        std::memcpy(work.data() + x * sizeof value, &value, sizeof value);
      }
      else
      {
        std::memcpy(work.data() + x * bytes, stored, bytes);
      }
    }
    return work.data();
  }

  voxelcore::ScanRows                                          rows;
  voxelcore::LabelNaming                                       naming;
  std::map<std::pair<std::size_t, std::int64_t>, std::int64_t> numbers; ///< of values in layers
};

LabelScanImageIO::LabelScanImageIO()
{
  this->SetNumberOfDimensions(3);
  for (const char * extension :
       { ".nrrd", ".nhdr", ".nii", ".nii.gz", ".hdr", ".img", ".mha", ".mhd", ".tif", ".tiff" })
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
  m_State.reset();
  this->Modified();
}

bool
LabelScanImageIO::CanReadFile(const char * name)
{
  // A single PNG is no volume: what reads images of two dimensions may have it.
  const voxelcore::ScanKind kind = voxelcore::ScanKindOf(name);
  return kind != voxelcore::ScanKind::Unknown && kind != voxelcore::ScanKind::Png;
}

ImageIORegion
LabelScanImageIO::GenerateStreamableReadRegionFromRequestedRegion(const ImageIORegion & requested) const
{
  return this->GetUseStreamedReading() ? requested
                                       : Superclass::GenerateStreamableReadRegionFromRequestedRegion(requested);
}

auto
LabelScanImageIO::Opened() -> State &
{
  if (!m_State || m_State->rows.Scan().path != this->GetFileName())
  {
    this->ReadImageInformation();
  }
  return *m_State;
}

void
LabelScanImageIO::ReadImageInformation()
{
  WithItkErrors(kWhere, [this] {
    m_State.reset();
    m_State = std::make_unique<State>(this->GetFileName(), m_Options);
  });
  const voxelcore::ScanFile &      scan = m_State->rows.Scan();
  const voxelcore::ImageGeometry & geometry = scan.geometry;
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
  this->SetComponentType(ComponentOf(m_State->PixelType()));
  m_Notes = scan.notes;
  m_Warnings = voxelcore::WarningsOf(scan);
}

void
LabelScanImageIO::ReadByRows(const RowFunction & take)
{
  State &                          state = this->Opened();
  const voxelcore::ImageGeometry & geometry = state.rows.Scan().geometry;
  // An image of fewer dimensions wants the first slice or row.
  std::array<std::uint64_t, 3> first{ 0, 0, 0 };
  std::array<std::uint64_t, 3> size{ 1, 1, 1 };
  const ImageIORegion &        region = this->GetIORegion();
  for (unsigned int axis = 0; axis < std::min(3U, region.GetImageDimension()); ++axis)
  {
    first[axis] = static_cast<std::uint64_t>(region.GetIndex(axis));
    size[axis] = region.GetSize(axis);
    if (region.GetIndex(axis) < 0 || first[axis] + size[axis] > static_cast<std::uint64_t>(geometry.size[axis]))
    {
      itkExceptionMacro("a region beyond the scan was asked for: " << region);
    }
  }
  const auto        sizeY = static_cast<std::uint64_t>(geometry.size[1]);
  const std::size_t rowBytes = state.rows.RowBytes();
  const std::size_t offset = first[0] * voxelcore::PixelBytes(state.PixelType());
  // Whole slices are one run of rows.
  const bool          wholeSlices = size[1] == sizeY;
  const std::uint64_t runs = wholeSlices ? 1 : size[2];
  const std::uint64_t rowsOfRun = wholeSlices ? size[1] * size[2] : size[1];
  WithItkErrors(kWhere, [&] {
    std::vector<std::byte> stored;
    std::vector<std::byte> work;
    for (std::uint64_t run = 0; run < runs; ++run)
    {
      const std::uint64_t begin = (first[2] + run) * sizeY + first[1];
      for (std::uint64_t row = begin; row < begin + rowsOfRun;)
      {
        const std::size_t count =
          std::min<std::uint64_t>(std::max<std::size_t>(1, kBlockBytes / rowBytes), begin + rowsOfRun - row);
        stored.resize(count * rowBytes);
        state.rows.Read(row, count, stored.data());
        for (std::size_t n = 0; n < count; ++n, ++row)
        {
          const Index<3> at{ { static_cast<IndexValueType>(first[0]),
                               static_cast<IndexValueType>(row % sizeY),
                               static_cast<IndexValueType>(row / sizeY) } };
          take(state.Delivered(stored.data() + n * rowBytes, row, work) + offset, at);
        }
      }
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
