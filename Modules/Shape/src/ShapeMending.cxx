#include "voxelcore/ShapeSmoothing.h"

#include "MendingWindow.h"
#include "ShapeField.h"
#include "ShapeRuns.h"
#include "voxelcore/ParallelTasks.h"
#include "voxelcore/StagePlan.h"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <vector>

namespace voxelcore
{

namespace
{

class Mending
{
public:
  explicit Mending(const VoxelShape & shape)
    : m_Shape(shape)
    , m_Runs(VoxelRuns(shape))
    , m_Components(UniteRuns(m_Runs, false))
  {}

  MendedShape
  Run(const ProgressCallback & progress)
  {
    // What is mended may let a neighbour be mended. Every change lowers a topology number, so this ends.
    // Each pass takes half of the progress left: how many there will be nobody knows, and the first is most work.
    double done = 0;
    for (bool changes = true; changes;)
    {
      changes = false;
      const double           next = 0.5 * (1 + done);
      const ProgressCallback pass = PartOfProgress(progress, done, next);
      done = next;
      ReportProgress(pass, "mending", 0);
      const std::vector<Voxel> voxels = NotSimple();
      for (std::size_t i = 0; i < voxels.size(); ++i)
      {
        if ((i & 0xFFFU) == 0)
        {
          ReportProgress(pass, "mending", static_cast<double>(i) / static_cast<double>(voxels.size()));
        }
        changes = (m_Shape.Contains(voxels[i]) ? TakeOut(voxels[i]) : PutIn(voxels[i])) || changes;
      }
    }
    m_Result.shape = std::move(m_Shape).Release();
    return std::move(m_Result);
  }

private:
  /** Voxels at the boundary whose flip changes the topology, in scan order. */
  std::vector<Voxel>
  NotSimple() const
  {
    const Voxel &                   size = m_Shape.Size();
    std::vector<std::vector<Voxel>> found(static_cast<std::size_t>(size[2]));
    FirstFailure                    failure;
#pragma omp parallel
    {
      SimpleVoxels simple;
#pragma omp for schedule(dynamic, 4)
      for (std::int32_t z = 1; z < size[2] - 1; ++z)
      {
        const auto slice = static_cast<std::size_t>(z);
        failure.Guard(slice, [&] {
          for (std::int32_t y = 1; y + 1 < size[1]; ++y)
          {
            m_Shape.VisitBoundary(y, z, [&](const Voxel & voxel) {
              if (!simple.IsSimple(m_Shape.Around(voxel)))
              {
                found[slice].push_back(voxel);
              }
            });
          }
        });
      }
    }
    failure.Rethrow();
    std::vector<Voxel> all;
    for (const auto & part : found)
    {
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }

  bool
  PutIn(const Voxel & voxel)
  {
    const Neighbourhood around = m_Shape.Around(voxel);
    const Pieces        shape = ShapePieces(around);
    const Pieces        background = BackgroundPieces(around);
    if (shape.count == 0 || (shape.count == 1 && background.count == 1))
    {
      return false;
    }
    const auto components = ComponentsOf(voxel, shape);
    if (!components || (background.count > 1 && !HangTogether(m_Shape, voxel, background, true)))
    {
      return false;
    }
    m_Shape.Flip(voxel);
    ++m_Result.voxelsAdded;
    m_Result.piecesJoined += shape.count - 1;
    m_Result.loopsClosed += background.count > 1 ? background.count - 1 : 0;
    m_Result.cavitiesFilled += background.count == 0 ? 1 : 0;
    for (const std::uint32_t component : *components)
    {
      m_Components.Unite(components->front(), component);
    }
    m_Added[Index(voxel)] = components->front();
    return true;
  }

  bool
  TakeOut(const Voxel & voxel)
  {
    const Neighbourhood around = m_Shape.Around(voxel);
    const Pieces        shape = ShapePieces(around);
    if (shape.count < 2 || BackgroundPieces(around).count != 1 || FieldAround(m_Shape, voxel) >= kFieldHalf ||
        !StandsOnSomethingThick(voxel) || !HangTogether(m_Shape, voxel, shape, false))
    {
      return false;
    }
    m_Shape.Flip(voxel);
    ++m_Result.voxelsRemoved;
    m_Result.loopsClosed += shape.count - 1;
    return true;
  }

  /** Loops of rods as thin as a voxel are not noise. */
  bool
  StandsOnSomethingThick(const Voxel & voxel) const
  {
    const auto faces = FaceNeighbours(voxel);
    return std::any_of(faces.begin(), faces.end(), [&](const Voxel & next) {
      return m_Shape.Contains(next) && FieldAround(m_Shape, next) >= kFieldWhole / 2;
    });
  }

  /** One run of the component of each piece; none when two are of the same. */
  std::optional<std::vector<std::uint32_t>>
  ComponentsOf(const Voxel & voxel, const Pieces & pieces)
  {
    std::vector<std::uint32_t> components;
    for (std::size_t piece = 0; piece < pieces.count; ++piece)
    {
      const auto   faces = FaceNeighbours(voxel);
      const auto * next = std::find_if(faces.begin(), faces.end(), [&](const Voxel & face) {
        return pieces.sets[piece] >>
                 (face[0] - voxel[0] + 1 + 3 * (face[1] - voxel[1] + 1) + 9 * (face[2] - voxel[2] + 1)) &
               1U;
      });
      components.push_back(m_Components.Find(RunOf(*next)));
    }
    std::vector<std::uint32_t> sorted = components;
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end() ? std::optional(components) : std::nullopt;
  }

  std::uint32_t
  RunOf(const Voxel & voxel) const
  {
    if (const auto added = m_Added.find(Index(voxel)); added != m_Added.end())
    {
      return added->second;
    }
    constexpr std::int32_t room = PaddedShape::kRoom;
    const auto             row = static_cast<std::size_t>(voxel[2] - room) * static_cast<std::size_t>(m_Runs.rowsY) +
                     static_cast<std::size_t>(voxel[1] - room);
    const auto first = m_Runs.begin.begin() + static_cast<std::ptrdiff_t>(m_Runs.rowStart[row]);
    const auto last = m_Runs.begin.begin() + static_cast<std::ptrdiff_t>(m_Runs.rowStart[row + 1]);
    return static_cast<std::uint32_t>(std::upper_bound(first, last, voxel[0] - room) - m_Runs.begin.begin() - 1);
  }

  std::uint64_t
  Index(const Voxel & voxel) const
  {
    const Voxel & size = m_Shape.Size();
    return (static_cast<std::uint64_t>(voxel[2]) * static_cast<std::uint64_t>(size[1]) +
            static_cast<std::uint64_t>(voxel[1])) *
             static_cast<std::uint64_t>(size[0]) +
           static_cast<std::uint64_t>(voxel[0]);
  }

  PaddedShape m_Shape;
  Runs        m_Runs;
  UnionFind   m_Components; ///< of runs
  MendedShape m_Result;

  std::unordered_map<std::uint64_t, std::uint32_t> m_Added; ///< voxels put in, with a run of their component
};

} // namespace

MendedShape
MendShape(const VoxelShape & shape, const ProgressCallback & progress)
{
  return Mending(shape).Run(progress);
}

} // namespace voxelcore
