// From the steps between voxels to spacing, origin and direction.

#include "ScanFile.h"
#include "voxelcore/TextFields.h"
#include "voxelcore/Vectors.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{
namespace
{

// The same tolerance ITK has for direction cosines; as an angle 0.0057 degrees.
constexpr double kOrthonormalTolerance = 1e-4;
// Axes this close to a common plane define no volume.
constexpr double kSingularVolume = 1e-6;

/** The orthonormal matrix nearest to the one with these columns (its polar factor), by Newton's iteration of Higham:
 *  X <- (X + X^-T) / 2. The columns of X^-T are the cross products of those of X over its determinant. */
void
MakeOrthonormal(std::array<Vector3, 3> & axes)
{
  for (int round = 0; round < 100; ++round)
  {
    const std::array<Vector3, 3> crossed{ Cross(axes[1], axes[2]), Cross(axes[2], axes[0]), Cross(axes[0], axes[1]) };
    const double                 determinant = Dot(axes[0], crossed[0]);
    double                       change = 0;
    for (std::size_t a = 0; a < 3; ++a)
    {
      for (std::size_t c = 0; c < 3; ++c)
      {
        const double next = 0.5 * (axes[a][c] + crossed[a][c] / determinant);
        change = std::max(change, std::abs(next - axes[a][c]));
        axes[a][c] = next;
      }
    }
    if (change < 1e-15)
    {
      break;
    }
  }
}

} // namespace

double
LargestCosine(const std::array<Vector3, 3> & steps)
{
  double largest = 0;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const std::size_t b = (a + 1) % 3;
    const double      lengths = std::sqrt(Dot(steps[a], steps[a])) * std::sqrt(Dot(steps[b], steps[b]));
    const double      cosine = std::abs(Dot(steps[a], steps[b])) / lengths;
    largest = std::isfinite(cosine) ? std::max(largest, cosine) : 1.0;
  }
  return largest;
}

void
SetGeometry(ScanFile &                     scan,
            const std::array<Vector3, 3> & directions,
            const Vector3 &                spacing,
            const Vector3 &                origin,
            const ReadOptions &            options)
{
  constexpr std::array<char, 3> axisName{ 'i', 'j', 'k' };
  ImageGeometry &               geometry = scan.geometry;
  geometry.spacing = options.spacing ? *options.spacing : spacing;
  geometry.origin = origin;
  std::array<Vector3, 3> axes{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    if (!std::isfinite(geometry.spacing[a]) || geometry.spacing[a] <= 0)
    {
      if (options.spacing)
      {
        throw UsageError(Text("--spacing ", Number(geometry.spacing[a]), ": spacings are lengths in mm above 0"));
      }
      RefuseInput(scan.path,
                  Text("the voxel spacing along axis ", axisName[a], " is ", Number(geometry.spacing[a])),
                  "give the true one with --spacing x,y,z in mm");
    }
    const double length = std::sqrt(Dot(directions[a], directions[a]));
    if (!std::isfinite(length) || length <= 0)
    {
      RefuseInput(scan.path, Text("axis ", axisName[a], " has no direction"), "mend the header");
    }
    if (!std::isfinite(origin[a]))
    {
      RefuseInput(scan.path, "the origin is not a number", "mend the header");
    }
    for (std::size_t c = 0; c < 3; ++c)
    {
      axes[a][c] = directions[a][c] / length;
    }
  }
  if (options.spacing)
  {
    scan.notes.push_back("the voxel spacing is the one given, not the file's");
  }

  const double volume = std::abs(Dot(axes[0], Cross(axes[1], axes[2])));
  const double cosine = LargestCosine(axes);
  if (cosine > kOrthonormalTolerance)
  {
    const std::string degrees = Number(std::asin(std::min(1.0, cosine)) * 180.0 / 3.14159265358979323846);
    if (volume < kSingularVolume)
    {
      RefuseInput(scan.path, "its axes lie in one plane", "mend the header");
    }
    if (!options.orthonormalize)
    {
      RefuseInput(scan.path,
                  Text("its axes are skewed, ", degrees, " degrees off a right angle"),
                  "resample it, or accept the nearest right-angled axes with --orthonormalize");
    }
    MakeOrthonormal(axes);
    scan.notes.push_back(
      Text("axes ", degrees, " degrees off a right angle were replaced by the nearest right-angled ones"));
  }
  for (std::size_t a = 0; a < 3; ++a)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      // Adding 0 turns -0 into 0: equal geometries print equally.
      geometry.direction[3 * c + a] = axes[a][c] + 0.0;
    }
    geometry.origin[a] += 0.0;
  }
}

} // namespace voxelcore
