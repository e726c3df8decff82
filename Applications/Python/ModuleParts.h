#pragma once
// Parts of the Python module voxelcore._voxelcore; Module.cxx puts them together.

#include <pybind11/pybind11.h>

namespace voxelcore
{

/** Classes that hold results and give out views on them. */
void
DefineResults(pybind11::module_ & module);

/** Functions that make results, check and save them. */
void
DefineCalls(pybind11::module_ & module);

} // namespace voxelcore
