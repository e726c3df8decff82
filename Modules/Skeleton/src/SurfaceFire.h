#pragma once
// Fire on a medial surface: Dijkstra in which a point burns sector by sector (Yan et al. 2016, section 5.2).

#include "BurnNetwork.h"
#include "TimeHeap.h"

#include "voxelcore/ErosionThickness.h"
#include "voxelcore/Vectors.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace voxelcore
{

/** Fire that has come to a point of a face and spread from there over all of it. Another point of the face that burns
 *  no earlier than straight fire from here is there has nothing to add: all it could reach, this has reached before. So
 *  most points need not spread, and a face costs the square of the points where fire enters it instead of all. They
 *  spread along their edges only: on one line the way in two parts is as long as that in one, and the times must not
 *  depend, by rounding, on which of them came to be remembered. The first few are, in a cache line. */
struct Entries
{
  static constexpr std::uint32_t most = 5;
  static constexpr std::uint32_t none = 0xFFFFFFFFU; ///< of a face that is small

  std::array<double, most>        times;
  std::array<std::uint32_t, most> points;
  std::uint32_t                   count = 0;
};

/** Where fire can still go in a face that is small, with one sample on each edge: what has burned need not be looked
 *  at. */
struct FaceAhead
{
  static constexpr std::uint32_t mostSides = 8;

  std::uint32_t first = 0; ///< corner
  std::uint16_t ahead = 0; ///< bit 2 i for corner i, 2 i + 1 for the sample behind it; unset when it has burned
  std::uint8_t  sides = 0; ///< 0 for other faces
};

/** Burns a surface once. SurfaceFire.cxx has what burns when, FireSpread.cxx how fire goes on from there. */
class SurfaceFire
{
public:
  SurfaceFire(const MedialComplex & complex, double sampling);

  BurnTimes
  Run(const ProgressCallback & progress);

private:
  using SectorRange = BurnNetwork::SectorRange;

  static constexpr double kNever = std::numeric_limits<double>::infinity();

  bool
  IsBurned(std::uint32_t sector) const
  {
    return std::signbit(m_Arrival[sector]);
  }

  void
  Burn(std::uint32_t sector, double time)
  {
    m_Arrival[sector] = -time;
    m_Fresh.push_back(sector);
  }

  friend TimeHeap;

  /** When the next sector of a point burns; NaN when it waits for no fire. */
  double
  operator()(std::uint32_t point) const;

  /** Points burn all over the surface in turn; what the next ones need is fetched from memory meanwhile, step by step:
   *  where a point is, where its edge's data are, these. */
  void
  Fetch(std::uint32_t point, int step) const;

  void
  FetchAhead() const;

  void
  Ignite();

  void
  BurnPoint(std::uint32_t point, double time);

  /** An unburned sector with an end on an edge where no other end is unburned. */
  std::uint32_t
  FindFreedSector(std::uint32_t point, const SectorRange & range);

  bool
  IsFresh(std::uint32_t sector) const;

  void
  Spread(std::uint32_t point, const SectorRange & range, double time);

  /** A point that burns now. */
  struct Flame
  {
    std::uint32_t point;
    Vector3       place;
    double        time;
  };

  /** Whether other fire in this face has reached before all that fire from here could. */
  bool
  IsOvertaken(const Flame & flame, const Entries & entries) const;

  /** From a corner (`step` 0) or the edge behind it (1). False when it is of no use but along the edges the point is
   *  on. */
  bool
  SpreadInFace(const Flame & flame, const BurnNetwork::FaceCorner & at, std::uint32_t step);

  /** The same where there is a FaceAhead; `place` of the two that it numbers. */
  void
  SpreadAhead(const Flame & flame, FaceAhead & face, std::uint32_t place);

  /** Along the edge that begins in this corner of a face, both ends included. */
  void
  SpreadAlong(const Flame & flame, const BurnNetwork::FaceCorner & at);

  void
  SpreadToCorner(const Flame & flame, std::uint32_t corner);

  void
  SpreadToSamples(const Flame & flame, std::uint32_t corner);

  /** Notes when fire comes to a sector of a point, if that is earlier than any before. */
  template <typename Place, typename Radius>
  void
  Reach(const Flame & flame, std::uint32_t sector, const Place & place, const Radius & radius, std::uint32_t point);

  /** When the last sector of a point burned. */
  double
  TimeOf(const SectorRange & range) const;

  /** One on no face is on the free boundary. */
  double
  TimeOfVertex(ElementIndex vertex) const;

  BurnTimes
  Times() const;

  const MedialComplex &      m_Complex;
  const CellComplex &        m_Cells;
  BurnNetwork                m_Network;
  std::vector<double>        m_Arrival; ///< per sector; when it has burned, the negative of when
  std::vector<FaceAhead>     m_Faces;
  std::vector<std::uint32_t> m_FaceEntries; ///< per face
  std::vector<Entries>       m_Entries;     ///< of faces that are not small
  TimeHeap                   m_Heap;
  std::vector<std::uint32_t> m_Fresh; ///< sectors of a point that burn now
};

} // namespace voxelcore
