#include "RootLevels.h"

#include "MeanOfKnown.h"

#include <algorithm>

namespace voxelcore
{

namespace
{

RootLevelRecord
SumUp(const RootHierarchy &           hierarchy,
      const std::vector<RootRecord> & roots,
      RootLevelRecord::Kind           kind,
      std::int32_t                    level)
{
  using Kind = RootLevelRecord::Kind;
  RootLevelRecord sum;
  sum.kind = kind;
  sum.level = level;
  MeanOfKnown length, diameter, tortuosity, emergence, midpoint, tip, emergenceDown, midpointDown, tipDown, children;
  for (std::size_t axis = 0; axis < roots.size(); ++axis)
  {
    const std::int32_t of = hierarchy.axes[axis].level;
    const RootRecord & root = roots[axis];
    if ((kind == Kind::Level && of != level) || (kind == Kind::Laterals && of == 0))
    {
      continue;
    }
    ++sum.count;
    sum.totalLength += root.length;
    sum.volume += root.volume;
    sum.surface += root.surface;
    length.Add(root.length);
    diameter.Add(root.meanDiameter, root.length);
    tortuosity.Add(root.tortuosity);
    emergence.Add(root.emergenceAngle);
    midpoint.Add(root.midpointAngle);
    tip.Add(root.tipAngle);
    emergenceDown.Add(root.emergenceFromDown);
    midpointDown.Add(root.midpointFromDown);
    tipDown.Add(root.tipFromDown);
    children.Add(root.children);
  }
  sum.meanLength = length.Value();
  sum.meanDiameter = diameter.Value();
  sum.meanTortuosity = tortuosity.Value();
  sum.meanEmergenceAngle = emergence.Value();
  sum.meanMidpointAngle = midpoint.Value();
  sum.meanTipAngle = tip.Value();
  sum.meanEmergenceFromDown = emergenceDown.Value();
  sum.meanMidpointFromDown = midpointDown.Value();
  sum.meanTipFromDown = tipDown.Value();
  sum.meanChildren = children.Value();
  return sum;
}

} // namespace

std::vector<RootLevelRecord>
SumLevels(const RootHierarchy & hierarchy, const std::vector<RootRecord> & roots)
{
  using Kind = RootLevelRecord::Kind;
  std::vector<RootLevelRecord> levels;
  std::int32_t                 deepest = -1;
  for (const RootAxis & axis : hierarchy.axes)
  {
    deepest = std::max(deepest, axis.level);
  }
  for (std::int32_t level = 0; level <= deepest; ++level)
  {
    levels.push_back(SumUp(hierarchy, roots, Kind::Level, level));
  }
  levels.push_back(SumUp(hierarchy, roots, Kind::Laterals, 0));
  levels.push_back(SumUp(hierarchy, roots, Kind::All, 0));
  return levels;
}

} // namespace voxelcore
