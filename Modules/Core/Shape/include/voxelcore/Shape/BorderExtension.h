#pragma once
// Where the border of a scan cuts a body, and the body as if it went on there. What lies beyond the border is not
// known; the plainest guess is that sections beyond are that at the border.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** What the border of a scan means for the ends of curves. */
enum class BorderEnds : std::uint8_t
{
  Closed, ///< bodies end at the border
  Open,   ///< a body cut by the border goes on: its curve runs up to the border's plane
  Overlap ///< of parts of one volume that share a layer of voxels: each section in an outermost layer has one end, at
          ///< the section's centre in the middle of the layer, so that both parts have it at the same place
};

/** A piece of a shape's outermost layer at a side of the scan: voxels that hang together over their faces. */
struct BorderSection
{
  std::size_t   axis = 0;
  bool          isUpper = false; ///< at the end of the axis, not at its beginning
  std::uint64_t voxels = 0;
  /** Of the greatest disc in the section: of all centres among voxels' centres, corners and middles of edges the one
   *  nearest to the section's centre of gravity. In lattice coordinates, in the middle of the layer. */
  Vector3 centre{};
  double  radius = 0; ///< mm, of that disc
  double  reach = 0;  ///< mm, from its centre to the section's farthest place
  /** Whether the border cuts the body here. One that is much wider half the disc's radius below the border only touches
   *  it; a section more than three times as long as wide is that of a body that runs along the border. */
  bool isCut = false;
};

struct BorderGrowth
{
  BorderEnds ends = BorderEnds::Closed;
  double     clear = 0; ///< mm; what is added is by so much longer than its section reaches from its centre
};

struct ExtendedShape
{
  VoxelShape                 shape;
  std::vector<BorderSection> sections; ///< by axis, side, and first voxel
};

/** The sections of a shape at the sides of the box of its scan. Along an axis of a single layer there are none. */
std::vector<BorderSection>
FindBorderSections(const VoxelShape & shape, const VoxelBox & scan, const Vector3 & spacing);

/** Whether ExtendBeyondBorder() adds anything. */
bool
GoesBeyondBorder(const VoxelShape & shape, const VoxelBox & scan, const Vector3 & spacing, BorderEnds ends);

/** A shape that goes on beyond the border: layers like that at the border are added, axis by axis, so many that their
 *  other end does not matter within the scan. They lead on in the direction in which the body leaves it, or at right
 *  angles where that would change the topology. Open: of sections that are cut. Overlap: of these, and of the others
 *  their greatest disc. What is added can be pushed back into the section it stands on, so the topology stays the
 *  shape's. */
ExtendedShape
ExtendBeyondBorder(const VoxelShape & shape, const VoxelBox & scan, const Vector3 & spacing, const BorderGrowth & how);

} // namespace voxelcore
