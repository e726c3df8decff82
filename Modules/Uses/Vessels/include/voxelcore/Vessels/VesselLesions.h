#pragma once
// Where vessels narrow and widen: stenoses, bulges and domes.

#include "voxelcore/Vessels/BranchSections.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace voxelcore
{

enum class LesionKind : std::uint8_t
{
  Stenosis, ///< narrower than the healthy vessel, which goes on beyond
  Bulge,    ///< wider than that, all around: an ectasia or a fusiform aneurysm
  Dome      ///< at the side of a vessel, behind a neck: a saccular aneurysm (DomeBranches.h)
};

/** A lesion of a vessel. Lengths in mm, places in LPS. Diameters are those of circles with the area of a section: twice
 *  SectionRadii(), and of domes those of layers of voxels. Numbers that a kind does not have
 *  are NaN. */
struct VesselLesion
{
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  LesionKind   kind = LesionKind::Stenosis;
  ElementIndex branch = 0; ///< of a dome: the one that leads into it
  double       arc = 0;    ///< along it from its first point: of the least or greatest diameter; of a dome, of its neck
  double       begin = 0;  ///< the part of the branch that is ill: off by a tenth or more; of a dome, from its neck
  double       end = 0;    ///< the same; of a dome, to the branch's end
  Vector3      place{};    ///< on the branch at `arc`
  double       diameter = 0; ///< the least of a stenosis, the greatest of others

  /** Of the healthy vessel there: a straight line through the diameters of the branch, to which at least half of it is
   *  near (HealthyCalibre.h). Of a dome: the mean of the vessel's branches at its foot; NaN where these have none. */
  double reference = kNone;

  /** Of a dome, by layers of voxels across its axis. Of these counts what hangs together with the middle of its largest
   *  ball. The neck is the least layer between that and the vessel's line. The axis leads from that line to the middle;
   *  where the vessel goes straight on, at right angles to it. */
  double neckWidth = kNone; ///< diameter of the neck
  double height = kNone;    ///< from the neck to the farthest point, at right angles to it
  double volume = kNone;    ///< mm^3 beyond the neck

  /** How much less, or more, the diameter is than that of the healthy vessel, over the latter. Of a stenosis it is the
   *  degree of NASCET (N Engl J Med 325 (1991), page 445): 1 - least diameter / healthy diameter. A bulge of .5 or more
   *  is called an aneurysm (Johnston et al., J Vasc Surg 13 (1991), page 452). NaN of domes. */
  double
  DegreeByDiameter() const;

  /** The same of areas. */
  double
  DegreeByArea() const;

  /** height / neckWidth (Ujiie et al., Neurosurgery 45 (1999), page 119). */
  double
  AspectRatio() const
  {
    return height / neckWidth;
  }
};

/** In order of branches and arcs. Stenoses and bulges of less than a fifth of the diameter are none, nor are those
 *  within three times the scatter of the healthy diameters, nor domes (DomesOf()) whose greatest ball is not greater by
 *  a fifth than that on the vessel. Beyond both ends there must be healthy vessel, or, of a stenosis, a fork without
 *  a dome. `sections` are those that MeasureSections() gives of the graph and the body. Between those that run into
 *  other branches, are cut or unknown, and beside domes, nothing counts. */
std::vector<VesselLesion>
FindLesions(const SkeletonGraph & graph, const std::vector<BranchSection> & sections, const SectionBody & body);

} // namespace voxelcore
