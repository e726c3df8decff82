#include "voxelcore/Base/DidYouMean.h"

#include <algorithm>
#include <vector>

namespace voxelcore
{

namespace
{

char
Lower(char c)
{
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool
SameLetter(char a, char b)
{
  return Lower(a) == Lower(b);
}

} // namespace

bool
EqualIgnoringCase(std::string_view a, std::string_view b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), SameLetter);
}

std::size_t
EditDistance(std::string_view a, std::string_view b)
{
  // Row i holds the distances of a's first i letters to each beginning of b; three rows are enough for swaps.
  std::vector<std::size_t> beforeLast(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j)
  {
    row[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i)
  {
    beforeLast.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j)
    {
      row[j] = std::min({ last[j] + 1, row[j - 1] + 1, last[j - 1] + (SameLetter(a[i - 1], b[j - 1]) ? 0U : 1U) });
      if (i > 1 && j > 1 && SameLetter(a[i - 1], b[j - 2]) && SameLetter(a[i - 2], b[j - 1]))
      {
        row[j] = std::min(row[j], beforeLast[j - 2] + 1);
      }
    }
  }
  return row[b.size()];
}

std::string_view
NearestName(std::string_view word, std::span<const std::string_view> candidates)
{
  constexpr std::size_t kLongest = 256; // names longer than this are not typed
  std::string_view      nearest;
  std::size_t           least = kLongest;
  if (word.empty() || word.size() > kLongest)
  {
    return {};
  }
  for (const std::string_view candidate : candidates)
  {
    const std::size_t longer = std::max(word.size(), candidate.size());
    if (candidate.empty() || longer > kLongest)
    {
      continue;
    }
    const std::size_t distance = EditDistance(word, candidate);
    if (distance < least && distance <= std::max<std::size_t>(1, longer / 3) && distance < longer)
    {
      least = distance;
      nearest = candidate;
    }
  }
  if (!nearest.empty() || word.size() < 3)
  {
    return nearest;
  }
  for (const std::string_view candidate : candidates)
  {
    if (EqualIgnoringCase(word, candidate.substr(0, word.size())))
    {
      if (!nearest.empty())
      {
        return {};
      }
      nearest = candidate;
    }
  }
  return nearest;
}

std::string
DidYouMean(std::string_view word, std::span<const std::string_view> candidates, std::string_view prefix)
{
  const std::string_view nearest = NearestName(word, candidates);
  return nearest.empty() ? std::string() : "; did you mean '" + std::string(prefix) + std::string(nearest) + "'?";
}

} // namespace voxelcore
