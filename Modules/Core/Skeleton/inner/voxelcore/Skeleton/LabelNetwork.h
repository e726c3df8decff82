#pragma once
// The skeleton of several labels taken as one body: which label each point is of, and where labels meet.

#include "voxelcore/Shape/LabelContacts.h"
#include "voxelcore/Skeleton/MeasuredSkeleton.h"

#include <vector>

namespace voxelcore
{

/** Gives each point of a graph its label, and cuts its branches where labels meet, into branches of one label each. The
 *  graph is that of the labels' union, with curves alone; no cycle and no component comes or goes.
 *
 *  The share of a label at a point is that of its voxels in the point's ball. Labels are chosen for all points at once:
 *  what a choice costs is, along each segment, its length times the share of all other labels, and for each change of
 *  label a quarter of the radius there, so that rough borders make no short pieces; labels that do not touch never
 *  follow each other where others can lie between. The choice is the cheapest there is on each tree; a cycle is opened
 *  for it where its label is most certain. A label that would have no point gets the one of its largest share.
 *
 *  Then each contact gets its point. A change of labels lies where their shares are equal. Within the ball of a
 *  junction all is one body: where that brings a contact to one point, labels that come to within this ball come to the
 *  junction itself, and a branch within the balls of both its ends is drawn together.
 *
 *  No point leaves `shape`, the one whose skeleton the graph is: the labels' union as it was edited. Fills `labels` and
 *  `contact` of the graph. In what it gives a contact has no place where the graph does not pass,
 *  several where it passes more than once. */
SkeletonNetwork
CutAtLabels(SkeletonGraph &                 graph,
            const std::vector<LabelShape> & labels,
            const VoxelShape &              shape,
            const ImageGeometry &           geometry);

} // namespace voxelcore
