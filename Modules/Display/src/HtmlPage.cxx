#include "voxelcore/HtmlPage.h"

#include "Decimation.h"
#include "PageTexts.h"
#include "voxelcore/Error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>

namespace voxelcore
{

#ifdef VOXELCORE_HAS_THREE

namespace
{

std::string
JsonText(const std::string & text)
{
  std::string result = "\"";
  for (const char c : text)
  {
    char code[8];
    // < too, so that no name can end the script it stands in.
    if (static_cast<unsigned char>(c) < 0x20 || c == '<' || c == '"' || c == '\\')
    {
      std::snprintf(code, sizeof(code), "\\u%04x", static_cast<unsigned>(c));
      result += code;
    }
    else
    {
      result += c;
    }
  }
  return result + "\"";
}

std::string
Number(double value)
{
  char text[40];
  std::snprintf(text, sizeof(text), "%.9g", value);
  return text;
}

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

/** The numbers of a page, little endian, one array after the other, each at a multiple of 4. */
class Blob
{
public:
  template <typename T>
  std::string
  Add(const std::vector<T> & values)
  {
    m_Bytes.resize((m_Bytes.size() + 3) / 4 * 4);
    const std::size_t at = m_Bytes.size();
    m_Bytes.resize(at + values.size() * sizeof(T));
    if (!values.empty())
    {
      std::memcpy(m_Bytes.data() + at, values.data(), values.size() * sizeof(T));
    }
    return "[" + std::to_string(at) + "," + std::to_string(values.size()) + "," + std::to_string(sizeof(T)) + "]";
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

  std::string
  Json(const ProgressCallback & progress)
  {
    std::string labels;
    for (std::size_t i = 0; i < m_Content.labels.size(); ++i)
    {
      ReportProgress(progress, "page", static_cast<double>(i) / static_cast<double>(m_Content.labels.size()));
      labels += (i > 0 ? ",\n" : "") + LabelJson(m_Content.labels[i]);
    }
    std::string ranges;
    for (std::size_t i = 0; i < kArrays.size(); ++i)
    {
      if (!m_Ranges[i].IsEmpty())
      {
        ranges += (ranges.empty() ? "\"" : ",\"") + std::string(kArrays[i]) + "\":[" + Number(m_Ranges[i].low) + "," +
                  Number(m_Ranges[i].high) + "]";
      }
    }
    return "{\"title\":" + JsonText(m_Options.title) + ",\"ranges\":{" + ranges +
           "},\"triangles\":" + std::to_string(m_Shown) + ",\"allTriangles\":" + std::to_string(m_All) +
           ",\"labels\":[\n" + labels + "]}";
  }

  const Blob &
  Data() const
  {
    return m_Blob;
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

  std::string
  MeshJson(const ShownMesh & mesh, const ValueArrays & arrays)
  {
    std::array<float, 3> low{};
    std::array<float, 3> high{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      low[k] = std::numeric_limits<float>::infinity();
      high[k] = -low[k];
      for (const auto & point : mesh.points)
      {
        low[k] = std::min(low[k], point[k]);
        high[k] = std::max(high[k], point[k]);
      }
    }
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
    std::string values;
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
      values += (values.empty() ? "\"" : ",\"") + std::string(kArrays[i]) + "\":" + m_Blob.Add(codes);
    }
    const auto vector = [](const std::array<float, 3> & v) {
      return "[" + Number(v[0]) + "," + Number(v[1]) + "," + Number(v[2]) + "]";
    };
    return "{\"low\":" + vector(low) + ",\"high\":" + vector(high) + ",\"points\":" + m_Blob.Add(points) +
           ",\"triangles\":" + Indices(corners, mesh.points.size()) +
           ",\"lines\":" + Indices(lines, mesh.points.size()) + ",\"offsets\":" + m_Blob.Add(offsets) +
           ",\"values\":{" + values + "}}";
  }

  std::string
  Indices(const std::vector<std::uint32_t> & indices, std::size_t points)
  {
    if (points <= 65536)
    {
      return m_Blob.Add(std::vector<std::uint16_t>(indices.begin(), indices.end()));
    }
    return m_Blob.Add(indices);
  }

  std::string
  LabelJson(const DisplayLabel & label)
  {
    std::string json = "{\"name\":" + JsonText(label.name) + ",\"label\":" + std::to_string(label.label) +
                       ",\"color\":[" + Number(label.color[0]) + "," + Number(label.color[1]) + "," +
                       Number(label.color[2]) + "]";
    if (!label.surface.triangles.empty())
    {
      json += ",\"surface\":" + MeshJson(Decimated(label.surface, Share(label.surface.triangles.size())), {});
    }
    const MedialComplex & core = label.medial.core;
    if (core.cells.vertexCount > 0)
    {
      json += ",\"medial\":" + MeshJson(Decimated(core, Share(TriangleCount(core.cells))), MedialArrays(label));
    }
    if (label.curves.BranchCount() > 0)
    {
      ShownMesh mesh;
      for (std::size_t point = 0; point < label.curves.positions.size(); ++point)
      {
        const auto & p = label.curves.positions[point];
        mesh.points.push_back({ static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]) });
        mesh.origin.push_back(static_cast<std::uint32_t>(point));
      }
      for (std::size_t branch = 0; branch < label.curves.BranchCount(); ++branch)
      {
        const auto points = label.curves.Branch(branch);
        mesh.lines.emplace_back(points.begin(), points.end());
      }
      json += ",\"curves\":" + MeshJson(mesh, CurveArrays(label));
    }
    return json + "}";
  }

  const DisplayContent & m_Content;
  const HtmlOptions &    m_Options;
  std::array<Range, 3>   m_Ranges;
  std::size_t            m_All = 0;
  std::size_t            m_Shown = 0;
  Blob                   m_Blob;
};

} // namespace

bool
HasHtml()
{
  return true;
}

void
WriteHtml(const std::filesystem::path & path,
          const DisplayContent &        content,
          const HtmlOptions &           options,
          const ProgressCallback &      progress)
{
  PageMaker         maker(content, options);
  const std::string json = maker.Json(progress);
  const std::string data = Base64(maker.Data().Bytes());
  std::string       page(PageTexts().page);
  // Each text takes the place of its mark, once, from the end on: marks that data may hold are left alone.
  const std::pair<std::string_view, std::string_view> texts[] = { { "@VIEWER@", PageTexts().viewer },
                                                                  { "@CONTROLS@", PageTexts().controls },
                                                                  { "@THREE@", PageTexts().three },
                                                                  { "@DATA@", data },
                                                                  { "@MODEL@", json } };
  for (const auto & [mark, text] : texts)
  {
    const auto place = page.find(mark);
    if (place == std::string::npos)
    {
      throw Error("the page lacks its mark " + std::string(mark));
    }
    page.replace(place, mark.size(), text);
  }
  std::ofstream file(path, std::ios::binary);
  file.write(page.data(), static_cast<std::streamsize>(page.size()));
  file.close();
  if (!file)
  {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    throw OutputError("cannot write '" + path.string() + "': the disk is full, or the folder cannot be written to");
  }
}

#else

bool
HasHtml()
{
  return false;
}

void
WriteHtml(const std::filesystem::path &, const DisplayContent &, const HtmlOptions &, const ProgressCallback &)
{
  throw UsageError("--html is off in this build: three.js was not there when it was made (Debian: libjs-three)");
}

#endif

} // namespace voxelcore
