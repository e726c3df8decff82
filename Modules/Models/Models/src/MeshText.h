#pragma once
// Meshes of text, line by line, every word checked. VTK has readers for most of these formats; they keep single
// precision and take a file that is cut off for a whole one.

#include "UnfitFile.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Models/ReadMesh.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

namespace voxelcore
{

/** Walks through a text. What is wrong is thrown as UnfitFile with the number of the line. */
class MeshText
{
public:
  explicit MeshText(std::string_view text)
    : m_Text(text)
  {}

  /** Goes to the next line that is not empty and no comment (of `comment`); false at the end. */
  bool
  NextLine(char comment)
  {
    while (m_At < m_Text.size())
    {
      const std::size_t end = std::min(m_Text.find('\n', m_At), m_Text.size());
      m_Line = m_Text.substr(m_At, end - m_At);
      m_At = std::min(end + 1, m_Text.size());
      ++m_Number;
      if (comment != '\0')
      {
        m_Line = m_Line.substr(0, m_Line.find(comment));
      }
      SkipBlanks();
      if (!m_Line.empty())
      {
        return true;
      }
    }
    return false;
  }

  /** The next word of the line; empty at its end. */
  std::string_view
  Word()
  {
    std::size_t length = 0;
    while (length < m_Line.size() && !IsBlank(m_Line[length]))
    {
      ++length;
    }
    const std::string_view word = m_Line.substr(0, length);
    m_Line.remove_prefix(length);
    SkipBlanks();
    return word;
  }

  double
  Coordinate()
  {
    std::string_view word = Word();
    word.remove_prefix(word.starts_with('+') ? 1 : 0);
    double value = 0;
    const auto [end, error] = from_chars(word.data(), word.data() + word.size(), value);
    // Too small to be told from 0 is 0.
    const bool isTiny = error == std::errc::result_out_of_range && word.find("e-") != std::string_view::npos;
    Require((error == std::errc() || isTiny) && end == word.data() + word.size() && std::isfinite(value),
            "'" + Shown(word) + "' where a coordinate is expected");
    return isTiny ? 0 : value;
  }

  Vector3
  Point()
  {
    const double x = Coordinate();
    const double y = Coordinate();
    return { x, y, Coordinate() };
  }

  std::int64_t
  Whole(std::string_view word)
  {
    std::int64_t value = 0;
    const auto [end, error] = from_chars(word.data(), word.data() + word.size(), value);
    Require(error == std::errc() && end == word.data() + word.size(),
            "'" + Shown(word) + "' where a whole number is expected");
    return value;
  }

  void
  Require(bool condition, const std::string & reason) const
  {
    if (!condition)
    {
      throw UnfitFile{ "line " + std::to_string(m_Number) + ": " + reason };
    }
  }

  /** The first word of a line; empty where there is none. */
  static std::string_view
  FirstWord(std::string_view line)
  {
    MeshText text(line);
    return text.NextLine('\0') ? text.Word() : std::string_view{};
  }

  /** A word as a message may show it: short, with nothing a terminal would act on. */
  static std::string
  Shown(std::string_view word)
  {
    std::string text(word.substr(0, 40));
    for (char & c : text)
    {
      c = c >= ' ' && c <= '~' ? c : '?';
    }
    return text;
  }

private:
  static bool
  IsBlank(char c)
  {
    return c == ' ' || c == '\t' || c == '\r';
  }
  void
  SkipBlanks()
  {
    while (!m_Line.empty() && IsBlank(m_Line.front()))
    {
      m_Line.remove_prefix(1);
    }
  }

  std::string_view m_Text;
  std::string_view m_Line;
  std::size_t      m_At = 0;
  std::size_t      m_Number = 0;
};

/** Adds a polygon as a fan. Of a planar one, convex or not, the fan's triangles sum up to the polygon: where it is not
 *  convex some are turned over, and winding numbers see what they should. */
inline void
AddPolygon(MeshFile & file, const std::vector<std::uint32_t> & corners)
{
  for (std::size_t i = 2; i < corners.size(); ++i)
  {
    file.mesh.triangles.push_back({ corners[0], corners[i - 1], corners[i] });
  }
  file.polygons += corners.size() > 3 ? 1 : 0;
}

/** Each takes the whole file and throws UnfitFile. */
MeshFile
ParseStl(std::string_view bytes);
MeshFile
ParseObj(std::string_view bytes);
MeshFile
ParseOff(std::string_view bytes);
MeshFile
ParsePly(std::string_view bytes);
MeshFile
ParseLegacyVtk(std::string_view bytes);
/** As these, array by array. */
MeshFile
ReadVtpMesh(const std::filesystem::path & path);

} // namespace voxelcore
