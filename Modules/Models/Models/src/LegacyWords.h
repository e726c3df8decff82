#pragma once
// The words, lines and numbers of VTK's legacy files, as text or as bytes.

#include "MeshNumbers.h"
#include "voxelcore/Base/TextFields.h"

namespace voxelcore
{

struct LegacyType
{
  std::string_view name;
  NumberType       type;
};

inline constexpr std::array<LegacyType, 16> kLegacyTypes{ { { "char", { 'i', 1 } },
                                                            { "signed_char", { 'i', 1 } },
                                                            { "unsigned_char", { 'u', 1 } },
                                                            { "short", { 'i', 2 } },
                                                            { "unsigned_short", { 'u', 2 } },
                                                            { "int", { 'i', 4 } },
                                                            { "unsigned_int", { 'u', 4 } },
                                                            { "vtkidtype", { 'i', 4 } },
                                                            { "long", { 'i', 8 } },
                                                            { "unsigned_long", { 'u', 8 } },
                                                            { "vtktypeint64", { 'i', 8 } },
                                                            { "vtktypeuint64", { 'u', 8 } },
                                                            { "float", { 'f', 4 } },
                                                            { "double", { 'f', 8 } },
                                                            { "vtktypeint32", { 'i', 4 } },
                                                            { "vtktypeuint32", { 'u', 4 } } } };

class LegacyWords
{
public:
  explicit LegacyWords(std::string_view bytes)
    : m_Bytes(bytes)
  {}

protected:
  static NumberType
  Type(std::string_view name)
  {
    const std::string  lower = LowerCase(name);
    const auto * const found =
      std::find_if(kLegacyTypes.begin(), kLegacyTypes.end(), [&](const auto & t) { return t.name == lower; });
    if (found == kLegacyTypes.end())
    {
      throw UnfitFile{ "'" + MeshText::Shown(name) + "' where a type of numbers is expected" };
    }
    return found->type;
  }

  template <typename Value>
  std::vector<Value>
  Numbers(std::uint64_t tuples, std::uint64_t components, NumberType type, bool finite = true)
  {
    const std::uint64_t count = Product(tuples, components);
    std::vector<Value>  numbers;
    if (m_IsText)
    {
      // A number takes two bytes at least, so that memory stays in proportion to the file whatever the count.
      RequireFit(count <= m_Bytes.size() - m_At, "it promises more numbers than it has room for");
      numbers.reserve(count);
      for (std::uint64_t i = 0; i < count; ++i)
      {
        const std::string_view word = Word();
        RequireFit(!word.empty(), "it ends in the middle of its numbers");
        numbers.push_back(ParseNumber<Value>(word, type, finite));
      }
      return numbers;
    }
    EndLine();
    const std::string_view bytes = Take(Product(count, type.bytes));
    numbers.reserve(count);
    for (std::uint64_t i = 0; i < count; ++i)
    {
      numbers.push_back(LoadNumber<Value>(bytes.data() + i * type.bytes, type, true, finite));
    }
    return numbers;
  }

  /** Passes over the numbers of an array with `tuples`, `components` and `type`. */
  template <typename Array>
  void
  SkipNumbers(const Array & array)
  {
    const std::uint64_t count = Product(array.tuples, array.components);
    if (!m_IsText)
    {
      EndLine();
      Take(Product(count, array.type.bytes));
      return;
    }
    for (std::uint64_t i = 0; i < count; ++i)
    {
      RequireFit(!Word().empty(), "it ends in the middle of an array");
    }
  }

  static std::uint64_t
  Product(std::uint64_t a, std::uint64_t b)
  {
    RequireFit(b == 0 || a <= std::numeric_limits<std::int64_t>::max() / b, "counts that cannot be");
    return a * b;
  }

  std::uint64_t
  Count()
  {
    const std::string_view word = Word();
    const auto             count = ParseNumber<std::int64_t>(word, { 'i', 8 });
    RequireFit(count >= 0, "counts that cannot be");
    return static_cast<std::uint64_t>(count);
  }

  static bool
  IsBlank(char c)
  {
    return c == ' ' || (c >= '\t' && c <= '\r');
  }

  /** The word at or behind `at`, which moves behind it; empty at the end of the file. */
  std::string_view
  Word(std::size_t & at) const
  {
    while (at < m_Bytes.size() && IsBlank(m_Bytes[at]))
    {
      ++at;
    }
    const std::size_t begin = at;
    while (at < m_Bytes.size() && !IsBlank(m_Bytes[at]))
    {
      ++at;
    }
    return m_Bytes.substr(begin, at - begin);
  }

  std::string_view
  Word()
  {
    return Word(m_At);
  }

  std::string_view
  Line()
  {
    const std::size_t      end = std::min(m_Bytes.find('\n', m_At), m_Bytes.size());
    const std::string_view line = m_Bytes.substr(m_At, end - m_At);
    m_At = std::min(end + 1, m_Bytes.size());
    return line;
  }

  /** Bytes begin behind the line that announces them. */
  void
  EndLine()
  {
    RequireFit(Line().find_first_not_of(" \t\r") == std::string_view::npos, "a line is longer than it should be");
  }

  std::string_view
  Take(std::uint64_t count)
  {
    RequireFit(count <= m_Bytes.size() - m_At, "it ends in the middle of an array");
    const std::string_view bytes = m_Bytes.substr(m_At, count);
    m_At += count;
    return bytes;
  }

  std::string_view m_Bytes;
  std::size_t      m_At = 0;
  bool             m_IsText = true;
};

} // namespace voxelcore
