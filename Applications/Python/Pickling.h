#pragma once
// Results as the tuples that pickle stores, and back with the same bits.

#include "LabelWork.h"

#include <memory>
#include <pybind11/pybind11.h>

namespace voxelcore
{

pybind11::tuple
StateOf(const CoreOfLabel & core);

pybind11::tuple
StateOf(const SkeletonOfLabel & skeleton);

/** The inverse. Everything is checked as when a file is read: a pickle may be damaged.
 *  \throws UsageError, InputError for what StateOf of this version did not make */
std::shared_ptr<CoreOfLabel>
CoreFromState(const pybind11::tuple & state);

std::shared_ptr<SkeletonOfLabel>
SkeletonFromState(const pybind11::tuple & state);

} // namespace voxelcore
