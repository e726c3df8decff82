#include "voxelcore/LabelAssembler.h"

#include "GuardedCollector.h"
#include "voxelcore/TextFields.h"

#include <cmath>

namespace voxelcore
{
namespace
{

constexpr std::size_t kBlockBytes = 4U << 20;
constexpr double      kLengthTolerance = 1e-4; // as for right angles

PixelType
StoredType(LabelAssembler::Pixel pixel)
{
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

struct LabelAssembler::State
{
  ScanFile                          scan;
  std::size_t                       rowBytes = 0;
  std::unique_ptr<GuardedCollector> collector;
};

ImageGeometry
LabelAssembler::CheckGeometry(const std::string & name, const ImageGeometry & geometry, bool orthonormalize)
{
  ScanFile scan;
  scan.path = name;
  scan.geometry.size = geometry.size;
  CheckSize(scan.path, geometry.size, 1, UINT64_MAX);
  std::array<Vector3, 3> axes;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto & m = geometry.direction;
    axes[axis] = { m[axis], m[3 + axis], m[6 + axis] };
  }
  ReadOptions options;
  options.orthonormalize = orthonormalize;
  SetGeometry(scan, axes, geometry.spacing, geometry.origin, options);
  for (std::size_t axis = 0; axis < 3 && !orthonormalize; ++axis)
  {
    // SetGeometry takes axes of any length; in memory another length would be another spacing.
    const double length = std::hypot(axes[axis][0], axes[axis][1], axes[axis][2]);
    if (!(std::abs(length - 1) <= kLengthTolerance))
    {
      RefuseInput(scan.path,
                  Text("axis ", "ijk"[axis], " of its direction has length ", Number(length)),
                  "mend it, or accept the nearest right-angled axes of length 1 with --orthonormalize");
    }
  }
  return scan.geometry;
}

LabelAssembler::LabelAssembler(const std::string &   name,
                               const ImageGeometry & geometry,
                               Pixel                 pixel,
                               const ReadOptions &   options)
  : m_State(std::make_unique<State>())
{
  ScanFile & scan = m_State->scan;
  scan.path = name;
  scan.type = StoredType(pixel);
  scan.geometry = geometry;
  m_State->rowBytes = static_cast<std::size_t>(geometry.size[0]) * pixel.bytes;
  m_State->collector = std::make_unique<GuardedCollector>(scan, options, ResolveCrop({}, geometry.size, name));
}

LabelAssembler::~LabelAssembler() = default;

std::size_t
LabelAssembler::RowsAtATime() const
{
  return std::max<std::size_t>(1, kBlockBytes / m_State->rowBytes);
}

void
LabelAssembler::AddRows(const void * rows, std::uint64_t firstRow, std::size_t rowCount)
{
  m_State->collector->AddRows(static_cast<const std::byte *>(rows), firstRow, rowCount);
  m_State->collector->FinishSlab();
}

std::vector<LabelShape>
LabelAssembler::TakeShapes()
{
  return m_State->collector->TakeShapes();
}

} // namespace voxelcore
