#include "voxelcore/LambdaPruning.h"

#include "Measures.h"

#include "voxelcore/Error.h"
#include "voxelcore/Rational.h"
#include "voxelcore/SimplePairCollapse.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace voxelcore
{

namespace
{

// A decimal such as "1.50" as digits / 10^places; none when it has more digits than the exact path takes.
struct Decimal
{
  std::int64_t digits = 0;
  int          places = 0;
};

std::optional<Decimal>
ReadDecimal(std::string_view text)
{
  Decimal decimal;
  bool    behindPoint = false;
  int     significant = 0;
  for (const char c : text)
  {
    if (c == '.')
    {
      behindPoint = true;
    }
    else if (c >= '0' && c <= '9')
    {
      decimal.digits = 10 * decimal.digits + (c - '0');
      decimal.places += behindPoint ? 1 : 0;
      significant += decimal.digits != 0 ? 1 : 0;
      if (significant > 15 || decimal.places > 15)
      {
        return {};
      }
    }
    else
    {
      break; // the unit, or an exponent, which the exact path does not take
    }
  }
  return decimal;
}

[[noreturn]] void
RefuseLambda(std::string_view text, const char * why)
{
  throw UsageError("lambda '" + std::string(text) + "' " + why +
                   "; write a number and mm, vox or %, for example 1.5mm, 2.5vox or 2.5%");
}

MedialComplex
Extract(const MedialComplex & core, const LiveElements & live)
{
  std::vector<ElementIndex> vertices;
  std::vector<ElementIndex> edges;
  std::vector<ElementIndex> faces;
  MedialComplex             part;
  part.cells = ExtractLive(core.cells, live, vertices, edges, faces);
  const auto gather = [](const auto & from, const std::vector<ElementIndex> & ids, auto & to) {
    to.reserve(ids.size());
    for (const ElementIndex id : ids)
    {
      to.push_back(from[id]);
    }
  };
  gather(core.positions, vertices, part.positions);
  gather(core.radius, vertices, part.radius);
  gather(core.vertexLambda, vertices, part.vertexLambda);
  gather(core.edgeLambda, edges, part.edgeLambda);
  gather(core.faceLambda, faces, part.faceLambda);
  return part;
}

} // namespace

Lambda
ParseLambda(std::string_view text)
{
  // Blanks around the number and before the unit are the user's; one within a number could mean anything.
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  Lambda     lambda;
  lambda.text.clear();
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    if (!blank(text[i]))
    {
      lambda.text.push_back(text[i]);
    }
    else if (!lambda.text.empty() && i + 1 < text.size() &&
             std::string_view("0123456789.").find(text[i + 1]) != std::string_view::npos)
    {
      RefuseLambda(text, "has a blank before a digit");
    }
  }
  const char * first = lambda.text.data();
  const char * last = first + lambda.text.size();
  const auto   parsed = std::from_chars(first, last, lambda.value);
  if (parsed.ec != std::errc{} || !std::isfinite(lambda.value))
  {
    RefuseLambda(text, "is not a number");
  }
  if (std::signbit(lambda.value) && lambda.value != 0.0)
  {
    RefuseLambda(text, "is negative");
  }
  const std::string_view unit(parsed.ptr, static_cast<std::size_t>(last - parsed.ptr));
  if (unit.empty() || unit == "mm")
  {
    lambda.unit = Lambda::Unit::Millimetre;
  }
  else if (unit == "vox")
  {
    lambda.unit = Lambda::Unit::Voxel;
  }
  else if (unit == "%")
  {
    lambda.unit = Lambda::Unit::Percent;
  }
  else
  {
    RefuseLambda(text, "has an unknown unit");
  }
  return lambda;
}

double
LambdaInMillimetres(const Lambda &                lambda,
                    const SpacingWeights &        weights,
                    const std::array<double, 3> & spacing,
                    const VoxelBox &              shapeBox)
{
  switch (lambda.unit)
  {
    case Lambda::Unit::Millimetre:
      return lambda.value;
    case Lambda::Unit::Percent:
    {
      double longest = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        longest = std::max(longest, shapeBox.size[axis] * spacing[axis]);
      }
      return lambda.value * longest / 100.0;
    }
    case Lambda::Unit::Voxel:
      break;
  }
  const auto        smallest = *std::min_element(weights.weight.begin(), weights.weight.end());
  const std::size_t digits = lambda.text.find_first_not_of("0123456789.");
  const bool        plain = digits == std::string::npos || (lambda.text[digits] != 'e' && lambda.text[digits] != 'E');
  if (const auto decimal = plain ? ReadDecimal(lambda.text) : std::nullopt)
  {
    // (digits / 10^places * weight)^2 exactly: at most 2 * (50 + 12) bits over 2 * 50.
    Int128 scale = 1;
    for (int i = 0; i < decimal->places; ++i)
    {
      scale *= 10;
    }
    const Int128 length = Int128{ decimal->digits } * smallest;
    return ToMillimetres(RatioToDouble(static_cast<UInt128>(length * length), static_cast<UInt128>(scale * scale)),
                         weights);
  }
  return lambda.value * static_cast<double>(smallest) * weights.unit;
}

std::vector<MedialComplex>
PruneByLambda(const MedialComplex & core, const std::vector<double> & thresholds, const ProgressCallback & progress)
{
  std::vector<MedialComplex> pruned;
  pruned.reserve(thresholds.size());
  SimplePairCollapse collapse(core.cells, core.vertexLambda, core.edgeLambda, core.faceLambda);
  for (const double threshold : thresholds)
  {
    collapse.CollapseBelow(threshold, progress);
    pruned.push_back(Extract(core, collapse.Live()));
  }
  return pruned;
}

} // namespace voxelcore
