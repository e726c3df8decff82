#include "PageModel.h"

#include "Decimation.h"
#include "voxelcore/Error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace voxelcore
{

namespace
{

using Json = nlohmann::ordered_json;

std::string
Base64(const std::vector<std::uint8_t> & bytes)
{
  constexpr const char * letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string            text;
  text.reserve(bytes.size() / 3 * 4 + 8);
  for (std::size_t at = 0; at < bytes.size(); at += 3)
  {
    std::uint32_t     three = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
    for (std::size_t k = 0; k < 3; ++k)
    {
      three = (three << 8) | (k < count ? bytes[at + k] : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k)
    {
      text += k <= count ? letters[(three >> (18 - 6 * k)) & 63U] : '=';
    }
  }
  return text;
}

/** zlib's: the page finds out by it whether its numbers are still what was written. */
std::uint32_t
Adler32(const std::vector<std::uint8_t> & bytes)
{
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const std::uint8_t byte : bytes)
  {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  return b << 16 | a;
}

/** The numbers of a page, little endian, one array after the other, each at a multiple of 4. */
class Blob
{
public:
  /** Gives the array's place, length and bytes a number. */
  template <typename T>
  Json
  Add(const std::vector<T> & values)
  {
    m_Bytes.resize((m_Bytes.size() + 3) / 4 * 4);
    const std::size_t at = m_Bytes.size();
    m_Bytes.resize(at + values.size() * sizeof(T));
    if (!values.empty())
    {
      std::memcpy(m_Bytes.data() + at, values.data(), values.size() * sizeof(T));
    }
    return { at, values.size(), sizeof(T) };
  }
  const std::vector<std::uint8_t> &
  Bytes() const
  {
    return m_Bytes;
  }

private:
  std::vector<std::uint8_t> m_Bytes;
};

struct Range
{
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void
  Add(const std::vector<double> & values)
  {
    for (const double value : values)
    {
      if (std::isfinite(value))
      {
        low = std::min(low, value);
        high = std::max(high, value);
      }
    }
  }
  bool
  IsEmpty() const
  {
    return low > high;
  }
};

constexpr std::array<const char *, 3> kArrays{ "Radius", "Lambda", "ErosionThickness" };

/** In the order of kArrays; null where there is none. */
using ValueArrays = std::array<const std::vector<double> *, 3>;

ValueArrays
MedialArrays(const DisplayLabel & label)
{
  return { &label.medial.core.radius,
           &label.medial.core.vertexLambda,
           label.erosionThickness.empty() ? nullptr : &label.erosionThickness };
}

ValueArrays
CurveArrays(const DisplayLabel & label)
{
  return { &label.curves.radius, nullptr, &label.curves.erosionThickness };
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

class PageMaker
{
public:
  PageMaker(const DisplayContent & content, const HtmlOptions & options)
    : m_Content(content)
    , m_Options(options)
  {
    for (const DisplayLabel & label : content.labels)
    {
      m_All += label.surface.triangles.size() + TriangleCount(label.medial.core.cells);
      for (const ValueArrays & arrays : { MedialArrays(label), CurveArrays(label) })
      {
        for (std::size_t i = 0; i < arrays.size(); ++i)
        {
          if (arrays[i] != nullptr)
          {
            m_Ranges[i].Add(*arrays[i]);
          }
        }
      }
    }
  }

  PageModel
  Make(const ProgressCallback & progress)
  {
    Json labels = Json::array();
    for (std::size_t i = 0; i < m_Content.labels.size(); ++i)
    {
      ReportProgress(progress, "page", static_cast<double>(i) / static_cast<double>(m_Content.labels.size()));
      labels.push_back(LabelJson(m_Content.labels[i]));
    }
    Json ranges = Json::object();
    for (std::size_t i = 0; i < kArrays.size(); ++i)
    {
      if (!m_Ranges[i].IsEmpty())
      {
        ranges[kArrays[i]] = { m_Ranges[i].low, m_Ranges[i].high };
      }
    }
    const Json json{
      { "title", m_Options.title }, { "bytes", m_Blob.Bytes().size() }, { "adler32", Adler32(m_Blob.Bytes()) },
      { "ranges", ranges },         { "triangles", m_Shown },           { "allTriangles", m_All },
      { "labels", labels }
    };
    std::string text;
    // `<` occurs in strings only. Names that are no UTF-8 get replacement characters.
    for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace))
    {
      text += c == '<' ? std::string("\\u003c") : std::string(1, c);
    }
    return { std::move(text), Base64(m_Blob.Bytes()) };
  }

private:
  /** A mesh's share of the budget. */
  std::size_t
  Share(std::size_t triangles) const
  {
    constexpr std::size_t kLeast = 64;
    const double part = static_cast<double>(m_Options.triangles) / static_cast<double>(std::max<std::size_t>(m_All, 1));
    return part >= 1 ? triangles : std::max(kLeast, static_cast<std::size_t>(part * static_cast<double>(triangles)));
  }

  Json
  MeshJson(const ShownMesh & mesh, const ValueArrays & arrays, const DisplayLabel & label)
  {
    std::array<float, 3> low = mesh.points.at(0);
    std::array<float, 3> high = low;
    for (const auto & point : mesh.points)
    {
      RequireFinite(point, label);
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
    std::vector<std::uint32_t> corners;
    for (const auto & triangle : mesh.triangles)
    {
      corners.insert(corners.end(), triangle.begin(), triangle.end());
    }
    std::vector<std::uint32_t> lines;
    std::vector<std::uint32_t> offsets{ 0 };
    for (const auto & line : mesh.lines)
    {
      lines.insert(lines.end(), line.begin(), line.end());
      offsets.push_back(static_cast<std::uint32_t>(lines.size()));
    }
    m_Shown += mesh.triangles.size();
    json["points"] = m_Blob.Add(points);
    json["triangles"] = Indices(corners, mesh.points.size());
    json["lines"] = Indices(lines, mesh.points.size());
    json["offsets"] = m_Blob.Add(offsets);
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
      const double               side = std::max(m_Ranges[i].high - m_Ranges[i].low, 1e-300);
      std::vector<std::uint16_t> codes;
      for (const std::uint32_t origin : mesh.origin)
      {
        const double value = (*arrays[i])[origin];
        codes.push_back(std::isfinite(value)
                          ? static_cast<std::uint16_t>(std::lround((value - m_Ranges[i].low) / side * 65534))
                          : std::uint16_t{ 65535 });
      }
      json[kArrays[i]] = m_Blob.Add(codes);
    }
    return json;
  }

  Json
  Indices(const std::vector<std::uint32_t> & indices, std::size_t points)
  {
    if (points <= 65536)
    {
      return m_Blob.Add(std::vector<std::uint16_t>(indices.begin(), indices.end()));
    }
    return m_Blob.Add(indices);
  }

  Json
  LabelJson(const DisplayLabel & label)
  {
    RequireFinite(label.color, label);
    Json json{ { "name", label.name }, { "label", label.label }, { "color", label.color } };
    if (!label.surface.triangles.empty())
    {
      json["surface"] = MeshJson(Decimated(label.surface, Share(label.surface.triangles.size())), {}, label);
    }
    const MedialComplex & core = label.medial.core;
    if (core.cells.vertexCount > 0)
    {
      json["medial"] = MeshJson(Decimated(core, Share(TriangleCount(core.cells))), MedialArrays(label), label);
    }
    if (!label.curves.positions.empty())
    {
      json["curves"] = MeshJson(ShownCurves(label.curves), CurveArrays(label), label);
    }
    return json;
  }

  const DisplayContent & m_Content;
  const HtmlOptions &    m_Options;
  std::array<Range, 3>   m_Ranges;
  std::size_t            m_All = 0;
  std::size_t            m_Shown = 0;
  Blob                   m_Blob;
};

} // namespace

PageModel
MakePageModel(const DisplayContent & content, const HtmlOptions & options, const ProgressCallback & progress)
{
  return PageMaker(content, options).Make(progress);
}

} // namespace voxelcore
