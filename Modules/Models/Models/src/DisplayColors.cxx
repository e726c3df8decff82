#include "voxelcore/Models/DisplayColors.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

/** Of sRGB, without its gamma. */
Color
Linear(const Color & color)
{
  Color linear{};
  for (std::size_t c = 0; c < 3; ++c)
  {
    linear[c] = color[c] <= 0.04045 ? color[c] / 12.92 : std::pow((color[c] + 0.055) / 1.055, 2.4);
  }
  return linear;
}

/** What is darker sinks into black, what is lighter into white: between these the contrast to both is at least 2. */
constexpr double kFirst = 0.22;
constexpr double kLast = 0.79;

} // namespace

Color
LengthColor(double t)
{
  constexpr std::array<std::array<double, 3>, 7> coefficients{ {
    { 0.05873234392399702, 0.02333670892565664, 0.5433401826748754 },
    { 2.176514634195958, 0.2383834171260182, 0.7539604599784036 },
    { -2.689460476458034, -7.455851135738909, 3.110799939717086 },
    { 6.130348345893603, 42.3461881477227, -28.51885465332158 },
    { -11.10743619062271, -82.66631109428045, 60.13984767418263 },
    { 10.02306557647065, 71.41361770095349, -54.07218655560067 },
    { -3.658713842777788, -22.93153465461149, 18.19190778539828 },
  } };
  const double                                   at = kFirst + (kLast - kFirst) * std::clamp(t, 0.0, 1.0);
  Color                                          color{};
  for (std::size_t c = 0; c < 3; ++c)
  {
    double value = 0;
    for (std::size_t power = coefficients.size(); power-- > 0;)
    {
      value = value * at + coefficients[power][c];
    }
    color[c] = std::clamp(value, 0.0, 1.0);
  }
  return color;
}

double
Luminance(const Color & color)
{
  const Color linear = Linear(color);
  return 0.2126729 * linear[0] + 0.7151522 * linear[1] + 0.0721750 * linear[2];
}

double
Contrast(const Color & a, const Color & b)
{
  const double first = Luminance(a) + 0.05;
  const double second = Luminance(b) + 0.05;
  return std::max(first, second) / std::min(first, second);
}

std::array<double, 3>
ToLab(const Color & color)
{
  const Color  linear = Linear(color);
  const auto   f = [](double t) { return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0; };
  const double x = f((0.4124564 * linear[0] + 0.3575761 * linear[1] + 0.1804375 * linear[2]) / 0.95047);
  const double y = f(Luminance(color));
  const double z = f((0.0193339 * linear[0] + 0.1191920 * linear[1] + 0.9503041 * linear[2]) / 1.08883);
  return { 116 * y - 16, 500 * (x - y), 200 * (y - z) };
}

namespace
{

constexpr std::size_t kPaletteSize = 255;

std::array<Color, kPaletteSize>
MakePalette()
{
  struct Candidate
  {
    Color                 color;
    std::array<double, 3> lab;
    double                distance; ///< squared, to the nearest colour taken so far
  };
  const auto squared = [](const std::array<double, 3> & a, const std::array<double, 3> & b) {
    return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]);
  };
  std::vector<Candidate> candidates;
  constexpr int          kSteps = 16;
  for (int code = 0; code < kSteps * kSteps * kSteps; ++code)
  {
    Candidate one;
    // NOLINTNEXTLINE(bugprone-integer-division): a digit of the code
    one.color = { (code / (kSteps * kSteps)) / (kSteps - 1.0),
                  (code / kSteps % kSteps) / (kSteps - 1.0),
                  (code % kSteps) / (kSteps - 1.0) };
    one.lab = ToLab(one.color);
    const double chroma = std::sqrt(one.lab[1] * one.lab[1] + one.lab[2] * one.lab[2]);
    one.distance = 1e30;
    if (one.lab[0] >= 35 && one.lab[0] <= 90 && chroma >= 20 && chroma <= 78)
    {
      candidates.push_back(one);
    }
  }
  std::array<Color, kPaletteSize> palette{};
  std::array<double, 3>           last = ToLab({ 0.9, 0.1, 0.15 }); // the list begins far from a clear red
  for (Color & color : palette)
  {
    for (Candidate & one : candidates)
    {
      one.distance = std::min(one.distance, squared(one.lab, last));
    }
    const auto best =
      std::max_element(candidates.begin(), candidates.end(), [](const Candidate & a, const Candidate & b) {
        return a.distance < b.distance;
      });
    color = best->color;
    last = best->lab;
  }
  return palette;
}

} // namespace

Color
LabelColor(std::int64_t label)
{
  static const std::array<Color, kPaletteSize> palette = MakePalette();
  const std::uint64_t                          place = static_cast<std::uint64_t>(label - 1) % kPaletteSize;
  return palette[place];
}

Color
ComponentColor(std::int64_t label, std::int64_t component)
{
  return LabelColor(label + 37 * std::max<std::int64_t>(component - 1, 0));
}

} // namespace voxelcore
