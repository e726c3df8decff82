#pragma once
// The certified skeleton of several labels taken as one body.

#include "voxelcore/Certified/CertifiedSkeleton.h"
#include "voxelcore/Shape/LabelShape.h"

#include <string>
#include <vector>

namespace voxelcore
{

/** Gives each point of a skeleton, that of `shape` with its loops, the label it is of, and finds where labels meet
 *  (LabelNetwork.h). The shape is the union of `labels` as it was edited, and as it goes on beyond a scan's border.
 *  What is found is counted again by other means (NetworkVerification.h). `name` is what messages call the union.
 *  \throws CertificateError */
void
MakeNetwork(CertifiedSkeleton &             skeleton,
            const std::vector<LabelShape> & labels,
            const VoxelShape &              shape,
            const ImageGeometry &           geometry,
            const std::string &             name);

/** What a user must be told of a network, a sentence each: contacts that its graph does not pass or passes more than
 *  once, labels without a line, labels that follow each other and do not touch. */
std::vector<std::string>
NetworkInWords(const MeasuredSkeleton & network, SpatialUnit unit);

} // namespace voxelcore
