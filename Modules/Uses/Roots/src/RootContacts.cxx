#include "voxelcore/Roots/RootContacts.h"

#include "RootStrands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

constexpr double      kWithin = 2;   // radii from a root's curve: farther is none of its voxels
constexpr std::size_t kTogether = 8; // segments of a curve that are looked at from each voxel near them

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
  /** The voxels less than `reach` mm from a line, and some more. */
  VoxelBox
  Around(std::span<const Vector3> line, double reach) const
  {
    Vector3 least{ HUGE_VAL, HUGE_VAL, HUGE_VAL };
    Vector3 most{ -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
    for (const Vector3 & place : line)
    {
      const Vector3 there = PhysicalToLattice(m_Geometry, place);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        least[axis] = std::min(least[axis], there[axis]);
        most[axis] = std::max(most[axis], there[axis]);
      }
    }
    VoxelBox box;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double room = reach / m_Geometry.spacing[axis] + 1;
      box.lower[axis] = static_cast<std::int32_t>(std::floor(least[axis] - room));
      box.size[axis] = static_cast<std::int32_t>(std::ceil(most[axis] + room)) - box.lower[axis] + 1;
    }
    return box;
  }

  Vector3
  MiddleOf(const std::array<std::int32_t, 3> & voxel) const
  {
    return LatticeToPhysical(m_Geometry, { voxel[0] + 0.5, voxel[1] + 0.5, voxel[2] + 0.5 });
  }

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
    const VoxelBox                   box = Around({ &meeting.position, 1 }, room);
    const auto &                     lower = box.lower;
    const auto &                     size = box.size;
    const auto                       row = static_cast<std::size_t>(size[0]);
    const auto                       plane = row * static_cast<std::size_t>(size[1]);
    const std::array<std::size_t, 3> stride{ 1, row, plane };
    // Which strand a voxel belongs to, 255 for none.
    constexpr std::uint8_t    none = 255;
    constexpr std::uint8_t    several = 254;
    std::vector<std::uint8_t> owner(plane * static_cast<std::size_t>(size[2]), none);
    std::vector<float>        away(owner.size(), 0); ///< from its curve, mm, squared
    const auto                visit = [&](const VoxelBox & part, auto && work) {
      const auto end = [&](std::size_t axis) {
        return std::min(part.lower[axis] + part.size[axis], lower[axis] + size[axis]);
      };
      for (std::int32_t z = std::max(part.lower[2], lower[2]); z < end(2); ++z)
      {
        for (std::int32_t y = std::max(part.lower[1], lower[1]); y < end(1); ++y)
        {
          for (std::int32_t x = std::max(part.lower[0], lower[0]); x < end(0); ++x)
          {
            const std::size_t at = static_cast<std::size_t>(z - lower[2]) * plane +
                                   static_cast<std::size_t>(y - lower[1]) * row +
                                   static_cast<std::size_t>(x - lower[0]);
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
    std::vector<double> nearest(owner.size(), kWithin * kWithin); // in radii, squared
    std::vector<double> squared(owner.size(), HUGE_VAL);          // of one strand
    for (std::size_t k = 0; k < std::min<std::size_t>(strands.size(), several); ++k)
    {
      const auto & line = strands[k].line;
      const double radius = strands[k].radius;
      for (std::size_t first = 0; first == 0 ? !line.empty() : first + 1 < line.size(); first += kTogether)
      {
        const std::span part(line.data() + first, std::min(kTogether + 1, line.size() - first));
        visit(Around(part, kWithin * radius), [&](std::size_t at, const std::array<std::int32_t, 3> & v) {
          if (m_Shape.Contains(v[0], v[1], v[2]))
          {
            squared[at] = std::min(squared[at], SquaredDistance(MiddleOf(v), part));
          }
        });
      }
      for (std::size_t at = 0; at < owner.size(); ++at)
      {
        const double radii = squared[at] / (radius * radius);
        if (radii < nearest[at])
        {
          nearest[at] = radii;
          owner[at] = static_cast<std::uint8_t>(k);
          away[at] = static_cast<float>(squared[at]);
        }
        squared[at] = HUGE_VAL;
      }
    }
    visit(box, [&](std::size_t at, const std::array<std::int32_t, 3> & v) {
      if (onCurve[at] < several && m_Shape.Contains(v[0], v[1], v[2]))
      {
        owner[at] = onCurve[at];
        away[at] = -1;
      }
    });
    visit(box, [&](std::size_t at, const std::array<std::int32_t, 3> & v) {
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
          if (next[axis] < lower[axis] || next[axis] >= lower[axis] + size[axis])
          {
            continue;
          }
          const std::size_t beside = step < 0 ? at - stride[axis] : at + stride[axis];
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
            m_Walls.Insert(v[0], v[1], v[2]);
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
