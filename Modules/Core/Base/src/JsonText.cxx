#include "voxelcore/Base/JsonText.h"

#include <array>

namespace voxelcore
{

std::string_view
PlainJson(std::string_view text, std::size_t mostMembers)
{
  std::array<std::size_t, 256> members{}; // of each open object
  std::size_t                  depth = 0;
  bool                         isQuoted = false;
  for (std::size_t at = 0; at < text.size(); ++at)
  {
    const char c = text[at];
    if (isQuoted)
    {
      at += c == '\\' ? 1 : 0;
      isQuoted = c != '"';
    }
    else if (c == '"')
    {
      isQuoted = true;
    }
    else if (c == '[' || c == '{')
    {
      if (depth == members.size())
      {
        return {};
      }
      members[depth++] = 0;
    }
    else if (c == ']' || c == '}')
    {
      depth -= depth > 0 ? 1 : 0;
    }
    else if (c == ':' && depth > 0 && ++members[depth - 1] > mostMembers)
    {
      return {};
    }
  }
  return text;
}

} // namespace voxelcore
