#include "voxelcore/ShapeSmoothing.h"

#include "ShapeField.h"
#include "ShapeRuns.h"
#include "voxelcore/StagePlan.h"

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

namespace voxelcore
{

namespace
{

constexpr std::int32_t kReach = 10; ///< voxels within which two ends of a tunnel must meet

/** The part of a shape, or of its background, within reach of a voxel, which itself is left out. */
class Window
{
public:
  Window(const PaddedShape & shape, const Voxel & centre, bool background)
    : m_Background(background)
  {
    // What lies beyond the room is background.
    const Voxel &      size = shape.Size();
    const std::int32_t first = std::max(0, centre[0] - kReach);
    const std::int32_t end = std::min(size[0], centre[0] + kReach + 1);
    for (std::int32_t row = 0; row < kSide * kSide; ++row)
    {
      const std::int32_t y = centre[1] - kReach + row % kSide;
      const std::int32_t z = centre[2] - kReach + row / kSide;
      std::uint32_t      bits = 0;
      if (y >= 0 && y < size[1] && z >= 0 && z < size[2])
      {
        bits = shape.Bits(first, y, z, static_cast<unsigned>(end - first)) << (first + kReach - centre[0]);
      }
      m_Set[static_cast<std::size_t>(row)] = background ? ~bits & ((1U << kSide) - 1) : bits;
    }
    m_Set[Row(kReach, kReach)] &= ~(1U << kReach);
  }

  /** Whether all pieces around the centre hang together here. */
  bool
  Connects(const Pieces & pieces)
  {
    Put(pieces.sets[0]);
    for (bool grows = true; grows && !Reaches(pieces);)
    {
      grows = false;
      for (std::int32_t i = 0; i < kSide * kSide; ++i)
      {
        grows = Grow(i / kSide, i % kSide) || grows;
      }
      for (std::int32_t i = kSide * kSide - 1; i >= 0; --i)
      {
        grows = Grow(i / kSide, i % kSide) || grows;
      }
    }
    return Reaches(pieces);
  }

private:
  static constexpr std::int32_t kSide = 2 * kReach + 1;

  static std::size_t
  Row(std::int32_t y, std::int32_t z)
  {
    return static_cast<std::size_t>(z * kSide + y);
  }

  template <typename TVisit>
  static void
  ForRows(Neighbourhood piece, const TVisit & visit)
  {
    for (std::int32_t k = 0; k < 9; ++k)
    {
      visit(Row(kReach - 1 + k % 3, kReach - 1 + k / 3), (piece >> (3 * k) & 7U) << (kReach - 1));
    }
  }

  void
  Put(Neighbourhood piece)
  {
    m_Reached.fill(0);
    ForRows(piece, [&](std::size_t row, std::uint32_t bits) { m_Reached[row] |= bits; });
  }

  bool
  Reaches(const Pieces & pieces) const
  {
    bool all = true;
    for (std::size_t i = 0; i < pieces.count; ++i)
    {
      bool any = false;
      ForRows(pieces.sets[i], [&](std::size_t row, std::uint32_t bits) { any = any || (m_Reached[row] & bits) != 0; });
      all = all && any;
    }
    return all;
  }

  bool
  Grow(std::int32_t y, std::int32_t z)
  {
    const std::size_t row = Row(y, z);
    const auto        spread = [](std::uint32_t bits) { return bits | bits << 1 | bits >> 1; };
    std::uint32_t     from = m_Reached[row];
    for (std::int32_t dz = -1; dz <= 1; ++dz)
    {
      for (std::int32_t dy = -1; dy <= 1; ++dy)
      {
        const bool isNear = m_Background || dy == 0 || dz == 0;
        if (isNear && y + dy >= 0 && y + dy < kSide && z + dz >= 0 && z + dz < kSide)
        {
          const std::uint32_t bits = m_Reached[Row(y + dy, z + dz)];
          from |= m_Background ? spread(bits) : bits;
        }
      }
    }
    std::uint32_t reached = from & m_Set[row];
    for (std::uint32_t before = 0; before != reached;)
    {
      before = reached;
      reached = spread(reached) & m_Set[row];
    }
    const bool grows = reached != m_Reached[row];
    m_Reached[row] = reached;
    return grows;
  }

  bool                                     m_Background;
  std::array<std::uint32_t, kSide * kSide> m_Set{};
  std::array<std::uint32_t, kSide * kSide> m_Reached{};
};

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
    double done =
      0; // each pass takes half of what is left: how many there will be nobody knows, and the first is most work
    for (bool changes = true; changes; done = 0.5 * (1 + done))
    {
      changes = false;
      const ProgressCallback pass = PartOfProgress(progress, done, 0.5 * (1 + done));
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
#pragma omp parallel for schedule(dynamic, 4)
    for (std::int32_t z = 1; z < size[2] - 1; ++z)
    {
      for (std::int32_t y = 1; y + 1 < size[1]; ++y)
      {
        m_Shape.VisitBoundary(y, z, [&](const Voxel & voxel) {
          if (!IsSimpleVoxel(m_Shape.Around(voxel)))
          {
            found[static_cast<std::size_t>(z)].push_back(voxel);
          }
        });
      }
    }
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
    if (!components || (background.count > 1 && !Window(m_Shape, voxel, true).Connects(background)))
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
    m_Added[voxel] = components->front();
    return true;
  }

  bool
  TakeOut(const Voxel & voxel)
  {
    const Neighbourhood around = m_Shape.Around(voxel);
    const Pieces        shape = ShapePieces(around);
    if (shape.count < 2 || BackgroundPieces(around).count != 1 || FieldAround(m_Shape, voxel) >= kFieldHalf ||
        !StandsOnSomethingThick(voxel) || !Window(m_Shape, voxel, false).Connects(shape))
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
    if (const auto added = m_Added.find(voxel); added != m_Added.end())
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

  PaddedShape                    m_Shape;
  Runs                           m_Runs;
  UnionFind                      m_Components; ///< of runs
  std::map<Voxel, std::uint32_t> m_Added;      ///< voxels put in, with a run of their component
  MendedShape                    m_Result;
};

} // namespace

MendedShape
MendShape(const VoxelShape & shape, const ProgressCallback & progress)
{
  return Mending(shape).Run(progress);
}

} // namespace voxelcore
