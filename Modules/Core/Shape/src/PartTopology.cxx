#include "voxelcore/Shape/PartTopology.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Shape/ShapeRuns.h"

#include "voxelcore/Base/CountBits.h"
#include "voxelcore/Base/UnionFind.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

namespace voxelcore
{
namespace
{

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/** The complement within the rows. */
Runs
Complement(const Runs & runs, std::int32_t length)
{
  Runs other;
  other.rowsY = runs.rowsY;
  other.rowsZ = runs.rowsZ;
  other.rowStart.push_back(0);
  for (std::size_t row = 0; row + 1 < runs.rowStart.size(); ++row)
  {
    std::int32_t from = 0;
    const auto   add = [&](std::int32_t end) {
      if (from < end)
      {
        other.begin.push_back(from);
        other.end.push_back(end);
      }
    };
    for (std::size_t run = runs.rowStart[row]; run < runs.rowStart[row + 1]; ++run)
    {
      add(runs.begin[run]);
      from = runs.end[run];
    }
    add(length);
    other.rowStart.push_back(other.begin.size());
  }
  return other;
}

/** Lists what of the runs lies at the faces of the box, with the sets numbered as they come. */
class FaceLister
{
public:
  FaceLister(const Runs & runs, bool diagonals, const VoxelBox & box)
    : m_Runs(runs)
    , m_Sets(UniteRuns(runs, diagonals))
    , m_Box(box)
    , m_Number(runs.begin.size(), kNone)
  {}

  /** Runs of face `face`: low x, high x, low y, ... */
  std::vector<FaceRun>
  List(std::size_t face)
  {
    const std::int32_t   axis = static_cast<std::int32_t>(face) / 2;
    const bool           isHigh = face % 2 == 1;
    std::vector<FaceRun> listed;
    if (axis == 0)
    {
      for (std::int32_t z = 0; z < m_Runs.rowsZ; ++z)
      {
        for (std::int32_t y = 0; y < m_Runs.rowsY; ++y)
        {
          AddEnd(y, z, isHigh, listed);
        }
      }
      return listed;
    }
    const std::int32_t rows = axis == 1 ? m_Runs.rowsZ : m_Runs.rowsY;
    const std::int32_t plane = isHigh ? (axis == 1 ? m_Runs.rowsY : m_Runs.rowsZ) - 1 : 0;
    for (std::int32_t row = 0; row < rows; ++row)
    {
      const std::size_t at = axis == 1 ? RowOf(plane, row) : RowOf(row, plane);
      for (std::size_t run = m_Runs.rowStart[at]; run < m_Runs.rowStart[at + 1]; ++run)
      {
        listed.push_back({ m_Box.lower[axis == 1 ? 2 : 1] + row,
                           m_Box.lower[0] + m_Runs.begin[run],
                           m_Box.lower[0] + m_Runs.end[run],
                           NumberOf(run) });
      }
    }
    return listed;
  }

  std::uint32_t
  Open() const
  {
    return m_Open;
  }
  std::int64_t
  Closed() const
  {
    return static_cast<std::int64_t>(m_Sets.Count()) - m_Open;
  }

private:
  std::size_t
  RowOf(std::int32_t y, std::int32_t z) const
  {
    return static_cast<std::size_t>(z) * static_cast<std::size_t>(m_Runs.rowsY) + static_cast<std::size_t>(y);
  }

  std::uint32_t
  NumberOf(std::size_t run)
  {
    std::uint32_t & number = m_Number[m_Sets.Find(run)];
    number = number == kNone ? m_Open++ : number;
    return number;
  }

  /** The first or last voxel of a row. */
  void
  AddEnd(std::int32_t y, std::int32_t z, bool isHigh, std::vector<FaceRun> & listed)
  {
    const std::size_t first = m_Runs.rowStart[RowOf(y, z)];
    const std::size_t end = m_Runs.rowStart[RowOf(y, z) + 1];
    if (first == end)
    {
      return;
    }
    const std::size_t run = isHigh ? end - 1 : first;
    if (isHigh ? m_Runs.end[run] != m_Box.size[0] : m_Runs.begin[run] != 0)
    {
      return;
    }
    const std::int32_t  place = m_Box.lower[1] + y;
    const std::int32_t  row = m_Box.lower[2] + z;
    const std::uint32_t set = NumberOf(run);
    if (!listed.empty() && listed.back().row == row && listed.back().end == place && listed.back().set == set)
    {
      ++listed.back().end;
      return;
    }
    listed.push_back({ row, place, place + 1, set });
  }

  const Runs &               m_Runs;
  UnionFind                  m_Sets;
  VoxelBox                   m_Box;
  std::vector<std::uint32_t> m_Number; ///< per representative
  std::uint32_t              m_Open = 0;
};

/** 64 voxels of a row, from `offset` on, which may lie anywhere; beyond the row is background. */
std::uint64_t
BitsAt(const ConstShapeRow & row, std::int64_t offset)
{
  const std::int64_t word = offset >> 6;
  const auto         shift = static_cast<unsigned>(offset & 63);
  const auto         at = [&](std::int64_t w) {
    return w >= 0 && w < static_cast<std::int64_t>(row.size()) ? row[static_cast<std::size_t>(w)] : std::uint64_t{ 0 };
  };
  return shift == 0 ? at(word) : at(word) >> shift | at(word + 1) << (64 - shift);
}

/** Calls visit(y, z, word, offset, own) for the words of a part's rows, from its lower corner on: y and z count in the
 *  shape's box, `offset` is where the word begins in its row, `own` are the bits that belong to the part. */
template <typename TVisit>
void
ForWordsOf(const VoxelShape & shape, const VoxelBox & part, const TVisit & visit)
{
  const auto & o = shape.Box().lower;
  for (std::int32_t z = 0; z < part.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < part.size[1]; ++y)
    {
      for (std::int32_t x = 0; x < part.size[0]; x += 64)
      {
        const int           left = std::min(64, part.size[0] - x);
        const std::uint64_t own = ~std::uint64_t{ 0 } >> (64 - left);
        visit(part.lower[1] + y - o[1],
              part.lower[2] + z - o[2],
              x / 64,
              std::int64_t{ part.lower[0] } + x - o[0],
              own);
      }
    }
  }
}

/** The part as a shape of just its box. */
VoxelShape
PartOf(const VoxelShape & shape, const VoxelBox & part)
{
  VoxelShape   own(part);
  const auto & o = shape.Box().lower;
  ForWordsOf(shape,
             part,
             [&](std::int32_t y, std::int32_t z, std::int32_t word, std::int64_t offset, std::uint64_t bits) {
               own.Row(y + o[1] - part.lower[1], z + o[2] - part.lower[2])[static_cast<std::size_t>(word)] =
                 BitsAt(shape.RowAnywhere(y, z), offset) & bits;
             });
  own.Compact();
  return own;
}

/** As the Euler number of the whole, of the elements whose greatest voxel lies in the part. */
std::int64_t
EulerOf(const VoxelShape & shape, const VoxelBox & part)
{
  const auto   ones = [](std::uint64_t word) { return static_cast<std::int64_t>(CountBits(word)); };
  std::int64_t euler = 0;
  ForWordsOf(shape, part, [&](std::int32_t y, std::int32_t z, std::int32_t, std::int64_t offset, std::uint64_t own) {
    const std::array<ConstShapeRow, 4> rows{ shape.RowAnywhere(y, z),
                                             shape.RowAnywhere(y - 1, z),
                                             shape.RowAnywhere(y, z - 1),
                                             shape.RowAnywhere(y - 1, z - 1) };
    std::array<std::uint64_t, 4>       here{};
    std::array<std::uint64_t, 4>       before{}; // each voxel's neighbour along x
    for (std::size_t row = 0; row < 4; ++row)
    {
      here[row] = BitsAt(rows[row], offset);
      before[row] = BitsAt(rows[row], offset - 1);
    }
    // Voxels, inner faces across y and z, inner edges along x; less each of these with its neighbour along x.
    const auto add = [&](std::int64_t sign, std::uint64_t bits, std::uint64_t neighbours) {
      euler += sign * (ones(bits & own) - ones(bits & neighbours & own));
    };
    const std::uint64_t edges = here[0] & here[1] & here[2] & here[3];
    add(1, here[0], before[0]);
    add(-1, here[0] & here[1], before[0] & before[1]);
    add(-1, here[0] & here[2], before[0] & before[2]);
    add(1, edges, before[0] & before[1] & before[2] & before[3]);
  });
  return euler;
}

/** A face's runs in the whole's numbering. */
struct JoinRun
{
  std::int32_t row;
  std::int32_t begin;
  std::int32_t end;
  std::size_t  set;
};

/** Unites sets of runs that touch across two neighbouring planes; both lists are sorted by row and begin. */
void
UnitePlanes(const std::vector<JoinRun> & a, const std::vector<JoinRun> & b, std::int32_t reach, UnionFind & sets)
{
  for (std::int32_t shift = -reach; shift <= reach; ++shift)
  {
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < a.size() && j < b.size())
    {
      const std::int32_t row = a[i].row + shift;
      if (row != b[j].row)
      {
        row < b[j].row ? ++i : ++j;
      }
      else if (a[i].end + reach <= b[j].begin)
      {
        ++i;
      }
      else if (b[j].end + reach <= a[i].begin)
      {
        ++j;
      }
      else
      {
        sets.Unite(a[i].set, b[j].set);
        a[i].end < b[j].end ? ++i : ++j;
      }
    }
  }
}

/** The components of the shape or of the background, of those that reach faces. */
std::int64_t
CountJoined(std::span<const TopologyPart> parts, bool isBackground)
{
  // Set 0 is what lies outside the whole; the shape has none there.
  std::size_t count = 1;
  // Planes by axis, side (0: at the low end of parts) and place.
  std::map<std::tuple<std::size_t, int, std::int32_t>, std::vector<JoinRun>> planes;
  std::array<std::int32_t, 6>                                                ends{}; // of the whole
  for (std::size_t face = 0; face < 6; ++face)
  {
    ends[face] = face % 2 == 0 ? std::numeric_limits<std::int32_t>::max() : std::numeric_limits<std::int32_t>::min();
  }
  for (const TopologyPart & part : parts)
  {
    for (std::size_t face = 0; face < 6 && part.HasVoxels(); ++face)
    {
      const std::int32_t end = part.faces[face].plane;
      ends[face] = face % 2 == 0 ? std::min(ends[face], end) : std::max(ends[face], end);
      auto & plane = planes[{ face / 2, static_cast<int>(face % 2), part.faces[face].plane }];
      for (const FaceRun & run : isBackground ? part.faces[face].background : part.faces[face].shape)
      {
        plane.push_back({ run.row, run.begin, run.end, count + run.set });
      }
    }
    count += isBackground ? part.openBackground : part.openShape;
  }
  UnionFind sets(count);
  for (auto & [key, runs] : planes)
  {
    ranges::sort(runs, [](const JoinRun & a, const JoinRun & b) {
      return std::tie(a.row, a.begin) < std::tie(b.row, b.begin);
    });
  }
  for (const auto & [key, runs] : planes)
  {
    const auto [axis, side, place] = key;
    if (side == 0)
    {
      continue;
    }
    const auto next = planes.find({ axis, 0, place + 1 });
    if (next != planes.end())
    {
      UnitePlanes(runs, next->second, isBackground ? 1 : 0, sets);
    }
  }
  for (const auto & [key, runs] : planes)
  {
    const auto [axis, side, place] = key;
    if (isBackground && place == ends[2 * axis + static_cast<std::size_t>(side)])
    {
      for (const JoinRun & run : runs)
      {
        sets.Unite(0, run.set);
      }
    }
  }
  return static_cast<std::int64_t>(sets.Count());
}

} // namespace

TopologyPart
ComputeTopologyPart(const VoxelShape & shape, const VoxelBox & part)
{
  TopologyPart result;
  if (part.size[0] == 0 || part.size[1] == 0 || part.size[2] == 0)
  {
    return result;
  }
  const VoxelShape own = PartOf(shape, part);
  const Runs       runs = VoxelRuns(own);
  const Runs       others = Complement(runs, part.size[0]);
  FaceLister       in(runs, false, part);
  FaceLister       out(others, true, part);
  for (std::size_t face = 0; face < 6; ++face)
  {
    const std::size_t axis = face / 2;
    result.faces[face] = { part.lower[axis] + (face % 2 == 1 ? part.size[axis] - 1 : 0),
                           in.List(face),
                           out.List(face) };
  }
  result.euler = EulerOf(shape, part);
  result.openShape = in.Open();
  result.openBackground = out.Open();
  result.closedShape = in.Closed();
  result.closedBackground = out.Closed();
  return result;
}

TopologyNumbers
JoinTopologyParts(std::span<const TopologyPart> parts)
{
  TopologyNumbers numbers;
  for (const TopologyPart & part : parts)
  {
    numbers.euler += part.euler;
    numbers.betti[0] += part.closedShape;
    numbers.betti[2] += part.closedBackground;
  }
  numbers.betti[0] += CountJoined(parts, false) - 1;
  numbers.betti[2] += CountJoined(parts, true) - 1;
  numbers.betti[1] = numbers.betti[0] + numbers.betti[2] - numbers.euler;
  return numbers;
}

} // namespace voxelcore
