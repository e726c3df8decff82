#include "ColorScale.h"

#include "voxelcore/Models/DisplayColors.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

vtkSmartPointer<vtkLookupTable>
MakeTable(const ColorRange & range)
{
  constexpr int kColors = 256;
  auto          table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(kColors);
  for (int i = 0; i < kColors; ++i)
  {
    const Color color = LengthColor((i + 0.5) / kColors);
    table->SetTableValue(i, color[0], color[1], color[2], 1);
  }
  table->SetNanColor(0.6, 0.6, 0.6, 1);
  if (!range.IsEmpty())
  {
    // One value everywhere has the colour in the middle.
    const double room = range.high > range.low ? 0 : std::max(std::abs(range.low), 1e-30);
    table->SetRange(range.low - room, range.high + room);
  }
  return table;
}

} // namespace

ColorScale::ColorScale(const DisplayContent & content, const PictureOptions & options)
{
  const LabelRanges ranges = RangesOfLabels(content.labels, options.coloring, options.shares);
  m_Range = ranges.all;
  if (!IsShown())
  {
    return;
  }
  if (options.range)
  {
    m_Range.low = (*options.range)[0];
    m_Range.high = (*options.range)[1];
  }
  const bool eachLabel = options.eachLabel.value_or(!options.range && NeedOwnRanges(ranges.each, m_Range));
  m_Bar = DescribeColorBar(options, m_Range, eachLabel, content.unit);
  if (!eachLabel)
  {
    m_Tables = { MakeTable(m_Range) };
    return;
  }
  for (const LabelRange & label : ranges.each)
  {
    m_Tables.push_back(MakeTable(label.range));
  }
}

} // namespace voxelcore
