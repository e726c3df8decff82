#pragma once
// Tetrahedra that fill space, and how a point is added to them.

#include "EdgeTable.h"
#include "PointPredicates.h"
#include "Tetrahedra.h"

#include "voxelcore/Predicates.h"

#include <algorithm>

namespace voxelcore
{

/** The Delaunay tetrahedra of the first of a list of points, and those beyond their hull, each a facet of it and the
 *  infinite vertex. TNumber holds the in-sphere value 72 w^2 N^5 (see Predicates.h).
 *
 *  Several threads can add points at the same time, each within a territory: the points are given owners, and an
 *  inserter changes only tetrahedra all of whose finite vertices are its own. It reads those and the ones that border
 *  on them, which are either its own too or have vertices of several owners, so that nobody changes them. */
template <typename TNumber>
class InsertionComplex
{
public:
  static constexpr std::uint32_t infinite = 0xFFFFFFFFU; ///< the vertex beyond the hull
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
  static constexpr std::uint8_t  all = 0xFFU; ///< an inserter with this owner may change everything, and is alone

  struct RimFace
  {
    std::uint32_t inner, face, outer;
  };
  struct Tetrahedron
  {
    std::array<std::uint32_t, 4> vertex;    // positive orientation; a ghost has `infinite` last
    std::array<std::uint32_t, 4> neighbour; // opposite to each vertex
  };

  /** Who adds points, one after the other. */
  struct Inserter
  {
    std::uint8_t  owner = all;
    std::uint32_t last = 0; ///< a tetrahedron of its territory, from where the next point is looked for
    std::uint32_t next = 0; ///< places that nobody else has: from here
    std::uint32_t end = 0;  ///< to here; an inserter that is alone makes new ones instead

    std::vector<std::uint32_t> free; ///< places whose tetrahedra are gone
    std::vector<std::uint32_t> cavity{};
    std::vector<RimFace>       rim{};
    std::vector<std::uint32_t> places{};
    std::vector<Tetrahedron>   made{};
    EdgeTable                  edges{};
  };

  InsertionComplex(std::vector<LatticePoint> points, const SpacingWeights & weights)
    : m_Points(std::move(points), weights)
  {}

  const PointPredicates<TNumber> &
  Points() const
  {
    return m_Points;
  }

  /** Starts with a tetrahedron of positive orientation. */
  void
  Start(const std::array<std::uint32_t, 4> & v)
  {
    m_Tetrahedra.reserve(8 * m_Points.Size());
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
  }

  /** Gives each point an owner below `all`. */
  void
  Divide(std::vector<std::uint8_t> owners)
  {
    m_Owner = std::move(owners);
  }

  /** Any tetrahedron that an inserter may change, or none. */
  std::uint32_t
  FindOwn(std::uint8_t owner) const
  {
    Inserter by;
    by.owner = owner;
    for (std::uint32_t t = 0; t < m_Tetrahedra.size(); ++t)
    {
      if (m_Mark[t] != dead && MayChange(by, t))
      {
        return t;
      }
    }
    return none;
  }

  /** Makes places, without tetrahedra, at the end; returns the first. */
  std::uint32_t
  AddPlaces(std::size_t count)
  {
    const auto first = static_cast<std::uint32_t>(m_Tetrahedra.size());
    m_Tetrahedra.resize(first + count);
    m_Mark.resize(first + count, dead);
    return first;
  }

  /** How many places there are. */
  std::size_t
  Size() const
  {
    return m_Tetrahedra.size();
  }
  const Tetrahedron &
  operator[](std::size_t t) const
  {
    return m_Tetrahedra[t];
  }
  /** Whether a place holds a tetrahedron, and not one beyond the hull. */
  bool
  IsFinite(std::size_t t) const
  {
    return m_Mark[t] != dead && m_Tetrahedra[t].vertex[3] != infinite;
  }

  /** Adds a point; false, and nothing done, where that would change a tetrahedron outside of the inserter's territory,
   *  or it has no place left. */
  bool
  Insert(Inserter & by, std::uint32_t p)
  {
    auto & cavity = by.cavity;
    auto & rim = by.rim;
    auto & made = by.made;
    cavity.clear();
    rim.clear();
    const std::uint32_t stamp = p + 1;
    const std::uint32_t start = Locate(by, p);
    if (start == none || !MayChange(by, start))
    {
      return false;
    }
    m_Mark[start] = stamp;
    cavity.push_back(start);
    for (std::size_t i = 0; i < cavity.size(); ++i)
    {
      const std::uint32_t t = cavity[i];
      for (std::size_t face = 0; face < 4; ++face)
      {
        const std::uint32_t u = m_Tetrahedra[t].neighbour[face];
        if (m_Mark[u] == stamp)
        {
          continue;
        }
        if (m_Mark[u] != (stamp | spared))
        {
          if (!MayChange(by, u))
          {
            return GiveUp(by);
          }
          if (Conflicts(u, p))
          {
            m_Mark[u] = stamp;
            cavity.push_back(u);
            continue;
          }
          m_Mark[u] = stamp | spared;
        }
        rim.push_back({ t, static_cast<std::uint32_t>(face), u });
      }
    }
    // Each rim face and the point make a tetrahedron, in places that earlier cavities have left or that are new.
    const std::size_t room = by.free.size() + (by.owner == all ? rim.size() : by.end - by.next);
    if (rim.size() > room)
    {
      return GiveUp(by);
    }
    by.edges.Start(3 * rim.size());
    by.places.clear();
    for (std::size_t i = 0; i < rim.size(); ++i)
    {
      by.places.push_back(NewPlace(by));
    }
    for (std::size_t i = 0; i < rim.size(); ++i)
    {
      const auto          f = tetrahedronFaces[rim[i].face];
      const Tetrahedron & old = m_Tetrahedra[rim[i].inner];
      // The rim face counter-clockwise from outside the cavity, so with the point inside it the order 0, 2, 1 is
      // positive.
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
      own.neighbour[outer] = rim[i].outer;
      made.push_back(own);
    }
    for (std::size_t i = 0; i < rim.size(); ++i)
    {
      Tetrahedron &       own = made[i];
      const std::uint32_t place = by.places[i];
      Tetrahedron &       beyond = m_Tetrahedra[rim[i].outer];
      beyond.neighbour[FaceTowards(beyond, rim[i].inner)] = place;
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
        const std::uint32_t met = by.edges.Meet(ends[0], ends[1], static_cast<std::uint32_t>(i) << 2 | j);
        if (met != none)
        {
          own.neighbour[j] = by.places[met >> 2];
          made[met >> 2].neighbour[met & 3U] = place;
        }
      }
    }
    for (const std::uint32_t t : cavity)
    {
      m_Mark[t] = dead;
    }
    for (std::size_t i = 0; i < rim.size(); ++i)
    {
      m_Tetrahedra[by.places[i]] = made[i];
      m_Mark[by.places[i]] = 0;
    }
    by.free.insert(by.free.end(), cavity.begin(), cavity.end());
    by.last = by.places[0];
    made.clear();
    return true;
  }

private:
  static constexpr std::uint32_t dead = 0xFFFFFFFFU;
  static constexpr std::uint32_t spared = 0x80000000U; // with the stamp of an insertion that looked at it and left it

  bool
  GiveUp(const Inserter & by)
  {
    for (const std::uint32_t t : by.cavity)
    {
      m_Mark[t] = 0;
    }
    for (const RimFace & face : by.rim)
    {
      m_Mark[face.outer] = 0;
    }
    return false;
  }

  bool
  MayChange(const Inserter & by, std::uint32_t t) const
  {
    if (by.owner == all)
    {
      return true;
    }
    const auto & v = m_Tetrahedra[t].vertex;
    return m_Owner[v[0]] == by.owner && m_Owner[v[1]] == by.owner && m_Owner[v[2]] == by.owner &&
           (v[3] == infinite || m_Owner[v[3]] == by.owner);
  }

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

  // The tetrahedron that holds the point; none where the way leads through another's territory.
  std::uint32_t
  Locate(const Inserter & by, std::uint32_t p) const
  {
    std::uint32_t t = by.last;
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
          if (by.owner != all && m_Owner[own.vertex[f[0]]] != by.owner &&
              m_Owner[own.vertex[f[1]]] == m_Owner[own.vertex[f[0]]] &&
              m_Owner[own.vertex[f[2]]] == m_Owner[own.vertex[f[0]]])
          {
            return none; // what lies beyond may be changing
          }
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

  // Where `beyond` has the cavity's tetrahedron `inner` as neighbour. That is one face: two tetrahedra that share two
  // faces have the same vertices, and the cavity's places are not taken before it is closed.
  static std::size_t
  FaceTowards(const Tetrahedron & beyond, std::uint32_t inner)
  {
    const auto & neighbour = beyond.neighbour;
    return neighbour[0] == inner ? 0 : neighbour[1] == inner ? 1 : neighbour[2] == inner ? 2 : 3;
  }

  std::uint32_t
  NewPlace(Inserter & by)
  {
    if (!by.free.empty())
    {
      const std::uint32_t place = by.free.back();
      by.free.pop_back();
      return place;
    }
    if (by.next < by.end)
    {
      return by.next++;
    }
    return AddPlaces(1);
  }

  PointPredicates<TNumber>   m_Points;
  std::vector<std::uint8_t>  m_Owner;
  std::vector<Tetrahedron>   m_Tetrahedra;
  std::vector<std::uint32_t> m_Mark; // stamp of the insertion that last looked at it, or dead
};

} // namespace voxelcore
