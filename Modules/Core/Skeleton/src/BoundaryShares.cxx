#include "BoundaryShares.h"

#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>
#include <utility>

namespace voxelcore
{

namespace
{

struct Box
{
  Vector3 lower{};
  Vector3 upper{};
};

/** Sites by halves of their longest extent; the children of node k are 2k + 1 and 2k + 2. */
class SiteTree
{
public:
  explicit SiteTree(const std::vector<WeightedSite> & sites)
    : m_Sites(sites)
    , m_Order(sites.size())
  {
    std::iota(m_Order.begin(), m_Order.end(), 0U);
    std::size_t leaves = 1;
    while (leaves * kLeaf < sites.size())
    {
      leaves *= 2;
    }
    m_Nodes.resize(2 * leaves - 1);
    Build(0, 0, sites.size());
  }

  /** All sites that may be nearest to a place in the box. */
  void
  Candidates(const Box & box, std::vector<std::uint32_t> & candidates) const
  {
    double most = std::numeric_limits<double>::infinity(); // of the nearest site to any place in the box
    Lower(0, box, most);
    candidates.clear();
    Collect(0, box, most, candidates);
  }

private:
  static constexpr std::size_t kLeaf = 8;

  struct Node
  {
    Box         box;
    double      weight = 0; ///< the greatest
    std::size_t first = 0;
    std::size_t last = 0;
  };

  void
  Build(std::size_t at, std::size_t first, std::size_t last)
  {
    Node & node = m_Nodes[at];
    node.first = first;
    node.last = last;
    if (first == last)
    {
      return;
    }
    node.box = { m_Sites[m_Order[first]].place, m_Sites[m_Order[first]].place };
    for (std::size_t i = first; i < last; ++i)
    {
      const WeightedSite & site = m_Sites[m_Order[i]];
      node.weight = std::max(node.weight, site.weight);
      for (std::size_t k = 0; k < 3; ++k)
      {
        node.box.lower[k] = std::min(node.box.lower[k], site.place[k]);
        node.box.upper[k] = std::max(node.box.upper[k], site.place[k]);
      }
    }
    if (IsLeaf(at))
    {
      return;
    }
    const Vector3     extent = Minus(node.box.upper, node.box.lower);
    const auto        axis = static_cast<std::size_t>(std::max_element(extent.begin(), extent.end()) - extent.begin());
    const std::size_t middle = first + (last - first) / 2;
    const auto        place = [&](std::size_t i) { return m_Order.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(place(first), place(middle), place(last), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(m_Sites[a].place[axis], a) < std::pair(m_Sites[b].place[axis], b);
    });
    Build(2 * at + 1, first, middle);
    Build(2 * at + 2, middle, last);
  }

  bool
  IsLeaf(std::size_t at) const
  {
    return 2 * at + 1 >= m_Nodes.size();
  }

  /** Least squared distance of two boxes. */
  static double
  Least(const Box & a, const Box & b)
  {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double gap = std::max({ 0.0, a.lower[k] - b.upper[k], b.lower[k] - a.upper[k] });
      sum += gap * gap;
    }
    return sum;
  }

  /** Greatest squared distance of a place in a box. */
  static double
  Most(const Box & box, const Vector3 & place)
  {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double gap = std::max(place[k] - box.lower[k], box.upper[k] - place[k]);
      sum += gap * gap;
    }
    return sum;
  }

  void
  Lower(std::size_t at, const Box & box, double & most) const
  {
    const Node & node = m_Nodes[at];
    if (node.first == node.last || Least(node.box, box) - node.weight >= most)
    {
      return;
    }
    if (IsLeaf(at))
    {
      for (std::size_t i = node.first; i < node.last; ++i)
      {
        const WeightedSite & site = m_Sites[m_Order[i]];
        most = std::min(most, Most(box, site.place) - site.weight);
      }
      return;
    }
    const std::size_t child = 2 * at + 1;
    const bool        swap = Least(m_Nodes[child + 1].box, box) < Least(m_Nodes[child].box, box);
    Lower(swap ? child + 1 : child, box, most);
    Lower(swap ? child : child + 1, box, most);
  }

  void
  Collect(std::size_t at, const Box & box, double most, std::vector<std::uint32_t> & candidates) const
  {
    const Node & node = m_Nodes[at];
    if (node.first == node.last || Least(node.box, box) - node.weight > most)
    {
      return;
    }
    if (!IsLeaf(at))
    {
      Collect(2 * at + 1, box, most, candidates);
      Collect(2 * at + 2, box, most, candidates);
      return;
    }
    for (std::size_t i = node.first; i < node.last; ++i)
    {
      const WeightedSite & site = m_Sites[m_Order[i]];
      if (Least({ site.place, site.place }, box) - site.weight <= most)
      {
        candidates.push_back(m_Order[i]);
      }
    }
  }

  const std::vector<WeightedSite> & m_Sites;
  std::vector<std::uint32_t>        m_Order;
  std::vector<Node>                 m_Nodes;
};

/** The middle of a face between two voxels, and where outwards is along its axis. */
struct Face
{
  Vector3     middle{};
  std::size_t axis = 0;
  double      outwards = 0; ///< 1 or -1
};

constexpr std::int32_t kBrick = 8;

/** Faces of a shape brick by brick. */
class FaceBricks
{
public:
  FaceBricks(const VoxelShape & shape, const Vector3 & spacing)
    : m_Shape(shape)
    , m_Spacing(spacing)
  {}

  /** Layers along z; the last voxels' upper faces lie beyond the box. */
  std::size_t
  Layers() const
  {
    return static_cast<std::size_t>(m_Shape.Box().size[2] / kBrick + 1);
  }

  /** Calls visit(faces) with the faces of each brick of a layer that has some. */
  template <typename Visit>
  void
  ForEach(std::size_t layer, const Visit & visit) const
  {
    const auto &      size = m_Shape.Box().size;
    std::vector<Face> faces;
    const auto        z0 = static_cast<std::int32_t>(layer) * kBrick;
    for (std::int32_t y0 = 0; y0 <= size[1]; y0 += kBrick)
    {
      for (std::int32_t word = 0; 64 * word <= size[0]; ++word)
      {
        std::array<std::array<std::uint64_t, 4>, kBrick * kBrick> rows{}; // faces along x, y, z, and what is in
        std::uint64_t                                             any = 0;
        for (std::int32_t row = 0; row < kBrick * kBrick; ++row)
        {
          const std::int32_t  y = y0 + row % kBrick;
          const std::int32_t  z = z0 + row / kBrick;
          const std::uint64_t in = Word(word, y, z);
          const std::uint64_t before = in << 1U | Word(word - 1, y, z) >> 63U;
          auto &              of = rows[static_cast<std::size_t>(row)];
          of = { in ^ before, in ^ Word(word, y - 1, z), in ^ Word(word, y, z - 1), in };
          any |= of[0] | of[1] | of[2];
        }
        for (std::int32_t x0 = 0; x0 < 64; x0 += kBrick)
        {
          if ((any >> static_cast<unsigned>(x0) & 0xFFU) == 0)
          {
            continue;
          }
          faces.clear();
          for (std::int32_t row = 0; row < kBrick * kBrick; ++row)
          {
            for (std::size_t axis = 0; axis < 3; ++axis)
            {
              const auto & of = rows[static_cast<std::size_t>(row)];
              for (auto bits = static_cast<std::uint32_t>(of[axis] >> static_cast<unsigned>(x0) & 0xFFU); bits != 0;
                   bits &= bits - 1)
              {
                const std::int32_t x = x0 + std::countr_zero(bits);
                const bool         isIn = (of[3] >> static_cast<unsigned>(x) & 1U) != 0;
                faces.push_back(FaceAt({ 64 * word + x, y0 + row % kBrick, z0 + row / kBrick }, axis, isIn));
              }
            }
          }
          visit(faces);
        }
      }
    }
  }

private:
  std::uint64_t
  Word(std::int32_t word, std::int32_t y, std::int32_t z) const
  {
    const auto & size = m_Shape.Box().size;
    return word < 0 || y < 0 || z < 0 || static_cast<std::size_t>(word) >= m_Shape.WordsPerRow() || y >= size[1] ||
               z >= size[2]
             ? 0
             : m_Shape.Row(y, z)[static_cast<std::size_t>(word)];
  }

  /** The lower face of a voxel of the box. */
  Face
  FaceAt(const std::array<std::int32_t, 3> & voxel, std::size_t axis, bool isIn) const
  {
    Face face;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double lower = static_cast<double>(m_Shape.Box().lower[k]) + voxel[k];
      face.middle[k] = (lower + (k == axis ? 0 : 0.5)) * m_Spacing[k];
    }
    face.axis = axis;
    face.outwards = isIn ? -1 : 1;
    return face;
  }

  const VoxelShape & m_Shape;
  Vector3            m_Spacing;
};

} // namespace

std::vector<BoundaryShare>
BoundaryShares(const VoxelShape & shape, const Vector3 & spacing, const std::vector<WeightedSite> & sites)
{
  std::vector<BoundaryShare> shares(sites.size());
  if (sites.empty())
  {
    return shares;
  }
  const double     volume = spacing[0] * spacing[1] * spacing[2];
  const Vector3    areas{ volume / spacing[0], volume / spacing[1], volume / spacing[2] };
  const SiteTree   tree(sites);
  const FaceBricks bricks(shape, spacing);
  using Parts = std::vector<std::pair<std::uint32_t, BoundaryShare>>; // sites and what a brick gives them
  std::vector<Parts> layers(bricks.Layers());
  RunEach(layers.size(), [&](std::size_t layer) {
    std::vector<std::uint32_t> candidates;
    std::vector<BoundaryShare> sums;
    bricks.ForEach(layer, [&](const std::vector<Face> & faces) {
      Box box{ faces.front().middle, faces.front().middle };
      for (const Face & face : faces)
      {
        for (std::size_t k = 0; k < 3; ++k)
        {
          box.lower[k] = std::min(box.lower[k], face.middle[k]);
          box.upper[k] = std::max(box.upper[k], face.middle[k]);
        }
      }
      tree.Candidates(box, candidates);
      std::sort(candidates.begin(), candidates.end());
      sums.assign(candidates.size(), {});
      for (const Face & face : faces)
      {
        std::size_t best = 0;
        double      least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < candidates.size(); ++i)
        {
          const WeightedSite & site = sites[candidates[i]];
          const Vector3        away = Minus(face.middle, site.place);
          const double         distance = Dot(away, away) - site.weight;
          if (distance < least)
          {
            least = distance;
            best = i;
          }
        }
        const WeightedSite & site = sites[candidates[best]];
        const Vector3        away = Minus(face.middle, site.place);
        const double         along = Dot(away, site.axis);
        const double         across = away[face.axis] - along * site.axis[face.axis];
        const double         part = 0.5 * face.outwards * areas[face.axis] * across;
        sums[best].volume += part;
        sums[best].moment += part * along;
      }
      for (std::size_t i = 0; i < candidates.size(); ++i)
      {
        if (sums[i].volume != 0 || sums[i].moment != 0)
        {
          layers[layer].emplace_back(candidates[i], sums[i]);
        }
      }
    });
  });
  for (const Parts & parts : layers)
  {
    for (const auto & [site, sum] : parts)
    {
      shares[site].volume += sum.volume;
      shares[site].moment += sum.moment;
    }
  }
  return shares;
}

} // namespace voxelcore
