#include "PageModel.h"

#include "MeshBudget.h"
#include "PageNumbers.h"
#include "ShownMesh.h"
#include "voxelcore/Base/Base64.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/LengthUnit.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Models/ColorRange.h"
#include "voxelcore/Models/DisplayColors.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace voxelcore
{

namespace
{

using Json = nlohmann::ordered_json;

constexpr int                         kMapColors = 65; // enough for the page to go straight between them
constexpr std::array<const char *, 5> kArrays{ "Radius", "Lambda", "ErosionThickness", "Thickness", "Confidence" };

constexpr std::array<PictureColoring, 5> kColorings{ PictureColoring::Radius,
                                                     PictureColoring::Lambda,
                                                     PictureColoring::ErosionThickness,
                                                     PictureColoring::Thickness,
                                                     PictureColoring::Confidence };

/** In the order of kArrays; null where there is none. */
using ValueArrays = std::array<const std::vector<double> *, 5>;

ValueArrays
MedialArrays(const DisplayLabel & label)
{
  return { &label.medial.core.radius,
           &label.medial.core.vertexLambda,
           label.erosionThickness.empty() ? nullptr : &label.erosionThickness,
           label.medial.thickness.empty() ? nullptr : &label.medial.thickness,
           nullptr };
}

ValueArrays
CurveArrays(const DisplayLabel & label)
{
  return { &SectionRadii(label.curves),
           nullptr,
           &label.curves.erosionThickness,
           nullptr,
           label.confidence.empty() ? nullptr : &label.confidence };
}

/** Takes all values into `range`'s least and greatest, those too which no colour goes by as they are of points: the
 *  page's codes run from one to the other. */
void
Widen(ColorRange & range, const std::vector<double> & values)
{
  for (const double value : values)
  {
    if (std::isfinite(value) && !range.IsEmpty())
    {
      range.least = std::min(range.least, value);
      range.greatest = std::max(range.greatest, value);
    }
  }
}

/** nlohmann-json would write null for what is not finite; the page could do nothing with it. */
template <typename T, std::size_t N>
void
RequireFinite(const std::array<T, N> & numbers, const DisplayLabel & label)
{
  for (const T number : numbers)
  {
    if (!std::isfinite(number))
    {
      throw Error("the page cannot show label '" + label.name + "': it has a place or a colour that is no number");
    }
  }
}

void
RequireFinitePlaces(const DisplayLabel & label)
{
  RequireFinite(label.color, label);
  for (const auto & place : label.surface.points)
  {
    RequireFinite(place, label);
  }
  for (const auto * places : { &label.medial.core.positions, &label.curves.positions })
  {
    for (const auto & place : *places)
    {
      RequireFinite(place, label);
    }
  }
}

template <std::size_t N>
std::vector<std::uint32_t>
Flat(const std::vector<std::array<std::uint32_t, N>> & elements)
{
  std::vector<std::uint32_t> flat;
  flat.reserve(N * elements.size());
  for (const auto & element : elements)
  {
    flat.insert(flat.end(), element.begin(), element.end());
  }
  return flat;
}

/** The units that people read lengths in: name, size, and the least length each is taken for; as LengthUnit. */
Json
UnitsJson(SpatialUnit unit)
{
  Json units = Json::array();
  for (const double typical : { 1.0, 1e-3, 1e-6 })
  {
    const LengthUnit one = LengthUnit::For(typical, unit);
    const double     size = 1 / one.Of(1);
    units.push_back({ { "name", one.Symbol() }, { "size", size }, { "from", 0.1 * size } });
    if (unit == SpatialUnit::Voxels)
    {
      break;
    }
  }
  units.back()["from"] = 0;
  return units;
}

class PageMaker
{
public:
  PageMaker(const DisplayContent & content, const HtmlOptions & options)
    : m_Content(content)
    , m_Options(options)
    , m_Shown(content.labels.size())
    , m_LabelRanges(content.labels.size())
  {}

  PageModel
  Make(const ProgressCallback & progress)
  {
    for (const DisplayLabel & label : m_Content.labels)
    {
      RequireFinitePlaces(label);
    }
    FindRanges();
    Simplify(progress);
    Json labels = Json::array();
    for (std::size_t i = 0; i < m_Content.labels.size(); ++i)
    {
      labels.push_back(LabelJson(i));
    }
    Json map = Json::array();
    for (int i = 0; i < kMapColors; ++i)
    {
      const Color color = LengthColor(static_cast<double>(i) / (kMapColors - 1));
      char        code[8];
      (void)std::snprintf(code,
                          sizeof(code),
                          "#%02x%02x%02x",
                          static_cast<unsigned>(std::lround(255 * color[0])),
                          static_cast<unsigned>(std::lround(255 * color[1])),
                          static_cast<unsigned>(std::lround(255 * color[2])));
      map.push_back(code);
    }
    const Json  json{ { "title", m_Options.title },
                     { "anatomical", m_Options.anatomical },
                     { "byLabel", m_Options.byLabel },
                     { "groups", m_Options.groups },
                     { "axes", m_Options.axes },
                     { "voxel", m_Options.voxel },
                     { "units", UnitsJson(m_Content.unit) },
                     { "bytes", m_Numbers.Bytes().size() },
                     { "adler32", Adler32(m_Numbers.Bytes()) },
                     { "map", map },
                     { "ranges", RangesJson(m_Ranges) },
                     { "ownRanges", m_OwnRanges },
                     { "triangles", m_ShownTriangles },
                     { "allTriangles", m_AllTriangles },
                     { "labels", labels } };
    std::string text;
    // `<` occurs in strings only. Names that are no UTF-8 get replacement characters.
    for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace))
    {
      text += c == '<' ? std::string("\\u003c") : std::string(1, c);
    }
    return { std::move(text), ToBase64(m_Numbers.Bytes()) };
  }

private:
  using Ranges = std::array<ColorRange, kArrays.size()>; ///< in the order of kArrays

  struct ShownLabel
  {
    ShownMesh surface;
    ShownMesh medial;
    ShownMesh curves;
  };

  void
  FindRanges()
  {
    const std::size_t count = m_Content.labels.size();
    for (std::size_t i = 0; i < kArrays.size(); ++i)
    {
      const LabelRanges ranges = RangesOfLabels(m_Content.labels, kColorings[i]);
      m_Ranges[i] = ranges.all;
      if (NeedOwnRanges(ranges.each, ranges.all))
      {
        m_OwnRanges.push_back(kArrays[i]);
      }
      for (std::size_t k = 0; k < count; ++k)
      {
        m_LabelRanges[k][i] = ranges.each[k].range;
        for (const ValueArrays & arrays : { MedialArrays(m_Content.labels[k]), CurveArrays(m_Content.labels[k]) })
        {
          if (arrays[i] != nullptr)
          {
            Widen(m_LabelRanges[k][i], *arrays[i]);
            Widen(m_Ranges[i], *arrays[i]);
          }
        }
      }
    }
  }

  static Json
  RangesJson(const Ranges & ranges)
  {
    Json json = Json::object();
    for (std::size_t i = 0; i < kArrays.size(); ++i)
    {
      if (!ranges[i].IsEmpty())
      {
        json[kArrays[i]] = { { "low", ranges[i].low },
                             { "high", ranges[i].high },
                             { "least", ranges[i].least },
                             { "greatest", ranges[i].greatest } };
      }
    }
    return json;
  }

  /** Labels side by side, each mesh in its share of the budget. */
  void
  Simplify(const ProgressCallback & progress)
  {
    const std::size_t count = m_Content.labels.size();
    // Per label its surface, then its medial surface. Surfaces, smooth and seen by their outline, do with less.
    constexpr double        kOutline = 0.4;
    std::vector<MeshDemand> demands;
    for (const DisplayLabel & label : m_Content.labels)
    {
      const ComplexSize medial = SizeOf(label.medial.core.cells);
      demands.push_back({ label.surface.triangles.size(), kOutline });
      demands.push_back({ medial.triangles + medial.edges, 1 });
      m_AllTriangles += label.surface.triangles.size() + medial.triangles;
    }
    const std::vector<std::size_t> shares = SharesOfBudget(demands, m_Options.triangles);
    RunEach(
      count,
      [&](std::size_t i) {
        const DisplayLabel & label = m_Content.labels[i];
        m_Shown[i] = { SimplifiedSurface(label.surface, shares[2 * i]),
                       SimplifiedComplex(label.medial.core, shares[2 * i + 1]),
                       ShownCurves(label.curves) };
      },
      [&](std::size_t done) {
        ReportProgress(progress, "page", static_cast<double>(done) / static_cast<double>(count));
      });
  }

  Json
  MeshJson(const ShownMesh & mesh, const ValueArrays & arrays)
  {
    std::array<float, 3> low = mesh.points.at(0);
    std::array<float, 3> high = low;
    for (const auto & point : mesh.points)
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        low[k] = std::min(low[k], point[k]);
        high[k] = std::max(high[k], point[k]);
      }
    }
    Json json{ { "low", low }, { "high", high } };

    std::vector<std::uint16_t> points;
    for (const auto & point : mesh.points)
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        const double side = high[k] > low[k] ? high[k] - low[k] : 1;
        points.push_back(static_cast<std::uint16_t>(std::lround((point[k] - low[k]) / side * 65535)));
      }
    }
    std::vector<std::uint32_t> lines;
    std::vector<std::uint32_t> offsets{ 0 };
    for (const auto & line : mesh.lines)
    {
      lines.insert(lines.end(), line.begin(), line.end());
      offsets.push_back(static_cast<std::uint32_t>(lines.size()));
    }
    m_ShownTriangles += mesh.triangles.size();
    json["points"] = m_Numbers.Add(points);
    json["triangles"] = Indices(Flat(mesh.triangles), mesh.points.size());
    json["segments"] = Indices(Flat(mesh.segments), mesh.points.size());
    json["lines"] = Indices(lines, mesh.points.size());
    json["offsets"] = m_Numbers.Add(offsets);
    json["dots"] = Indices(mesh.dots, mesh.points.size());
    json["values"] = ValuesJson(mesh, arrays);
    return json;
  }

  Json
  ValuesJson(const ShownMesh & mesh, const ValueArrays & arrays)
  {
    Json json = Json::object();
    for (std::size_t i = 0; i < arrays.size(); ++i)
    {
      if (arrays[i] == nullptr || m_Ranges[i].IsEmpty())
      {
        continue;
      }
      const double               side = std::max(m_Ranges[i].greatest - m_Ranges[i].least, 1e-300);
      std::vector<std::uint16_t> codes;
      for (const std::uint32_t origin : mesh.origin)
      {
        const double value = (*arrays[i])[origin];
        codes.push_back(std::isfinite(value)
                          ? static_cast<std::uint16_t>(std::lround((value - m_Ranges[i].least) / side * 65534))
                          : std::uint16_t{ 65535 });
      }
      json[kArrays[i]] = m_Numbers.Add(codes);
    }
    return json;
  }

  Json
  Indices(const std::vector<std::uint32_t> & indices, std::size_t points)
  {
    if (points <= 65536)
    {
      return m_Numbers.Add(std::vector<std::uint16_t>(indices.begin(), indices.end()));
    }
    return m_Numbers.Add(indices);
  }

  Json
  LabelJson(std::size_t i)
  {
    const DisplayLabel & label = m_Content.labels[i];
    RequireFinite(label.color, label);
    Json       json{ { "name", label.name },
               { "label", label.label },
               { "color", label.color },
               { "ranges", RangesJson(m_LabelRanges[i]) } };
    const auto add = [&](const char * kind, ShownMesh & mesh, const ValueArrays & arrays) {
      if (!mesh.points.empty())
      {
        json[kind] = MeshJson(mesh, arrays);
        mesh = {};
      }
    };
    add("surface", m_Shown[i].surface, {});
    add("medial", m_Shown[i].medial, MedialArrays(label));
    add("curves", m_Shown[i].curves, CurveArrays(label));
    if (!label.curveNames.empty() && json.contains("curves"))
    {
      json["curves"]["names"] = label.curveNames;
    }
    return json;
  }

  const DisplayContent &    m_Content;
  const HtmlOptions &       m_Options;
  std::vector<ShownLabel>   m_Shown;
  Ranges                    m_Ranges;
  std::vector<Ranges>       m_LabelRanges;
  std::vector<const char *> m_OwnRanges; ///< arrays that each label shows over its own range at first
  std::size_t               m_AllTriangles = 0;
  std::size_t               m_ShownTriangles = 0;
  PageNumbers               m_Numbers;
};

} // namespace

PageModel
MakePageModel(const DisplayContent & content, const HtmlOptions & options, const ProgressCallback & progress)
{
  return PageMaker(content, options).Make(progress);
}

} // namespace voxelcore
