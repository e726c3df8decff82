#include "itkVoxelShapeObject.h"

#include <algorithm>

namespace itk
{
namespace
{

/** The first label not below `value`. */
auto
Place(const VoxelShapeObject::LabelContainer & labels, VoxelShapeObject::LabelType value)
{
  return std::lower_bound(labels.begin(), labels.end(), value, [](const auto & label, auto wanted) {
    return label.value < wanted;
  });
}

} // namespace

VoxelShapeObject::VoxelShapeObject()
  : m_Labels(std::make_shared<const LabelContainer>())
{}

void
VoxelShapeObject::SetLabels(LabelContainer labels)
{
  std::sort(labels.begin(), labels.end(), [](const auto & a, const auto & b) { return a.value < b.value; });
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    if (i > 0 && labels[i - 1].value == labels[i].value)
    {
      itkExceptionMacro("label " << labels[i].value << " is given twice");
    }
  }
  this->RequireWithinGeometry(labels);
  m_Labels = std::make_shared<const LabelContainer>(std::move(labels));
  this->Modified();
}

void
VoxelShapeObject::RequireWithinGeometry() const
{
  this->RequireWithinGeometry(*m_Labels);
}

void
VoxelShapeObject::RequireWithinGeometry(const LabelContainer & labels) const
{
  for (const LabelShapeType & label : labels)
  {
    const voxelcore::VoxelBox & box = label.shape.Box();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (box.lower[axis] < 0 || std::int64_t{ box.lower[axis] } + box.size[axis] > this->GetGeometry().size[axis])
      {
        itkExceptionMacro("the shape of label " << label.value << " reaches beyond the image; set its geometry first");
      }
    }
  }
}

bool
VoxelShapeObject::HasLabel(LabelType value) const
{
  const auto place = Place(*m_Labels, value);
  return place != m_Labels->end() && place->value == value;
}

auto
VoxelShapeObject::GetLabel(LabelType value) const -> const LabelShapeType &
{
  if (!this->HasLabel(value))
  {
    itkExceptionMacro("there is no label " << value);
  }
  return *Place(*m_Labels, value);
}

void
VoxelShapeObject::Initialize()
{
  Superclass::Initialize();
  m_Labels = std::make_shared<const LabelContainer>();
}

void
VoxelShapeObject::Graft(const DataObject * data)
{
  Superclass::Graft(data);
  const auto * other = dynamic_cast<const Self *>(data);
  if (other == nullptr)
  {
    itkExceptionMacro("only a VoxelShapeObject can be grafted onto one");
  }
  this->CopyInformation(other);
  if (m_Labels != other->m_Labels)
  {
    m_Labels = other->m_Labels;
    this->Modified();
  }
}

void
VoxelShapeObject::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Labels: " << m_Labels->size() << std::endl;
  for (const LabelShapeType & label : *m_Labels)
  {
    os << indent.GetNextIndent() << label.value << " (" << label.name << "): " << label.voxels << " voxels"
       << std::endl;
  }
}

} // namespace itk
