#include "voxelcore/Models/ColorRange.h"

#include "voxelcore/Base/Hypot.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/VoxelCore/PolygonArea.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

/** Sums up weights by vertex. */
class VertexWeights
{
public:
  VertexWeights(const std::vector<std::array<double, 3>> & positions, const std::vector<double> & radius)
    : m_Positions(positions)
    , m_Radius(radius)
    , m_Weights(positions.size())
  {}

  void
  AddFace(std::span<const ElementIndex> corners)
  {
    const double part = PolygonArea(m_Positions, corners) / static_cast<double>(corners.size());
    for (const ElementIndex corner : corners)
    {
      m_Weights[corner] += part;
    }
  }

  void
  AddLine(ElementIndex a, ElementIndex b)
  {
    const auto & p = m_Positions[a];
    const auto & q = m_Positions[b];
    const double half = Hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) / 2;
    m_Weights[a] += half * m_Radius[a];
    m_Weights[b] += half * m_Radius[b];
  }

  void
  Append(const std::vector<double> & values, std::vector<WeightedValue> & to) const
  {
    for (std::size_t vertex = 0; vertex < std::min(values.size(), m_Weights.size()); ++vertex)
    {
      to.push_back({ values[vertex], m_Weights[vertex] });
    }
  }

private:
  const std::vector<std::array<double, 3>> & m_Positions;
  const std::vector<double> &                m_Radius;
  std::vector<double>                        m_Weights;
};

void
AppendMedial(const DisplayLabel & label, PictureColoring coloring, std::vector<WeightedValue> & values)
{
  const MedialComplex & core = label.medial.core;
  VertexWeights         weights(core.positions, core.radius);
  std::vector<bool>     onFace(core.cells.edges.size());
  for (const ElementIndex edge : core.cells.faceEdges)
  {
    onFace[edge] = true;
  }
  for (std::size_t face = 0; face < core.cells.FaceCount(); ++face)
  {
    weights.AddFace(core.cells.FaceVertices(face));
  }
  for (std::size_t edge = 0; edge < core.cells.edges.size(); ++edge)
  {
    if (!onFace[edge])
    {
      weights.AddLine(core.cells.edges[edge][0], core.cells.edges[edge][1]);
    }
  }
  weights.Append(MedialValues(label, coloring), values);
}

void
AppendCurves(const DisplayLabel & label, PictureColoring coloring, std::vector<WeightedValue> & values)
{
  const SkeletonGraph & graph = label.curves;
  VertexWeights         weights(graph.positions, SectionRadii(graph));
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto points = graph.Branch(branch);
    for (std::size_t i = 1; i < points.size(); ++i)
    {
      weights.AddLine(points[i - 1], points[i]);
    }
  }
  for (std::size_t face = 0; face < graph.FaceCount(); ++face)
  {
    weights.AddFace(
      { graph.faceVertices.data() + graph.faceOffsets[face], graph.faceVertices.data() + graph.faceOffsets[face + 1] });
  }
  weights.Append(CurveValues(label, coloring), values);
}

} // namespace

const std::vector<double> &
MedialValues(const DisplayLabel & label, PictureColoring coloring)
{
  static const std::vector<double> none;
  switch (coloring)
  {
    case PictureColoring::Confidence:
      return none;
    case PictureColoring::Lambda:
      return label.medial.core.vertexLambda;
    case PictureColoring::ErosionThickness:
      return label.erosionThickness;
    case PictureColoring::Thickness:
      return label.medial.thickness;
    default:
      return label.medial.core.radius;
  }
}

const std::vector<double> &
CurveValues(const DisplayLabel & label, PictureColoring coloring)
{
  static const std::vector<double> none;
  switch (coloring)
  {
    case PictureColoring::Confidence:
      return label.confidence;
    case PictureColoring::Lambda:
    case PictureColoring::Thickness:
      return none;
    case PictureColoring::ErosionThickness:
      return label.curves.erosionThickness;
    default:
      return SectionRadii(label.curves);
  }
}

ColorRange
RangeOfShares(std::vector<WeightedValue> values, const ColorShares & shares)
{
  std::erase_if(values, [](const WeightedValue & v) { return !std::isfinite(v.value); });
  if (values.empty())
  {
    return {};
  }
  const bool weighted = std::any_of(values.begin(), values.end(), [](const WeightedValue & v) { return v.weight > 0; });
  if (weighted)
  {
    std::erase_if(values, [](const WeightedValue & v) { return !(v.weight > 0); });
  }
  std::sort(values.begin(), values.end(), [](const auto & a, const auto & b) { return a.value < b.value; });
  double total = 0;
  for (WeightedValue & v : values)
  {
    v.weight = weighted ? v.weight : 1;
    total += v.weight;
  }
  ColorRange range{ values.front().value, values.back().value, values.front().value, values.back().value };
  double     below = 0;
  bool       begun = false;
  for (const WeightedValue & v : values)
  {
    below += v.weight;
    if (!begun && below > shares.low * total)
    {
      range.low = v.value;
      begun = true;
    }
    if (below >= shares.high * total)
    {
      range.high = v.value;
      break;
    }
  }
  if (!(range.low < range.high))
  {
    range.low = range.least;
    range.high = range.greatest;
  }
  return range;
}

std::vector<WeightedValue>
ShownValues(const DisplayLabel & label, PictureColoring coloring)
{
  std::vector<WeightedValue> values;
  if (coloring != PictureColoring::Label)
  {
    AppendMedial(label, coloring, values);
    AppendCurves(label, coloring, values);
  }
  return values;
}

LabelRange
RangeOfLabel(const std::vector<WeightedValue> & values, const ColorShares & shares)
{
  LabelRange label{ RangeOfShares(values, shares) };
  for (const WeightedValue & v : values)
  {
    label.weight += std::isfinite(v.value) ? v.weight : 0;
  }
  return label;
}

bool
NeedOwnRanges(std::span<const LabelRange> labels, const ColorRange & all)
{
  double narrow = 0;
  double sum = 0;
  for (const LabelRange & label : labels)
  {
    if (!label.range.IsEmpty())
    {
      narrow += 4 * (label.range.high - label.range.low) < all.high - all.low ? label.weight : 0;
      sum += label.weight;
    }
  }
  return sum > 0 && 2 * narrow >= sum;
}

LabelRanges
RangesOfLabels(std::span<const DisplayLabel> labels, PictureColoring coloring, const ColorShares & shares)
{
  LabelRanges ranges;
  ranges.each.resize(labels.size());
  std::vector<std::vector<WeightedValue>> values(labels.size());
  RunEach(labels.size(), [&](std::size_t i) {
    values[i] = ShownValues(labels[i], coloring);
    ranges.each[i] = RangeOfLabel(values[i], shares);
  });
  std::vector<WeightedValue> all;
  for (const auto & some : values)
  {
    all.insert(all.end(), some.begin(), some.end());
  }
  ranges.all = RangeOfShares(std::move(all), shares);
  return ranges;
}

ColorRange
RangeOfLabels(std::span<const DisplayLabel> labels, PictureColoring coloring, const ColorShares & shares)
{
  return RangesOfLabels(labels, coloring, shares).all;
}

} // namespace voxelcore
