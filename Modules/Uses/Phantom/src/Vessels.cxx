// Vessels that meet in a ring, as those at the base of the brain do.

#include "RoundCone.h"

#include <array>
#include <cstdint>
#include <vector>

namespace voxelcore
{

namespace
{

constexpr std::size_t kMostPoints = 4;

/** A vessel through up to four points, in parts of the sides; its radius is a part of that asked for. */
struct Vessel
{
  double                           radius;
  std::size_t                      points;
  std::array<Vector3, kMostPoints> way;
};

// The stem behind, two stems beside it, and what springs from these to both sides; then the vessels that close the
// ring. The one named first has the voxels where two are one body.
constexpr std::array<Vessel, 12> kVessels{ {
  { 1.0, 2, { { { 0.5, 0.3, 0.06 }, { 0.5, 0.3, 0.5 } } } },
  { 1.2, 2, { { { 0.3, 0.6, 0.06 }, { 0.3, 0.6, 0.5 } } } },
  { 1.2, 2, { { { 0.7, 0.6, 0.06 }, { 0.7, 0.6, 0.5 } } } },
  { 0.8, 3, { { { 0.5, 0.3, 0.5 }, { 0.3, 0.3, 0.5 }, { 0.08, 0.12, 0.56 } } } },
  { 0.8, 3, { { { 0.5, 0.3, 0.5 }, { 0.7, 0.3, 0.5 }, { 0.92, 0.12, 0.56 } } } },
  { 0.9, 2, { { { 0.3, 0.6, 0.5 }, { 0.05, 0.64, 0.56 } } } },
  { 0.9, 2, { { { 0.7, 0.6, 0.5 }, { 0.95, 0.64, 0.56 } } } },
  { 0.8, 3, { { { 0.3, 0.6, 0.5 }, { 0.42, 0.78, 0.5 }, { 0.42, 0.95, 0.62 } } } },
  { 0.8, 3, { { { 0.7, 0.6, 0.5 }, { 0.58, 0.78, 0.5 }, { 0.58, 0.95, 0.62 } } } },
  { 0.6, 2, { { { 0.3, 0.3, 0.5 }, { 0.3, 0.6, 0.5 } } } },
  { 0.6, 2, { { { 0.7, 0.3, 0.5 }, { 0.7, 0.6, 0.5 } } } },
  { 0.7, 2, { { { 0.42, 0.78, 0.5 }, { 0.58, 0.78, 0.5 } } } },
} };

} // namespace

std::vector<VoxelShape>
MakeVessels(const PhantomOptions & options, const ProgressCallback & progress)
{
  const Vector3           sides = Sides(options);
  const double            radius = options.radius.value_or(0.035 * ShortestSide(options));
  VoxelShape              taken(VoxelBox{ { 0, 0, 0 }, options.size });
  std::vector<VoxelShape> bodies;
  for (std::size_t number = 0; number < kVessels.size(); ++number)
  {
    ReportProgress(progress, "sampling", static_cast<double>(number) / static_cast<double>(kVessels.size()));
    const Vessel & vessel = kVessels[number];
    VoxelShape     body(VoxelBox{ { 0, 0, 0 }, options.size });
    for (std::size_t i = 1; i < vessel.points; ++i)
    {
      VisitRoundCone(options,
                     { Times(vessel.way[i - 1], sides), vessel.radius * radius },
                     { Times(vessel.way[i], sides), vessel.radius * radius },
                     0,
                     options.size[2] - 1,
                     [&](std::int32_t x, std::int32_t y, std::int32_t z) {
                       if (!taken.Contains(x, y, z))
                       {
                         body.Insert(x, y, z);
                       }
                     });
    }
    for (std::int32_t z = 0; z < options.size[2]; ++z)
    {
      for (std::int32_t y = 0; y < options.size[1]; ++y)
      {
        const ConstShapeRow from = std::as_const(body).Row(y, z);
        const ShapeRow      to = taken.Row(y, z);
        for (std::size_t word = 0; word < from.size(); ++word)
        {
          to[word] |= from[word];
        }
      }
    }
    if (VoxelShape tight = CropToVoxels(std::move(body)); tight.Box().size[0] > 0)
    {
      bodies.push_back(std::move(tight));
    }
  }
  return bodies;
}

} // namespace voxelcore
