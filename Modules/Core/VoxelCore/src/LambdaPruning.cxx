#include "voxelcore/VoxelCore/LambdaPruning.h"

#include "voxelcore/Base/LengthText.h"
#include "voxelcore/VoxelCore/ExtractPart.h"
#include "Measures.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Complex/SimplePairCollapse.h"
#include "voxelcore/Lattice/Rational.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

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
RefuseLambda(std::string_view what, std::string_view text, const char * why)
{
  throw UsageError(std::string(what) + " '" + std::string(text) + "' " + why +
                   "; write a number and mm, vox or %, for example 1.5mm, 2.5vox or 2.5%");
}

} // namespace

Lambda
ParseLambda(std::string_view text, std::string_view what)
{
  const LengthText length = ReadLength(text, [&](const char * why) { RefuseLambda(what, text, why); });
  Lambda           lambda;
  lambda.value = length.value;
  lambda.text = length.text;
  const std::string & unit = length.unit;
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
    RefuseLambda(what, text, "has an unknown unit");
  }
  return lambda;
}

void
RequireLengthIn(SpatialUnit unit, const Lambda & length)
{
  if (unit == SpatialUnit::Voxels && length.unit == Lambda::Unit::Millimetre && length.value != 0)
  {
    RefuseMillimetres(length.text);
  }
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

namespace
{

/** `spent`: the core itself, where it may be used up. */
std::vector<MedialComplex>
Prune(const MedialComplex &                    core,
      const std::vector<double> &              thresholds,
      std::vector<std::vector<ElementIndex>> * vertices,
      MedialComplex *                          spent,
      const ProgressCallback &                 progress)
{
  std::vector<MedialComplex> pruned;
  if (thresholds.empty())
  {
    return pruned;
  }
  pruned.reserve(thresholds.size());
  const auto take = [&](const LiveElements & live) {
    PartElements elements;
    pruned.push_back(ExtractPart(core, live, elements));
    if (vertices != nullptr)
    {
      vertices->push_back(std::move(elements.vertices));
    }
  };
  // Edges tell the corners, too: once no other result is to be taken they may go.
  const auto dropCorners = [&](std::size_t next) {
    if (spent != nullptr && next + 1 == thresholds.size())
    {
      std::vector<ElementIndex>().swap(spent->cells.faceVertices);
    }
  };
  dropCorners(0);
  SimplePairCollapse collapse(core.cells, core.vertexLambda, core.edgeLambda, core.faceLambda);
  for (std::size_t i = 0; i < thresholds.size(); ++i)
  {
    const auto at = [&](std::size_t done) {
      return static_cast<double>(done) / static_cast<double>(thresholds.size());
    };
    collapse.CollapseBelow(thresholds[i], PartOfProgress(progress, at(i), at(i + 1)));
    if (i + 1 < thresholds.size())
    {
      take(collapse.Live());
      dropCorners(i + 1);
    }
  }
  const LiveElements live = std::move(collapse).TakeLive();
  if (spent != nullptr)
  {
    pruned.push_back(KeepPart(std::move(*spent), live));
  }
  else
  {
    take(live);
  }
  return pruned;
}

} // namespace

std::vector<MedialComplex>
PruneByLambda(const MedialComplex & core, const std::vector<double> & thresholds, const ProgressCallback & progress)
{
  return Prune(core, thresholds, nullptr, nullptr, progress);
}

std::vector<MedialComplex>
PruneByLambda(MedialComplex && core, const std::vector<double> & thresholds, const ProgressCallback & progress)
{
  return Prune(core, thresholds, nullptr, &core, progress);
}

std::vector<MedialComplex>
PruneByLambda(const MedialComplex &                    core,
              const std::vector<double> &              thresholds,
              std::vector<std::vector<ElementIndex>> & vertices,
              const ProgressCallback &                 progress)
{
  vertices.clear();
  return Prune(core, thresholds, &vertices, nullptr, progress);
}

} // namespace voxelcore
