#pragma once
// How a street writes down the options of its command.

#include "voxelcore/Options/Command.h"

#include <array>

namespace voxelcore::table
{

using enum ParameterKind;
using Group = ParameterGroup;

/** The rows of all parts, heading by heading; within one in the order of the parts. */
template <std::size_t... N>
constexpr auto
Joined(const std::array<Parameter, N> &... parts)
{
  std::array<Parameter, (N + ...)> all{};
  std::size_t                      end = 0;
  const auto                       append = [&](const auto & rows) {
    for (const Parameter & row : rows)
    {
      std::size_t at = end++;
      for (; at > 0 && row.group < all[at - 1].group; --at)
      {
        all[at] = all[at - 1];
      }
      all[at] = row;
    }
  };
  (append(parts), ...);
  return all;
}

} // namespace voxelcore::table
