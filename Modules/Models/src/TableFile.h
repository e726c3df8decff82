#pragma once
// Text in large pieces.

#include "OutputFile.h"

#include <charconv>
#include <cmath>
#include <string>
#include <type_traits>

namespace voxelcore
{

/** Gathers text and passes it on in large pieces. Whole numbers in full, others with so many significant digits as
 *  `digits` says; what is no finite number is left empty. */
class TableFile
{
public:
  explicit TableFile(const std::filesystem::path & path, int digits = 7)
    : m_File(path)
    , m_Digits(digits)
  {}
  TableFile &
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
  requires std::is_arithmetic_v<Number> TableFile &
  operator<<(Number number)
  {
    char digits[64];
    if constexpr (std::is_floating_point_v<Number>)
    {
      if (!std::isfinite(number))
      {
        return *this;
      }
      const auto end = std::to_chars(digits, digits + sizeof(digits), number, std::chars_format::general, m_Digits).ptr;
      return *this << std::string_view(digits, static_cast<std::size_t>(end - digits));
    }
    else
    {
      const auto end = std::to_chars(digits, digits + sizeof(digits), number).ptr;
      return *this << std::string_view(digits, static_cast<std::size_t>(end - digits));
    }
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
  OutputFile  m_File;
  int         m_Digits;
  std::string m_Text;
};

} // namespace voxelcore
