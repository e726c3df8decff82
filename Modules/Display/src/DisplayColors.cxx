#include "voxelcore/DisplayColors.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

Color
ViridisColor(double t)
{
  constexpr std::array<std::array<double, 3>, 7> coefficients{ {
    { 0.2777273272234177, 0.005407344544966578, 0.3340998053353061 },
    { 0.1050930431085774, 1.404613529898575, 1.384590162594685 },
    { -0.3308618287255563, 0.214847559468213, 0.09509516302823659 },
    { -4.634230498983486, -5.799100973351585, -19.33244095627987 },
    { 6.228269936347081, 14.17993336680509, 56.69055260068105 },
    { 4.776384997670288, -13.74514537774601, -65.35303263337234 },
    { -5.435455855934631, 4.645852612178535, 26.3124352495832 },
  } };
  t = std::clamp(t, 0.0, 1.0);
  Color color{};
  for (std::size_t c = 0; c < 3; ++c)
  {
    double value = 0;
    for (std::size_t power = coefficients.size(); power-- > 0;)
    {
      value = value * t + coefficients[power][c];
    }
    color[c] = std::clamp(value, 0.0, 1.0);
  }
  return color;
}

std::array<double, 3>
ToLab(const Color & color)
{
  Color linear{};
  for (std::size_t c = 0; c < 3; ++c)
  {
    linear[c] = color[c] <= 0.04045 ? color[c] / 12.92 : std::pow((color[c] + 0.055) / 1.055, 2.4);
  }
  const auto   f = [](double t) { return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0; };
  const double x = f((0.4124564 * linear[0] + 0.3575761 * linear[1] + 0.1804375 * linear[2]) / 0.95047);
  const double y = f(0.2126729 * linear[0] + 0.7151522 * linear[1] + 0.0721750 * linear[2]);
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
