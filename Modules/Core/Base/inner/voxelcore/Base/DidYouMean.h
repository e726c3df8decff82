#pragma once
// Mistyped names: what was probably meant.

#include <span>
#include <string>
#include <string_view>

namespace voxelcore
{

/** Whether two words are the same but for the case of the letters a to z. */
bool
EqualIgnoringCase(std::string_view a, std::string_view b);

/** The least number of letters inserted, removed, replaced, or swapped with their neighbour that makes one word of the
 *  other (Damerau-Levenshtein distance in which no part is changed twice); the case of a to z does not count. */
std::size_t
EditDistance(std::string_view a, std::string_view b);

/** The candidate nearest to `word`, the first of several; empty when none is close. Close is up to a third of the
 *  letters of the longer word, and never all of them; else the only candidate that begins with `word`, of three letters
 *  or more. */
std::string_view
NearestName(std::string_view word, std::span<const std::string_view> candidates);

/** "; did you mean 'lambda'?", or nothing when no candidate is close. `prefix` goes before the name, such as "--". */
std::string
DidYouMean(std::string_view word, std::span<const std::string_view> candidates, std::string_view prefix = "");

} // namespace voxelcore
