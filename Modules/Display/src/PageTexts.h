#pragma once
// The texts a page is made of, which are part of the program.

#include <string_view>

namespace voxelcore
{

struct PageTextSet
{
  std::string_view page;     ///< HTML with marks @..@ where the others go
  std::string_view viewer;   ///< our script
  std::string_view three;    ///< three.js
  std::string_view controls; ///< its TrackballControls
};

const PageTextSet &
PageTexts();

} // namespace voxelcore
