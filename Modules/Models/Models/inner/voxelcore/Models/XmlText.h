#pragma once
// Text for XML files.

#include <string>

namespace voxelcore
{

/** With what has a meaning in XML escaped, for elements and attributes. */
inline std::string
XmlText(const std::string & text)
{
  std::string escaped;
  for (const char c : text)
  {
    escaped += c == '&'   ? std::string("&amp;")
               : c == '<' ? std::string("&lt;")
               : c == '>' ? std::string("&gt;")
               : c == '"' ? std::string("&quot;")
                          : std::string(1, c);
  }
  return escaped;
}

} // namespace voxelcore
