#pragma once
// Files of text, written in large pieces.


#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/OutputFile.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>

namespace voxelcore
{

/** Gathers text and passes it on in large pieces. Numbers in the shortest form that reads back to the same bits. With
 *  `digits`, those that are not whole have so many significant ones, and what is no finite number is left empty. */
class TextFile
{
public:
  explicit TextFile(const std::filesystem::path & path, std::optional<int> digits = {})
    : m_File(path)
    , m_Digits(digits)
  {}
  TextFile &
  operator<<(std::string_view text)
  {
    m_Text += text;
    if (m_Text.size() > (std::size_t{ 1 } << 20))
    {
      Flush();
    }
    return *this;
  }
  template <typename Number>
  requires std::is_arithmetic_v<Number> TextFile &
  operator<<(Number number)
  {
    char                 digits[64];
    char * const         last = digits + sizeof(digits);
    std::to_chars_result written;
    if constexpr (std::is_floating_point_v<Number>)
    {
      if (m_Digits && !std::isfinite(number))
      {
        return *this;
      }
      written = m_Digits ? to_chars(digits, last, number, std::chars_format::general, *m_Digits)
                         : to_chars(digits, last, number);
    }
    else
    {
      written = to_chars(digits, last, number);
    }
    return *this << std::string_view(digits, static_cast<std::size_t>(written.ptr - digits));
  }
  void
  Finish()
  {
    Flush();
    m_File.Finish();
  }

private:
  void
  Flush()
  {
    m_File.Write(m_Text);
    m_Text.clear();
  }
  OutputFile         m_File;
  std::optional<int> m_Digits;
  std::string        m_Text;
};

} // namespace voxelcore
