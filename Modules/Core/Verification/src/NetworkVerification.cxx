#include "voxelcore/Verification/NetworkVerification.h"

#include <algorithm>
#include <bit>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

namespace voxelcore
{

namespace
{

using Voxel = std::array<std::int32_t, 3>;
using Values = std::array<std::int64_t, 2>;

/** Labels of voxels, one voxel at a time. */
class LabelledVoxels
{
public:
  explicit LabelledVoxels(const std::vector<std::pair<std::int64_t, const VoxelShape *>> & labels)
    : m_Labels(labels)
  {}

  /** 0: none. */
  std::int64_t
  At(const Voxel & voxel) const
  {
    for (const auto & [value, shape] : m_Labels)
    {
      if (shape->Contains(voxel[0], voxel[1], voxel[2]))
      {
        return value;
      }
    }
    return 0;
  }

  /** Calls `visit` with each voxel of a label that has a neighbour which is not the label's. */
  template <typename TVisit>
  void
  ForBoundary(const VoxelShape & shape, TVisit && visit) const
  {
    const VoxelBox & box = shape.Box();
    for (std::int32_t z = 0; z < box.size[2]; ++z)
    {
      for (std::int32_t y = 0; y < box.size[1]; ++y)
      {
        const ConstShapeRow own = shape.Row(y, z);
        for (std::size_t word = 0; word < own.size(); ++word)
        {
          std::uint64_t inner = own[word];
          for (std::int32_t step = 0; inner != 0 && step < 9; ++step)
          {
            const ConstShapeRow row = shape.RowAnywhere(y + step % 3 - 1, z + step / 3 - 1);
            const std::uint64_t bits = row[word];
            const std::uint64_t below = word > 0 ? row[word - 1] >> 63U : 0;
            const std::uint64_t above = word + 1 < row.size() ? row[word + 1] << 63U : 0;
            inner &= bits & (bits << 1U | below) & (bits >> 1U | above);
          }
          for (std::uint64_t bits = own[word] & ~inner; bits != 0; bits &= bits - 1)
          {
            visit(Voxel{ box.lower[0] + static_cast<std::int32_t>(64 * word) + std::countr_zero(bits),
                         box.lower[1] + y,
                         box.lower[2] + z });
          }
        }
      }
    }
  }

private:
  const std::vector<std::pair<std::int64_t, const VoxelShape *>> & m_Labels;
};

template <typename TVisit>
void
ForNeighbours(const Voxel & voxel, TVisit && visit)
{
  for (std::int32_t step = 0; step < 27; ++step)
  {
    const Voxel neighbour{ voxel[0] + step % 3 - 1, voxel[1] + step / 3 % 3 - 1, voxel[2] + step / 9 - 1 };
    if (step != 13)
    {
      visit(neighbour, (step % 3 != 1) + (step / 3 % 3 != 1) + (step / 9 != 1));
    }
  }
}

/** Values, voxels and faces of each contact, sorted. */
std::vector<std::tuple<Values, std::uint64_t, std::uint64_t>>
CountContacts(const std::vector<std::pair<std::int64_t, const VoxelShape *>> & labels)
{
  const LabelledVoxels                              all(labels);
  std::map<Values, std::map<Voxel, bool>>           touching; // whether a voxel was flooded
  std::map<std::pair<Values, Voxel>, std::uint64_t> faces;    // each at the voxel of the smaller value
  for (const auto & [value, shape] : labels)
  {
    all.ForBoundary(*shape, [&, own = value](const Voxel & voxel) {
      if (all.At(voxel) != own)
      {
        return;
      }
      ForNeighbours(voxel, [&](const Voxel & neighbour, int steps) {
        const std::int64_t other = all.At(neighbour);
        if (other == 0 || other == own)
        {
          return;
        }
        const Values pair{ std::min(own, other), std::max(own, other) };
        touching[pair].emplace(voxel, false);
        if (steps == 1 && own < other)
        {
          ++faces[{ pair, voxel }];
        }
      });
    });
  }
  std::vector<std::tuple<Values, std::uint64_t, std::uint64_t>> contacts;
  for (auto & [pair, voxels] : touching)
  {
    for (auto & [first, isFlooded] : voxels)
    {
      if (isFlooded)
      {
        continue;
      }
      std::uint64_t      found = 0;
      std::uint64_t      shared = 0;
      std::vector<Voxel> open{ first };
      isFlooded = true;
      while (!open.empty())
      {
        const Voxel voxel = open.back();
        open.pop_back();
        ++found;
        const auto own = faces.find({ pair, voxel });
        shared += own == faces.end() ? 0 : own->second;
        ForNeighbours(voxel, [&, &known = voxels](const Voxel & neighbour, int) {
          const auto next = known.find(neighbour);
          if (next != known.end() && !next->second)
          {
            next->second = true;
            open.push_back(neighbour);
          }
        });
      }
      contacts.emplace_back(pair, found, shared);
    }
  }
  std::sort(contacts.begin(), contacts.end());
  return contacts;
}

std::string
ContactText(const Values & pair)
{
  return "a contact of labels " + std::to_string(pair[0]) + " and " + std::to_string(pair[1]);
}

} // namespace

std::vector<std::string>
CheckNetwork(const NetworkClaims & claims)
{
  std::vector<std::string> problems;
  const std::size_t        count = claims.positions.size();
  // Components and Euler number of points, segments and faces.
  std::vector<std::uint32_t> parent(count);
  std::iota(parent.begin(), parent.end(), 0U);
  const auto find = [&](std::uint32_t point) {
    while (parent[point] != point)
    {
      point = parent[point] = parent[parent[point]];
    }
    return point;
  };
  auto       components = static_cast<std::int64_t>(count);
  auto       euler = static_cast<std::int64_t>(count);
  const auto unite = [&](std::uint32_t one, std::uint32_t other) {
    const std::uint32_t a = find(one);
    const std::uint32_t b = find(other);
    components -= a == b ? 0 : 1;
    parent[a] = b;
  };

  std::map<std::array<double, 3>, std::set<std::int64_t>> meeting; // labels of the branches at each contact point
  for (std::size_t point = 0; point < count; ++point)
  {
    if (claims.contactPoints[point] != 0)
    {
      meeting[claims.positions[point]];
    }
  }
  for (std::size_t branch = 0; branch + 1 < claims.branchOffsets.size(); ++branch)
  {
    const auto             points = claims.branchPoints.subspan(claims.branchOffsets[branch],
                                                    claims.branchOffsets[branch + 1] - claims.branchOffsets[branch]);
    std::set<std::int64_t> own;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      if (i > 0)
      {
        --euler;
        unite(points[i - 1], points[i]);
      }
      const bool isEnd = i == 0 || i + 1 == points.size();
      if (claims.contactPoints[points[i]] == 0)
      {
        own.insert(claims.pointLabels[points[i]]);
      }
      else if (!isEnd)
      {
        problems.push_back("branch " + std::to_string(branch) + " passes a contact");
      }
    }
    if (own.size() != 1)
    {
      problems.push_back("branch " + std::to_string(branch) + " is of " + std::to_string(own.size()) + " labels");
      continue;
    }
    for (const std::uint32_t end : { points.front(), points.back() })
    {
      if (claims.contactPoints[end] != 0)
      {
        meeting[claims.positions[end]].insert(*own.begin());
      }
    }
  }
  std::set<std::array<std::uint32_t, 2>> faceEdges;
  for (std::size_t face = 0; face + 1 < claims.faceOffsets.size(); ++face)
  {
    ++euler;
    for (std::uint64_t i = claims.faceOffsets[face]; i < claims.faceOffsets[face + 1]; ++i)
    {
      const bool          isLast = i + 1 == claims.faceOffsets[face + 1];
      const std::uint32_t a = claims.faceVertices[i];
      const std::uint32_t b = claims.faceVertices[isLast ? claims.faceOffsets[face] : i + 1];
      unite(a, b);
      faceEdges.insert({ std::min(a, b), std::max(a, b) });
    }
  }
  euler -= static_cast<std::int64_t>(faceEdges.size());
  if (components != claims.components || euler != claims.euler)
  {
    problems.push_back("it has " + std::to_string(components) + " components and the Euler number " +
                       std::to_string(euler) + ", the labels' union " + std::to_string(claims.components) + " and " +
                       std::to_string(claims.euler));
  }

  std::set<std::array<double, 3>>                               known(claims.gaps.begin(), claims.gaps.end());
  std::vector<std::tuple<Values, std::uint64_t, std::uint64_t>> claimed;
  for (const ClaimedContact & contact : claims.contacts)
  {
    claimed.emplace_back(contact.labels, contact.voxels, contact.faces);
    for (const auto & place : contact.places)
    {
      known.insert(place);
      const auto at = meeting.find(place);
      if (at == meeting.end() || !at->second.contains(contact.labels[0]) || !at->second.contains(contact.labels[1]))
      {
        problems.push_back("at " + ContactText(contact.labels) + " their branches do not meet");
      }
    }
  }
  for (const auto & [place, labels] : meeting)
  {
    if (!known.contains(place))
    {
      problems.push_back("branches meet where labels do not touch");
    }
  }
  std::sort(claimed.begin(), claimed.end());
  if (const auto counted = CountContacts(claims.labels); counted != claimed)
  {
    problems.push_back("it has " + std::to_string(claimed.size()) + " contacts of labels, and a count of voxels " +
                       std::to_string(counted.size()) + ", or of other sizes");
  }
  return problems;
}

} // namespace voxelcore
