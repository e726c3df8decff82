#include "BowyerWatson.h"

#include "EdgeTable.h"
#include "InsertionOrder.h"
#include "PointPredicates.h"

#include "voxelcore/Error.h"
#include "voxelcore/Predicates.h"

#include <algorithm>

namespace voxelcore
{

namespace
{

constexpr std::uint32_t infinite = 0xFFFFFFFFU; // the vertex beyond the hull
constexpr std::uint32_t none = 0xFFFFFFFFU;

struct Tetrahedron
{
  std::array<std::uint32_t, 4> vertex;    // positive orientation; a ghost has `infinite` last
  std::array<std::uint32_t, 4> neighbour; // opposite to each vertex
};

// TNumber holds the in-sphere value 72 w^2 N^5 (see Predicates.h).
template <typename TNumber>
class Builder
{
public:
  Builder(std::vector<LatticePoint> points, const SpacingWeights & weights)
    : m_Points(std::move(points), weights)
  {
    m_Tetrahedra.reserve(8 * m_Points.Size());
  }

  void
  Build(const ProgressCallback & progress)
  {
    const auto first = FirstTetrahedron();
    MakeFirst(first);
    for (std::uint32_t p = 0; p < m_Points.Size(); ++p)
    {
      if ((p & 0x3FFFU) == 0)
      {
        ReportProgress(progress, "delaunay", static_cast<double>(p) / static_cast<double>(m_Points.Size()));
      }
      if (std::find(first.begin(), first.end(), p) == first.end())
      {
        Insert(p);
      }
    }
  }

  // Finite tetrahedra, with corners renamed by `names`.
  Tetrahedra
  Finish(const std::vector<std::uint32_t> & names)
  {
    Tetrahedra                 result;
    std::vector<std::uint32_t> number(m_Tetrahedra.size(), kOutside);
    std::uint32_t              count = 0;
    for (std::size_t t = 0; t < m_Tetrahedra.size(); ++t)
    {
      if (m_Mark[t] != dead && m_Tetrahedra[t].vertex[3] != infinite)
      {
        number[t] = count++;
      }
    }
    result.corners.reserve(count);
    result.neighbours.reserve(count);
    for (std::size_t t = 0; t < m_Tetrahedra.size(); ++t)
    {
      if (number[t] != kOutside)
      {
        const Tetrahedron & own = m_Tetrahedra[t];
        result.corners.push_back(
          { names[own.vertex[0]], names[own.vertex[1]], names[own.vertex[2]], names[own.vertex[3]] });
        result.neighbours.push_back(
          { number[own.neighbour[0]], number[own.neighbour[1]], number[own.neighbour[2]], number[own.neighbour[3]] });
      }
    }
    return result;
  }

private:
  static constexpr std::uint32_t dead = 0xFFFFFFFFU;

  bool
  Conflicts(std::uint32_t t, std::uint32_t p) const
  {
    const Tetrahedron & own = m_Tetrahedra[t];
    if (own.vertex[3] != infinite)
    {
      return m_Points.InSphere(own.vertex, p) > 0;
    }
    const TNumber side = m_Points.Orient(own.vertex[0], own.vertex[1], own.vertex[2], p);
    if (side != 0)
    {
      return side > 0;
    }
    // In the plane of the hull facet: strictly inside its circle, that is inside the sphere of the tetrahedron there.
    return m_Points.InSphere(m_Tetrahedra[own.neighbour[3]].vertex, p) > 0;
  }

  std::array<std::uint32_t, 4>
  FirstTetrahedron() const
  {
    const auto count = static_cast<std::uint32_t>(m_Points.Size());
    for (std::uint32_t c = 2; c < count; ++c)
    {
      const LatticePoint & o = m_Points[0];
      const LatticePoint & a = m_Points[1];
      const LatticePoint & b = m_Points[c];
      const std::int64_t   ux = a.x - o.x, uy = a.y - o.y, uz = a.z - o.z;
      const std::int64_t   vx = b.x - o.x, vy = b.y - o.y, vz = b.z - o.z;
      if (uy * vz == uz * vy && uz * vx == ux * vz && ux * vy == uy * vx)
      {
        continue;
      }
      for (std::uint32_t d = 2; d < count; ++d)
      {
        const TNumber side = m_Points.Orient(0, 1, c, d);
        if (side != 0)
        {
          return side > 0 ? std::array<std::uint32_t, 4>{ 0, 1, c, d } : std::array<std::uint32_t, 4>{ 1, 0, c, d };
        }
      }
      break;
    }
    throw Error("the points of a Delaunay tetrahedralization lie in one plane; please report this input");
  }

  void
  MakeFirst(const std::array<std::uint32_t, 4> & v)
  {
    m_Tetrahedra = { { v, { 1, 2, 3, 4 } } };
    for (std::size_t i = 0; i < 4; ++i)
    {
      // A ghost sees its facet from outside: positive with any point beyond in the place of the infinite vertex.
      const auto & f = tetrahedronFaces[i];
      Tetrahedron  ghost{ { v[f[0]], v[f[1]], v[f[2]], infinite }, { 0, 0, 0, 0 } };
      for (std::size_t j = 0; j < 3; ++j)
      {
        ghost.neighbour[j] = static_cast<std::uint32_t>(f[j]) + 1; // the ghost opposite to that corner
      }
      m_Tetrahedra.push_back(ghost);
    }
    m_Mark.assign(5, 0);
    m_Last = 0;
  }

  std::uint32_t
  Locate(std::uint32_t p) const
  {
    std::uint32_t t = m_Last;
    if (m_Tetrahedra[t].vertex[3] == infinite)
    {
      t = m_Tetrahedra[t].neighbour[3];
    }
    for (std::uint32_t from = none;;)
    {
      const Tetrahedron & own = m_Tetrahedra[t];
      if (own.vertex[3] == infinite)
      {
        return t;
      }
      std::uint32_t next = none;
      for (std::size_t i = 0; i < 4; ++i)
      {
        const auto & f = tetrahedronFaces[i];
        if (own.neighbour[i] != from && m_Points.Orient(own.vertex[f[0]], own.vertex[f[1]], own.vertex[f[2]], p) > 0)
        {
          next = own.neighbour[i];
          break;
        }
      }
      if (next == none)
      {
        return t;
      }
      from = t;
      t = next;
    }
  }

  void
  Insert(std::uint32_t p)
  {
    m_Cavity.clear();
    m_Rim.clear();
    const std::uint32_t stamp = p + 1;
    const std::uint32_t start = Locate(p);
    m_Mark[start] = stamp;
    m_Cavity.push_back(start);
    for (std::size_t i = 0; i < m_Cavity.size(); ++i)
    {
      const std::uint32_t t = m_Cavity[i];
      for (std::size_t face = 0; face < 4; ++face)
      {
        const std::uint32_t u = m_Tetrahedra[t].neighbour[face];
        if (m_Mark[u] == stamp)
        {
          continue;
        }
        if (Conflicts(u, p))
        {
          m_Mark[u] = stamp;
          m_Cavity.push_back(u);
        }
        else
        {
          m_Rim.push_back({ t, static_cast<std::uint32_t>(face), u });
        }
      }
    }
    // Each rim face and the point make a tetrahedron; they take the places of the cavity's first.
    m_Edges.Start(3 * m_Rim.size());
    m_Places.clear();
    for (std::size_t i = 0; i < m_Rim.size(); ++i)
    {
      m_Places.push_back(NewPlace());
    }
    for (std::size_t i = 0; i < m_Rim.size(); ++i)
    {
      const auto          f = tetrahedronFaces[m_Rim[i].face];
      const Tetrahedron & old = m_Tetrahedra[m_Rim[i].inner];
      // The rim face counter-clockwise from outside the cavity, so with the point inside it the order 0, 2, 1 is positive.
      std::array<std::uint32_t, 3> side{ old.vertex[f[0]], old.vertex[f[2]], old.vertex[f[1]] };
      // A ghost keeps the infinite vertex last: rotate it to the third place, then swap places with the point evenly.
      Tetrahedron own{};
      std::size_t outer = 3;
      if (side[0] == infinite || side[1] == infinite || side[2] == infinite)
      {
        while (side[2] != infinite)
        {
          std::rotate(side.begin(), side.begin() + 1, side.end());
        }
        own.vertex = { side[1], side[0], p, infinite };
        outer = 2;
      }
      else
      {
        own.vertex = { side[0], side[1], side[2], p };
      }
      own.neighbour.fill(none);
      own.neighbour[outer] = m_Rim[i].outer;
      m_New.push_back(own);
    }
    for (std::size_t i = 0; i < m_Rim.size(); ++i)
    {
      Tetrahedron &       own = m_New[i];
      const std::uint32_t place = m_Places[i];
      Tetrahedron &       beyond = m_Tetrahedra[m_Rim[i].outer];
      for (std::size_t j = 0; j < 4; ++j)
      {
        if (beyond.neighbour[j] == m_Rim[i].inner && SharesFace(beyond, j, own, p))
        {
          beyond.neighbour[j] = place;
          break;
        }
      }
      for (std::uint32_t j = 0; j < 4; ++j)
      {
        if (own.vertex[j] == p || own.neighbour[j] != none)
        {
          continue;
        }
        // The face opposite to vertex j holds p and an edge of the rim.
        std::uint32_t ends[2];
        std::size_t   n = 0;
        for (std::uint32_t k = 0; k < 4; ++k)
        {
          if (k != j && own.vertex[k] != p)
          {
            ends[n++] = own.vertex[k];
          }
        }
        const std::uint32_t met = m_Edges.Meet(ends[0], ends[1], static_cast<std::uint32_t>(i) << 2 | j);
        if (met != none)
        {
          own.neighbour[j] = m_Places[met >> 2];
          m_New[met >> 2].neighbour[met & 3U] = place;
        }
      }
    }
    for (const std::uint32_t t : m_Cavity)
    {
      m_Mark[t] = dead;
    }
    for (std::size_t i = 0; i < m_Rim.size(); ++i)
    {
      m_Tetrahedra[m_Places[i]] = m_New[i];
      m_Mark[m_Places[i]] = 0;
    }
    m_Free.insert(m_Free.end(), m_Cavity.begin(), m_Cavity.end());
    m_Last = m_Places[0];
    m_New.clear();
  }

  // Two tetrahedra can meet the same cavity cell at one face only, unless both faces are the cell's; compare vertices.
  bool
  SharesFace(const Tetrahedron & beyond, std::size_t opposite, const Tetrahedron & own, std::uint32_t p) const
  {
    for (std::size_t k = 0; k < 4; ++k)
    {
      if (k != opposite && (beyond.vertex[k] == p ||
                            std::find(own.vertex.begin(), own.vertex.end(), beyond.vertex[k]) == own.vertex.end()))
      {
        return false;
      }
    }
    return true;
  }

  std::uint32_t
  NewPlace()
  {
    if (!m_Free.empty())
    {
      const std::uint32_t place = m_Free.back();
      m_Free.pop_back();
      return place;
    }
    m_Tetrahedra.push_back({});
    m_Mark.push_back(0);
    return static_cast<std::uint32_t>(m_Tetrahedra.size() - 1);
  }

  struct RimFace
  {
    std::uint32_t inner, face, outer;
  };

  PointPredicates<TNumber>   m_Points;
  std::vector<Tetrahedron>   m_Tetrahedra;
  std::vector<std::uint32_t> m_Mark; // stamp of the insertion that removed it, or dead
  std::vector<std::uint32_t> m_Free;
  std::uint32_t              m_Last = 0;
  std::vector<std::uint32_t> m_Cavity;
  std::vector<RimFace>       m_Rim;
  std::vector<std::uint32_t> m_Places;
  std::vector<Tetrahedron>   m_New;
  EdgeTable                  m_Edges;
};

template <typename TNumber>
Tetrahedra
Run(const std::vector<LatticePoint> & points, const SpacingWeights & weights, const ProgressCallback & progress)
{
  const std::vector<std::uint32_t> order = InsertionOrder(points);
  std::vector<LatticePoint>        sorted(points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    sorted[i] = points[order[i]];
  }
  Builder<TNumber> builder(std::move(sorted), weights);
  builder.Build(progress);
  return builder.Finish(order);
}

} // namespace

Tetrahedra
BowyerWatson(const std::vector<LatticePoint> & points,
             const SpacingWeights &            weights,
             const ProgressCallback &          progress)
{
  LatticePoint low = points.at(0);
  LatticePoint high = low;
  for (const LatticePoint & p : points)
  {
    low = { std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z) };
    high = { std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z) };
  }
  const std::int64_t extent =
    std::max({ std::int64_t{ high.x } - low.x, std::int64_t{ high.y } - low.y, std::int64_t{ high.z } - low.z });
  return InSphereBits(extent, weights) < 62.99 ? Run<std::int64_t>(points, weights, progress)
                                               : Run<__int128>(points, weights, progress);
}

} // namespace voxelcore
