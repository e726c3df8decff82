#include "voxelcore/Report/ResultRecords.h"

#include <utility>

namespace voxelcore
{

SkeletonPart
TakeSkeleton(CertifiedSkeleton skeleton, LabelRecord & record)
{
  SkeletonPart part = std::move(skeleton.skeleton);
  part.label = record.label;
  part.component = record.component;
  part.name = record.name;
  record.standOut = skeleton.standOut;
  record.skeleton = { skeleton.topology,          part.table.numbers, std::move(skeleton.cuts), {},
                      std::move(skeleton.border), part.network };
  return part;
}

CertifiedShape
RecordedShape(const CoreReport & made, const LabelRecord & label)
{
  return { LabelText(label.label, label.name), label.shape, label.box, made.input.geometry };
}

} // namespace voxelcore
