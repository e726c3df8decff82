#pragma once
// What filters over the labels of a VoxelShapeObject have in common: requests, and progress by each label's voxels.

#include "itkErrors.h"
#include "itkVoxelShapeObject.h"
#include "voxelcore/Certified/Certified.h"

#include <optional>

namespace itk
{

/** What is asked of a label: pruned by `tolerance`, or its whole core; `isRefined`: refined where cores usually are. */
inline voxelcore::CertifiedRequest
RequestOf(const voxelcore::LabelShape & label, const std::optional<voxelcore::Tolerance> & tolerance, bool isRefined)
{
  voxelcore::CertifiedRequest request;
  request.name = voxelcore::LabelText(label.value, label.name);
  request.lambdas = { voxelcore::Lambda() };
  if (tolerance)
  {
    request.tolerances = { *tolerance };
  }
  if (!isRefined)
  {
    request.surface = voxelcore::SurfaceSource();
  }
  return request;
}

/** Calls `each` with every label and its part of the filter's progress. */
template <typename TEach>
void
EachLabel(ProcessObject * filter, const VoxelShapeObject & shapes, const TEach & each)
{
  shapes.RequireWithinGeometry(); // which may have been set anew after the labels
  const VoxelShapeObject::LabelContainer & labels = shapes.GetLabels();
  double                                   total = 0;
  for (const voxelcore::LabelShape & label : labels)
  {
    total += 1 + static_cast<double>(label.voxels);
  }
  double before = 0;
  for (const voxelcore::LabelShape & label : labels)
  {
    const double share = (1 + static_cast<double>(label.voxels)) / total;
    each(label, ForwardProgress(filter, before, before + share));
    before += share;
  }
  voxelcore::ReportProgress(ForwardProgress(filter, 0, 1), "done", 1);
}

} // namespace itk
