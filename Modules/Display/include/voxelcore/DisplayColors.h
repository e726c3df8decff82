#pragma once
// Colours: a map for lengths, and one for each label.

#include "voxelcore/DisplayContent.h"

namespace voxelcore
{

/** The colour map viridis (S. van der Walt, N. Smith; CC0) at t from 0 to 1: perceptually uniform, and readable with any
 *  colour blindness and in grey. By the polynomial that M. Zucker fitted to it (shadertoy.com/view/WlfXRN, CC0). */
Color
ViridisColor(double t);

/** The colour of a label that comes without one. A fixed list of 255 colours, each as far as can be from those before it
 *  (CIELAB, as C. Glasbey et al. 2007 choose them), none of them near to white, black or
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
