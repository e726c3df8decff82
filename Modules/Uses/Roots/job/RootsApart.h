#pragma once
// Roots that touch are told apart and cut apart, so that the mask of a plant is a tree, too. All of it is done in the
// body's own place (BodyFrame.h), so that it does not depend on where in the scan the plant lies.

#include "RootAnnotations.h"

#include "voxelcore/Roots/RootsJob.h"

namespace voxelcore
{

/** How the topology of a plant is made what was asked for. */
struct ApartRequest
{
  GapWidth                depth;    ///< farther from the boundary nothing is filled
  TopologyRequest         topology; ///< none: as few as can be
  std::optional<double>   kernel;
  std::optional<double>   neighbourhood;
  std::optional<VoxelBox> scan; ///< at whose border roots may be cut
};

/** Finds the roots in the mask as it is, and simplifies its topology with cuts where they touch (RootContacts.h). What
 *  a change costs is its grey values' distance to the shape's level where `core` reads a grey scan, else its distance
 *  to the boundary. The mask, one label of a scan, is left with its changes done; `core` says how a skeleton is made.
 *  Roots of one piece are edited before walls are drawn between them.
 *  Gives nothing where the mask has the topology asked for.
 *  \throws CertificateError, InputError, Cancelled */
std::optional<RootsTopology>
TellRootsApart(LabelShape &             mask,
               const ImageGeometry &    geometry,
               const CoreOptions &      core,
               const RootRules &        rules,
               const ApartRequest &     request,
               RootEditing &            editing,
               const ProgressCallback & progress);

/** The roots of a skeleton, joined where it is torn; `torn` are the gaps, in mm. Where `core` reads a grey scan of
 *  bright roots, the curves of thin ones are put where the values say that their middle is (RootCentring.h), and
 *  directions are those of such curves. `mask` is the scan's, `depth` how far from it values are looked at.
 *  TellRootsApart() has done so with the graph it gives. */
RootHierarchy
FindRootsByGrey(const VoxelShape &    mask,
                const ImageGeometry & geometry,
                const CoreOptions &   core,
                const RootRules &     rules,
                const GapWidth &      depth,
                RootEditing &         editing,
                SkeletonGraph &       graph,
                std::vector<double> & torn);

/** What was cut and filled, with the voxels, as a file that --change-voxels reads. */
std::string
RootChangesText(const std::optional<RootsTopology> & topology, SpatialUnit unit);

/** "7 loops became 0 by 7 cuts of 93 voxels and 0 fills" */
std::string
RootsTopologyText(const RootsTopology & topology);

} // namespace voxelcore
