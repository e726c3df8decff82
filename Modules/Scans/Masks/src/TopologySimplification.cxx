#include "voxelcore/Masks/TopologySimplification.h"

#include "CandidateChoice.h"
#include "CandidateGraph.h"
#include "ChangeRefinement.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Shape/ShapeRuns.h"
#include "SimpleFlips.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <algorithm>
#include <string>
#include <utility>

namespace voxelcore
{

namespace
{

/** The shape in a box that holds all its voxels. */
VoxelShape
InBox(const VoxelShape & shape, const VoxelBox & box)
{
  VoxelShape result(box);
  const Runs runs = VoxelRuns(shape);
  const auto shift = [&](std::size_t axis) { return shape.Box().lower[axis] - box.lower[axis]; };
  for (std::int32_t z = 0; z < runs.rowsZ; ++z)
  {
    for (std::int32_t y = 0; y < runs.rowsY; ++y)
    {
      const std::size_t row =
        static_cast<std::size_t>(z) * static_cast<std::size_t>(runs.rowsY) + static_cast<std::size_t>(y);
      for (std::size_t run = runs.rowStart[row]; run < runs.rowStart[row + 1]; ++run)
      {
        const std::array<std::int32_t, 3> at{ runs.begin[run] + shift(0), y + shift(1), z + shift(2) };
        const std::int32_t                end = runs.end[run] + shift(0);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          if (at[axis] < 0 || (axis == 0 ? end - 1 : at[axis]) >= box.size[axis])
          {
            throw InputError(
              "simplifying topology needs the kernel inside the shape and the shape inside the "
              "neighborhood; give levels in that order");
          }
        }
        SetRun(result.Row(at[1], at[2]), at[0], end, true);
      }
    }
  }
  return result;
}

/** The voxels of one that are not in the other, in the same box. */
VoxelShape
Without(const VoxelShape & shape, const VoxelShape & other)
{
  VoxelShape result(shape.Box());
  for (std::int32_t z = 0; z < shape.Box().size[2]; ++z)
  {
    for (std::int32_t y = 0; y < shape.Box().size[1]; ++y)
    {
      const auto to = result.Row(y, z);
      for (std::size_t word = 0; word < to.size(); ++word)
      {
        to[word] = shape.Row(y, z)[word] & ~other.Row(y, z)[word];
      }
    }
  }
  return result;
}

void
RequireNested(const VoxelShape & inner, const VoxelShape & outer)
{
  if (Without(inner, outer).CountVoxels() != 0)
  {
    throw InputError(
      "simplifying topology needs the kernel inside the shape and the shape inside the neighborhood; "
      "give levels in that order");
  }
}

std::string
NumbersText(const TopologyNumbers & numbers)
{
  return "(" + std::to_string(numbers.betti[0]) + ", " + std::to_string(numbers.betti[1]) + ", " +
         std::to_string(numbers.betti[2]) + ")";
}

/** Calls visit(voxel in indices of the padded box) for all voxels. */
template <typename TVisit>
void
VisitAll(const PaddedShape & shape, const TVisit & visit)
{
  for (std::int32_t z = 0; z < shape.Size()[2]; ++z)
  {
    for (std::int32_t y = 0; y < shape.Size()[1]; ++y)
    {
      const auto row = shape.Voxels().Row(y, z);
      for (std::size_t word = 0; word < row.size(); ++word)
      {
        for (std::uint64_t bits = row[word]; bits != 0; bits &= bits - 1)
        {
          visit(Voxel{ static_cast<std::int32_t>(64 * word) + std::countr_zero(bits), y, z });
        }
      }
    }
  }
}

/** The costliest voxel, the first of equally costly ones. */
VoxelShape
CostliestVoxel(const VoxelShape & shape, const PaddedCost & cost)
{
  VoxelShape    result(shape.Box());
  std::uint32_t highest = 0;
  Voxel         best{};
  bool          isFound = false;
  VisitAll(PaddedShape(shape), [&](const Voxel & at) {
    const std::uint32_t found = cost(at);
    if (!isFound || found > highest)
    {
      highest = found;
      best = at;
      isFound = true;
    }
  });
  if (isFound)
  {
    const auto &   lower = shape.Box().lower;
    constexpr auto room = PaddedShape::kRoom;
    result.Insert(best[0] - room + lower[0], best[1] - room + lower[1], best[2] - room + lower[2]);
  }
  return result;
}

/** Which candidates make one cut or fill: a wall that is cut hangs together over edges and corners, too, so that it is
 *  many candidates. Those of which nothing is changed are in no group. */
std::vector<std::uint32_t>
GroupChanges(const CandidateGraph & graph, const PaddedShape & changed, std::size_t & groups)
{
  UnionFind                                    together(graph.candidates.size());
  std::vector<char>                            isChanged(graph.candidates.size(), 0);
  std::vector<std::pair<Voxel, std::uint32_t>> cut;
  for (std::size_t i = 0; i < graph.voxels.size(); ++i)
  {
    const std::uint32_t owner = graph.owner[i];
    if (changed.Contains(graph.voxels[i]))
    {
      isChanged[owner] = 1;
      if (!graph.candidates[owner].isFill)
      {
        cut.emplace_back(graph.voxels[i], owner);
      }
    }
  }
  ranges::sort(cut);
  for (const auto & [at, owner] : cut)
  {
    for (std::int32_t k = 14; k < 27; ++k) // half of the neighbours
    {
      const Voxel next{ at[0] + k / 9 - 1, at[1] + k / 3 % 3 - 1, at[2] + k % 3 - 1 };
      const auto  found = ranges::lower_bound(cut, next, {}, [](const auto & one) { return one.first; });
      if (found != cut.end() && found->first == next)
      {
        together.Unite(owner, found->second);
      }
    }
  }
  std::vector<std::uint32_t> group(graph.candidates.size(), kNoCandidate);
  groups = 0;
  for (std::uint32_t i = 0; i < group.size(); ++i)
  {
    if (isChanged[i] != 0)
    {
      const std::uint32_t first = together.Find(i);
      group[i] = first == i ? static_cast<std::uint32_t>(groups++) : group[first];
    }
  }
  return group;
}

/** Cuts and fills of a choice, with what is still changed of each after the clean-up. */
void
ListChanges(const CandidateGraph &  graph,
            const CandidateChoice & choice,
            const PaddedShape &     changed,
            const VoxelBox &        box,
            SimplifiedShape &       result)
{
  std::size_t                 groups = 0;
  const auto                  group = GroupChanges(graph, changed, groups);
  const auto                  differences = GroupDifferences(graph, choice, group, groups);
  std::vector<TopologyChange> changes(groups);
  for (std::size_t i = 0; i < graph.voxels.size(); ++i)
  {
    const Voxel & at = graph.voxels[i];
    if (changed.Contains(at))
    {
      TopologyChange & change = changes[group[graph.owner[i]]];
      change.isFill = graph.candidates[graph.owner[i]].isFill;
      std::array<std::int32_t, 3> & place = change.where.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        place[axis] = at[axis] - PaddedShape::kRoom + box.lower[axis];
      }
    }
  }
  for (std::size_t i = 0; i < groups; ++i)
  {
    changes[i].difference = differences[i];
  }
  result.changes = std::move(changes);
}

void
RequireSense(const TopologyRequest & request)
{
  for (const auto & number : { request.pieces, request.loops, request.cavities })
  {
    if (number && *number < 0)
    {
      throw InputError("give numbers of pieces, loops and cavities of 0 or more, not " + std::to_string(*number));
    }
  }
}

} // namespace

SimplifiedShape
SimplifyTopology(const VoxelShape &       kernel,
                 const VoxelShape &       shape,
                 const VoxelShape &       neighbourhood,
                 const ChangeCost &       cost,
                 const TopologyRequest &  request,
                 const ProgressCallback & progress)
{
  RequireSense(request);
  const VoxelBox   box = neighbourhood.Box();
  const PaddedCost costAt(cost, box);
  SimplifiedShape  result;
  result.before = ComputeShapeTopology(shape);
  const VoxelShape whole = InBox(shape, box);
  VoxelShape       inner = InBox(kernel, box);
  RequireNested(inner, whole);
  RequireNested(whole, neighbourhood);
  const bool       isKernelGiven = inner.CountVoxels() > 0;
  const VoxelShape costliest = isKernelGiven ? VoxelShape() : CostliestVoxel(whole, costAt);
  if (!isKernelGiven)
  {
    inner = costliest;
  }
  PaddedShape grown(inner);
  PaddedShape cuts(Without(whole, inner));
  inner = VoxelShape();
  FlipSimpleVoxels(grown, cuts, costAt, PartOfProgress(progress, 0, 0.4));
  PaddedShape shrunk(neighbourhood);
  PaddedShape fills(Without(neighbourhood, whole));
  FlipSimpleVoxels(shrunk, fills, costAt, PartOfProgress(progress, 0.4, 0.8));
  const CandidateGraph graph = MakeCandidateGraph(grown, cuts, shrunk, fills, costAt);
  shrunk = PaddedShape(VoxelShape());
  const CandidateChoice choice =
    ChooseCandidates(graph, result.before.betti, request, PartOfProgress(progress, 0.8, 0.9));

  // What is changed now: candidates that change sides. What may go back goes back.
  PaddedShape & changed = fills;
  changed = PaddedShape(VoxelShape(box));
  for (std::size_t i = 0; i < graph.voxels.size(); ++i)
  {
    const std::uint32_t owner = graph.owner[i];
    if (choice.isIn[owner] != 0)
    {
      grown.Flip(graph.voxels[i]);
    }
    if ((choice.isIn[owner] != 0) == graph.candidates[owner].isFill)
    {
      changed.Flip(graph.voxels[i]);
    }
  }
  FlipSimpleVoxels(grown, changed, costAt, PartOfProgress(progress, 0.9, 0.95));
  ListChanges(graph, choice, changed, box, result);
  RefineChanges(grown,
                box,
                { isKernelGiven ? kernel : costliest, shape, neighbourhood },
                costAt,
                result,
                PartOfProgress(progress, 0.95, 1));
  result.shape = std::move(grown).Release();
  result.after = ComputeShapeTopology(result.shape);
  TopologyNumbers foreseen = result.before;
  for (std::size_t i = 0; i < 3; ++i)
  {
    foreseen.betti[i] += choice.shift[i];
  }
  foreseen.euler = foreseen.betti[0] - foreseen.betti[1] + foreseen.betti[2];
  if (foreseen != result.after)
  {
    throw CertificateError("the simplified shape has pieces, loops and cavities " + NumbersText(result.after) +
                           " and not " + NumbersText(foreseen) + ", which its cuts and fills should give");
  }
  const auto & [pieces, loops, cavities] = result.after.betti;
  result.asAsked = (!request.IsGiven()) || (pieces == request.pieces.value_or(result.before.betti[0]) &&
                                            loops == request.loops.value_or(result.before.betti[1]) &&
                                            cavities == request.cavities.value_or(result.before.betti[2]));
  return result;
}

} // namespace voxelcore
