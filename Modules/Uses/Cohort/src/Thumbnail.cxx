#include "voxelcore/Cohort/Thumbnail.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Jobs/OutputTransaction.h"
#include "voxelcore/Models/ColorRange.h"
#include "voxelcore/Models/DisplayColors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <png.h>

namespace voxelcore
{

namespace
{

using Vector = std::array<double, 3>;

// Rows of a rotation of LPS: to the right of the picture, down, and away from the viewer, who looks from the patient's
// left, front and above.
constexpr std::array<Vector, 3> kView{ { { 0.788010753606722, 0.615661475325658, 0 },
                                         { 0.210567, -0.269514, -0.939693 },
                                         { -0.578533, 0.740488, -0.342020 } } };

/** The colour map as the case's page has it at first: radii between their 2nd and 98th percentile. */
class RadiusColors
{
public:
  explicit RadiusColors(const MedialModel & model)
  {
    std::vector<WeightedValue> values;
    for (const ModelPart & part : model.parts)
    {
      DisplayLabel label;
      label.medial = part;
      const auto more = ShownValues(label, PictureColoring::Radius);
      values.insert(values.end(), more.begin(), more.end());
    }
    m_Range = RangeOfShares(std::move(values));
  }

  Color
  operator()(double radius) const
  {
    return LengthColor(
      m_Range.high > m_Range.low ? std::clamp((radius - m_Range.low) / (m_Range.high - m_Range.low), 0.0, 1.0) : 0.5);
  }

private:
  ColorRange m_Range;
};

Color
Darker(const Color & color, double light)
{
  return { color[0] * light, color[1] * light, color[2] * light };
}

Vector
Mean(const Vector & a, const Vector & b, const Vector & c)
{
  return { (a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3, (a[2] + b[2] + c[2]) / 3 };
}

Vector
Turned(const Vector & p)
{
  Vector q;
  for (std::size_t k = 0; k < 3; ++k)
  {
    q[k] = kView[k][0] * p[0] + kView[k][1] * p[1] + kView[k][2] * p[2];
  }
  return q;
}

class Canvas
{
public:
  explicit Canvas(int size)
    : m_Size(size)
    , m_Depth(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), std::numeric_limits<double>::infinity())
    , m_Color(m_Depth.size(), Vector{ 1, 1, 1 })
  {}

  void
  Point(const Vector & p, const Vector & color)
  {
    Set(static_cast<int>(std::floor(p[0])), static_cast<int>(std::floor(p[1])), p[2], color);
  }

  /** Three pixels wide, so that it is still seen when the picture is halved. */
  void
  Dot(const Vector & p, const Vector & color)
  {
    for (int dy = -1; dy <= 1; ++dy)
    {
      for (int dx = -1; dx <= 1; ++dx)
      {
        Point({ p[0] + dx, p[1] + dy, p[2] }, color);
      }
    }
  }

  void
  Line(const Vector & a, const Vector & b, const Vector & color)
  {
    const int steps = 1 + static_cast<int>(std::ceil(std::max(std::abs(b[0] - a[0]), std::abs(b[1] - a[1]))));
    for (int i = 0; i <= steps; ++i)
    {
      const double t = static_cast<double>(i) / steps;
      Dot({ a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]) }, color);
    }
  }

  /** Every pixel whose middle lies in it; and its first corner, so that nothing small is lost. */
  void
  Triangle(const Vector & a, const Vector & b, const Vector & c, const Vector & color)
  {
    Point(a, color);
    const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if (area == 0)
    {
      return;
    }
    const int left = std::max(0, static_cast<int>(std::floor(std::min({ a[0], b[0], c[0] }))));
    const int right = std::min(m_Size - 1, static_cast<int>(std::ceil(std::max({ a[0], b[0], c[0] }))));
    const int top = std::max(0, static_cast<int>(std::floor(std::min({ a[1], b[1], c[1] }))));
    const int bottom = std::min(m_Size - 1, static_cast<int>(std::ceil(std::max({ a[1], b[1], c[1] }))));
    for (int y = top; y <= bottom; ++y)
    {
      for (int x = left; x <= right; ++x)
      {
        const double px = x + 0.5;
        const double py = y + 0.5;
        const double u = ((px - a[0]) * (c[1] - a[1]) - (py - a[1]) * (c[0] - a[0])) / area;
        const double v = ((b[0] - a[0]) * (py - a[1]) - (b[1] - a[1]) * (px - a[0])) / area;
        if (u >= 0 && v >= 0 && u + v <= 1)
        {
          Set(x, y, a[2] + u * (b[2] - a[2]) + v * (c[2] - a[2]), color);
        }
      }
    }
  }

  /** With twice as many pixels each way, the mean of four. */
  Thumbnail
  Halved() const
  {
    Thumbnail picture{ m_Size / 2, m_Size / 2, {} };
    for (int y = 0; y < picture.height; ++y)
    {
      for (int x = 0; x < picture.width; ++x)
      {
        for (std::size_t k = 0; k < 3; ++k)
        {
          const double sum = m_Color[At(2 * x, 2 * y)][k] + m_Color[At(2 * x + 1, 2 * y)][k] +
                             m_Color[At(2 * x, 2 * y + 1)][k] + m_Color[At(2 * x + 1, 2 * y + 1)][k];
          picture.rgb.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(sum / 4, 0.0, 1.0))));
        }
      }
    }
    return picture;
  }

private:
  std::size_t
  At(int x, int y) const
  {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(m_Size) + static_cast<std::size_t>(x);
  }
  void
  Set(int x, int y, double depth, const Vector & color)
  {
    if (x >= 0 && y >= 0 && x < m_Size && y < m_Size && depth < m_Depth[At(x, y)])
    {
      m_Depth[At(x, y)] = depth;
      m_Color[At(x, y)] = color;
    }
  }

  int                 m_Size;
  std::vector<double> m_Depth;
  std::vector<Vector> m_Color;
};

/** From the viewer's side, both sides of a face alike; mostly the colour itself, so that it is that of the map. */
double
Light(const Vector & a, const Vector & b, const Vector & c)
{
  const Vector u{ b[0] - a[0], b[1] - a[1], b[2] - a[2] };
  const Vector v{ c[0] - a[0], c[1] - a[1], c[2] - a[2] };
  const Vector n{ u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  const double facing = length > 0 ? std::abs(-0.35 * n[0] - 0.45 * n[1] - 0.82 * n[2]) / length : 1;
  return 0.6 + 0.4 * facing;
}

} // namespace

Thumbnail
PaintModel(const MedialModel & model, int size)
{
  const int                        pixels = 2 * size;
  std::vector<std::vector<Vector>> points;
  Vector                           low{ 1e300, 1e300, 1e300 };
  Vector                           high{ -1e300, -1e300, -1e300 };
  for (const ModelPart & part : model.parts)
  {
    points.emplace_back();
    for (const auto & position : part.core.positions)
    {
      points.back().push_back(Turned(position));
      for (std::size_t k = 0; k < 3; ++k)
      {
        low[k] = std::min(low[k], points.back().back()[k]);
        high[k] = std::max(high[k], points.back().back()[k]);
      }
    }
  }
  const double extent = std::max({ high[0] - low[0], high[1] - low[1], 1e-9 });
  const double scale = 0.92 * pixels / extent;
  for (auto & part : points)
  {
    for (Vector & p : part)
    {
      for (std::size_t k = 0; k < 2; ++k)
      {
        p[k] = (p[k] - (low[k] + high[k]) / 2) * scale + pixels / 2.0;
      }
      p[2] *= scale;
    }
  }
  const RadiusColors colorOf(model);
  Canvas             canvas(pixels);
  for (std::size_t i = 0; i < model.parts.size(); ++i)
  {
    const CellComplex & cells = model.parts[i].core.cells;
    const auto &        at = points[i];
    std::vector<Color>  colors;
    for (const double radius : model.parts[i].core.radius)
    {
      colors.push_back(colorOf(radius));
    }
    std::vector<bool> onFace(cells.edges.size());
    for (const ElementIndex edge : cells.faceEdges)
    {
      onFace[edge] = true;
    }
    for (std::size_t face = 0; face < cells.FaceCount(); ++face)
    {
      const auto corners = cells.FaceVertices(face);
      for (std::size_t k = 1; k + 1 < corners.size(); ++k)
      {
        const Vector & a = at[corners[0]];
        const Vector & b = at[corners[k]];
        const Vector & c = at[corners[k + 1]];
        const Color    color = Mean(colors[corners[0]], colors[corners[k]], colors[corners[k + 1]]);
        canvas.Triangle(a, b, c, Darker(color, Light(a, b, c)));
      }
    }
    for (std::size_t edge = 0; edge < cells.edges.size(); ++edge)
    {
      if (!onFace[edge])
      {
        const auto & [a, b] = cells.edges[edge];
        const double middle = (model.parts[i].core.radius[a] + model.parts[i].core.radius[b]) / 2;
        canvas.Line(at[a], at[b], colorOf(middle));
      }
    }
    for (std::size_t k = 0; k < at.size(); ++k)
    {
      canvas.Dot({ at[k][0], at[k][1], at[k][2] + 1e-6 }, Darker(colors[k], 0.6)); // behind what is there
    }
  }
  return canvas.Halved();
}

void
WriteThumbnail(const std::filesystem::path & path, const Thumbnail & picture)
{
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  std::string      bytes;
  if (png_image_write_to_memory(&image, nullptr, &size, 0, picture.rgb.data(), 0, nullptr) != 0)
  {
    bytes.resize(size);
    if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.rgb.data(), 0, nullptr) != 0)
    {
      bytes.resize(size);
      WriteTextFile(path, bytes);
      return;
    }
  }
  throw OutputError(path.string() + ": cannot make this picture: " + image.message);
}

void
PaintCase(const CoreReport & report, TemporaryRegistry * temporaries)
{
  constexpr int kPixels = 144;
  if (report.labels.empty() || report.labels.front().pruned.empty())
  {
    return;
  }
  const std::filesystem::path surface = report.labels.front().pruned.front().output;
  const std::string           name = surface.filename().string();
  const std::size_t           mark = name.rfind("_medial");
  if (surface.extension() != ".vtp" || mark == std::string::npos)
  {
    return;
  }
  OutputTransaction transaction(true, temporaries);
  WriteThumbnail(transaction.Stage(surface.parent_path() / (name.substr(0, mark) + "_thumbnail.png")),
                 PaintModel(ReadModel(surface), kPixels));
  transaction.Commit();
}

} // namespace voxelcore
