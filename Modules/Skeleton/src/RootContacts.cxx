#include "voxelcore/RootContacts.h"

#include "RootStrands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

constexpr double kWithin = 2; // radii from a root's curve: farther is none of its voxels

class WallBuilder
{
public:
  WallBuilder(const VoxelShape &    shape,
              const ImageGeometry & geometry,
              const SkeletonGraph & graph,
              const RootHierarchy & roots)
    : m_Shape(shape)
    , m_Geometry(geometry)
    , m_Graph(graph)
    , m_Roots(roots)
    , m_Walls(shape.Box())
  {}

  VoxelShape
  Build()
  {
    for (const RootMeeting & meeting : m_Roots.meetings)
    {
      const std::vector<Strand> strands = TraceStrands(m_Graph, m_Roots, meeting);
      if (strands.size() > 1)
      {
        AddWalls(meeting, strands);
      }
    }
    return std::move(m_Walls);
  }

private:
  /** Voxels along a curve that hang together over faces: the boxes of steps of a quarter of a voxel. What lies between
   *  two voxels is in both, so that a turned scan has the same. */
  template <typename TVisit>
  void
  VisitCurve(const Strand & strand, const TVisit & visit) const
  {
    for (std::size_t i = 0; i + 1 < strand.line.size(); ++i)
    {
      const Vector3 from = PhysicalToLattice(m_Geometry, strand.line[i]);
      const Vector3 along = Minus(PhysicalToLattice(m_Geometry, strand.line[i + 1]), from);
      const int     steps = std::max(1, static_cast<int>(std::ceil(4 * Length(along))));
      for (int step = 0; step < steps; ++step)
      {
        const Vector3               a = AddScaled(from, static_cast<double>(step) / steps, along);
        const Vector3               b = AddScaled(from, static_cast<double>(step + 1) / steps, along);
        std::array<std::int32_t, 3> least{};
        std::array<std::int32_t, 3> most{};
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          least[axis] = static_cast<std::int32_t>(std::floor(std::min(a[axis], b[axis]) - 1e-6));
          most[axis] = static_cast<std::int32_t>(std::floor(std::max(a[axis], b[axis]) + 1e-6));
        }
        for (std::int32_t z = least[2]; z <= most[2]; ++z)
        {
          for (std::int32_t y = least[1]; y <= most[1]; ++y)
          {
            for (std::int32_t x = least[0]; x <= most[0]; ++x)
            {
              visit({ x, y, z });
            }
          }
        }
      }
    }
  }

  void
  AddWalls(const RootMeeting & meeting, const std::vector<Strand> & strands)
  {
    double room = meeting.reach;
    for (const Strand & strand : strands)
    {
      room = std::max(room, meeting.reach + kWithin * strand.radius);
    }
    const Vector3               centre = PhysicalToLattice(m_Geometry, meeting.position);
    std::array<std::int32_t, 3> lower{};
    std::array<std::int32_t, 3> size{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double reach = room / m_Geometry.spacing[axis] + 1;
      lower[axis] = static_cast<std::int32_t>(std::floor(centre[axis] - reach));
      size[axis] = static_cast<std::int32_t>(std::ceil(centre[axis] + reach)) - lower[axis] + 1;
    }
    const auto row = static_cast<std::size_t>(size[0]);
    const auto plane = row * static_cast<std::size_t>(size[1]);
    // Which strand a voxel belongs to, 255 for none.
    constexpr std::uint8_t    none = 255;
    constexpr std::uint8_t    several = 254;
    std::vector<std::uint8_t> owner(plane * static_cast<std::size_t>(size[2]), none);
    std::vector<float>        away(owner.size(), 0); ///< from its curve, mm, squared
    const auto                visit = [&](auto && work) {
      std::size_t at = 0;
      for (std::int32_t z = 0; z < size[2]; ++z)
      {
        for (std::int32_t y = 0; y < size[1]; ++y)
        {
          for (std::int32_t x = 0; x < size[0]; ++x, ++at)
          {
            work(at, std::array<std::int32_t, 3>{ x, y, z });
          }
        }
      }
    };
    // Where its curve runs a root is whole, however thin.
    std::vector<std::uint8_t> onCurve(owner.size(), none);
    for (std::size_t k = 0; k < std::min<std::size_t>(strands.size(), several); ++k)
    {
      VisitCurve(strands[k], [&](const std::array<std::int32_t, 3> & place) {
        std::size_t at = 0;
        for (const std::size_t axis : { std::size_t{ 2 }, std::size_t{ 1 }, std::size_t{ 0 } })
        {
          const std::int32_t v = place[axis] - lower[axis];
          if (v < 0 || v >= size[axis])
          {
            return;
          }
          at = at * static_cast<std::size_t>(size[axis]) + static_cast<std::size_t>(v);
        }
        onCurve[at] = onCurve[at] == none || onCurve[at] == k ? static_cast<std::uint8_t>(k) : several;
      });
    }
    visit([&](std::size_t at, const std::array<std::int32_t, 3> & v) {
      if (!m_Shape.Contains(v[0] + lower[0], v[1] + lower[1], v[2] + lower[2]))
      {
        return;
      }
      const Vector3 place =
        LatticeToPhysical(m_Geometry, { v[0] + lower[0] + 0.5, v[1] + lower[1] + 0.5, v[2] + lower[2] + 0.5 });
      double nearest = kWithin * kWithin;
      for (std::size_t k = 0; k < std::min<std::size_t>(strands.size(), several); ++k)
      {
        const double squared = SquaredDistance(place, strands[k].line);
        const double radii = squared / (strands[k].radius * strands[k].radius);
        if (radii < nearest)
        {
          nearest = radii;
          owner[at] = static_cast<std::uint8_t>(k);
          away[at] = static_cast<float>(squared);
        }
        if (onCurve[at] == k)
        {
          owner[at] = onCurve[at];
          away[at] = -1;
          break;
        }
      }
    });
    visit([&](std::size_t at, const std::array<std::int32_t, 3> & v) {
      if (owner[at] == none)
      {
        return;
      }
      const Strand & own = strands[owner[at]];
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        for (const std::int32_t step : { -1, 1 })
        {
          std::array<std::int32_t, 3> next = v;
          next[axis] += step;
          if (next[axis] < 0 || next[axis] >= size[axis])
          {
            continue;
          }
          const std::size_t beside = static_cast<std::size_t>(next[2]) * plane +
                                     static_cast<std::size_t>(next[1]) * row + static_cast<std::size_t>(next[0]);
          if (owner[beside] == none || owner[beside] == owner[at])
          {
            continue;
          }
          const Strand & other = strands[owner[beside]];
          // Thin roots would be cut through were it always the thicker's.
          const bool hasWall = away[at] != away[beside] ? away[at] > away[beside]
                                                        : own.radius > other.radius ||
                                                            (own.radius == other.radius && owner[at] < owner[beside]);
          if (hasWall && !AreKin(m_Roots, own, other))
          {
            m_Walls.Insert(v[0] + lower[0], v[1] + lower[1], v[2] + lower[2]);
          }
        }
      }
    });
  }

  const VoxelShape &    m_Shape;
  const ImageGeometry & m_Geometry;
  const SkeletonGraph & m_Graph;
  const RootHierarchy & m_Roots;
  VoxelShape            m_Walls;
};

} // namespace

VoxelShape
ContactWalls(const VoxelShape &    shape,
             const ImageGeometry & geometry,
             const SkeletonGraph & graph,
             const RootHierarchy & roots)
{
  return WallBuilder(shape, geometry, graph, roots).Build();
}

} // namespace voxelcore
