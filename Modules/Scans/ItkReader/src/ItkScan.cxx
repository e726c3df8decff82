#include "ItkScan.h"

#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Base/Library.h"

#include <charconv>
#include <iterator>
#include <utility>

namespace voxelcore
{
namespace
{

/** All the digits that make the same number again. */
std::string
Exactly(double value)
{
  std::array<char, 64> text;
  const auto           end = to_chars(text.begin(), text.end(), value).ptr;
  return { text.begin(), end };
}

void
AddReals(std::string & text, const char * key, const Vector3 & values)
{
  text += Text(key, " ", Exactly(values[0]), " ", Exactly(values[1]), " ", Exactly(values[2]), "\n");
}

/** One line, whatever a file has put into it. */
std::string
Line(std::string text)
{
  for (char & c : text)
  {
    c = static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return text;
}

/** The words of one line, taken from the left. */
class LineWords
{
public:
  LineWords(const std::filesystem::path & path, std::string_view rest)
    : m_Path(path)
    , m_Rest(rest)
  {}

  std::string_view
  Word()
  {
    const std::size_t      blank = std::min(m_Rest.find(' '), m_Rest.size());
    const std::string_view word = m_Rest.substr(0, blank);
    m_Rest.remove_prefix(std::min(blank + 1, m_Rest.size()));
    return word;
  }
  std::string
  Rest()
  {
    return std::string(std::exchange(m_Rest, {}));
  }
  template <typename T>
  T
  Value()
  {
    const std::string_view word = Word();
    T                      value{};
    const auto [end, error] = from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
    {
      RefuseInput(m_Path,
                  Text("its reader sent '", Printable(word), "' for a number"),
                  "please report this as a fault");
    }
    return value;
  }
  Vector3
  Reals()
  {
    Vector3 values{};
    for (double & value : values)
    {
      value = Value<double>();
    }
    return values;
  }

private:
  const std::filesystem::path & m_Path;
  std::string_view              m_Rest;
};

void
TakeLine(const std::filesystem::path & path, std::string_view line, ItkScan & scan)
{
  LineWords         words(path, line);
  const std::string key(words.Word());
  if (key == "format")
  {
    scan.format = words.Rest();
  }
  else if (key == "stored")
  {
    scan.storedType = words.Rest();
  }
  else if (key == "type")
  {
    const auto number = words.Value<unsigned>();
    if (number > static_cast<unsigned>(PixelType::Float64))
    {
      RefuseInput(path, "its reader sent an unknown type", "please report this as a fault");
    }
    scan.type = static_cast<PixelType>(number);
  }
  else if (key == "size")
  {
    for (auto & side : scan.size)
    {
      side = words.Value<std::int64_t>();
    }
  }
  else if (key == "values")
  {
    scan.components = words.Value<std::uint64_t>();
    scan.volumes = words.Value<std::uint64_t>();
    scan.separate = words.Value<unsigned>() != 0;
  }
  else if (key.size() == 2 && key[0] == 'a' && key[1] >= '0' && key[1] <= '2')
  {
    scan.axes[static_cast<std::size_t>(key[1] - '0')] = words.Reals();
  }
  else if (key == "spacing")
  {
    scan.spacing = words.Reals();
  }
  else if (key == "origin")
  {
    scan.origin = words.Reals();
  }
  else if (key == "scale")
  {
    scan.slope = words.Value<double>();
    scan.intercept = words.Value<double>();
  }
  else if (key == "segment")
  {
    Segment segment;
    segment.layer = words.Value<std::size_t>();
    segment.value = words.Value<std::int64_t>();
    if (words.Value<unsigned>() != 0)
    {
      segment.color = words.Reals();
    }
    segment.name = words.Rest();
    scan.segments.push_back(std::move(segment));
  }
  else if (key == "note" || key == "warning")
  {
    (key == "note" ? scan.notes : scan.warnings).push_back(words.Rest());
  }
  else if (key == "file")
  {
    scan.files.emplace_back(words.Rest());
  }
  else
  {
    RefuseInput(path, Text("its reader sent '", Printable(key), "'"), "please report this as a fault");
  }
}

} // namespace

std::string
ItkScanText(const ItkScan & scan)
{
  std::string text = Text("format ",
                          Line(scan.format),
                          "\nstored ",
                          Line(scan.storedType),
                          "\ntype ",
                          static_cast<unsigned>(scan.type),
                          "\nsize ",
                          scan.size[0],
                          " ",
                          scan.size[1],
                          " ",
                          scan.size[2],
                          "\nvalues ",
                          scan.components,
                          " ",
                          scan.volumes,
                          " ",
                          scan.separate ? 1 : 0,
                          "\nscale ",
                          Exactly(scan.slope),
                          " ",
                          Exactly(scan.intercept),
                          "\n");
  AddReals(text, "a0", scan.axes[0]);
  AddReals(text, "a1", scan.axes[1]);
  AddReals(text, "a2", scan.axes[2]);
  AddReals(text, "spacing", scan.spacing);
  AddReals(text, "origin", scan.origin);
  for (const Segment & segment : scan.segments)
  {
    text += Text("segment ", segment.layer, " ", segment.value, " ", segment.color ? 1 : 0, " ");
    for (std::size_t c = 0; segment.color && c < 3; ++c)
    {
      text += Exactly((*segment.color)[c]) + " ";
    }
    text += Line(segment.name) + "\n";
  }
  for (const std::string & note : scan.notes)
  {
    text += "note " + Line(note) + "\n";
  }
  for (const std::string & warning : scan.warnings)
  {
    text += "warning " + Line(warning) + "\n";
  }
  for (const std::filesystem::path & file : scan.files)
  {
    text += file.string().find('\n') == std::string::npos ? "file " + file.string() + "\n" : std::string();
  }
  return text + "\n";
}

ItkScan
ParseItkScan(const std::filesystem::path & path, std::string_view text)
{
  ItkScan scan;
  while (!text.empty())
  {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (end > 0)
    {
      TakeLine(path, text.substr(0, end), scan);
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return scan;
}

const char *
ItkFormatName(ItkFormat format)
{
  constexpr std::array names{ "none", "dicom", "mrc", "minc", "gipl", "vtk", "hdf5" };
  return names[static_cast<std::size_t>(format)];
}

} // namespace voxelcore
