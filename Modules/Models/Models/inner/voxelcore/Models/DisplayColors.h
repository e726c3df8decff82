#pragma once
// Colours: a map for lengths, and one for each label.

#include "voxelcore/Models/DisplayContent.h"

namespace voxelcore
{

/** The colour of a length at t from 0 to 1: the middle part of the colour map plasma (S. van der Walt, N. Smith; CC0),
 *  from violet to orange. It is perceptually uniform, readable with any colour blindness and in grey, and both its ends
 *  stand out from white and from black. By the polynomial that M. Zucker fitted to it (shadertoy.com/view/WlfXRN,
 *  CC0). */
Color
LengthColor(double t);

/** Luminance of a colour as sRGB defines it, from 0 to 1. */
double
Luminance(const Color & color);

/** How well two colours can be told apart by lightness, from 1 to 21 (WCAG 2). */
double
Contrast(const Color & a, const Color & b);

/** The colour of a label that comes without one. A fixed list of 255 colours, each as far as can be from those before
 *  it (CIELAB, as C. Glasbey et al. 2007 choose them), none of them near to white, black or
 *  grey, and none garish; larger values begin again. */
Color
LabelColor(std::int64_t label);

/** Of a component (from 1; 0: the whole label) of such a label: another one for each. */
Color
ComponentColor(std::int64_t label, std::int64_t component);

/** CIELAB (D65) of a colour. */
std::array<double, 3>
ToLab(const Color & color);

} // namespace voxelcore
