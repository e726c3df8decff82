#include "PictureCamera.h"

#include "voxelcore/Lattice/Vectors.h"

#include <vtkMath.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace voxelcore
{

namespace
{

Vector3
Unit(const Vector3 & a)
{
  const double length = Length(a);
  return { a[0] / length, a[1] / length, a[2] / length };
}

PictureAxes
LookFrom(const Vector3 & towardsViewer)
{
  constexpr Vector3 superior{ 0, 0, 1 };
  constexpr Vector3 anterior{ 0, -1, 0 };
  PictureAxes       axes;
  axes.back = Unit(towardsViewer);
  const Vector3 & up = std::abs(axes.back[2]) > 0.9 ? anterior : superior;
  axes.right = Unit(Cross(up, axes.back));
  axes.up = Cross(axes.back, axes.right);
  return axes;
}

Vector3
MeanOf(const PointCloud & points)
{
  Vector3 mean{};
  for (const auto & point : points)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      mean[k] += point[k];
    }
  }
  for (double & value : mean)
  {
    value /= static_cast<double>(std::max<std::size_t>(points.size(), 1));
  }
  return mean;
}

/** The direction in which the points spread least, pointing to where a viewer stands by habit: anterior, left,
 *  superior. */
Vector3
FlatDirection(const PointCloud & points)
{
  const Vector3 mean = MeanOf(points);
  double        spread[3][3] = {};
  for (const auto & point : points)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      for (std::size_t j = 0; j < 3; ++j)
      {
        spread[i][j] += (point[i] - mean[i]) * (point[j] - mean[j]);
      }
    }
  }
  double   vectors[3][3];
  double   values[3];
  double * rows[3] = { spread[0], spread[1], spread[2] };
  double * out[3] = { vectors[0], vectors[1], vectors[2] };
  vtkMath::Jacobi(rows, values, out); // columns, by falling value
  Vector3           least{ vectors[0][2], vectors[1][2], vectors[2][2] };
  constexpr Vector3 habit{ 0.3, -1, 0.5 };
  if (Dot(least, habit) < 0)
  {
    least = { -least[0], -least[1], -least[2] };
  }
  return least;
}

} // namespace

PictureAxes
AxesOf(PictureView view, const PointCloud & points)
{
  switch (view)
  {
    case PictureView::Front:
      return LookFrom({ 0, -1, 0 });
    case PictureView::Top:
      return LookFrom({ 0, 0, 1 });
    case PictureView::Iso:
      return LookFrom({ 0.6, -1, 0.6 });
    case PictureView::Auto:
      break;
  }
  return LookFrom(FlatDirection(points));
}

PictureAxes
Turned(const PictureAxes & axes, double radians)
{
  const Vector3 axis = std::abs(axes.back[2]) > 0.9 ? axes.up : Vector3{ 0, 0, 1 };
  const auto    turn = [&](const Vector3 & v) {
    // Rodrigues' formula
    const Vector3 across = Cross(axis, v);
    const double  along = Dot(axis, v) * (1 - std::cos(radians));
    Vector3       result{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      result[k] = v[k] * std::cos(radians) + across[k] * std::sin(radians) + axis[k] * along;
    }
    return result;
  };
  return { turn(axes.right), turn(axes.up), turn(axes.back) };
}

PictureFrame
FrameOf(const PointCloud & points, const PictureAxes & axes, int turns)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Vector3    mean = MeanOf(points);
  double           low[3] = { infinity, infinity, infinity };
  double           high[3] = { -infinity, -infinity, -infinity };
  for (int turn = 0; turn < turns; ++turn)
  {
    const PictureAxes now = Turned(axes, 2 * std::numbers::pi * turn / turns);
    for (const auto & point : points)
    {
      const Vector3 away{ point[0] - mean[0], point[1] - mean[1], point[2] - mean[2] };
      const double  at[3] = { Dot(away, now.right), Dot(away, now.up), Dot(away, now.back) };
      for (std::size_t k = 0; k < 3; ++k)
      {
        low[k] = std::min(low[k], at[k]);
        high[k] = std::max(high[k], at[k]);
      }
    }
  }
  PictureFrame frame;
  frame.center = mean;
  if (turns == 1)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      frame.center[k] += axes.right[k] * (low[0] + high[0]) / 2 + axes.up[k] * (low[1] + high[1]) / 2 +
                         axes.back[k] * (low[2] + high[2]) / 2;
    }
    frame.halfWidth = (high[0] - low[0]) / 2;
    frame.halfHeight = (high[1] - low[1]) / 2;
    frame.halfDepth = (high[2] - low[2]) / 2;
    return frame;
  }
  frame.halfWidth = std::max(-low[0], high[0]);
  frame.halfHeight = std::max(-low[1], high[1]);
  frame.halfDepth = std::max(-low[2], high[2]);
  return frame;
}

} // namespace voxelcore
