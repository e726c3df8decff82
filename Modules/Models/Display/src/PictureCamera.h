#pragma once
// From where a picture is taken, and how large things are in it.

#include "voxelcore/Display/RenderPicture.h"

namespace voxelcore
{

/** An orthonormal frame in LPS: `right` and `up` of the picture, `back` towards the viewer. */
struct PictureAxes
{
  Vector3 right{};
  Vector3 up{};
  Vector3 back{};
};

using PointCloud = std::vector<std::array<float, 3>>;

PictureAxes
AxesOf(PictureView view, const PointCloud & points);

/** Turned by an angle around the vertical: the patient's axis nearest to the picture's, or, seen from above, the
 *  picture's own. */
PictureAxes
Turned(const PictureAxes & axes, double radians);

/** The part of a view's plane that the points take: centre (LPS mm) and half sides (mm). */
struct PictureFrame
{
  Vector3 center{};
  double  halfWidth = 0;
  double  halfHeight = 0;
  double  halfDepth = 0;
};

/** Of all `turns` of a full turn: the same for each, centred on the axis of turning when there is more than one. */
PictureFrame
FrameOf(const PointCloud & points, const PictureAxes & axes, int turns);

} // namespace voxelcore
