#pragma once
// Which branch goes on as which, chosen over a whole root system at once.

#include "ContactPairing.h"

#include <array>
#include <span>
#include <vector>

namespace voxelcore
{

/** The number of a branch's end; that of its other end differs in the last bit. */
constexpr ElementIndex
ArmOf(const BranchEnd & end)
{
  return 2 * end.branch + end.last;
}

constexpr BranchEnd
EndOf(ElementIndex arm)
{
  return { arm / 2, static_cast<std::uint8_t>(arm % 2) };
}

/** A root as it is now: from its base, where it has one, to its end. */
struct ChosenRoot
{
  std::array<ElementIndex, 2> arms{}; ///< the first and the last
  double                      length = 0;
  std::int32_t                level = -1;       ///< -1: nothing leads to it from a stem
  ElementIndex                parent = kNoRoot; ///< a branch of the root it springs from
  std::int32_t                children = 0;
};

/** Partners of arms at each contact and junction, such that a sum over the whole hierarchy is small that follows from
 *  them: what each pair turns and thins, the length of roots by their levels, and what roots end at (RootNumbers.h).
 *  Local search: at each place in turn all choices of partners are tried, until none is better anywhere. */
class HierarchyChoice
{
public:
  /** `partner`: per arm, where the search begins; arms of stems keep theirs. */
  HierarchyChoice(const RootBranches &        branches,
                  const RootFlow &            flow,
                  const RootPairing &         pairing,
                  std::vector<ElementIndex> & partner);

  void
  Search();

  /** Parts roots that nothing leads to from a stem where they pass one that has a way. */
  void
  ReachAll();

  /** The roots by the partners there are, sources first, then level by level; those that nothing leads to last. */
  std::vector<ChosenRoot>
  Roots();

  /** By how much the next best choice at a place is worse; 0 where there are too many arms to try all. */
  double
  Margin(ElementIndex place);

  /** The arms at a place. */
  const std::vector<ElementIndex> &
  ArmsAt(ElementIndex place) const
  {
    return m_Arms[place];
  }
  ElementIndex
  PlaceOf(ElementIndex arm) const
  {
    return m_PlaceOf[arm];
  }

private:
  double
  Cost();

  void
  FollowAll();

  void
  FindLevels();

  void
  Reach(ElementIndex place, ElementIndex parent, std::int32_t level, std::int32_t * children);

  double
  Best(ElementIndex place, bool takes);

  double
  PairCost(ElementIndex a, ElementIndex b) const;

  const RootBranches &                   m_Branches;
  const RootFlow &                       m_Flow;
  const RootPairing &                    m_Pairing;
  std::vector<ElementIndex> &            m_Partner;
  std::vector<ElementIndex>              m_PlaceOf;   ///< per arm
  std::vector<std::vector<ElementIndex>> m_Arms;      ///< per place
  std::vector<std::vector<ElementIndex>> m_Free;      ///< per place those that may have other partners
  std::vector<Vector3>                   m_Direction; ///< per arm
  std::vector<ChosenRoot>                m_Roots;
  std::vector<ElementIndex>              m_RootOf;    ///< per branch
  std::vector<ElementIndex>              m_Order;     ///< of roots that are reached
  std::vector<std::uint8_t>              m_IsReached; ///< per place
  double                                 m_Usual = 1; ///< mm, length of all for each tip
  double                                 m_Pairs = 0; ///< costs of pairs
  double                                 m_Now = 0;
};

} // namespace voxelcore
