#include "itkMedialComplexObject.h"

#include "itkErrors.h"
#include "voxelcore/Certified/Certified.h"

#include <algorithm>

namespace itk
{
namespace
{

/** The first part not below `label`. */
auto
Place(const MedialComplexObject::PartContainer & parts, MedialComplexObject::LabelType label)
{
  return std::lower_bound(parts.begin(), parts.end(), label, [](const auto & part, auto wanted) {
    return part.origin.label < wanted;
  });
}

void
PrintTopology(std::ostream & os, const voxelcore::TopologyNumbers & topology)
{
  os << "Euler number " << topology.euler << ", Betti numbers " << topology.betti[0] << ' ' << topology.betti[1] << ' '
     << topology.betti[2];
}

} // namespace

MedialComplexObject::MedialComplexObject()
  : m_Parts(std::make_shared<const PartContainer>())
{}

void
MedialComplexObject::SetParts(PartContainer parts)
{
  std::sort(parts.begin(), parts.end(), [](const auto & a, const auto & b) { return a.origin.label < b.origin.label; });
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    if (i > 0 && parts[i - 1].origin.label == parts[i].origin.label)
    {
      itkExceptionMacro("label " << parts[i].origin.label << " is given twice");
    }
    if (!parts[i].core)
    {
      itkExceptionMacro("label " << parts[i].origin.label << " has no core");
    }
  }
  m_Parts = std::make_shared<const PartContainer>(std::move(parts));
  this->Modified();
}

bool
MedialComplexObject::HasLabel(LabelType label) const
{
  const auto place = Place(*m_Parts, label);
  return place != m_Parts->end() && place->origin.label == label;
}

auto
MedialComplexObject::GetPart(LabelType label) const -> const Part &
{
  if (!this->HasLabel(label))
  {
    itkExceptionMacro("there is no label " << label);
  }
  return *Place(*m_Parts, label);
}

std::string
MedialComplexObject::GetRefined() const
{
  const bool refined = !m_Parts->empty() && m_Parts->front().core->numbers.refined;
  return refined ? voxelcore::PruningOf(m_Parts->front().core->numbers).refined : std::string();
}

std::string
MedialComplexObject::GetProvenance(bool keepEdges) const
{
  std::vector<voxelcore::CoreOrigin>  origins;
  std::vector<voxelcore::CorePruning> prunings;
  for (const Part & part : *m_Parts)
  {
    origins.push_back(part.origin);
    prunings.push_back(voxelcore::PruningOf(part.core->numbers));
  }
  return WithItkErrors(this->GetNameOfClass(), [&] {
    return voxelcore::CoreProvenanceJson(this->GetGeometry(), origins, prunings, keepEdges);
  });
}

void
MedialComplexObject::Initialize()
{
  Superclass::Initialize();
  m_Parts = std::make_shared<const PartContainer>();
}

void
MedialComplexObject::Graft(const DataObject * data)
{
  Superclass::Graft(data);
  const auto * other = dynamic_cast<const Self *>(data);
  if (other == nullptr)
  {
    itkExceptionMacro("only a MedialComplexObject can be grafted onto one");
  }
  this->CopyInformation(other);
  if (m_Parts != other->m_Parts)
  {
    m_Parts = other->m_Parts;
    this->Modified();
  }
}

void
MedialComplexObject::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Parts: " << m_Parts->size() << std::endl;
  const Indent inner = indent.GetNextIndent();
  for (const Part & part : *m_Parts)
  {
    const voxelcore::CoreNumbers &   numbers = part.core->numbers;
    const voxelcore::ComplexRecord & complex = numbers.complex;
    os << inner << part.origin.label << " (" << part.origin.name << "): " << complex.vertices << " vertices, "
       << complex.edges << " edges, " << complex.faces << " faces, pruned at " << numbers.lambda << std::endl;
    os << inner.GetNextIndent() << "shape: ";
    PrintTopology(os, part.origin.shape);
    os << "; core: ";
    PrintTopology(os, complex.topology);
    os << std::endl;
  }
}

} // namespace itk
