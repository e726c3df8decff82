#include "LegacyPolyData.h"

#include "voxelcore/Base/Library.h"

namespace voxelcore
{
namespace
{

/** The section of a .vtp where such cells are; null where the word announces none. */
const char *
SectionOfCells(std::string_view word)
{
  return word == "vertices"          ? "Verts"
         : word == "lines"           ? "Lines"
         : word == "polygons"        ? "Polys"
         : word == "triangle_strips" ? "Strips"
                                     : nullptr;
}

/** Without the escapes (%20) that VTK writes for blanks and what is no letter. */
std::string
Decoded(std::string_view text)
{
  std::string decoded;
  for (std::size_t at = 0; at < text.size(); ++at)
  {
    unsigned           value = 0;
    const char * const begin = text.data() + at + 1;
    if (text[at] == '%' && at + 2 < text.size() && from_chars(begin, begin + 2, value, 16).ptr == begin + 2)
    {
      decoded.push_back(static_cast<char>(value));
      at += 2;
      continue;
    }
    decoded.push_back(text[at]);
  }
  return decoded;
}

} // namespace

LegacyPolyData::LegacyPolyData(std::string_view bytes)
  : LegacyWords(bytes)
{
  constexpr std::string_view start = "# vtk DataFile Version ";
  RequireFit(m_Bytes.starts_with(start), "it does not begin with '# vtk DataFile Version'");
  const auto version = ParseNumber<double>(MeshText::FirstWord(Line().substr(start.size())), { 'f', 8 });
  RequireFit(version >= 1 && version < 10, "a version that VTK does not have");
  title = Line();
  const std::string form = LowerCase(Word());
  RequireFit(form == "ascii" || form == "binary", "its third line says neither ASCII nor BINARY");
  m_IsText = form == "ascii";
  for (std::string word = LowerCase(Word()); !word.empty(); word = LowerCase(Word()))
  {
    Section(word);
  }
  RequireFit(m_HasPoints, "it holds no polydata");
}

void
LegacyPolyData::Section(const std::string & word)
{
  if (word == "dataset")
  {
    RequireFit(LowerCase(Word()) == "polydata", "it holds no polydata");
  }
  else if (word == "points")
  {
    RequireFit(!m_HasPoints, "it has its points twice");
    m_HasPoints = true;
    points.tuples = Count();
    points.components = 3;
    points.type = Type(Word());
    points.begin = m_At;
    SkipNumbers(points);
  }
  else if (const char * const kind = SectionOfCells(word))
  {
    RequireFit(cells.find(kind) == cells.end(), "it has its cells twice");
    cells[kind] = ReadCells();
  }
  else if (word == "metadata")
  {
    SkipMetadata();
  }
  else if (word == "point_data")
  {
    m_Section = "PointData";
    m_Tuples = Count();
    RequireFit(m_HasPoints && m_Tuples == points.tuples, "its point data are not one for each point");
  }
  else if (word == "cell_data")
  {
    m_Section = "CellData";
    m_Tuples = Count();
    std::size_t all = 0;
    for (const auto & one : cells)
    {
      all += one.second.ends.size();
    }
    RequireFit(m_Tuples == all, "its cell data are not one for each cell");
  }
  else
  {
    TakeAttribute(word);
  }
}

LegacyCells
LegacyPolyData::ReadCells()
{
  const std::uint64_t first = Count();
  const std::uint64_t second = Count();
  LegacyCells         read;
  std::size_t         next = m_At;
  if (Word(next) == "OFFSETS") // from version 5 on; there are one more offsets than cells
  {
    m_At = next;
    read.ends = Numbers<std::int64_t>(first, 1, Type(Word()));
    RequireFit(!read.ends.empty() && read.ends.front() == 0, "its cells' offsets are damaged");
    read.ends.erase(read.ends.begin());
    RequireFit(Word() == "CONNECTIVITY", "it ends in the middle of its cells");
    read.corners = Numbers<std::int64_t>(second, 1, Type(Word()));
  }
  else if (first > 0)
  {
    const auto  numbers = Numbers<std::int64_t>(second, 1, { 'i', 4 });
    std::size_t at = 0;
    for (std::uint64_t cell = 0; cell < first; ++cell)
    {
      RequireFit(at < numbers.size(), "it has fewer cells than it promises");
      const std::int64_t size = numbers[at++];
      RequireFit(size >= 0 && static_cast<std::uint64_t>(size) <= numbers.size() - at,
                 "it has fewer cells than it promises");
      const auto from = numbers.begin() + static_cast<std::ptrdiff_t>(at);
      read.corners.insert(read.corners.end(), from, from + static_cast<std::ptrdiff_t>(size));
      read.ends.push_back(static_cast<std::int64_t>(read.corners.size()));
      at += static_cast<std::size_t>(size);
    }
    RequireFit(at == numbers.size(), "its cells are not as many numbers as it promises");
  }
  return read;
}

void
LegacyPolyData::TakeAttribute(const std::string & word)
{
  static constexpr std::array<std::pair<std::string_view, std::uint64_t>, 7> fixed{ { { "vectors", 3 },
                                                                                      { "normals", 3 },
                                                                                      { "tensors", 9 },
                                                                                      { "tensors6", 6 },
                                                                                      { "global_ids", 1 },
                                                                                      { "pedigree_ids", 1 },
                                                                                      { "edge_flags", 1 } } };
  if (word == "field")
  {
    Word();
    TakeField();
    return;
  }
  const auto * const known = std::find_if(fixed.begin(), fixed.end(), [&](const auto & f) { return f.first == word; });
  RequireFit(known != fixed.end() || word == "scalars" || word == "color_scalars" || word == "lookup_table" ||
               word == "texture_coordinates",
             "an unknown keyword");
  const std::string_view name = Word();
  if (known != fixed.end())
  {
    TakeArray(name, m_Tuples, known->second, Word());
  }
  else if (word == "scalars")
  {
    const std::string_view type = Word();
    std::uint64_t          components = 1;
    std::size_t            next = m_At;
    if (LowerCase(Word(next)) != "lookup_table")
    {
      components = Count();
    }
    RequireFit(LowerCase(Word()) == "lookup_table", "'LOOKUP_TABLE' is missing");
    Word();
    TakeArray(name, m_Tuples, components, type);
  }
  else if (word == "texture_coordinates")
  {
    const std::uint64_t components = Count();
    TakeArray(name, m_Tuples, components, Word());
  }
  else
  {
    const std::uint64_t count = Count();
    const bool          isTable = word == "lookup_table";
    // A table belongs to no point; colours are numbers from 0 to 1 in text, bytes else.
    TakeArray(isTable ? "" : name, isTable ? count : m_Tuples, isTable ? 4 : count, "unsigned_char");
  }
}

void
LegacyPolyData::TakeField()
{
  const std::uint64_t count = Count();
  for (std::uint64_t i = 0; i < count; ++i)
  {
    std::size_t next = m_At;
    while (LowerCase(Word(next)) == "metadata") // of the array before
    {
      m_At = next;
      SkipMetadata();
      next = m_At;
    }
    const std::string_view name = Word();
    RequireFit(!name.empty(), "it ends in the middle of its fields");
    if (name == "NULL_ARRAY")
    {
      continue;
    }
    const std::uint64_t components = Count();
    const std::uint64_t tuples = Count();
    TakeArray(name, tuples, components, Word());
  }
}

void
LegacyPolyData::TakeArray(std::string_view name,
                          std::uint64_t    tuples,
                          std::uint64_t    components,
                          std::string_view typeName)
{
  const std::string lower = LowerCase(typeName);
  const bool        isText = lower == "string" || lower == "utf8_string";
  const bool        isBits = lower == "bit";
  LegacyArray       array{ isText || isBits ? NumberType{} : Type(typeName), components, tuples, isText, m_At };
  const auto        count = Product(tuples, components);
  if (isText)
  {
    EndLine();
    for (std::uint64_t i = 0; i < count; ++i)
    {
      TakeString();
    }
  }
  else if (isBits && !m_IsText)
  {
    EndLine();
    Take(count / 8 + (count % 8 > 0 ? 1 : 0));
  }
  else
  {
    SkipNumbers(array);
  }
  arrays.emplace(std::pair(m_Section, Decoded(name)), array); // as VTK, which finds the first of a name
}

std::string
LegacyPolyData::TakeString()
{
  RequireFit(m_At < m_Bytes.size(), "it ends in the middle of an array");
  if (m_IsText)
  {
    return Decoded(Line());
  }
  // The two highest bits say how many bytes the length takes.
  const auto        first = static_cast<unsigned char>(m_Bytes[m_At]);
  const std::size_t width = std::size_t{ 8 } >> (first >> 6U);
  std::uint64_t     length = 0;
  for (const char c : Take(width))
  {
    length = (length << 8U) | static_cast<unsigned char>(c);
  }
  return std::string(Take(length & (~std::uint64_t{ 0 } >> (66 - 8 * width))));
}

std::string
LegacyPolyData::ReadText(const LegacyArray & array)
{
  RequireFit(array.isText && array.tuples == 1 && array.components == 1, "an array is not one text");
  m_At = array.begin;
  EndLine();
  return TakeString();
}

/** Names and keys of an array, up to an empty line. */
void
LegacyPolyData::SkipMetadata()
{
  EndLine();
  while (m_At < m_Bytes.size())
  {
    const std::string_view line = Line();
    if (line.find_first_not_of(" \t\r") == std::string_view::npos)
    {
      return;
    }
  }
}

} // namespace voxelcore
