#include "voxelcore/Masks/TornPieces.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/Shape/ShapeOperations.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

using Voxel = std::array<std::int32_t, 3>;

constexpr std::uint64_t kFewestVoxels = 8;
constexpr double        kLeastLength = 2;   // in diameters
constexpr double        kLeastCosine = 0.5; // of the gap to the piece's way, 60 degrees
constexpr double        kAlong = 4;         // radii over which an end's way is taken

template <typename Visit>
void
VisitVoxels(const VoxelShape & shape, const Visit & visit)
{
  const VoxelBox & box = shape.Box();
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const ConstShapeRow row = shape.Row(y, z);
      for (std::size_t word = 0; word < shape.WordsPerRow(); ++word)
      {
        for (std::uint64_t bits = row[word]; bits != 0; bits &= bits - 1)
        {
          visit(Voxel{ box.lower[0] + static_cast<std::int32_t>(64 * word) + std::countr_zero(bits),
                       box.lower[1] + y,
                       box.lower[2] + z });
        }
      }
    }
  }
}

struct Piece
{
  std::vector<Voxel> voxels;
  double             radius = 0; ///< mm, of a rod as long with its volume
  Voxel              ends[2]{};
  bool               isLong = false;
};

struct Gap
{
  double      length = 0; ///< longer where the piece's way has to turn, by 1 / cos
  std::size_t piece = 0;
  std::size_t other = 0;
  Voxel       from{};
  Voxel       to{};
};

class TornPieceJoiner
{
public:
  TornPieceJoiner(VoxelShape shape, const Vector3 & spacing, double gap)
    : m_Shape(std::move(shape))
    , m_Spacing(spacing)
    , m_Gap(gap)
  {}

  TornPieces
  Join()
  {
    TornPieces result;
    if (FindPieces())
    {
      std::vector<Gap> gaps;
      for (std::size_t piece = 1; piece < m_Pieces.size(); ++piece)
      {
        for (const Voxel & end : m_Pieces[piece].ends)
        {
          if (const auto gap = m_Pieces[piece].isLong ? GapFrom(piece, end) : std::nullopt)
          {
            gaps.push_back(*gap);
          }
        }
      }
      ranges::stable_sort(gaps, {}, &Gap::length);
      UnionFind joined(m_Pieces.size());
      for (const Gap & gap : gaps)
      {
        const auto piece = static_cast<std::uint32_t>(gap.piece);
        const auto other = static_cast<std::uint32_t>(gap.other);
        if (joined.Find(piece) != joined.Find(other))
        {
          joined.Unite(piece, other);
          ++result.piecesJoined;
          result.voxelsAdded += Fill(gap.from, gap.to);
        }
      }
    }
    result.shape = std::move(m_Shape);
    return result;
  }

private:
  Vector3
  Place(const Voxel & voxel) const
  {
    return Times({ static_cast<double>(voxel[0]), static_cast<double>(voxel[1]), static_cast<double>(voxel[2]) },
                 m_Spacing);
  }

  /** The components that count, the largest first; of that only which voxels are its. Whether there are others. */
  bool
  FindPieces()
  {
    std::vector<VoxelShape> parts = SplitComponents(RemoveSmallComponents(m_Shape, kFewestVoxels).shape);
    if (parts.size() < 2)
    {
      return false;
    }
    m_Largest = std::move(parts.front());
    m_Pieces.resize(parts.size());
    for (std::size_t piece = 1; piece < parts.size(); ++piece)
    {
      VisitVoxels(parts[piece], [&](const Voxel & voxel) {
        m_Pieces[piece].voxels.push_back(voxel);
        m_PieceAt.emplace(Key(voxel), piece);
      });
      Measure(m_Pieces[piece]);
    }
    return true;
  }

  void
  Measure(Piece & piece) const
  {
    Vector3 centre{ 0, 0, 0 };
    for (const Voxel & voxel : piece.voxels)
    {
      centre = AddScaled(centre, 1 / static_cast<double>(piece.voxels.size()), Place(voxel));
    }
    const auto farthest = [&](const Vector3 & from) {
      return *ranges::max_element(piece.voxels, {}, [&](const Voxel & v) { return Distance(Place(v), from); });
    };
    piece.ends[0] = farthest(centre);
    piece.ends[1] = farthest(Place(piece.ends[0]));
    const double length = Distance(Place(piece.ends[0]), Place(piece.ends[1]));
    const double volume = static_cast<double>(piece.voxels.size()) * m_Spacing[0] * m_Spacing[1] * m_Spacing[2];
    piece.radius = std::sqrt(volume / (std::numbers::pi * std::max(length, m_Spacing[0])));
    piece.isLong = length >= kLeastLength * 2 * piece.radius;
  }

  std::optional<Gap>
  GapFrom(std::size_t number, const Voxel & end) const
  {
    const Piece & piece = m_Pieces[number];
    const Vector3 tip = Place(end);
    Vector3       inside{ 0, 0, 0 };
    double        count = 0;
    for (const Voxel & voxel : piece.voxels)
    {
      if (Distance(Place(voxel), tip) <= kAlong * piece.radius)
      {
        inside = AddScaled(inside, 1, Place(voxel));
        ++count;
      }
    }
    const Vector3 way = AddScaled(tip, -1 / count, inside);
    const double  reach =
      m_Gap * 2 * piece.radius + std::max({ m_Spacing[0], m_Spacing[1], m_Spacing[2] }); // from centre to centre
    Voxel steps{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      steps[axis] = static_cast<std::int32_t>(reach / m_Spacing[axis]);
    }
    std::optional<Gap> best;
    for (std::int32_t z = end[2] - steps[2]; z <= end[2] + steps[2]; ++z)
    {
      for (std::int32_t y = end[1] - steps[1]; y <= end[1] + steps[1]; ++y)
      {
        for (std::int32_t x = end[0] - steps[0]; x <= end[0] + steps[0]; ++x)
        {
          const Voxel   at{ x, y, z };
          const Vector3 across = Minus(Place(at), tip);
          const double  away = Length(across);
          const double  cosine = Dot(way, across) / (Length(way) * away);
          if (away > reach || !(cosine >= kLeastCosine) || (best && away / cosine >= best->length) ||
              !m_Shape.Contains(x, y, z))
          {
            continue;
          }
          const auto other = PieceAt(at);
          if (other && *other != number)
          {
            best = Gap{ away / cosine, number, *other, end, at };
          }
        }
      }
    }
    return best;
  }

  /** Among the pieces; none for one that does not count. */
  std::optional<std::size_t>
  PieceAt(const Voxel & voxel) const
  {
    if (m_Largest.Contains(voxel[0], voxel[1], voxel[2]))
    {
      return 0;
    }
    const auto found = m_PieceAt.find(Key(voxel));
    return found == m_PieceAt.end() ? std::nullopt : std::optional(found->second);
  }

  std::uint64_t
  Key(const Voxel & voxel) const
  {
    const VoxelBox & box = m_Shape.Box();
    std::uint64_t    key = 0;
    for (const std::size_t axis : { std::size_t{ 2 }, std::size_t{ 1 }, std::size_t{ 0 } })
    {
      key =
        key * static_cast<std::uint64_t>(box.size[axis]) + static_cast<std::uint64_t>(voxel[axis] - box.lower[axis]);
    }
    return key;
  }

  /** Puts in the voxels between two, step by step over faces, and tells how many. */
  std::uint64_t
  Fill(Voxel at, const Voxel & to)
  {
    std::uint64_t added = 0;
    const Voxel   from = at;
    while (at != to)
    {
      // The axis along which least of the way is done.
      std::size_t next = 0;
      double      least = 2;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const double whole = std::abs(to[axis] - from[axis]);
        const double done = whole > 0 ? (std::abs(at[axis] - from[axis]) + 0.5) / whole : 3;
        if (at[axis] != to[axis] && done < least)
        {
          least = done;
          next = axis;
        }
      }
      at[next] += to[next] > at[next] ? 1 : -1;
      added += m_Shape.Contains(at[0], at[1], at[2]) ? 0 : 1;
      m_Shape.Insert(at[0], at[1], at[2]);
    }
    return added;
  }

  VoxelShape                                     m_Shape;
  Vector3                                        m_Spacing;
  double                                         m_Gap;
  VoxelShape                                     m_Largest;
  std::vector<Piece>                             m_Pieces; ///< the first, the largest, without its voxels
  std::unordered_map<std::uint64_t, std::size_t> m_PieceAt;
};

} // namespace

TornPieces
JoinTornPieces(VoxelShape shape, const Vector3 & spacing, double gap)
{
  return TornPieceJoiner(std::move(shape), spacing, gap).Join();
}

} // namespace voxelcore
