#include "ChangeRefinement.h"

#include "ChangeProposals.h"
#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr std::size_t                 kMostVoxels = 40000000; // looked at in all
constexpr std::int32_t                kLongestWindow = 48;
constexpr std::array<std::int32_t, 3> kReaches{ 8, 5, 3 }; // steps to voxels that stay
constexpr int                         kMostTurns = 4;
constexpr std::size_t                 kMostLooks = 50;                    // for another proposal, within a window
constexpr std::uint64_t               kBarred = std::uint64_t{ 1 } << 40; // the cost of a voxel that is to stay

class Refiner
{
public:
  Refiner(PaddedShape & shape, const VoxelBox & box, const ChangeBounds & bounds, const PaddedCost & cost)
    : m_Shape(shape)
    , m_Box(box)
    , m_Bounds(bounds)
    , m_Cost(cost)
  {}

  /** The voxels of a change, in padded indices, that hang together; better ones take their place. A cut becomes a fill
   *  or the other way round only if `mayTurn`. */
  bool
  Refine(std::vector<Voxel> & part, bool & isFill, bool mayTurn)
  {
    bool isBetter = false;
    m_Looks = 0;
    for (int turn = 0; turn < kMostTurns; ++turn)
    {
      const bool isBetterNow =
        ranges::any_of(kReaches, [&](std::int32_t reach) { return RefineWithin(reach, part, isFill, mayTurn); });
      isBetter = isBetter || isBetterNow;
      if (!isBetterNow)
      {
        break;
      }
    }
    return isBetter;
  }

  std::uint64_t
  CostOf(const std::vector<Voxel> & part) const
  {
    std::uint64_t cost = 0;
    for (const Voxel & at : part)
    {
      cost += m_Cost(at);
    }
    return cost;
  }

  bool
  HasWork() const
  {
    return m_Work < kMostVoxels;
  }

private:
  /** Whether a voxel may change in this way. */
  bool
  IsOpen(const Voxel & at, bool isFill) const
  {
    constexpr std::int32_t            room = PaddedShape::kRoom;
    const std::array<std::int32_t, 3> v{ at[0] - room + m_Box.lower[0],
                                         at[1] - room + m_Box.lower[1],
                                         at[2] - room + m_Box.lower[2] };
    const bool                        wasIn = m_Bounds.shape.Contains(v[0], v[1], v[2]);
    return isFill ? !wasIn && m_Bounds.neighbourhood.Contains(v[0], v[1], v[2])
                  : wasIn && !m_Bounds.kernel.Contains(v[0], v[1], v[2]);
  }

  bool
  RefineWithin(std::int32_t reach, std::vector<Voxel> & part, bool & isFill, bool mayTurn)
  {
    const ChangeWindow window(m_Shape, part, reach);
    if (ranges::max(window.Size()) > kLongestWindow || !HasWork())
    {
      return false;
    }
    VoxelNumbers barred;
    const auto   costAt = [&](std::size_t number, bool asFill) {
      const Voxel at = window.At(number);
      if (!IsOpen(at, asFill))
      {
        return std::uint64_t{ 0 };
      }
      return ranges::find(barred, number) == barred.end() ? std::uint64_t{ m_Cost(at) } : kBarred;
    };
    ChangeInWindow change{ window, isFill, mayTurn, reach, CostOf(part), {}, costAt };
    for (const Voxel & at : part)
    {
      change.voxels.push_back(window.NumberOf(at));
    }
    ranges::sort(change.voxels);
    // The cheapest first. For one that leaves a loop or a scrap behind, those without one of its voxels are looked at.
    std::multimap<std::uint64_t, std::pair<ChangeProposal, VoxelNumbers>> waiting;
    std::set<VoxelNumbers>                                                seen;
    const auto                                                            now = window.Read(m_Shape);
    const auto                                                            look = [&] {
      m_Work += window.Count();
      ++m_Looks;
      for (ChangeProposal & one : ProposeChanges(change, now))
      {
        if (seen.insert(one.voxels).second)
        {
          const std::uint64_t cost = one.cost;
          waiting.emplace(cost, std::pair(std::move(one), barred));
        }
      }
    };
    for (look(); !waiting.empty();)
    {
      const auto first = waiting.extract(waiting.begin());
      const auto & [one, without] = first.mapped();
      const auto voxels = VoxelsOf(window, one.voxels);
      if (Replace(part, voxels) || (one.isFill == isFill && Move(part, voxels, VoxelsOf(window, one.between))))
      {
        isFill = one.isFill;
        return true;
      }
      for (const std::size_t number : one.voxels)
      {
        if (m_Looks < kMostLooks && HasWork())
        {
          barred = without;
          barred.push_back(number);
          look();
        }
      }
    }
    return false;
  }

  static std::vector<Voxel>
  VoxelsOf(const ChangeWindow & window, const VoxelNumbers & numbers)
  {
    std::vector<Voxel> voxels;
    voxels.reserve(numbers.size());
    for (const std::size_t number : numbers)
    {
      voxels.push_back(window.At(number));
    }
    return voxels;
  }

  void
  FlipAll(const std::vector<Voxel> & voxels)
  {
    for (const Voxel & at : voxels)
    {
      m_Shape.Flip(at);
    }
  }

  /** At once, if what that changes has the same topology. */
  bool
  Replace(std::vector<Voxel> & part, const std::vector<Voxel> & voxels)
  {
    std::vector<Voxel> both = part;
    both.insert(both.end(), voxels.begin(), voxels.end());
    const ChangeWindow window(m_Shape, both, 2);
    m_Work += 2 * window.Count();
    const auto before = window.Sign(window.Read(m_Shape));
    FlipAll(part);
    FlipAll(voxels);
    if (window.Sign(window.Read(m_Shape)) == before)
    {
      part = voxels;
      return true;
    }
    FlipAll(voxels);
    FlipAll(part);
    return false;
  }

  /** Flips what is simple, in order, until nothing is; what was flipped leaves the list for `flipped`. */
  void
  FlipSimple(std::vector<Voxel> & open, std::vector<Voxel> & flipped)
  {
    for (bool isMoving = true; isMoving;)
    {
      isMoving = false;
      std::vector<Voxel> left;
      for (const Voxel & at : open)
      {
        if (IsSimpleVoxel(m_Shape.Around(at)))
        {
          m_Shape.Flip(at);
          flipped.push_back(at);
          isMoving = true;
        }
        else
        {
          left.push_back(at);
        }
      }
      open = std::move(left);
    }
  }

  void
  CostliestFirst(std::vector<Voxel> & voxels) const
  {
    ranges::sort(voxels);
    ranges::stable_sort(voxels, ranges::greater{}, [&](const Voxel & at) { return m_Cost(at); });
  }

  /** By simple voxels: the change grows up to its new place, then all that can goes back, costly voxels and those of
   *  the old place first. */
  bool
  Move(std::vector<Voxel> & part, const std::vector<Voxel> & voxels, std::vector<Voxel> between)
  {
    const std::vector<Voxel> old = part;
    std::vector<Voxel>       grown;
    between.insert(between.end(), voxels.begin(), voxels.end());
    std::erase_if(between, [&](const Voxel & at) { return ranges::find(old, at) != old.end(); });
    m_Work += 10 * between.size();
    FlipSimple(between, grown);
    grown.insert(grown.end(), old.begin(), old.end());
    std::vector<Voxel> wanted;
    std::vector<Voxel> others;
    for (const Voxel & at : grown)
    {
      (ranges::find(voxels, at) == voxels.end() ? others : wanted).push_back(at);
    }
    std::vector<Voxel> back;
    CostliestFirst(others);
    CostliestFirst(wanted);
    FlipSimple(others, back);
    FlipSimple(wanted, back);
    FlipSimple(others, back);
    others.insert(others.end(), wanted.begin(), wanted.end());
    if (CostOf(others) < CostOf(old) && !others.empty())
    {
      ranges::sort(others);
      part = std::move(others);
      return true;
    }
    FlipAll(others);
    FlipAll(old);
    return false;
  }

  PaddedShape &        m_Shape;
  const VoxelBox &     m_Box;
  const ChangeBounds & m_Bounds;
  const PaddedCost &   m_Cost;
  std::size_t          m_Work = 0;  ///< voxels looked at
  std::size_t          m_Looks = 0; ///< for proposals, of a change
};

/** Parts of a list of voxels that hang together over faces, or over corners, too. */
std::vector<std::vector<Voxel>>
PartsOf(std::vector<Voxel> left, bool corners)
{
  ranges::sort(left);
  std::vector<std::vector<Voxel>> parts;
  std::vector<char>               isDone(left.size(), 0);
  for (std::size_t first = 0; first < left.size(); ++first)
  {
    if (std::exchange(isDone[first], char{ 1 }) != 0)
    {
      continue;
    }
    std::vector<Voxel> & part = parts.emplace_back(1, left[first]);
    for (std::size_t i = 0; i < part.size(); ++i)
    {
      for (std::int32_t k = 0; k < 27; ++k)
      {
        const Voxel step{ k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1 };
        if (!corners && std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]) != 1)
        {
          continue;
        }
        const Voxel next{ part[i][0] + step[0], part[i][1] + step[1], part[i][2] + step[2] };
        const auto  found = ranges::lower_bound(left, next);
        if (found != left.end() && *found == next &&
            std::exchange(isDone[static_cast<std::size_t>(found - left.begin())], char{ 1 }) == 0)
        {
          part.push_back(next);
        }
      }
    }
  }
  return parts;
}

/** The voxels of a change with all that follows from them. */
void
Describe(TopologyChange & change, const std::vector<Voxel> & voxels, const Voxel & shift, const Refiner & refiner)
{
  change.voxels = voxels.size();
  change.cost = refiner.CostOf(voxels);
  change.centre = { 0, 0, 0 };
  change.where.clear();
  for (const Voxel & at : voxels)
  {
    const Voxel & place = change.where.emplace_back(Voxel{ at[0] + shift[0], at[1] + shift[1], at[2] + shift[2] });
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      change.centre[axis] += place[axis];
    }
  }
  for (double & coordinate : change.centre)
  {
    coordinate /= static_cast<double>(change.voxels);
  }
  // In scan order, as runs of voxels are made of them.
  ranges::sort(change.where, {}, [](const auto & at) { return std::array{ at[2], at[1], at[0] }; });
}

} // namespace

void
RefineChanges(PaddedShape &            shape,
              const VoxelBox &         box,
              const ChangeBounds &     bounds,
              const PaddedCost &       cost,
              SimplifiedShape &        result,
              const ProgressCallback & progress)
{
  Refiner      refiner(shape, box, bounds, cost);
  const auto   shift = [&](std::size_t axis) { return box.lower[axis] - PaddedShape::kRoom; };
  const Voxel  back{ shift(0), shift(1), shift(2) };
  const double share = 1 / static_cast<double>(std::max<std::size_t>(1, result.changes.size()));
  // The greatest first: work is limited.
  ranges::stable_sort(result.changes, ranges::greater{}, [](const auto & one) { return one.where.size(); });
  double done = 0;
  for (TopologyChange & change : result.changes)
  {
    ReportProgress(progress, "simplifying", done);
    done += share;
    std::vector<Voxel> voxels;
    for (const auto & at : change.where)
    {
      voxels.push_back({ at[0] - back[0], at[1] - back[1], at[2] - back[2] });
    }
    const bool isCut = !change.isFill;
    auto       parts = PartsOf(std::move(voxels), isCut);
    bool       isBetter = false;
    for (auto & part : parts)
    {
      isBetter = refiner.Refine(part, change.isFill, parts.size() == 1) || isBetter;
    }
    if (!isBetter && isCut && parts.size() == 1)
    {
      // A wall between more than two sides, say: each stretch of it.
      parts = PartsOf(parts.front(), false);
      for (auto & part : parts)
      {
        refiner.Refine(part, change.isFill, false);
      }
    }
    voxels.clear();
    for (const auto & part : parts)
    {
      voxels.insert(voxels.end(), part.begin(), part.end());
    }
    Describe(change, voxels, back, refiner);
    (change.isFill ? result.voxelsAdded : result.voxelsRemoved) += change.voxels;
    result.cost += change.cost;
  }
  ranges::stable_sort(result.changes, ranges::greater{}, &TopologyChange::cost);
}

} // namespace voxelcore
