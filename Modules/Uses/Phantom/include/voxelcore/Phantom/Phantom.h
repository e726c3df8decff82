#pragma once
// Synthetic voxel shapes whose answers are known: solids given by formulas, seeded noise, a branching root system with
// its centre lines, and a volume full of touching bodies.
//
// The same options give the same voxels on every machine: random numbers come from splitmix64, and no function of the
// C library is used whose last bit may differ (of those that round, only sqrt).

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace voxelcore
{

/** One kind of phantom, for the command line. */
struct PhantomKind
{
  std::string_view name;
  std::string_view help;    ///< one line
  std::string_view options; ///< which of the options below it heeds, in words, with their defaults
};

/** All kinds, in the order to show them. */
std::span<const PhantomKind>
PhantomKinds();

/** What to make. A body is defined in millimetres by the sides of the whole grid (size times spacing), so any grid over
 *  the same sides samples the same body; a voxel is in when its centre is. Lengths left open take the kind's
 *  default. */
struct PhantomOptions
{
  std::string                 kind;
  std::array<std::int32_t, 3> size{ 64, 64, 64 }; ///< voxels
  Vector3                     spacing{ 1, 1, 1 }; ///< mm
  std::uint64_t               seed = 1;           ///< porous, noise, root, cells
  std::optional<double>       radius;             ///< mm
  std::optional<double>       thickness;          ///< mm
  std::optional<double>       period;             ///< mm: of the gyroid; distance of porous' grains
  std::optional<double>       density;            ///< 0 to 1: part of the volume that is in (porous, noise)
  std::optional<double>       detail;      ///< mm: smallest radius of a root; half a voxel's diagonal keeps it whole
  std::optional<int>          laterals;    ///< root: number of laterals on the stem
  std::optional<int>          subLaterals; ///< root: number of laterals on each of these
  std::optional<int>          whorls;      ///< root: heights of the stem that the laterals spring from; else any
  std::optional<int>          contacts;    ///< root: further laterals, each of which touches another on its way
  std::optional<int>          cells;       ///< cells: number of bodies
};

/** The voxels, in a box that begins at 0 and has the given size; of cells and vessels, those of all bodies.
 *  \throws UsageError for an unknown kind or a value without sense; Cancelled when the callback says so. */
VoxelShape
MakePhantom(const PhantomOptions & options, const ProgressCallback & progress = {});

/** The bodies of a phantom, each in its tight box: one, or those of `cells`, which fill the volume, and of `vessels`;
 *  none overlap. A body that lies wholly within others' share is left out, so that there may be a few less than were
 *  asked for.
 *  \throws as MakePhantom */
std::vector<VoxelShape>
MakePhantomBodies(const PhantomOptions & options, const ProgressCallback & progress = {});

/** A point of a known centre line. */
struct CentreLinePoint
{
  Vector3      position{};  ///< lattice coordinates (voxel index + 1/2), as in MedialComplex
  double       radius = 0;  ///< mm
  std::int64_t parent = -1; ///< index of the point before it, always a smaller one; -1 for the first of the stem
  std::int32_t branch = 0;  ///< 0 for the stem, then 1, 2, ... in the order of growth
  std::int32_t order = 0;   ///< 0 stem, 1 lateral, 2 lateral of a lateral
};

/** The centre lines of the phantom `root`: the voxels that are in are those whose centre lies in one of the round cones
 *  between a point and its parent. A lateral's first point follows the point of the parent branch it springs from.
 *  \throws UsageError when the kind is not root or a value has no sense. */
std::vector<CentreLinePoint>
RootCentreLines(const PhantomOptions & options);

/** A place where two branches of a root touch that do not spring from each other. */
struct RootContact
{
  Vector3                     position{}; ///< lattice coordinates, between the two centre lines
  std::array<std::int32_t, 2> branches{}; ///< the one that was there, the one that touches it
};

/** The contacts of the phantom `root`; where there is no room for all that were asked for there are fewer.
 *  \throws as RootCentreLines */
std::vector<RootContact>
RootContacts(const PhantomOptions & options);

} // namespace voxelcore
