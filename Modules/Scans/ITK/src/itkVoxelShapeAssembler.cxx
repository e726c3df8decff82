#include "itkVoxelShapeAssembler.h"

#include "itkErrors.h"
#include "voxelcore/Lattice/CheckedGeometry.h"
#include "voxelcore/Masks/ShapeEdits.h"

namespace itk
{
namespace
{

constexpr const char * kAssembler = "LabelImageToVoxelShapeFilter";
constexpr const char * kName = "the input image"; // where a scan's message names its file

} // namespace

struct VoxelShapeAssembler::State
{
  voxelcore::ImageGeometry                   geometry;
  std::unique_ptr<voxelcore::LabelAssembler> assembler;
};

voxelcore::ImageGeometry
VoxelShapeAssembler::CheckGeometry(const voxelcore::ImageGeometry & geometry, bool orthonormalize)
{
  return WithItkErrors(kAssembler, [&] { return voxelcore::CheckedGeometry(kName, geometry, orthonormalize); });
}

VoxelShapeAssembler::VoxelShapeAssembler(const voxelcore::ImageGeometry & geometry,
                                         voxelcore::LabelAssembler::Pixel pixel,
                                         const voxelcore::LabelChoice &   choice)
  : m_State(std::make_unique<State>())
{
  m_State->geometry = geometry;
  WithItkErrors(kAssembler, [&] {
    m_State->assembler = std::make_unique<voxelcore::LabelAssembler>(kName, geometry, pixel, choice);
  });
}

VoxelShapeAssembler::~VoxelShapeAssembler() = default;

std::size_t
VoxelShapeAssembler::RowsAtATime() const
{
  return m_State->assembler->RowsAtATime();
}

void
VoxelShapeAssembler::AddRows(const void * rows, std::uint64_t firstRow, std::size_t rowCount)
{
  WithItkErrors(kAssembler, [&] { m_State->assembler->AddRows(rows, firstRow, rowCount); });
}

std::vector<voxelcore::LabelShape>
VoxelShapeAssembler::TakeShapes(const std::string & connectivity, std::vector<std::string> & warnings)
{
  return WithItkErrors(kAssembler, [&] {
    auto shapes = m_State->assembler->TakeShapes();
    warnings = voxelcore::ConnectLabels(shapes, m_State->geometry, voxelcore::RequireConnectivity(connectivity), kName);
    return shapes;
  });
}

} // namespace itk
