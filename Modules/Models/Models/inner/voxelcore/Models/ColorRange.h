#pragma once
// What a colour map runs over: not all values there are, of which a few far off would leave one colour to the rest.

#include "voxelcore/Models/DisplayContent.h"

#include <span>
#include <vector>

namespace voxelcore
{

enum class PictureColoring
{
  Radius,
  Lambda,
  ErosionThickness,
  Thickness,
  Confidence,
  Label
};

/** A value and how large the part is that has it (mm2, any other measure, or all the same). */
struct WeightedValue
{
  double value = 0;
  double weight = 1;
};

/** The colour map's ends, and the least and the greatest value there is. Without any finite value low > high. */
struct ColorRange
{
  double low = 1;
  double high = 0;
  double least = 1;
  double greatest = 0;

  bool
  IsEmpty() const
  {
    return low > high;
  }
};

/** Shares of what is shown, from 0 to 1, below which values have the map's first colour and above which its last. */
struct ColorShares
{
  double low = 0.02;
  double high = 0.98;
};

/** Ends at the values below and above which those shares of the whole weight lie; where both are one value, all there
 *  is. What is not finite or weighs nothing is left out, unless nothing weighs anything: then all weigh the same. */
ColorRange
RangeOfShares(std::vector<WeightedValue> values, const ColorShares & shares = {});

/** What `coloring` takes of each vertex of a label's medial surface; empty where it is not known. */
const std::vector<double> &
MedialValues(const DisplayLabel & label, PictureColoring coloring);

/** The same of each point of its curve skeleton, which has no lambda. */
const std::vector<double> &
CurveValues(const DisplayLabel & label, PictureColoring coloring);

/** The values of a label's medial surface and curve skeleton under `coloring`, weighted by area: of faces their own,
 *  shared by their corners; of lines, length times radius, about what their tubes take. */
std::vector<WeightedValue>
ShownValues(const DisplayLabel & label, PictureColoring coloring);

/** Of one of several labels. */
struct LabelRange
{
  ColorRange range;
  double     weight = 0; ///< of all its values
};

LabelRange
RangeOfLabel(const std::vector<WeightedValue> & values, const ColorShares & shares = {});

/** Whether labels need a range each: labels that make half of the weight or more have a range less than a quarter as
 *  wide as that of all together, in which they would show little of the map. */
bool
NeedOwnRanges(std::span<const LabelRange> labels, const ColorRange & all);

/** The ranges of several labels, together and one by one. */
struct LabelRanges
{
  ColorRange              all;
  std::vector<LabelRange> each;
};

LabelRanges
RangesOfLabels(std::span<const DisplayLabel> labels, PictureColoring coloring, const ColorShares & shares = {});

/** The range of several labels together. */
ColorRange
RangeOfLabels(std::span<const DisplayLabel> labels, PictureColoring coloring, const ColorShares & shares = {});

} // namespace voxelcore
