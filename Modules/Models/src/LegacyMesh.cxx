// VTK's legacy polydata. VTK 9.1's own reader takes every count in the file on trust and crashes where one is wrong.

#include "LegacyWords.h"

namespace voxelcore
{
namespace
{

/** Reads a whole file, attributes included: a file that ends within them is cut off, too. */
class LegacyParser : private LegacyWords
{
public:
  using LegacyWords::LegacyWords;

  MeshFile
  Parse()
  {
    constexpr std::string_view start = "# vtk DataFile Version ";
    RequireFit(m_Bytes.starts_with(start), "it does not begin with '# vtk DataFile Version'");
    const auto version = ParseNumber<double>(MeshText::FirstWord(Line().substr(start.size())), { 'f', 8 });
    RequireFit(version >= 1 && version < 10, "a version that VTK does not have");
    Line(); // the title, whatever it says
    const std::string form = LowerCase(Word());
    RequireFit(form == "ascii" || form == "binary", "its third line says neither ASCII nor BINARY");
    m_IsText = form == "ascii";
    for (std::string word = LowerCase(Word()); !word.empty(); word = LowerCase(Word()))
    {
      Section(word);
    }
    RequireFit(m_HasPoints, "it holds no polydata");
    AddCells(m_File, m_Polygons.corners, m_Polygons.ends, 0, false);
    AddCells(m_File, m_Strips.corners, m_Strips.ends, 0, true);
    return std::move(m_File);
  }

private:
  struct Cells
  {
    std::vector<std::int64_t> corners;
    std::vector<std::int64_t> ends;
  };

  void
  Section(const std::string & word)
  {
    if (word == "dataset")
    {
      RequireFit(LowerCase(Word()) == "polydata", "it holds no polydata");
    }
    else if (word == "points")
    {
      RequireFit(!m_HasPoints, "it has its points twice");
      m_HasPoints = true;
      const std::uint64_t count = Count();
      AddPoints(m_File, Numbers<double>(count, 3, Type(Word())));
    }
    else if (word == "polygons" || word == "triangle_strips")
    {
      Cells & cells = word == "polygons" ? m_Polygons : m_Strips;
      RequireFit(cells.ends.empty(), "it has its cells twice");
      cells = ReadCells();
    }
    else if (word == "vertices" || word == "lines")
    {
      m_OtherCells += ReadCells().ends.size();
    }
    else if (word == "metadata")
    {
      SkipMetadata();
    }
    else if (word == "point_data")
    {
      m_Tuples = Count();
      RequireFit(m_HasPoints && m_Tuples == m_File.mesh.points.size(), "its point data are not one for each point");
    }
    else if (word == "cell_data")
    {
      m_Tuples = Count();
      RequireFit(m_Tuples == m_OtherCells + m_Polygons.ends.size() + m_Strips.ends.size(),
                 "its cell data are not one for each cell");
    }
    else
    {
      SkipAttribute(word);
    }
  }

  Cells
  ReadCells()
  {
    const std::uint64_t first = Count();
    const std::uint64_t second = Count();
    Cells               cells;
    std::size_t         next = m_At;
    if (Word(next) == "OFFSETS") // from version 5 on; there are one more offsets than cells
    {
      m_At = next;
      cells.ends = Numbers<std::int64_t>(first, 1, Type(Word()));
      RequireFit(!cells.ends.empty() && cells.ends.front() == 0, "its cells' offsets are damaged");
      cells.ends.erase(cells.ends.begin());
      RequireFit(Word() == "CONNECTIVITY", "it ends in the middle of its cells");
      cells.corners = Numbers<std::int64_t>(second, 1, Type(Word()));
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
        cells.corners.insert(cells.corners.end(), from, from + static_cast<std::ptrdiff_t>(size));
        cells.ends.push_back(static_cast<std::int64_t>(cells.corners.size()));
        at += static_cast<std::size_t>(size);
      }
      RequireFit(at == numbers.size(), "its cells are not as many numbers as it promises");
    }
    return cells;
  }

  /** Passes over what says nothing about the shape. */
  void
  SkipAttribute(const std::string & word)
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
      SkipField();
      return;
    }
    const auto * const known =
      std::find_if(fixed.begin(), fixed.end(), [&](const auto & f) { return f.first == word; });
    RequireFit(known != fixed.end() || word == "scalars" || word == "color_scalars" || word == "lookup_table" ||
                 word == "texture_coordinates",
               "an unknown keyword");
    Word(); // the name
    if (known != fixed.end())
    {
      SkipArray(m_Tuples, known->second, Word());
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
      SkipArray(m_Tuples, components, type);
    }
    else if (word == "texture_coordinates")
    {
      const std::uint64_t components = Count();
      SkipArray(m_Tuples, components, Word());
    }
    else
    {
      const std::uint64_t count = Count();
      const bool          isTable = word == "lookup_table";
      SkipArray(isTable ? count : m_Tuples, isTable ? 4 : count, "unsigned_char");
    }
  }

  void
  SkipField()
  {
    const std::uint64_t arrays = Count();
    for (std::uint64_t i = 0; i < arrays; ++i)
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
      SkipArray(tuples, components, Word());
    }
  }

  void
  SkipArray(std::uint64_t tuples, std::uint64_t components, std::string_view typeName)
  {
    const std::uint64_t count = Product(tuples, components);
    const std::string   name = LowerCase(typeName);
    if (name == "string" || name == "utf8_string")
    {
      EndLine();
      for (std::uint64_t i = 0; i < count; ++i)
      {
        SkipString();
      }
      return;
    }
    if (m_IsText)
    {
      RequireFit(name == "bit" || Type(typeName).bytes > 0, "an array of an unknown type");
      for (std::uint64_t i = 0; i < count; ++i)
      {
        RequireFit(!Word().empty(), "it ends in the middle of an array");
      }
      return;
    }
    EndLine();
    if (name == "bit")
    {
      Take(count / 8 + (count % 8 > 0 ? 1 : 0));
    }
    else
    {
      Take(Product(count, Type(typeName).bytes));
    }
  }

  void
  SkipString()
  {
    RequireFit(m_At < m_Bytes.size(), "it ends in the middle of an array");
    if (m_IsText)
    {
      Line();
      return;
    }
    // The two highest bits say how many bytes the length takes.
    const auto        first = static_cast<unsigned char>(m_Bytes[m_At]);
    const std::size_t width = std::size_t{ 8 } >> (first >> 6U);
    std::uint64_t     length = 0;
    for (const char c : Take(width))
    {
      length = (length << 8U) | static_cast<unsigned char>(c);
    }
    Take(length & (~std::uint64_t{ 0 } >> (66 - 8 * width)));
  }

  /** Names and keys of an array, up to an empty line. */
  void
  SkipMetadata()
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

  bool          m_HasPoints = false;
  MeshFile      m_File;
  Cells         m_Polygons;
  Cells         m_Strips;
  std::uint64_t m_OtherCells = 0;
  std::uint64_t m_Tuples = 0;
};

} // namespace

MeshFile
ParseLegacyVtk(std::string_view bytes)
{
  MeshFile file = LegacyParser(bytes).Parse();
  file.format = "VTK";
  return file;
}

} // namespace voxelcore
