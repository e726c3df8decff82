#include "itkVoxelLatticeObject.h"

namespace itk
{
namespace
{

template <typename TValues>
void
PrintValues(std::ostream & os, Indent indent, const char * name, const TValues & values)
{
  os << indent << name << ":";
  for (const auto & value : values)
  {
    os << ' ' << value;
  }
  os << std::endl;
}

} // namespace

void
VoxelLatticeObject::SetGeometry(const voxelcore::ImageGeometry & geometry)
{
  if (m_Geometry.size != geometry.size || m_Geometry.spacing != geometry.spacing ||
      m_Geometry.origin != geometry.origin || m_Geometry.direction != geometry.direction)
  {
    m_Geometry = geometry;
    this->Modified();
  }
}

void
VoxelLatticeObject::SetStartIndex(const IndexType & index)
{
  if (m_StartIndex != index)
  {
    m_StartIndex = index;
    this->Modified();
  }
}

auto
VoxelLatticeObject::TransformLatticeToPhysicalPoint(const voxelcore::Vector3 & lattice) const -> PointType
{
  const voxelcore::Vector3 physical = voxelcore::LatticeToPhysical(m_Geometry, lattice);
  return PointType(physical.data());
}

void
VoxelLatticeObject::CopyInformation(const DataObject * data)
{
  Superclass::CopyInformation(data);
  if (const auto * other = dynamic_cast<const Self *>(data))
  {
    this->SetGeometry(other->m_Geometry);
    this->SetStartIndex(other->m_StartIndex);
  }
}

void
VoxelLatticeObject::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  PrintValues(os, indent, "Size", m_Geometry.size);
  PrintValues(os, indent, "Spacing", m_Geometry.spacing);
  PrintValues(os, indent, "Origin", m_Geometry.origin);
  PrintValues(os, indent, "Direction", m_Geometry.direction);
  os << indent << "StartIndex: " << m_StartIndex << std::endl;
}

} // namespace itk
