#include "voxelcore/Shape/BorderExtension.h"

#include "voxelcore/Base/Hypot.h"
#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Shape/LowerEnvelope.h"
#include "voxelcore/Shape/ShapeBits.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

namespace voxelcore
{

namespace
{

// A cut that leaves an axis by 70 degrees makes of a round tube a section three times as long as wide.
constexpr double kMostElongated = 3;

// So many radii below the border bodies are wider by this part of the depth at most. Of balls in boxes of their size,
// with radii of 3 voxels and more, none is taken for one that is cut, of tubes of any radius that leave a scan by up to
// 60 degrees all.
constexpr double kDepthInRadii = 0.5;
constexpr double kSteep = 0.4;

// The direction in which a body leaves is that of a radius of it, of so many layers where it is thin. It is the same
// body as long as its sections do not differ more than by this factor.
constexpr std::int32_t kLeastSlopeLayers = 4;
constexpr double       kSameSection = 1.5;

using Axes = std::array<std::size_t, 3>; ///< along a layer, along it the slower, across

Axes
AxesOf(std::size_t across)
{
  return across == 0 ? Axes{ 1, 2, 0 } : across == 1 ? Axes{ 0, 2, 1 } : Axes{ 0, 1, 2 };
}

/** A part of a layer of voxels: which of them are in. */
struct Layer
{
  Axes                        axes{};
  std::int32_t                at = 0; ///< along the axis across
  std::array<std::int32_t, 2> lower{};
  std::array<std::int32_t, 2> size{};
  std::vector<std::uint8_t>   in;

  std::size_t
  Number(std::int32_t u, std::int32_t v) const
  {
    return static_cast<std::size_t>(v) * size[0] + u;
  }
  bool
  Has(std::int32_t u, std::int32_t v) const
  {
    return u >= 0 && v >= 0 && u < size[0] && v < size[1] && in[Number(u, v)] != 0;
  }
  std::array<std::int32_t, 3>
  Voxel(std::int32_t u, std::int32_t v) const
  {
    std::array<std::int32_t, 3> voxel{};
    voxel[axes[0]] = lower[0] + u;
    voxel[axes[1]] = lower[1] + v;
    voxel[axes[2]] = at;
    return voxel;
  }
};

Layer
LayerOf(const VoxelShape & shape, std::size_t across, std::int32_t at, const VoxelBox & box)
{
  Layer layer;
  layer.axes = AxesOf(across);
  layer.at = at;
  for (const std::size_t k : { 0, 1 })
  {
    layer.lower[k] = box.lower[layer.axes[k]];
    layer.size[k] = box.size[layer.axes[k]];
  }
  layer.in.assign(static_cast<std::size_t>(layer.size[0]) * layer.size[1], 0);
  for (std::int32_t v = 0; v < layer.size[1]; ++v)
  {
    for (std::int32_t u = 0; u < layer.size[0]; ++u)
    {
      const auto voxel = layer.Voxel(u, v);
      layer.in[layer.Number(u, v)] = shape.Contains(voxel[0], voxel[1], voxel[2]) ? 1 : 0;
    }
  }
  return layer;
}

using Pixels = std::vector<std::array<std::int32_t, 2>>;

/** Takes all that hangs together with a pixel out of `left`. */
Pixels
TakePiece(Layer & left, std::int32_t u, std::int32_t v)
{
  Pixels piece{ { u, v } };
  left.in[left.Number(u, v)] = 0;
  for (std::size_t next = 0; next < piece.size(); ++next)
  {
    const auto [x, y] = piece[next];
    for (const auto & [dx, dy] : { std::pair(-1, 0), std::pair(1, 0), std::pair(0, -1), std::pair(0, 1) })
    {
      if (left.Has(x + dx, y + dy))
      {
        left.in[left.Number(x + dx, y + dy)] = 0;
        piece.push_back({ x + dx, y + dy });
      }
    }
  }
  return piece;
}

/** One piece of a layer, in half voxels: a pixel's centre is odd, its corners are even. */
class Section
{
public:
  Section(const Pixels & pixels, const std::array<std::int64_t, 2> & weight)
    : m_Pixels(pixels)
    , m_Weight(weight)
  {
    m_Low = pixels.front();
    std::array<std::int32_t, 2> high = m_Low;
    for (const auto & pixel : pixels)
    {
      for (const std::size_t k : { 0, 1 })
      {
        m_Low[k] = std::min(m_Low[k], pixel[k]);
        high[k] = std::max(high[k], pixel[k]);
      }
    }
    m_Nodes = { 2 * (high[0] - m_Low[0] + 1) + 1, 2 * (high[1] - m_Low[1] + 1) + 1 };
    FindCentre(FarFromOutside());
  }

  /** In half voxels from the layer's lower corner. */
  std::array<std::int32_t, 2>
  Centre() const
  {
    return { m_Centre[0] + 2 * m_Low[0], m_Centre[1] + 2 * m_Low[1] };
  }

  /** In half lattice units. */
  double
  Radius() const
  {
    return std::sqrt(static_cast<double>(m_Squared));
  }

  double
  Reach() const
  {
    std::int64_t most = 0;
    for (const auto & pixel : m_Pixels)
    {
      std::int64_t squared = 0;
      for (const std::size_t k : { 0, 1 })
      {
        const std::int64_t middle = 2 * (pixel[k] - m_Low[k]) + 1 - m_Centre[k];
        const std::int64_t far = (std::abs(middle) + 1) * m_Weight[k];
        squared += far * far;
      }
      most = std::max(most, squared);
    }
    return std::sqrt(static_cast<double>(most));
  }

private:
  std::size_t
  Number(std::int32_t i, std::int32_t j) const
  {
    return static_cast<std::size_t>(j) * m_Nodes[0] + i;
  }

  /** Squared distances of all nodes to the nearest place that does not lie in the open section. That place is a node:
   *  the nearest of a pixel to a node is. */
  std::vector<std::int64_t>
  FarFromOutside() const
  {
    std::vector<std::uint8_t> around(static_cast<std::size_t>(m_Nodes[0]) * m_Nodes[1],
                                     0); // halves and quarters that are in
    for (const auto & [u, v] : m_Pixels)
    {
      const std::int32_t i = 2 * (u - m_Low[0]) + 1;
      const std::int32_t j = 2 * (v - m_Low[1]) + 1;
      for (std::int32_t dj = -1; dj <= 1; ++dj)
      {
        for (std::int32_t di = -1; di <= 1; ++di)
        {
          ++around[Number(i + di, j + dj)];
        }
      }
    }
    const auto isOutside = [&](std::int32_t i, std::int32_t j) {
      const int all = (i % 2 == 0 ? 2 : 1) * (j % 2 == 0 ? 2 : 1);
      return around[Number(i, j)] < all;
    };
    std::vector<std::int64_t> squared(around.size());
    LowerEnvelope             along(m_Weight[0], m_Nodes[0]);
    for (std::int32_t j = 0; j < m_Nodes[1]; ++j)
    {
      along.Clear();
      for (std::int32_t i = 0; i < m_Nodes[0]; ++i)
      {
        if (isOutside(i, j))
        {
          along.Add(i, 0);
        }
      }
      along.ForAll([&](std::int32_t i, std::int64_t least) { squared[Number(i, j)] = least; });
    }
    LowerEnvelope across(m_Weight[1], m_Nodes[1]);
    for (std::int32_t i = 0; i < m_Nodes[0]; ++i)
    {
      across.Clear();
      for (std::int32_t j = 0; j < m_Nodes[1]; ++j)
      {
        across.Add(j, squared[Number(i, j)]);
      }
      across.ForAll([&](std::int32_t j, std::int64_t least) { squared[Number(i, j)] = least; });
    }
    return squared;
  }

  void
  FindCentre(const std::vector<std::int64_t> & squared)
  {
    std::array<double, 2> gravity{};
    for (const auto & pixel : m_Pixels)
    {
      for (const std::size_t k : { 0, 1 })
      {
        gravity[k] += (2 * (pixel[k] - m_Low[k]) + 1) / static_cast<double>(m_Pixels.size());
      }
    }
    double nearest = 0;
    for (std::int32_t j = 0; j < m_Nodes[1]; ++j)
    {
      for (std::int32_t i = 0; i < m_Nodes[0]; ++i)
      {
        const double x = (i - gravity[0]) * static_cast<double>(m_Weight[0]);
        const double y = (j - gravity[1]) * static_cast<double>(m_Weight[1]);
        const double off = x * x + y * y;
        if (const std::int64_t here = squared[Number(i, j)];
            here > m_Squared || (here == m_Squared && here > 0 && off < nearest))
        {
          m_Squared = here;
          nearest = off;
          m_Centre = { i, j };
        }
      }
    }
  }

  const Pixels &              m_Pixels;
  std::array<std::int64_t, 2> m_Weight;
  std::array<std::int32_t, 2> m_Low{};
  std::array<std::int32_t, 2> m_Nodes{};
  std::array<std::int32_t, 2> m_Centre{};
  std::int64_t                m_Squared = 0;
};

using Slope = std::array<double, 2>; ///< pixels a layer outwards

struct FoundSection
{
  BorderSection section;
  Pixels        pixels;
  Pixels        disc;    ///< whose centres the greatest disc holds
  Slope         slope{}; ///< of the body's axis
};

/** Whether pixels, as an open set in the plane, are one piece without holes. */
bool
IsOnePiece(const Layer & layer)
{
  std::int64_t euler = 0;
  Layer        left = layer;
  int          pieces = 0;
  for (std::int32_t v = 0; v < layer.size[1]; ++v)
  {
    for (std::int32_t u = 0; u < layer.size[0]; ++u)
    {
      if (!layer.Has(u, v))
      {
        continue;
      }
      const bool right = layer.Has(u + 1, v);
      const bool above = layer.Has(u, v + 1);
      euler += 1 - (right ? 1 : 0) - (above ? 1 : 0) + (right && above && layer.Has(u + 1, v + 1) ? 1 : 0);
      if (left.Has(u, v))
      {
        ++pieces;
        TakePiece(left, u, v);
      }
    }
  }
  return pieces == 1 && euler == 1;
}

Layer
LayerOfPixels(const Pixels & pixels)
{
  Layer                       layer;
  std::array<std::int32_t, 2> high = pixels.front();
  layer.lower = pixels.front();
  for (const auto & pixel : pixels)
  {
    for (const std::size_t k : { 0, 1 })
    {
      layer.lower[k] = std::min(layer.lower[k], pixel[k]);
      high[k] = std::max(high[k], pixel[k]);
    }
  }
  layer.size = { high[0] - layer.lower[0] + 1, high[1] - layer.lower[1] + 1 };
  layer.in.assign(static_cast<std::size_t>(layer.size[0]) * layer.size[1], 0);
  for (const auto & [u, v] : pixels)
  {
    layer.in[layer.Number(u - layer.lower[0], v - layer.lower[1])] = 1;
  }
  return layer;
}

std::array<std::int32_t, 2>
ShiftAt(const Slope & slope, std::int32_t layer)
{
  return { static_cast<std::int32_t>(std::lround(slope[0] * layer)),
           static_cast<std::int32_t>(std::lround(slope[1] * layer)) };
}

/** Whether layers of these pixels, each shifted against the last as the slope wants, can be pushed back into the first:
 *  each is one piece without holes, and so is what it has in common with the next. */
bool
CanBeStacked(const Pixels & pixels, const Slope & slope, std::int32_t layers)
{
  const Layer layer = LayerOfPixels(pixels);
  if (!IsOnePiece(layer))
  {
    return false;
  }
  std::vector<std::array<std::int32_t, 2>> steps;
  for (std::int32_t k = 0; k < layers; ++k)
  {
    const auto                        from = ShiftAt(slope, k);
    const auto                        to = ShiftAt(slope, k + 1);
    const std::array<std::int32_t, 2> step{ to[0] - from[0], to[1] - from[1] };
    if (step != std::array<std::int32_t, 2>{ 0, 0 } && std::find(steps.begin(), steps.end(), step) == steps.end())
    {
      steps.push_back(step);
    }
  }
  return std::all_of(steps.begin(), steps.end(), [&](const std::array<std::int32_t, 2> & step) {
    Layer common = layer;
    for (std::int32_t v = 0; v < layer.size[1]; ++v)
    {
      for (std::int32_t u = 0; u < layer.size[0]; ++u)
      {
        common.in[common.Number(u, v)] = layer.Has(u, v) && layer.Has(u - step[0], v - step[1]) ? 1 : 0;
      }
    }
    return IsOnePiece(common);
  });
}

std::array<double, 2>
Gravity(const Pixels & pixels)
{
  std::array<double, 2> sum{};
  for (const auto & pixel : pixels)
  {
    sum[0] += pixel[0];
    sum[1] += pixel[1];
  }
  return { sum[0] / static_cast<double>(pixels.size()), sum[1] / static_cast<double>(pixels.size()) };
}

/** All that is found at one side of the scan. */
class Side
{
public:
  Side(const VoxelShape & shape, const VoxelBox & scan, const Vector3 & spacing, std::size_t axis, bool isUpper)
    : m_Shape(shape)
    , m_Spacing(spacing)
    , m_Axis(axis)
    , m_IsUpper(isUpper)
    , m_At(isUpper ? scan.lower[axis] + scan.size[axis] - 1 : scan.lower[axis])
    , m_Layer(LayerOf(shape, axis, m_At, shape.Box()))
    , m_Weights(ComputeSpacingWeights(spacing).weight)
  {
    Layer left = m_Layer;
    for (std::int32_t v = 0; v < left.size[1]; ++v)
    {
      for (std::int32_t u = 0; u < left.size[0]; ++u)
      {
        if (left.Has(u, v))
        {
          Add(TakePiece(left, u, v));
        }
      }
    }
  }

  const Layer &
  OwnLayer() const
  {
    return m_Layer;
  }

  std::vector<FoundSection> found;

private:
  std::array<std::int64_t, 2>
  LayerWeights() const
  {
    return { m_Weights[m_Layer.axes[0]], m_Weights[m_Layer.axes[1]] };
  }

  void
  Add(Pixels pixels)
  {
    const Section section(pixels, LayerWeights());
    // Half a lattice unit in mm.
    const double  half = 0.5 * m_Spacing[m_Layer.axes[0]] / static_cast<double>(m_Weights[m_Layer.axes[0]]);
    const auto    centre = section.Centre();
    BorderSection one{ m_Axis, m_IsUpper, pixels.size(), {}, section.Radius() * half, section.Reach() * half, false };
    for (const std::size_t k : { 0, 1 })
    {
      one.centre[m_Layer.axes[k]] = m_Layer.lower[k] + 0.5 * centre[k];
    }
    one.centre[m_Axis] = m_At + 0.5;
    const double voxel = std::min(m_Spacing[m_Layer.axes[0]], m_Spacing[m_Layer.axes[1]]);
    one.isCut = one.reach <= kMostElongated * (one.radius + 0.5 * voxel) && IsSteep(centre, one);
    Pixels disc;
    for (const auto & pixel : pixels)
    {
      if (OffCentre(pixel, centre) <= one.radius)
      {
        disc.push_back(pixel);
      }
    }
    const Slope slope = one.isCut ? SlopeBelow(pixels, one.radius) : Slope{};
    found.push_back({ one, std::move(pixels), std::move(disc), slope });
  }

  /** Whether what lies below the section is not much wider: by the radii of circles of equal areas. */
  bool
  IsSteep(const std::array<std::int32_t, 2> & centre, const BorderSection & section) const
  {
    const double across = m_Spacing[m_Axis];
    const auto   layers =
      std::max<std::int32_t>(1, static_cast<std::int32_t>(std::lround(kDepthInRadii * section.radius / across)));
    const double                wide = section.reach + layers * across;
    std::array<std::int32_t, 2> low{};
    std::array<std::int32_t, 2> high{};
    for (const std::size_t k : { 0, 1 })
    {
      const double reach = wide / m_Spacing[m_Layer.axes[k]];
      low[k] = static_cast<std::int32_t>(std::floor(0.5 * centre[k] - reach));
      high[k] = static_cast<std::int32_t>(std::ceil(0.5 * centre[k] + reach)) - 1;
    }
    std::uint64_t below = 0;
    for (std::int32_t v = low[1]; v <= high[1]; ++v)
    {
      for (std::int32_t u = low[0]; u <= high[0]; ++u)
      {
        auto voxel = m_Layer.Voxel(u, v);
        voxel[m_Axis] += m_IsUpper ? -layers : layers;
        below += OffCentre({ u, v }, centre) < wide && m_Shape.Contains(voxel[0], voxel[1], voxel[2]) ? 1 : 0;
      }
    }
    const auto radiusOf = [&](std::uint64_t voxels) {
      return std::sqrt(static_cast<double>(voxels) * m_Spacing[m_Layer.axes[0]] * m_Spacing[m_Layer.axes[1]] /
                       std::numbers::pi);
    };
    return radiusOf(below) - radiusOf(section.voxels) <= kSteep * layers * across;
  }

  /** How far a pixel's centre is from a node, mm. */
  double
  OffCentre(const std::array<std::int32_t, 2> & pixel, const std::array<std::int32_t, 2> & centre) const
  {
    return Hypot(0.5 * (2 * pixel[0] + 1 - centre[0]) * m_Spacing[m_Layer.axes[0]],
                 0.5 * (2 * pixel[1] + 1 - centre[1]) * m_Spacing[m_Layer.axes[1]]);
  }

  /** How the centre of gravity of the section moves from layer to layer below the border, by regression, as far as its
   *  body neither forks nor becomes another. */
  Slope
  SlopeBelow(const Pixels & section, double radius) const
  {
    const auto depth = std::max(kLeastSlopeLayers, static_cast<std::int32_t>(std::lround(radius / m_Spacing[m_Axis])));
    Pixels     last = section;
    std::vector<std::array<double, 2>> centres{ Gravity(section) };
    for (std::int32_t k = 1; k <= depth; ++k)
    {
      // As much wider than the last section as that is wide.
      const Layer near = LayerOfPixels(last);
      VoxelBox    window = m_Shape.Box();
      for (const std::size_t i : { 0, 1 })
      {
        window.lower[m_Layer.axes[i]] = m_Layer.lower[i] + near.lower[i] - near.size[i];
        window.size[m_Layer.axes[i]] = 3 * near.size[i];
      }
      Layer  left = LayerOf(m_Shape, m_Axis, m_IsUpper ? m_At - k : m_At + k, window);
      Pixels next;
      int    pieces = 0;
      for (const auto & [u, v] : last)
      {
        const std::array<std::int32_t, 2> off{ near.size[0] - near.lower[0], near.size[1] - near.lower[1] };
        if (left.Has(u + off[0], v + off[1]))
        {
          for (const auto & pixel : TakePiece(left, u + off[0], v + off[1]))
          {
            next.push_back({ pixel[0] - off[0], pixel[1] - off[1] });
          }
          ++pieces;
        }
      }
      const double ratio = static_cast<double>(next.size()) / static_cast<double>(section.size());
      if (pieces != 1 || ratio > kSameSection || ratio < 1 / kSameSection)
      {
        break;
      }
      centres.push_back(Gravity(next));
      last = std::move(next);
    }
    Slope        slope{};
    const double middle = 0.5 * static_cast<double>(centres.size() - 1);
    double       spread = 0;
    for (std::size_t k = 0; k < centres.size(); ++k)
    {
      const double above = middle - static_cast<double>(k); // outwards
      spread += above * above;
      slope[0] += above * centres[k][0];
      slope[1] += above * centres[k][1];
    }
    return spread > 0 ? Slope{ slope[0] / spread, slope[1] / spread } : Slope{};
  }

  const VoxelShape &          m_Shape;
  const Vector3               m_Spacing;
  std::size_t                 m_Axis;
  bool                        m_IsUpper;
  std::int32_t                m_At;
  Layer                       m_Layer;
  std::array<std::int64_t, 3> m_Weights;
};

bool
Touches(const VoxelBox & box, const VoxelBox & scan, std::size_t axis, bool isUpper)
{
  if (box.size[axis] == 0 || scan.size[axis] < 2)
  {
    return false;
  }
  return isUpper ? box.lower[axis] + box.size[axis] >= scan.lower[axis] + scan.size[axis]
                 : box.lower[axis] <= scan.lower[axis];
}

/** What is added at a section: layers of pixels, in indices of the scan. */
struct Addition
{
  std::size_t  axis = 0;
  bool         isUpper = false;
  std::int32_t at = 0; ///< the layer they stand on
  Pixels       pixels;
  std::int32_t layers = 0;
  Slope        slope{};
};

/** `grown` is the shape with what was added along other axes. Straight: bodies go on at right angles to the border. */
std::vector<Addition>
AdditionsAt(const VoxelShape &   grown,
            const Side &         side,
            const Vector3 &      spacing,
            const BorderGrowth & how,
            bool                 straight)
{
  const Layer &         own = side.OwnLayer();
  const std::size_t     axis = own.axes[2];
  Layer                 left = LayerOf(grown, axis, own.at, grown.Box());
  std::vector<Addition> additions;
  for (const FoundSection & one : side.found)
  {
    if (!one.section.isCut && how.ends != BorderEnds::Overlap)
    {
      continue;
    }
    const double far = one.section.isCut ? one.section.reach : one.section.radius;
    Addition     addition{ axis, one.section.isUpper, own.at, {}, 0, {} };
    addition.layers = static_cast<std::int32_t>(std::ceil((far + how.clear) / spacing[axis]));
    if (one.section.isCut)
    {
      // With what was added along other axes; of sections joined by that the first has them all.
      const std::int32_t u = one.pixels.front()[0] + own.lower[0] - left.lower[0];
      const std::int32_t v = one.pixels.front()[1] + own.lower[1] - left.lower[1];
      if (left.Has(u, v))
      {
        addition.pixels = TakePiece(left, u, v);
      }
    }
    for (auto & pixel : addition.pixels)
    {
      pixel = { pixel[0] + left.lower[0], pixel[1] + left.lower[1] };
    }
    if (!one.section.isCut)
    {
      for (const auto & pixel : one.disc)
      {
        addition.pixels.push_back({ pixel[0] + own.lower[0], pixel[1] + own.lower[1] });
      }
    }
    if (addition.pixels.empty())
    {
      continue;
    }
    if (!straight && CanBeStacked(addition.pixels, one.slope, addition.layers))
    {
      addition.slope = one.slope;
    }
    additions.push_back(std::move(addition));
  }
  return additions;
}

/** Calls work(voxel) for each voxel added. */
template <typename TWork>
void
ForVoxels(const Addition & addition, const TWork & work)
{
  const Axes axes = AxesOf(addition.axis);
  for (std::int32_t k = 1; k <= addition.layers; ++k)
  {
    const auto shift = ShiftAt(addition.slope, k);
    for (const auto & pixel : addition.pixels)
    {
      std::array<std::int32_t, 3> voxel{};
      voxel[axes[0]] = pixel[0] + shift[0];
      voxel[axes[1]] = pixel[1] + shift[1];
      voxel[axes[2]] = addition.at + (addition.isUpper ? k : -k);
      work(voxel);
    }
  }
}

VoxelShape
WithAdditions(const VoxelShape & shape, const std::vector<Addition> & additions)
{
  std::array<std::int32_t, 3> low = shape.Box().lower;
  std::array<std::int32_t, 3> end{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    end[axis] = low[axis] + shape.Box().size[axis];
  }
  for (const Addition & addition : additions)
  {
    ForVoxels(addition, [&](const std::array<std::int32_t, 3> & voxel) {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        low[axis] = std::min(low[axis], voxel[axis]);
        end[axis] = std::max(end[axis], voxel[axis] + 1);
      }
    });
  }
  VoxelShape grown({ low, { end[0] - low[0], end[1] - low[1], end[2] - low[2] } });
  PutInto(shape, grown);
  for (const Addition & addition : additions)
  {
    ForVoxels(addition, [&](const std::array<std::int32_t, 3> & voxel) { grown.Insert(voxel[0], voxel[1], voxel[2]); });
  }
  grown.Compact();
  return grown;
}

ExtendedShape
Extend(const VoxelShape &   shape,
       const VoxelBox &     scan,
       const Vector3 &      spacing,
       const BorderGrowth & how,
       bool                 straight)
{
  ExtendedShape result{ shape, {} };
  for (const std::size_t axis : { 0, 1, 2 })
  {
    std::vector<Addition> additions; // at both sides of the shape before any is added
    for (const bool isUpper : { false, true })
    {
      if (!Touches(shape.Box(), scan, axis, isUpper))
      {
        continue;
      }
      const Side side(shape, scan, spacing, axis, isUpper);
      for (const FoundSection & one : side.found)
      {
        result.sections.push_back(one.section);
      }
      if (how.ends != BorderEnds::Closed)
      {
        auto more = AdditionsAt(result.shape, side, spacing, how, straight);
        std::move(more.begin(), more.end(), std::back_inserter(additions));
      }
    }
    if (!additions.empty())
    {
      result.shape = WithAdditions(result.shape, additions);
    }
  }
  return result;
}

} // namespace

std::vector<BorderSection>
FindBorderSections(const VoxelShape & shape, const VoxelBox & scan, const Vector3 & spacing)
{
  return Extend(shape, scan, spacing, {}, true).sections;
}

bool
GoesBeyondBorder(const VoxelShape & shape, const VoxelBox & scan, const Vector3 & spacing, BorderEnds ends)
{
  if (ends == BorderEnds::Closed)
  {
    return false;
  }
  const std::vector<BorderSection> sections = FindBorderSections(shape, scan, spacing);
  return std::any_of(sections.begin(), sections.end(), [ends](const BorderSection & section) {
    return section.isCut || ends == BorderEnds::Overlap;
  });
}

ExtendedShape
ExtendBeyondBorder(const VoxelShape & shape, const VoxelBox & scan, const Vector3 & spacing, const BorderGrowth & how)
{
  ExtendedShape result = Extend(shape, scan, spacing, how, false);
  if (result.shape.Box().size != shape.Box().size &&
      !(ComputeShapeTopology(result.shape) == ComputeShapeTopology(shape)))
  {
    // Bodies that meet beyond the border.
    result = Extend(shape, scan, spacing, how, true);
  }
  return result;
}

} // namespace voxelcore
