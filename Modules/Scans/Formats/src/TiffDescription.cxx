#include "TiffDescription.h"

#include "voxelcore/Base/TextFields.h"
#include "TiffHandle.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>

namespace voxelcore
{
namespace
{

constexpr std::string_view kImageJ = "ImageJ=";
constexpr std::string_view kAxes = "CZT"; // channel, slice, frame

/** The lines "key=value" that ImageJ begins with. */
std::string
ImageJValue(const std::string & description, std::string_view key)
{
  for (std::size_t at = 0; at < description.size();)
  {
    const std::size_t      end = std::min(description.find('\n', at), description.size());
    const std::string_view line = Trim(std::string_view(description).substr(at, end - at));
    if (line.starts_with(key) && line.size() > key.size() && line[key.size()] == '=')
    {
      return std::string(Trim(line.substr(key.size() + 1)));
    }
    at = end + 1;
  }
  return {};
}

/** ImageJ writes letters beyond ASCII as \u00B5, XML may write them as &#181; or &#xB5;. */
std::string
WithoutEscapes(std::string text)
{
  for (const std::string_view micro :
       { "\\u00B5", "\\u00b5", "\\u03BC", "\\u03bc", "&#181;", "&#xB5;", "&#xb5;", "&#956;" })
  {
    if (const std::size_t at = text.find(micro); at != std::string::npos)
    {
      text.replace(at, micro.size(), "\xC2\xB5");
    }
  }
  return text;
}

/** An XML element's attributes. */
using Attributes = std::map<std::string, std::string, std::less<>>;

/** The attributes of each element of this name, whatever its namespace prefix. Enough for what is looked up here; a
 *  file that is no XML has none. */
std::vector<Attributes>
Elements(std::string_view xml, std::string_view name)
{
  std::vector<Attributes> found;
  for (std::size_t at = xml.find(name); at != std::string_view::npos; at = xml.find(name, at + 1))
  {
    const std::size_t behind = at + name.size();
    if (at == 0 || (xml[at - 1] != '<' && xml[at - 1] != ':') || behind >= xml.size() ||
        std::string_view(" \t\r\n/>").find(xml[behind]) == std::string_view::npos)
    {
      continue;
    }
    // A short look to both sides, so that a file of nothing but such names takes no longer than another.
    constexpr std::size_t  longestPrefix = 64;
    constexpr std::size_t  longestElement = 8192;
    const std::size_t      begin = at - std::min(at, longestPrefix);
    const std::string_view before = xml.substr(begin, at - begin);
    const std::size_t      open = before.rfind('<');
    if (open == std::string_view::npos || before.find_first_of("/ \t\r\n", open) != std::string_view::npos)
    {
      continue;
    }
    std::string_view element = xml.substr(behind, longestElement);
    element = element.substr(0, element.find('<')); // else elements without an end would hold the attributes of others
    Attributes attributes;
    for (std::size_t from = 0; from < element.size();)
    {
      const std::size_t equals = element.find_first_of("=>", from);
      const std::size_t quote = element.find_first_of("\"'>", equals);
      if (equals == std::string_view::npos || quote == std::string_view::npos || element[equals] == '>' ||
          element[quote] == '>')
      {
        break;
      }
      const std::size_t end = element.find(element[quote], quote + 1);
      if (end == std::string_view::npos)
      {
        break;
      }
      const std::string_view key = Trim(element.substr(from, equals - from));
      attributes[std::string(key)] = std::string(element.substr(quote + 1, end - quote - 1));
      from = end + 1;
    }
    found.push_back(std::move(attributes));
  }
  return found;
}

std::string
Value(const Attributes & attributes, std::string_view key)
{
  const auto at = attributes.find(key);
  return at == attributes.end() ? std::string() : at->second;
}

std::uint64_t
CountOr(std::string_view text, std::uint64_t otherwise)
{
  const auto value = ParseInteger(Trim(text));
  return value && *value > 0 ? static_cast<std::uint64_t>(*value) : otherwise;
}

bool
IsOme(const std::string & description)
{
  return description.find("<OME") != std::string::npos || description.find(":OME") != std::string::npos;
}

PageOrder
OmeOrder(const std::string & description, std::uint16_t samples)
{
  PageOrder  order;
  const auto images = Elements(description, "Pixels");
  if (images.empty())
  {
    return order;
  }
  order.program = "OME";
  order.volumesInFile = images.size();
  const Attributes & pixels = images.front();
  order.channels = CountOr(Value(pixels, "SizeC"), 1);
  if (samples > 1 && order.channels % samples == 0)
  {
    order.channels /= samples; // colours of one page
  }
  order.frames = CountOr(Value(pixels, "SizeT"), 1);
  const std::uint64_t slices = CountOr(Value(pixels, "SizeZ"), 1);
  order.images = order.channels * order.frames * slices;
  const std::string axes = Value(pixels, "DimensionOrder");
  order.fastest = axes.empty() ? "ZCT" : axes.substr(std::min<std::size_t>(2, axes.size()));
  order.isPlain = std::is_permutation(order.fastest.begin(), order.fastest.end(), kAxes.begin(), kAxes.end());
  // Each block of pages says where it begins: it must be where the order puts it.
  for (const Attributes & block : Elements(description, "TiffData"))
  {
    const auto number = [&block](std::string_view key) { return CountOr(Value(block, key), 0); };
    if (block.contains("IFD") && block.size() > 1)
    {
      std::uint64_t at = 0;
      std::uint64_t step = 1;
      for (const char axis : order.fastest)
      {
        at += step * number(axis == 'C' ? "FirstC" : axis == 'T' ? "FirstT" : "FirstZ");
        step *= axis == 'C' ? order.channels : axis == 'T' ? order.frames : slices;
      }
      order.isPlain = order.isPlain && at == number("IFD");
    }
  }
  return order;
}

/** Resolutions that programs for pictures write, in dots an inch: they speak of screens and printers. */
bool
IsPrintResolution(double dotsPerInch)
{
  constexpr std::array<double, 18> usual{ 72,  90,  96,  100, 120, 144, 150, 180,  200,
                                          240, 300, 350, 360, 400, 600, 720, 1200, 2400 };
  return std::any_of(usual.begin(), usual.end(), [&](double dots) {
    return std::abs(dotsPerInch - dots) <= 2e-4 * dots; // dots a cm are written with few digits
  });
}

/** libtiff gives resolutions in single precision, and files hold fractions of few digits: 1 / 3.333333 stands for
 *  0.3. */
double
FewDigits(double value)
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::setprecision(6) << value;
  const double rounded = ParseReal(out.str()).value_or(value);
  return std::abs(rounded - value) <= 3e-7 * value ? rounded : value;
}

std::optional<double>
Length(double value, std::optional<double> millimetres)
{
  value = std::abs(value);
  if (!millimetres || !std::isfinite(value) || value <= 0)
  {
    return std::nullopt;
  }
  return FewDigits(value * *millimetres);
}

StatedSpacing
ImageJSpacing(const std::string & description, double x, double y)
{
  const auto unit = [&](std::string_view key) { return WithoutEscapes(ImageJValue(description, key)); };
  const auto unitX = MillimetresIn(unit("unit"));
  const auto own = [&](std::string_view key) { return unit(key).empty() ? unitX : MillimetresIn(unit(key)); };
  const auto depth = ParseReal(LowerCase(unit("spacing")));
  return { { Length(1 / x, unitX), Length(1 / y, own("yunit")), Length(depth.value_or(0), own("zunit")) }, "ImageJ" };
}

StatedSpacing
OmeSpacing(const std::string & description)
{
  StatedSpacing stated;
  stated.source = "OME-XML";
  const auto images = Elements(description, "Pixels");
  for (std::size_t axis = 0; axis < 3 && !images.empty(); ++axis)
  {
    const std::string key = Text("PhysicalSize", "XYZ"[axis]);
    const std::string unit = WithoutEscapes(Value(images.front(), key + "Unit"));
    const auto        size = ParseReal(LowerCase(Trim(Value(images.front(), key))));
    stated.mm[axis] = Length(size.value_or(0), unit.empty() ? 1e-3 : MillimetresIn(unit));
  }
  return stated;
}

StatedSpacing
ResolutionSpacing(std::uint16_t unit, double x, double y)
{
  StatedSpacing stated;
  const double  millimetres = unit == RESUNIT_INCH ? 25.4 : 10.0;
  if ((unit != RESUNIT_INCH && unit != RESUNIT_CENTIMETER) || !(x > 0) || !(y > 0) || !std::isfinite(x + y) ||
      (x == 1 && y == 1))
  {
    return stated;
  }
  const std::string dots = Text(Number(x), unit == RESUNIT_INCH ? " dots an inch" : " dots a cm");
  if (IsPrintResolution(x * 25.4 / millimetres) && IsPrintResolution(y * 25.4 / millimetres))
  {
    stated.note = Text("its resolution of ", dots, " is one for screens or printers: not taken for a voxel size");
    return stated;
  }
  stated.mm = { Length(1 / x, millimetres), Length(1 / y, millimetres), std::nullopt };
  stated.source = Text("resolution tags (", dots, ")");
  return stated;
}

} // namespace

PageOrder
ReadPageOrder(const std::string & description, std::uint16_t samples)
{
  if (IsOme(description))
  {
    return OmeOrder(description, samples);
  }
  PageOrder order;
  if (description.starts_with(kImageJ))
  {
    order.program = "ImageJ";
    order.channels = CountOr(ImageJValue(description, "channels"), 1);
    order.frames = CountOr(ImageJValue(description, "frames"), 1);
    order.images = CountOr(ImageJValue(description, "images"), 0);
    if (samples > 1 && order.channels == samples)
    {
      order.channels = 1; // colours of one page
    }
  }
  return order;
}

std::vector<std::uint64_t>
ChoosePages(const std::filesystem::path &      path,
            const PageOrder &                  order,
            const std::vector<std::uint64_t> & pages,
            const ReadOptions &                options)
{
  if (order.program == "ImageJ" && order.images > pages.size())
  {
    RefuseInput(
      path,
      Text("ImageJ says it holds ", order.images, " pages, it lists ", pages.size(), ", and the others are not there"),
      "the file is cut off: fetch it anew, or save it as BigTIFF or NRRD");
  }
  if (order.volumesInFile > 1)
  {
    RefuseInput(path,
                Text("OME-TIFF with ", order.volumesInFile, " images"),
                "save the one you need as a file of its own");
  }
  __extension__ using Wide = unsigned __int128; // two numbers of 64 bits that a file claims
  const Wide groups = Wide{ order.channels } * order.frames;
  if (groups == 1 || (!options.component && order.AreChannelsSlices(pages.size())))
  {
    return pages;
  }
  if (!order.isPlain || (order.images > 0 && order.images != pages.size()) || groups > pages.size() ||
      pages.size() % static_cast<std::uint64_t>(groups) != 0)
  {
    RefuseInput(path,
                Text(order.program,
                     " speaks of ",
                     order.channels,
                     " channels and ",
                     order.frames,
                     " time points, which do not fit its ",
                     pages.size(),
                     " pages"),
                "save one channel of one time point as a stack");
  }
  const auto choose =
    [&](std::uint64_t count, std::optional<std::int64_t> chosen, const char * what, const char * option) {
      const auto number = static_cast<std::uint64_t>(chosen.value_or(0));
      if ((!chosen && count > 1) || (chosen && number >= count))
      {
        RefuseInput(path,
                    chosen ? Text("there is no ", what, " ", *chosen, ", it has ", count)
                           : Text("hyperstack of ", order.program, " with ", count, " ", what, "s"),
                    (count == 1 ? Text("leave ", option, " out or give 0")
                                : Text("choose one with ", option, " 0 to ", option, " ", count - 1)) +
                      (groups == pages.size() && pages.size() > 1
                         ? Text("; if its ", what, "s are slices, say so in Fiji (Image > Properties) and save it anew")
                         : std::string()));
      }
      return number;
    };
  const std::uint64_t        channel = choose(order.channels, options.component, "channel", "--component");
  const std::uint64_t        frame = choose(order.frames, options.volume, "time point", "--volume");
  const std::uint64_t        slices = pages.size() / static_cast<std::uint64_t>(groups);
  std::vector<std::uint64_t> chosen;
  for (std::uint64_t slice = 0; slice < slices; ++slice)
  {
    std::uint64_t at = 0;
    std::uint64_t step = 1;
    for (const char axis : order.fastest)
    {
      at += step * (axis == 'C' ? channel : axis == 'T' ? frame : slice);
      step *= axis == 'C' ? order.channels : axis == 'T' ? order.frames : slices;
    }
    chosen.push_back(pages[at]);
  }
  return chosen;
}

StatedSpacing
ReadTiffSpacing(const TiffHandle & tiff, const std::string & description)
{
  const double x = tiff.Field<float>(TIFFTAG_XRESOLUTION, 0);
  const double y = tiff.Field<float>(TIFFTAG_YRESOLUTION, 0);
  if (IsOme(description))
  {
    if (StatedSpacing stated = OmeSpacing(description); stated.mm[0] && stated.mm[1])
    {
      return stated;
    }
  }
  if (description.starts_with(kImageJ))
  {
    // As ImageJ: without a resolution a pixel is one unit wide.
    if (StatedSpacing stated = ImageJSpacing(description, x > 0 ? x : 1, y > 0 ? y : 1); stated.mm[0] && stated.mm[1])
    {
      return stated;
    }
  }
  const auto    unit = tiff.Field<std::uint16_t>(TIFFTAG_RESOLUTIONUNIT, RESUNIT_INCH);
  StatedSpacing stated = ResolutionSpacing(unit, x, y);
  if (stated.mm[0] && description.starts_with(kImageJ))
  {
    const auto depth = ParseReal(LowerCase(ImageJValue(description, "spacing")));
    stated.mm[2] = Length(depth.value_or(0), unit == RESUNIT_INCH ? 25.4 : 10.0);
  }
  return stated;
}

std::string
ImageJDescription(const ImageGeometry & geometry)
{
  // No number of images: ImageJ would then take all voxels to lie in one piece behind the first page.
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << kImageJ << "1.53t\nslices=" << geometry.size[2] << "\nunit=" << UnitName(geometry.unit)
      << "\nspacing=" << std::setprecision(17) << geometry.spacing[2] << "\nloop=false\n";
  return out.str();
}

} // namespace voxelcore
