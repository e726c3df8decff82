// Files of formats that ITK's own ImageIOs read.

#include "ImageIOHeaders.h"
#include "ScanSource.h"
#include "voxelcore/Base/TextFields.h"

#include <itkGiplImageIO.h>
#include <itkHDF5ImageIO.h>
#include <itkMINCImageIO.h>
#include <itkMRCImageIO.h>
#include <itkVTKImageIO.h>
#include <itkVersion.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace voxelcore::itkreader
{
namespace
{

constexpr std::size_t kSlabBytes = 8U << 20;

itk::ImageIOBase::Pointer
MakeImageIO(ItkFormat format)
{
  switch (format)
  {
    case ItkFormat::Mrc:
      return itk::MRCImageIO::New().GetPointer();
    case ItkFormat::Minc:
      return itk::MINCImageIO::New().GetPointer();
    case ItkFormat::Gipl:
      return itk::GiplImageIO::New().GetPointer();
    case ItkFormat::Vtk:
      return itk::VTKImageIO::New().GetPointer();
    default:
      return itk::HDF5ImageIO::New().GetPointer();
  }
}

const char *
FormatTitle(ItkFormat format)
{
  switch (format)
  {
    case ItkFormat::Mrc:
      return "MRC";
    case ItkFormat::Minc:
      return "MINC";
    case ItkFormat::Gipl:
      return "GIPL";
    case ItkFormat::Vtk:
      return "VTK";
    default:
      return "ITK HDF5";
  }
}

PixelType
TypeOf(const std::filesystem::path & path, itk::IOComponentEnum component)
{
  using itk::IOComponentEnum;
  switch (component)
  {
    case IOComponentEnum::UCHAR:
      return PixelType::UInt8;
    case IOComponentEnum::CHAR:
      return PixelType::Int8;
    case IOComponentEnum::USHORT:
      return PixelType::UInt16;
    case IOComponentEnum::SHORT:
      return PixelType::Int16;
    case IOComponentEnum::UINT:
      return PixelType::UInt32;
    case IOComponentEnum::INT:
      return PixelType::Int32;
    case IOComponentEnum::ULONG:
    case IOComponentEnum::ULONGLONG:
      return PixelType::UInt64;
    case IOComponentEnum::LONG:
    case IOComponentEnum::LONGLONG:
      return PixelType::Int64;
    case IOComponentEnum::FLOAT:
      return PixelType::Float32;
    case IOComponentEnum::DOUBLE:
      return PixelType::Float64;
    default:
      RefuseInput(path, "voxels that are no numbers", "save it with a type of whole numbers");
  }
}

class ImageIOSource : public ScanSource
{
public:
  ImageIOSource(const std::filesystem::path & path, ItkFormat format)
    : m_Path(path)
    , m_Format(format)
    , m_IO(MakeImageIO(format))
  {
    if (!m_IO->CanReadFile(path.c_str()))
    {
      RefuseInput(path,
                  Text("ITK's ", m_IO->GetNameOfClass(), " does not know it"),
                  "the file is damaged or another's: write it anew");
    }
    CheckBeforeItk(path, format);
    m_IO->SetFileName(path.string());
    m_IO->ReadImageInformation();
    const unsigned int dimensions = m_IO->GetNumberOfDimensions();
    if (dimensions < 3 || dimensions > 4)
    {
      RefuseInput(path, Text(dimensions, "-D image"), "save one volume with three axes in space");
    }
    scan.format = FormatTitle(format);
    scan.files = { path };
    scan.type = TypeOf(path, m_IO->GetComponentType());
    scan.components = m_IO->GetNumberOfComponents();
    scan.volumes = dimensions == 4 ? m_IO->GetDimensions(3) : 1;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      scan.size[axis] = static_cast<std::int64_t>(m_IO->GetDimensions(axis));
      scan.spacing[axis] = m_IO->GetSpacing(axis);
      scan.origin[axis] = m_IO->GetOrigin(axis);
      const std::vector<double> direction = m_IO->GetDirection(axis);
      scan.axes[axis] = { direction.at(0), direction.at(1), direction.at(2) };
    }
    scan.notes.push_back(Text("read by ITK's ", m_IO->GetNameOfClass(), " (", itk::Version::GetITKVersion(), ")"));
    CheckHeader(path, format, scan);
    scan.storedType = PixelName(scan.type);
  }

  void
  Send(std::uint64_t volume, std::uint64_t, const Sink & sink) override
  {
    if (m_Format == ItkFormat::Minc && scan.type == PixelType::Float32)
    {
      // MINCImageIO makes scaled whole numbers of any width single precision.
      return SendVolume(volume, [&](const char * bytes, std::size_t count) {
        for (std::size_t at = 0; at < count; at += sizeof(float))
        {
          const double value = StoredValue<float>(reinterpret_cast<const std::byte *>(bytes + at));
          if (std::abs(value) >= 16777216.0) // 2^24
          {
            RefuseInput(m_Path, Text("value ", Number(value), ", which ITK rounds"), "convert it with mnc2nii");
          }
        }
        sink(bytes, count);
      });
    }
    SendVolume(volume, sink);
  }

private:
  void
  SendVolume(std::uint64_t volume, const Sink & sink)
  {
    const unsigned int dimensions = m_IO->GetNumberOfDimensions();
    const std::size_t  sliceBytes = static_cast<std::size_t>(scan.size[0]) * static_cast<std::size_t>(scan.size[1]) *
                                   PixelBytes(scan.type) * scan.components;
    const auto         slices = static_cast<std::size_t>(scan.size[2]);
    const bool         streams = m_IO->CanStreamRead();
    itk::ImageIORegion region(dimensions);
    for (unsigned int axis = 0; axis < dimensions; ++axis)
    {
      region.SetIndex(axis, 0);
      region.SetSize(axis, m_IO->GetDimensions(axis));
    }
    std::vector<char> slab;
    if (!streams) // the whole file at once
    {
      slab.resize(sliceBytes * slices * scan.volumes);
      m_IO->SetIORegion(region);
      m_IO->Read(slab.data());
      sink(slab.data() + volume * sliceBytes * slices, sliceBytes * slices);
      return;
    }
    m_IO->SetUseStreamedReading(true);
    const std::size_t step = std::max<std::size_t>(1, kSlabBytes / sliceBytes);
    for (std::size_t k = 0; k < slices; k += step)
    {
      const std::size_t count = std::min(step, slices - k);
      region.SetIndex(2, static_cast<itk::IndexValueType>(k));
      region.SetSize(2, count);
      if (dimensions == 4)
      {
        region.SetIndex(3, static_cast<itk::IndexValueType>(volume));
        region.SetSize(3, 1);
      }
      slab.resize(sliceBytes * count);
      m_IO->SetIORegion(region);
      m_IO->Read(slab.data());
      sink(slab.data(), slab.size());
    }
  }

  std::filesystem::path     m_Path;
  ItkFormat                 m_Format;
  itk::ImageIOBase::Pointer m_IO;
};

} // namespace

std::unique_ptr<ScanSource>
OpenByImageIO(const std::filesystem::path & path, ItkFormat format, const std::string & dataset)
{
  if (format == ItkFormat::Hdf5 && (!dataset.empty() || !MakeImageIO(format)->CanReadFile(path.c_str())))
  {
    return OpenHdf5(path, dataset);
  }
  return std::make_unique<ImageIOSource>(path, format);
}

} // namespace voxelcore::itkreader
