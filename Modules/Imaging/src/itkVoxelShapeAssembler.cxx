#include "itkVoxelShapeAssembler.h"

#include "LabelCollector.h"
#include "TextFields.h"
#include "itkErrors.h"

#include <cmath>

namespace itk
{
namespace
{

constexpr const char * kWhere = "LabelImageToVoxelShapeFilter";
constexpr const char * kName = "the input image"; // where a scan's message names its file
constexpr std::size_t  kBlockBytes = 4U << 20;
constexpr double       kLengthTolerance = 1e-4; // as for right angles

voxelcore::PixelType
StoredType(VoxelShapeAssembler::PixelType pixel)
{
  using voxelcore::PixelType;
  if (pixel.isReal)
  {
    return pixel.bytes == 4 ? PixelType::Float32 : PixelType::Float64;
  }
  switch (pixel.bytes)
  {
    case 1:
      return pixel.isSigned ? PixelType::Int8 : PixelType::UInt8;
    case 2:
      return pixel.isSigned ? PixelType::Int16 : PixelType::UInt16;
    case 4:
      return pixel.isSigned ? PixelType::Int32 : PixelType::UInt32;
    default:
      return pixel.isSigned ? PixelType::Int64 : PixelType::UInt64;
  }
}

} // namespace

struct VoxelShapeAssembler::State
{
  voxelcore::ScanFile                        scan;
  std::size_t                                rowBytes = 0;
  std::unique_ptr<voxelcore::LabelCollector> collector;
};

voxelcore::ImageGeometry
VoxelShapeAssembler::CheckGeometry(const voxelcore::ImageGeometry & geometry, bool orthonormalize)
{
  return WithItkErrors(kWhere, [&] {
    voxelcore::ScanFile scan;
    scan.path = kName;
    scan.geometry.size = geometry.size;
    voxelcore::CheckSize(scan.path, geometry.size, 1, UINT64_MAX);
    std::array<voxelcore::Vector3, 3> axes;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto & m = geometry.direction;
      axes[axis] = { m[axis], m[3 + axis], m[6 + axis] };
    }
    voxelcore::ReadOptions options;
    options.orthonormalize = orthonormalize;
    voxelcore::SetGeometry(scan, axes, geometry.spacing, geometry.origin, options);
    for (std::size_t axis = 0; axis < 3 && !orthonormalize; ++axis)
    {
      // SetGeometry takes axes of any length; to ITK another length is another spacing.
      const double length = std::hypot(axes[axis][0], axes[axis][1], axes[axis][2]);
      if (!(std::abs(length - 1) <= kLengthTolerance))
      {
        voxelcore::Refuse(
          scan.path,
          voxelcore::Text("axis ", "ijk"[axis], " of its direction has length ", voxelcore::Number(length)),
          "mend it, or accept the nearest right-angled axes of length 1 with --orthonormalize");
      }
    }
    return scan.geometry;
  });
}

VoxelShapeAssembler::VoxelShapeAssembler(const voxelcore::ImageGeometry & geometry,
                                         PixelType                        pixel,
                                         const voxelcore::ReadOptions &   options)
  : m_State(std::make_unique<State>())
{
  WithItkErrors(kWhere, [&] {
    voxelcore::ScanFile & scan = m_State->scan;
    scan.path = kName;
    scan.type = StoredType(pixel);
    scan.geometry = geometry;
    m_State->rowBytes = static_cast<std::size_t>(geometry.size[0]) * pixel.bytes;
    m_State->collector = std::make_unique<voxelcore::LabelCollector>(scan, options, voxelcore::ResolveCrop(scan, {}));
  });
}

VoxelShapeAssembler::~VoxelShapeAssembler() = default;

std::size_t
VoxelShapeAssembler::RowsAtATime() const
{
  return std::max<std::size_t>(1, kBlockBytes / m_State->rowBytes);
}

void
VoxelShapeAssembler::AddRows(const void * rows, std::uint64_t firstRow, std::size_t rowCount)
{
  WithItkErrors(kWhere, [&] {
    m_State->collector->AddRows(static_cast<const std::byte *>(rows), firstRow, rowCount);
    m_State->collector->FinishSlab();
  });
}

std::vector<voxelcore::LabelShape>
VoxelShapeAssembler::TakeShapes()
{
  return WithItkErrors(kWhere, [&] { return m_State->collector->TakeShapes(); });
}

} // namespace itk
