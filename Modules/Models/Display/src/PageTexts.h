#pragma once
// The texts a page is made of, which are part of the program.

#include <array>
#include <string_view>

namespace voxelcore
{

struct PageTextSet
{
  std::string_view                page;    ///< HTML with marks @..@ where the others go
  std::string_view                style;   ///< CSS
  std::string_view                three;   ///< three.js
  std::array<std::string_view, 6> scripts; ///< ours, in the order they run
};

const PageTextSet &
PageTexts();

} // namespace voxelcore
