#include "voxelcore/Certified/CertifiedNetwork.h"

#include "CertificateText.h"
#include "SkeletonSteps.h"
#include "voxelcore/Base/LengthUnit.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Skeleton/LabelNetwork.h"
#include "voxelcore/Verification/NetworkVerification.h"

#include <algorithm>

namespace voxelcore
{

void
MakeNetwork(CertifiedSkeleton &             skeleton,
            const std::vector<LabelShape> & labels,
            const VoxelShape &              shape,
            const ImageGeometry &           geometry,
            const std::string &             name)
{
  SkeletonGraph & graph = skeleton.skeleton.graph;
  skeleton.skeleton.network = CutAtLabels(graph, labels, shape, geometry);
  const SkeletonNetwork & network = *skeleton.skeleton.network;
  NetworkClaims           claims;
  for (const LabelShape & label : labels)
  {
    claims.labels.emplace_back(label.value, &label.shape);
  }
  claims.positions = graph.positions;
  claims.pointLabels = graph.labels;
  claims.contactPoints = graph.contact;
  claims.branchOffsets = graph.branchOffsets;
  claims.branchPoints = graph.branchPoints;
  claims.faceOffsets = graph.faceOffsets;
  claims.faceVertices = graph.faceVertices;
  for (const NetworkContact & contact : network.contacts)
  {
    claims.contacts.push_back({ contact.labels, contact.voxels, contact.faces, contact.places });
  }
  for (const NetworkGap & gap : network.gaps)
  {
    claims.gaps.push_back(gap.place);
  }
  claims.components = skeleton.topology.betti[0];
  claims.euler = skeleton.topology.euler;
  if (const std::vector<std::string> problems = CheckNetwork(claims); !problems.empty())
  {
    RefuseResult(name, problems.front());
  }
  RequireEnclosed(graph, shape, { name, skeleton.topology, shape.Box(), geometry });
}

std::vector<std::string>
NetworkInWords(const MeasuredSkeleton & skeleton, SpatialUnit unit)
{
  const SkeletonNetwork &  network = *skeleton.network;
  std::vector<std::string> lines;
  const auto               label = [&](std::int64_t value) {
    const auto own = ranges::find(network.labels, value, &NetworkLabel::value);
    return LabelText(value, own->name);
  };
  double extent = 0;
  for (const auto & position : skeleton.graph.positions)
  {
    extent = std::max({ extent, std::abs(position[0]), std::abs(position[1]), std::abs(position[2]) });
  }
  const LengthUnit lengths = LengthUnit::For(extent, unit);
  const auto       at = [&](const std::array<double, 3> & place) {
    return "at " + lengths.Text(place[0]) + ", " + lengths.Text(place[1]) + ", " + lengths.Text(place[2]) + " (LPS " +
           lengths.Name() + ")";
  };
  for (const NetworkLabel & one : network.labels)
  {
    bool hasLine = false;
    for (std::size_t branch = 0; branch < skeleton.graph.BranchCount(); ++branch)
    {
      hasLine = hasLine || skeleton.graph.BranchLabel(branch) == one.value;
    }
    if (!hasLine)
    {
      lines.push_back(label(one.value) +
                      " has no line: no branch of the network runs through it; keep shorter branches with --stand-out "
                      "0 --prune-branches 0, or give the label by itself");
    }
  }
  for (const NetworkContact & contact : network.contacts)
  {
    const std::string two = label(contact.labels[0]) + " and " + label(contact.labels[1]);
    if (contact.places.empty())
    {
      lines.push_back(two + " touch " + at(contact.centre) + ", and the network does not pass there: " +
                      (contact.faces == 0 ? "they share edges and corners alone"
                                          : "it runs past their contact of " + lengths.Text(contact.areaMm2, 2) + " " +
                                              lengths.Name(2)));
    }
    else if (contact.places.size() > 1)
    {
      lines.push_back(two + " are one body around their contact " + at(contact.centre) + ": they meet there in " +
                      std::to_string(contact.places.size()) + " nodes");
    }
  }
  for (const NetworkGap & gap : network.gaps)
  {
    lines.push_back(label(gap.labels[0]) + " and " + label(gap.labels[1]) + " do not touch, and meet " + at(gap.place) +
                    ": an edit of the shape has joined them");
  }
  return lines;
}

} // namespace voxelcore
