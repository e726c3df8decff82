#include "voxelcore/Compare/MaskComparison.h"

#include "voxelcore/Base/CountBits.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Lattice/LatticePoint.h"
#include "voxelcore/Shape/ShapeOperations.h"
#include "voxelcore/Shape/ShapeRuns.h"
#include "voxelcore/Shape/ShapeTopology.h"
#include "voxelcore/Verification/BoundaryTree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double
Ratio(std::uint64_t part, std::uint64_t whole, double ofNothing)
{
  return whole == 0 ? ofNothing : static_cast<double>(part) / static_cast<double>(whole);
}

/** From each voxel of one to the nearest of the other, mm. */
std::vector<double>
DistancesTo(const std::vector<std::array<std::int32_t, 3>> & from, const BoundaryTree & to)
{
  std::vector<double> distances(from.size());
  RunInParts(from.size() > 1000, from.size(), [&](std::size_t first, std::size_t last) {
    std::vector<BoundaryTree::Candidate> found;
    for (std::size_t i = first; i < last; ++i)
    {
      const auto & [x, y, z] = from[i];
      distances[i] =
        to.FindNearest({ static_cast<double>(x), static_cast<double>(y), static_cast<double>(z) }, 0, found);
    }
  });
  return distances;
}

BoundaryTree
TreeOf(const std::vector<std::array<std::int32_t, 3>> & voxels, const Vector3 & spacing)
{
  std::vector<LatticePoint> points;
  points.reserve(voxels.size());
  for (const auto & [x, y, z] : voxels)
  {
    points.push_back({ x, y, z });
  }
  return { std::move(points), spacing };
}

TopologyComparison
Compared(const TopologyNumbers & a, const TopologyNumbers & b)
{
  TopologyComparison compared{ a, b, {} };
  for (std::size_t k = 0; k < 3; ++k)
  {
    compared.errors[k] = std::abs(a.betti[k] - b.betti[k]);
  }
  return compared;
}

/** Runs with the parts they are of, numbered by their first runs; rows and voxels in indices of the scan. */
struct Parts
{
  static constexpr std::uint32_t kOutside = 0xFFFFFFFF;

  Runs                        runs;
  std::array<std::int32_t, 3> lower{}; ///< of x, and of the first row
  std::vector<std::uint32_t>  of;      ///< per run; kOutside: no part
  std::vector<std::uint64_t>  voxels;  ///< per part
};

Parts
PartsOf(Runs runs, const std::array<std::int32_t, 3> & lower, bool diagonals, bool firstIsOutside)
{
  Parts     parts;
  UnionFind sets = UniteRuns(runs, diagonals);
  parts.of.assign(runs.begin.size(), Parts::kOutside);
  for (std::size_t run = 0; run < parts.of.size(); ++run)
  {
    const std::size_t first = sets.Find(run);
    if (firstIsOutside && first == 0)
    {
      continue;
    }
    if (first == run)
    {
      parts.of[run] = static_cast<std::uint32_t>(parts.voxels.size());
      parts.voxels.push_back(0);
    }
    else
    {
      parts.of[run] = parts.of[first];
    }
    parts.voxels[parts.of[run]] += static_cast<std::uint64_t>(runs.end[run] - runs.begin[run]);
  }
  parts.lower = lower;
  parts.runs = std::move(runs);
  return parts;
}

Parts
PiecesOf(const VoxelShape & shape)
{
  return PartsOf(VoxelRuns(shape), shape.Box().lower, true, false);
}

Parts
CavitiesOf(const VoxelShape & shape)
{
  const auto & lower = shape.Box().lower; // rows are those of the grown box, x is the box's
  return PartsOf(BackgroundRuns(shape), { lower[0], lower[1] - 1, lower[2] - 1 }, false, true);
}

/** Voxels in common, by parts of A and of B. */
std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t>
SharedVoxels(const Parts & a, const Parts & b)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t> shared;
  for (std::int32_t z = 0; z < a.runs.rowsZ; ++z)
  {
    for (std::int32_t y = 0; y < a.runs.rowsY; ++y)
    {
      const std::int32_t otherY = y + a.lower[1] - b.lower[1];
      const std::int32_t otherZ = z + a.lower[2] - b.lower[2];
      if (otherY < 0 || otherZ < 0 || otherY >= b.runs.rowsY || otherZ >= b.runs.rowsZ)
      {
        continue;
      }
      const auto row = [](const Runs & runs, std::int32_t atY, std::int32_t atZ) {
        return static_cast<std::size_t>(atZ) * static_cast<std::size_t>(runs.rowsY) + static_cast<std::size_t>(atY);
      };
      const std::size_t rowA = row(a.runs, y, z);
      const std::size_t rowB = row(b.runs, otherY, otherZ);
      std::size_t       j = b.runs.rowStart[rowB];
      for (std::size_t i = a.runs.rowStart[rowA]; i < a.runs.rowStart[rowA + 1]; ++i)
      {
        const std::int32_t begin = a.runs.begin[i] + a.lower[0];
        const std::int32_t end = a.runs.end[i] + a.lower[0];
        while (j < b.runs.rowStart[rowB + 1] && b.runs.end[j] + b.lower[0] <= begin)
        {
          ++j;
        }
        for (std::size_t k = j; k < b.runs.rowStart[rowB + 1] && b.runs.begin[k] + b.lower[0] < end; ++k)
        {
          if (a.of[i] != Parts::kOutside && b.of[k] != Parts::kOutside)
          {
            shared[{ a.of[i], b.of[k] }] += static_cast<std::uint64_t>(std::min(end, b.runs.end[k] + b.lower[0]) -
                                                                       std::max(begin, b.runs.begin[k] + b.lower[0]));
          }
        }
      }
    }
  }
  return shared;
}

/** The voxels in the middle of some parts' scan order. */
std::vector<std::array<std::int32_t, 3>>
MiddleVoxels(const Parts & parts)
{
  std::vector<std::array<std::int32_t, 3>> places(parts.voxels.size());
  std::vector<std::uint64_t>               before(parts.voxels.size(), 0);
  for (std::int32_t z = 0; z < parts.runs.rowsZ; ++z)
  {
    for (std::int32_t y = 0; y < parts.runs.rowsY; ++y)
    {
      const std::size_t row =
        static_cast<std::size_t>(z) * static_cast<std::size_t>(parts.runs.rowsY) + static_cast<std::size_t>(y);
      for (std::size_t i = parts.runs.rowStart[row]; i < parts.runs.rowStart[row + 1]; ++i)
      {
        const std::uint32_t part = parts.of[i];
        if (part == Parts::kOutside)
        {
          continue;
        }
        const std::uint64_t middle = parts.voxels[part] / 2;
        const auto          count = static_cast<std::uint64_t>(parts.runs.end[i] - parts.runs.begin[i]);
        if (before[part] <= middle && middle < before[part] + count)
        {
          places[part] = { parts.lower[0] + parts.runs.begin[i] + static_cast<std::int32_t>(middle - before[part]),
                           parts.lower[1] + y,
                           parts.lower[2] + z };
        }
        before[part] += count;
      }
    }
  }
  return places;
}

/** Parts of `own` that share a part of the other with one that shares more voxels with it: all but the first. */
void
AddFurther(const std::vector<std::vector<std::pair<std::uint64_t, std::uint32_t>>> & byOther,
           std::vector<std::uint8_t> &                                               isFurther)
{
  for (auto list : byOther)
  {
    ranges::sort(list, [](const auto & one, const auto & two) {
      return one.first != two.first ? one.first > two.first : one.second < two.second;
    });
    for (std::size_t i = 1; i < list.size(); ++i)
    {
      isFurther[list[i].second] = 1;
    }
  }
}

void
AddDiffering(PartKind kind, const Parts & a, const Parts & b, std::vector<DifferingPart> & differing)
{
  std::vector<std::vector<std::pair<std::uint64_t, std::uint32_t>>> byA(a.voxels.size());
  std::vector<std::vector<std::pair<std::uint64_t, std::uint32_t>>> byB(b.voxels.size());
  for (const auto & [pair, voxels] : SharedVoxels(a, b))
  {
    byA[pair.first].emplace_back(voxels, pair.second);
    byB[pair.second].emplace_back(voxels, pair.first);
  }
  std::vector<std::uint8_t> broken(b.voxels.size(), 0);
  std::vector<std::uint8_t> joined(a.voxels.size(), 0);
  AddFurther(byA, broken);
  AddFurther(byB, joined);
  const auto placesA = MiddleVoxels(a);
  const auto placesB = MiddleVoxels(b);
  const auto add = [&](PartChange change, const Parts & parts, const auto & places, const auto & is) {
    for (std::uint32_t part = 0; part < parts.voxels.size(); ++part)
    {
      if (is(part))
      {
        differing.push_back({ kind, change, parts.voxels[part], places[part] });
      }
    }
  };
  add(PartChange::Missed, a, placesA, [&](std::uint32_t part) { return byA[part].empty(); });
  add(PartChange::Invented, b, placesB, [&](std::uint32_t part) { return byB[part].empty(); });
  add(PartChange::Broken, b, placesB, [&](std::uint32_t part) { return broken[part] != 0; });
  add(PartChange::Joined, a, placesA, [&](std::uint32_t part) { return joined[part] != 0; });
}

} // namespace

double
MaskOverlap::Dice() const
{
  return Ratio(2 * both, a + b, 1);
}

double
MaskOverlap::Jaccard() const
{
  return Ratio(both, a + b - both, 1);
}

double
MaskOverlap::MissingRatio() const
{
  return Ratio(a - both, a, kNone);
}

double
MaskOverlap::LeakageRatio() const
{
  return Ratio(b - both, a, kNone);
}

const char *
NameOf(PartKind kind)
{
  return kind == PartKind::Piece ? "piece" : kind == PartKind::Loop ? "loop" : "cavity";
}

const char *
NameOf(PartChange change)
{
  switch (change)
  {
    case PartChange::Missed:
      return "missed";
    case PartChange::Invented:
      return "invented";
    case PartChange::Broken:
      return "broken";
    case PartChange::Joined:
      break;
  }
  return "joined";
}

MaskOverlap
CountOverlap(const VoxelShape & a, const VoxelShape & b)
{
  MaskOverlap overlap{ a.CountVoxels(), b.CountVoxels(), 0 };
  const Runs  runs = VoxelRuns(a);
  const auto  offset = [&](std::size_t k) { return a.Box().lower[k] - b.Box().lower[k]; };
  std::size_t row = 0;
  for (std::int32_t z = 0; z < runs.rowsZ; ++z)
  {
    for (std::int32_t y = 0; y < runs.rowsY; ++y, ++row)
    {
      const ConstShapeRow other = b.RowAnywhere(y + offset(1), z + offset(2));
      for (std::size_t run = runs.rowStart[row]; run < runs.rowStart[row + 1]; ++run)
      {
        const std::int32_t begin = std::max(runs.begin[run] + offset(0), 0);
        const std::int32_t end = std::min(runs.end[run] + offset(0), b.Box().size[0]);
        overlap.both += static_cast<std::uint64_t>(CountBits(other, begin, end));
      }
    }
  }
  return overlap;
}

std::vector<std::array<std::int32_t, 3>>
BoundaryVoxels(const VoxelShape & shape)
{
  std::vector<std::array<std::int32_t, 3>> voxels;
  const auto & [lower, size] = shape.Box();
  for (std::int32_t z = 0; z < size[2]; ++z)
  {
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      const ConstShapeRow row = shape.Row(y, z);
      for (std::size_t word = 0; word < row.size(); ++word)
      {
        const std::uint64_t bits = row[word];
        if (bits == 0)
        {
          continue;
        }
        const std::uint64_t before = word > 0 ? row[word - 1] >> 63U : 0;
        const std::uint64_t behind = word + 1 < row.size() ? row[word + 1] << 63U : 0;
        const std::uint64_t inner = (bits << 1U | before) & (bits >> 1U | behind) & shape.RowAnywhere(y - 1, z)[word] &
                                    shape.RowAnywhere(y + 1, z)[word] & shape.RowAnywhere(y, z - 1)[word] &
                                    shape.RowAnywhere(y, z + 1)[word];
        for (std::uint64_t rest = bits & ~inner; rest != 0; rest &= rest - 1)
        {
          voxels.push_back(
            { lower[0] + static_cast<std::int32_t>(64 * word) + std::countr_zero(rest), lower[1] + y, lower[2] + z });
        }
      }
    }
  }
  return voxels;
}

double
QuantileOf(std::vector<double> values, double part)
{
  if (values.empty())
  {
    return kNone;
  }
  ranges::sort(values);
  const double rank = part * static_cast<double>(values.size() - 1);
  const auto   below = static_cast<std::size_t>(rank);
  const double above = values[std::min(below + 1, values.size() - 1)];
  return values[below] + (rank - static_cast<double>(below)) * (above - values[below]);
}

SurfaceDistances
MeasureSurfaceDistances(const VoxelShape & a, const VoxelShape & b, const Vector3 & spacing)
{
  const auto voxelsA = BoundaryVoxels(a);
  const auto voxelsB = BoundaryVoxels(b);
  if (voxelsA.empty() || voxelsB.empty())
  {
    return { kNone, kNone, kNone };
  }
  const std::vector<double> fromA = DistancesTo(voxelsA, TreeOf(voxelsB, spacing));
  const std::vector<double> fromB = DistancesTo(voxelsB, TreeOf(voxelsA, spacing));
  const auto                sum = [](const std::vector<double> & values) {
    double all = 0;
    for (const double value : values)
    {
      all += value;
    }
    return all;
  };
  SurfaceDistances distances;
  distances.hausdorff = std::max(*ranges::max_element(fromA), *ranges::max_element(fromB));
  distances.percentile95 = std::max(QuantileOf(fromA, 0.95), QuantileOf(fromB, 0.95));
  distances.mean = (sum(fromA) + sum(fromB)) / static_cast<double>(fromA.size() + fromB.size());
  return distances;
}

TopologyComparison
CompareTopology6(const VoxelShape & a, const VoxelShape & b)
{
  return Compared(ComputeShapeTopology(a), ComputeShapeTopology(b));
}

TopologyComparison
CompareTopology26(const VoxelShape & a, const VoxelShape & b)
{
  return Compared(ComputeClosedTopology(a), ComputeClosedTopology(b));
}

std::vector<DifferingPart>
FindDifferingParts(const VoxelShape & a, const VoxelShape & b)
{
  std::vector<DifferingPart> differing;
  AddDiffering(PartKind::Piece, PiecesOf(a), PiecesOf(b), differing);
  AddDiffering(PartKind::Cavity, CavitiesOf(a), CavitiesOf(b), differing);
  return differing;
}

} // namespace voxelcore
