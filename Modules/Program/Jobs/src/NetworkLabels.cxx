#include "voxelcore/Jobs/NetworkLabels.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Certified/CertifiedNetwork.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Shape/LabelContacts.h"

#include <utility>

namespace voxelcore
{

NetworkLabels::NetworkLabels(std::vector<LabelShape> &  labels,
                             const std::string &        where,
                             std::vector<std::string> & notes)
{
  if (labels.size() < 2)
  {
    throw InputError(where + ": a network is of several labels, and here is one; leave out --network");
  }
  std::uint64_t all = 0;
  for (const LabelShape & label : labels)
  {
    all += label.voxels;
  }
  m_Labels = WithoutSharedVoxels(std::move(labels));
  LabelShape whole{ 1, "network", 0, UnionOfLabels(m_Labels) };
  whole.voxels = whole.shape.CountVoxels();
  if (all > whole.voxels)
  {
    notes.push_back(std::to_string(all - whole.voxels) +
                    " voxels are of several labels; in the network each is of the label with the smallest value");
  }
  labels.clear();
  labels.push_back(std::move(whole));
}

void
NetworkLabels::Fit(const EditedLabel &             edited,
                   const ImageGeometry &           geometry,
                   const std::optional<VoxelBox> & scan,
                   const SkeletonRequest &         request)
{
  m_Shape = scan ? UpToBorder(edited.label.shape, geometry, *scan, request).shape : edited.label.shape;
  if (edited.edits)
  {
    m_Labels = LabelsWithin(std::move(m_Labels), edited.label.shape);
  }
}

void
NetworkLabels::Take(LabelOutcome &             outcome,
                    const SkeletonRequest &    request,
                    const CoreReport &         report,
                    std::vector<std::string> & notes) const
{
  LabelRecord &         record = outcome.record;
  const ImageGeometry & geometry = report.input.geometry;
  CertifiedSkeleton     skeleton{ std::move(*outcome.skeleton),
                              record.skeleton->topology,
                              {},
                              std::move(record.skeleton->border) };
  MakeNetwork(skeleton, m_Labels, m_Shape, geometry, LabelText(record.label, record.name));
  CutAndMeasure(skeleton,
                request.branches,
                InMeanVoxels(request.standOut, report.parameters.weights, geometry.spacing, record.box));
  outcome.skeleton = TakeSkeleton(std::move(skeleton), record);
  for (std::string & line : NetworkInWords(*outcome.skeleton, geometry.unit))
  {
    notes.push_back(std::move(line));
  }
}

} // namespace voxelcore
