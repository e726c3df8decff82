#include "RayVotes.h"

#include "AxisCrossings.h"
#include "RowBits.h"
#include "voxelcore/Base/CountBits.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <mutex>
#include <span>
#include <vector>

namespace voxelcore
{
namespace
{

using Words = std::vector<std::uint64_t>;

/** A place where what a ray says changes. */
struct Change
{
  std::int32_t slice;
  std::int32_t row;
  std::int32_t column;
};

/** A slice of bits, rows along x. */
struct Slice
{
  Slice(std::size_t wordsPerRow, std::size_t rows)
    : words(wordsPerRow * rows, 0)
    , perRow(wordsPerRow)
  {}

  void
  Clear()
  {
    std::fill(words.begin(), words.end(), 0);
  }
  std::span<std::uint64_t>
  Row(std::int32_t row)
  {
    return { words.data() + static_cast<std::size_t>(row) * perRow, perRow };
  }
  void
  Toggle(std::int32_t row, std::int32_t column)
  {
    Row(row)[static_cast<std::size_t>(column) >> 6U] ^= std::uint64_t{ 1 } << (static_cast<unsigned>(column) & 63U);
  }

  Words       words;
  std::size_t perRow;
};

void
FillRows(const std::vector<RayRun> & runs, Slice & slice)
{
  slice.Clear();
  for (const RayRun & run : runs)
  {
    SetBits(slice.Row(run.inner), run.first, run.end);
  }
}

void
FillColumns(const std::vector<RayRun> & runs, std::int32_t rows, Slice & slice)
{
  slice.Clear();
  for (const RayRun & run : runs)
  {
    slice.Toggle(run.first, run.inner);
    if (run.end < rows)
    {
      slice.Toggle(run.end, run.inner);
    }
  }
  for (std::size_t w = slice.perRow; w < slice.words.size(); ++w)
  {
    slice.words[w] ^= slice.words[w - slice.perRow];
  }
}

/** What rays along z say in one of the two directions, slice after slice. */
class RisingSlice
{
public:
  RisingSlice(std::size_t wordsPerRow, std::size_t rows)
    : m_Slice(wordsPerRow, rows)
  {}

  void
  Add(const std::vector<RayRun> & runs, std::int32_t row, std::int32_t slices)
  {
    for (const RayRun & run : runs)
    {
      m_Changes.push_back({ run.first, row, run.inner });
      if (run.end < slices)
      {
        m_Changes.push_back({ run.end, row, run.inner });
      }
    }
  }
  void
  Sort()
  {
    std::sort(m_Changes.begin(), m_Changes.end(), [](const Change & a, const Change & b) { return a.slice < b.slice; });
  }
  Slice &
  RiseTo(std::int32_t slice)
  {
    for (; m_Next < m_Changes.size() && m_Changes[m_Next].slice <= slice; ++m_Next)
    {
      m_Slice.Toggle(m_Changes[m_Next].row, m_Changes[m_Next].column);
    }
    return m_Slice;
  }

private:
  Slice               m_Slice;
  std::vector<Change> m_Changes;
  std::size_t         m_Next = 0;
};

/** Words of which bit b tells whether at least `n` of six words have bit b set. */
struct VoteCounts
{
  std::uint64_t any;
  std::uint64_t atLeastFour;
  std::uint64_t atLeastFive;
  std::uint64_t all;
};

VoteCounts
CountVotes(const std::array<std::uint64_t, 6> & votes)
{
  // A counter of three bits for each of 64 voxels.
  std::uint64_t one = 0;
  std::uint64_t two = 0;
  std::uint64_t four = 0;
  for (const std::uint64_t vote : votes)
  {
    const std::uint64_t carry = one & vote;
    one ^= vote;
    four |= two & carry;
    two ^= carry;
  }
  return { one | two | four, four, four & (one | two), four & two };
}

} // namespace

std::uint64_t
FillByVotes(const IndexMesh &        mesh,
            const MeshSurface &      surface,
            const VoxelGrid &        grid,
            VoxelShape &             shape,
            const ProgressCallback & progress)
{
  const std::size_t   perRow = shape.WordsPerRow();
  const auto          rows = static_cast<std::size_t>(grid.size[1]);
  const AxisCrossings alongX(mesh, surface, grid, 0);
  const AxisCrossings alongY(mesh, surface, grid, 1);
  const AxisCrossings alongZ(mesh, surface, grid, 2);

  RisingSlice up(perRow, rows);
  RisingSlice down(perRow, rows);
  std::mutex  guard;
  RunEach(alongZ.SlabCount(), [&](std::size_t slab) {
    const auto             planes = alongZ.Runs(slab);
    const std::scoped_lock lock(guard);
    for (std::size_t i = 0; i < planes.size(); ++i)
    {
      const auto row = static_cast<std::int32_t>(slab * AxisCrossings::kSlab + i);
      up.Add(planes[i].in, row, grid.size[2]);
      down.Add(planes[i].inBack, row, grid.size[2]);
    }
  });
  up.Sort();
  down.Sort();

  std::vector<Slice> votes(4, Slice(perRow, rows));
  std::uint64_t      doubtful = 0;
  bool               isSure = false;
  for (std::size_t slab = 0; slab < alongX.SlabCount(); ++slab)
  {
    ReportProgress(progress, "voxelize", static_cast<double>(slab) / static_cast<double>(alongX.SlabCount()));
    std::vector<PlaneRuns> x;
    std::vector<PlaneRuns> y;
    RunBoth(
      true,
      [&] { x = alongX.Runs(slab); },
      [&] { y = alongY.Runs(slab); });
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      const auto z = static_cast<std::int32_t>(slab * AxisCrossings::kSlab + i);
      FillRows(x[i].in, votes[0]);
      FillRows(x[i].inBack, votes[1]);
      FillColumns(y[i].in, grid.size[1], votes[2]);
      FillColumns(y[i].inBack, grid.size[1], votes[3]);
      const Slice & rising = up.RiseTo(z);
      const Slice & falling = down.RiseTo(z);
      for (std::int32_t row = 0; row < grid.size[1]; ++row)
      {
        const auto to = shape.Row(row, z);
        for (std::size_t w = 0; w < perRow; ++w)
        {
          const std::size_t at = static_cast<std::size_t>(row) * perRow + w;
          const VoteCounts  counts = CountVotes({ votes[0].words[at],
                                                  votes[1].words[at],
                                                  votes[2].words[at],
                                                  votes[3].words[at],
                                                  rising.words[at],
                                                  falling.words[at] });
          to[w] = counts.atLeastFour;
          isSure = isSure || counts.atLeastFive != 0;
          doubtful += CountBits(counts.any & ~counts.all);
        }
      }
    }
  }
  if (!isSure)
  {
    throw InputError("it bounds nothing: it is open at " + std::to_string(surface.findings.openEdges) +
                     " edges, and nowhere inside do five of six rays along the axes meet it as a closed surface's; "
                     "close its holes with --cap");
  }
  return doubtful;
}

} // namespace voxelcore
