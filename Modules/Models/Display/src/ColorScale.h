#pragma once
// The colours of lengths as VTK draws them.

#include "ColorBar.h"

#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

namespace voxelcore
{

/** A colour table for each label, all alike unless each has its own range. */
class ColorScale
{
public:
  ColorScale(const DisplayContent & content, const PictureOptions & options);

  /** Whether colours mean lengths. */
  bool
  IsShown() const
  {
    return !m_Range.IsEmpty();
  }

  /** Null where they do not. */
  vtkLookupTable *
  Table(std::size_t label) const
  {
    return IsShown() ? m_Tables[m_Tables.size() > 1 ? label : 0].Get() : nullptr;
  }

  const ColorBar &
  Bar() const
  {
    return m_Bar;
  }

private:
  ColorRange                                   m_Range;
  std::vector<vtkSmartPointer<vtkLookupTable>> m_Tables;
  ColorBar                                     m_Bar;
};

} // namespace voxelcore
