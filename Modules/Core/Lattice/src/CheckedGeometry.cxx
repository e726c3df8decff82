#include "voxelcore/Lattice/CheckedGeometry.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Hypot.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Lattice/Vectors.h"

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

ImageGeometry
CheckedGeometry(const std::filesystem::path & scan,
                const StatedGeometry &        stated,
                const GeometryOptions &       options,
                std::vector<std::string> &    notes)
{
  constexpr std::array<char, 3> axisName{ 'i', 'j', 'k' };
  ImageGeometry                 geometry;
  geometry.size = stated.size;
  geometry.spacing = options.spacing.value_or(stated.spacing);
  geometry.origin = stated.origin;
  geometry.unit = options.spacing ? SpatialUnit::Millimetres : stated.unit;
  std::array<Vector3, 3> axes{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    if (!std::isfinite(geometry.spacing[a]) || geometry.spacing[a] <= 0)
    {
      if (options.spacing)
      {
        throw UsageError(Text("--spacing ", Number(geometry.spacing[a]), ": give lengths in mm above 0"));
      }
      RefuseInput(scan,
                  Text("the voxel spacing along axis ", axisName[a], " is ", Number(geometry.spacing[a])),
                  "give the true one with --spacing X,Y,Z in mm");
    }
    const double length = std::sqrt(Dot(stated.axes[a], stated.axes[a]));
    if (!std::isfinite(length) || length <= 0)
    {
      RefuseInput(scan, Text("axis ", axisName[a], " has no direction"), "mend the header");
    }
    if (!std::isfinite(stated.origin[a]))
    {
      RefuseInput(scan, "the origin is not a number", "mend the header");
    }
    for (std::size_t c = 0; c < 3; ++c)
    {
      axes[a][c] = stated.axes[a][c] / length;
    }
  }
  if (options.spacing)
  {
    notes.push_back("the voxel spacing is the one given, not the file's");
  }

  const double volume = std::abs(Dot(axes[0], Cross(axes[1], axes[2])));
  const double cosine = LargestCosine(axes);
  if (cosine > kOrthonormalTolerance)
  {
    const std::string degrees = Number(std::asin(std::min(1.0, cosine)) * 180.0 / 3.14159265358979323846);
    if (volume < kSingularVolume)
    {
      RefuseInput(scan, "its axes lie in one plane", "mend the header");
    }
    if (!options.orthonormalize)
    {
      RefuseInput(scan,
                  Text("its axes are skewed, ", degrees, " degrees off a right angle"),
                  "resample it, or accept the nearest right-angled axes with --orthonormalize");
    }
    MakeOrthonormal(axes);
    notes.push_back(
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
  return geometry;
}

ImageGeometry
CheckedGeometry(const std::filesystem::path & image, const ImageGeometry & geometry, bool orthonormalize)
{
  CheckSize(image, geometry.size, 1, UINT64_MAX);
  StatedGeometry stated{ geometry.size, {}, geometry.spacing, geometry.origin, geometry.unit };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto & m = geometry.direction;
    stated.axes[axis] = { m[axis], m[3 + axis], m[6 + axis] };
  }
  std::vector<std::string> notes;
  const ImageGeometry      checked = CheckedGeometry(image, stated, { {}, orthonormalize }, notes);
  for (std::size_t axis = 0; axis < 3 && !orthonormalize; ++axis)
  {
    // In memory another length would be another spacing.
    const double length = Hypot(stated.axes[axis][0], stated.axes[axis][1], stated.axes[axis][2]);
    if (!(std::abs(length - 1) <= kOrthonormalTolerance))
    {
      RefuseInput(image,
                  Text("axis ", "ijk"[axis], " of its direction has length ", Number(length)),
                  "mend it, or accept the nearest right-angled axes of length 1 with --orthonormalize");
    }
  }
  return checked;
}

std::uint64_t
CheckSize(const std::filesystem::path &       path,
          const std::array<std::int64_t, 3> & size,
          std::uint64_t                       bytesPerVoxel,
          std::uint64_t                       bytesPossible)
{
  __extension__ using Wide = unsigned __int128;
  Wide total = 1;
  for (const std::int64_t side : size)
  {
    if (side < 1 || side > (std::int64_t{ 1 } << 30))
    {
      RefuseInput(path, Text("its header gives a side of ", side, " voxels"), "the file is damaged or no volume");
    }
    total *= static_cast<Wide>(side);
  }
  // Three sides of 2^30 and 2^20 bytes a voxel stay below 2^128.
  if (bytesPerVoxel > (1U << 20) || total * bytesPerVoxel > bytesPossible)
  {
    RefuseInput(path,
                Text("its header gives ",
                     size[0],
                     " x ",
                     size[1],
                     " x ",
                     size[2],
                     " voxels of ",
                     bytesPerVoxel,
                     " bytes, its data hold at most ",
                     bytesPossible),
                "the file is truncated or its header damaged: fetch or write it anew");
  }
  return static_cast<std::uint64_t>(total);
}

} // namespace voxelcore
