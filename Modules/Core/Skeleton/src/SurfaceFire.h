#pragma once
// Fire on a medial surface: a point burns sector by sector (Yan et al. 2016, section 5.2).

#include "BurnNetwork.h"

#include "voxelcore/Base/CountBits.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Skeleton/ErosionThickness.h"

#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
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

  std::array<double, most>        times;
  std::array<std::uint32_t, most> points;
  std::uint32_t                   count = 0;
};

/** The faces that have entries, and their places among them: most faces are small, or not of one block, and have
 *  none. */
class EntryPlaces
{
public:
  static constexpr std::uint32_t none = 0xFFFFFFFFU;

  EntryPlaces() = default;

  /** Of `faceCount` those that are named, which ascend. */
  EntryPlaces(const std::vector<std::size_t> & faces, std::size_t faceCount);

  std::uint32_t
  Of(std::uint32_t face) const
  {
    const Group &       group = m_Groups[face / kGroup];
    const std::uint64_t bit = std::uint64_t{ 1 } << face % kGroup;
    return (group.faces & bit) == 0 ? none : group.before + CountBits(group.faces & (bit - 1));
  }

private:
  static constexpr std::size_t kGroup = 64;

  struct Group
  {
    std::uint64_t faces = 0;  ///< a bit each
    std::uint32_t before = 0; ///< in groups before
  };

  std::vector<Group> m_Groups;
};

/** Burns a surface once. When a sector burns is a least bound over all ways of fire, whatever order they are looked at
 *  in, so neither queue nor threads change a bit of it. Times are bounds that only fall: within a block of points near
 *  each other, which fits a cache, in nearly the order in which they burn; in rounds over all blocks side by side, with
 *  what fire carries from one to another handed over in between; until none changes before the end of a window of
 *  time, then in the next. FireBlocks.cxx cuts blocks, SurfaceFire.cxx has windows, and FireSpread.cxx how fire goes on
 *  from a point. */
class SurfaceFire
{
public:
  SurfaceFire(const MedialComplex & complex, double sampling);

  BurnTimes
  Run(const ProgressCallback & progress);

private:
  using SectorRange = BurnNetwork::SectorRange;

  static constexpr double kNever = std::numeric_limits<double>::infinity();

  /** Fire that comes to a sector of another block's point. */
  struct Arrival
  {
    double        time;
    std::uint32_t sector;
    std::uint32_t point;
  };

  /** Points that burn on one thread at a time: vertices and samples in a row each. */
  struct Block
  {
    std::uint32_t              firstVertex;
    std::uint32_t              lastVertex;
    std::uint32_t              firstSample;
    std::uint32_t              lastSample;
    ElementIndex               firstEdge; ///< those the samples are on
    ElementIndex               lastEdge;
    double                     next = kNever; ///< nothing here burns before
    std::vector<std::uint32_t> waiting;       ///< points to burn when their window comes
    std::vector<Arrival>       out;
    std::uint64_t              burned = 0;

    bool
    Has(std::uint32_t point, std::size_t vertexCount) const
    {
      return point < vertexCount ? point - firstVertex < lastVertex - firstVertex
                                 : point - firstSample < lastSample - firstSample;
    }
  };

  /** The part of a window's time that a thread is at, and what is to burn in each. */
  struct Queue;

  /** A point that burns now. */
  struct Flame
  {
    std::uint32_t point;
    Vector3       place;
    double        time;
  };

  // Other threads look at times of points on the border of their block, to see whether fire there is of use.
  double
  Time(std::uint32_t sector) const
  {
    return atomic_ref(const_cast<double &>(m_Times[sector])).load(std::memory_order_relaxed);
  }

  void
  SetTime(std::uint32_t sector, double time)
  {
    atomic_ref(m_Times[sector]).store(time, std::memory_order_relaxed);
  }

  static bool
  HasSpread(double time)
  {
    return std::signbit(time);
  }

  void
  CutBlocks();

  void
  FindFaces();

  /** Whether all points of a face are. */
  bool
  IsOfOneBlock(std::size_t face) const;

  void
  Ignite();
  void
  Ignite(Block & block);

  std::size_t
  OwnerOf(std::uint32_t point) const;

  /** Hands over what fire carries between blocks; returns when the next point burns. */
  double
  HandOver(const std::vector<std::size_t> & from);

  /** Burns what burns in a block before the end of the window. */
  void
  BurnBlock(Block & block, double start, double end);

  void
  BurnPoint(Block & block, Queue & queue, std::uint32_t point);

  /** A seam with one sheet left is a free edge: what is left there burns when the last of the others does. True when
   *  that is news; the sector is among the fresh ones then. */
  bool
  BurnFreed(Queue & queue, std::uint32_t point, const SectorRange & range);

  /** Of the sectors at one seam, of which all but the last to burn have spread. */
  template <typename TSectorAt>
  bool
  BurnLast(Queue & queue, std::uint32_t count, TSectorAt sectorAt);

  /** When the next sector of a point burns; never when it waits for no fire. */
  double
  Due(std::uint32_t point) const;

  void
  Spread(Block & block, Queue & queue, std::uint32_t point, const SectorRange & range);

  /** Whether other fire in this face has reached before all that fire from here could. */
  bool
  IsOvertaken(const Flame & flame, const Entries & entries) const;

  /** From a corner (`step` 0) or the edge behind it (1). False when it is of no use but along the edges the point is
   *  on. */
  bool
  SpreadInFace(Block & block, Queue & queue, const Flame & flame, const BurnNetwork::FaceCorner & at);

  /** The same where no edge has more than one sample. */
  void
  SpreadInSmallFace(Block & block, Queue & queue, const Flame & flame, std::uint32_t face);

  /** Along the edge that begins in this corner of a face, both ends included. */
  void
  SpreadAlong(Block & block, Queue & queue, const Flame & flame, const BurnNetwork::FaceCorner & at);

  void
  SpreadToCorner(Block & block, Queue & queue, const Flame & flame, std::uint32_t corner);

  void
  SpreadToSamples(Block & block, Queue & queue, const Flame & flame, std::uint32_t corner);

  /** Notes when fire comes to a sector of a point, if that is earlier than any before. */
  template <typename Place, typename Radius, typename Point>
  void
  Reach(Block &        block,
        Queue &        queue,
        const Flame &  flame,
        std::uint32_t  sector,
        const Place &  place,
        const Radius & radius,
        const Point &  pointOf);

  /** Notes what fire carries to another block; of what comes to one sector the earliest is enough. */
  static void
  Send(Block & block, Queue & queue, const Arrival & arrival);

  /** The earliest for each sector, in an order that does not tell which later ones were noted: that depends on when
   *  this thread looked at the times of others. */
  static void
  KeepFirst(std::vector<Arrival> & out);

  /** Puts a point in line to burn then. */
  void
  Line(Block & block, Queue & queue, std::uint32_t point, double time);

  /** Fire comes to a sector earlier than any before: `before`, as it was noted. */
  void
  Arrive(Block & block, Queue & queue, const Arrival & arrival, double before);

  /** When the last sector of a point burned. */
  double
  TimeOf(const SectorRange & range) const;

  /** One on no face is on the free boundary. */
  double
  TimeOfVertex(ElementIndex vertex) const;

  /** Mean over its samples; where it has none, halfway between its ends, as seen from the face that burned last. */
  double
  TimeOfEdge(ElementIndex edge, const std::vector<double> & vertices) const;

  BurnTimes
  Times() const;

  const MedialComplex &      m_Complex;
  const CellComplex &        m_Cells;
  BurnNetwork                m_Network;
  double                     m_Window; ///< mm
  std::unique_ptr<double[]>  m_Times;  ///< per sector; when fire has spread from it, the negative of when
  std::vector<std::uint16_t> m_Small;  ///< per face: 0, or bit 2 i for corner i, 2 i + 1 for the sample behind it
  EntryPlaces                m_EntryPlaces;
  std::vector<Entries>       m_Entries; ///< empty where no face has any
  std::vector<Block>         m_Blocks;
};

/** Buckets by time. */
struct SurfaceFire::Queue
{
  static constexpr std::size_t most = 16;
  static constexpr std::size_t mostSent = 8192;

  std::array<std::vector<std::uint32_t>, most> buckets;
  std::vector<std::uint32_t>                   fresh;  ///< sectors of a point that burn now
  std::array<std::uint32_t, mostSent>          sent{}; ///< where a sector may be in Block::out, by its last bits
  double                                       start = 0;
  double                                       end = 0;
  double                                       perTime = 0;
  std::size_t                                  present = 0;

  std::size_t
  BucketOf(double time) const
  {
    const double at = (time - start) * perTime;
    return at < static_cast<double>(most - 1) ? static_cast<std::size_t>(std::max(at, 0.0)) : most - 1;
  }
};

} // namespace voxelcore
