#include "ZarrImage.h"

#include "ZarrMetadata.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/TextFields.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

namespace voxelcore
{

using Json = nlohmann::json;

namespace
{

namespace fs = std::filesystem;

constexpr std::size_t kMostNamed = 20; ///< images in a message

/** The user's metadata of a group or array, of OME where version 0.5 puts them. */
Json
UserMetadata(const fs::path & folder)
{
  Json json = ReadZarrJson(folder / ".zattrs");
  if (json.is_null())
  {
    json = ReadZarrJson(folder / "zarr.json");
    json = json.is_object() ? json.value("attributes", Json::object()) : Json::object();
  }
  return json.contains("ome") && json.at("ome").is_object() ? json.at("ome") : json;
}

bool
IsImage(const fs::path & folder)
{
  const Json attributes = UserMetadata(folder);
  return attributes.contains("multiscales") && attributes.at("multiscales").is_array() &&
         !attributes.at("multiscales").empty();
}

/** Names of folders within, in the order of a list, that a store must not lead out of. */
fs::path
Within(const fs::path & folder, const std::string & name)
{
  const fs::path relative = fs::path(name).lexically_normal();
  if (name.empty() || relative.is_absolute() || *relative.begin() == "..")
  {
    RefuseInput(folder,
                Text("it names '", Printable(name, 60), "', which does not lie in it"),
                "the store is damaged: write it anew");
  }
  RequireInStore(folder, folder / relative);
  return folder / relative;
}

/** The one image that is meant by a group that is none itself. */
fs::path
ImageWithin(const fs::path & folder)
{
  const Json               attributes = UserMetadata(folder);
  std::vector<std::string> names;
  if (attributes.contains("labels") && attributes.at("labels").is_array())
  {
    for (const Json & name : attributes.at("labels"))
    {
      names.push_back(name.is_string() ? name.get<std::string>() : std::string());
    }
  }
  else if (IsZarr(folder / "labels"))
  {
    return ImageWithin(Within(folder, "labels"));
  }
  else
  {
    // As bioformats2raw lays them out: 0, 1, 2, ...
    for (std::size_t n = 0; n < kMostNamed && IsZarr(folder / std::to_string(n)); ++n)
    {
      names.push_back(std::to_string(n));
    }
  }
  if (names.size() != 1)
  {
    std::string list;
    for (std::size_t n = 0; n < std::min(names.size(), kMostNamed); ++n)
    {
      list += (n > 0 ? ", " : "") + Printable(names[n], 60);
    }
    RefuseInput(folder,
                names.empty() ? "a Zarr store without an image or labels" : Text("a Zarr store of several images"),
                names.empty() ? "name the folder of one" : Text("name the folder of one within: ", list));
  }
  const fs::path only = Within(folder, names.front());
  if (*fs::path(names.front()).lexically_normal().begin() == ".") // one would look into it for ever
  {
    RefuseInput(folder,
                "its metadata name the folder itself as the labels in it",
                "the store is damaged: write it anew");
  }
  return IsImage(only) || IsZarrArray(only) ? only : ImageWithin(only);
}

std::vector<double>
Numbers(const fs::path & folder, const Json & list, std::size_t count)
{
  std::vector<double> numbers;
  for (const Json & one : list.is_array() ? list : Json::array())
  {
    numbers.push_back(one.is_number() ? one.get<double>() : std::nan(""));
  }
  if (numbers.size() != count)
  {
    RefuseInput(folder,
                Text("a scale or translation of ", numbers.size(), " numbers for ", count, " axes"),
                "the store is damaged: write it anew");
  }
  return numbers;
}

/** Goes on by the transformations of a list: each scales, or moves, what the ones before gave. */
void
Transform(const fs::path & folder, const Json & holder, ZarrImage & image)
{
  const Json list = holder.value("coordinateTransformations", Json::array());
  for (const Json & one : list)
  {
    const std::string type = one.value("type", "");
    if (type == "identity")
    {
      continue;
    }
    if ((type != "scale" && type != "translation") || !one.contains(type))
    {
      RefuseInput(folder,
                  Text("a transformation of type '", Printable(type, 30), "', which is not read here"),
                  "write it with a scale and a translation");
    }
    const auto numbers = Numbers(folder, one.at(type), image.scale.size());
    for (std::size_t a = 0; a < numbers.size(); ++a)
    {
      if (type == "scale")
      {
        image.scale[a] *= numbers[a];
        image.translation[a] *= numbers[a];
      }
      else
      {
        image.translation[a] += numbers[a];
      }
    }
  }
}

/** Where an axis leads, in LPS; RFC 4 of OME-Zarr: "left-to-right". */
std::optional<Vector3>
Orientation(const Json & axis)
{
  const Json                                  said = axis.value("orientation", Json::object());
  const std::string                           value = said.is_object()   ? said.value("value", "")
                                                      : said.is_string() ? said.get<std::string>()
                                                                         : "";
  static const std::map<std::string, Vector3> known{
    { "right-to-left", { 1, 0, 0 } },         { "left-to-right", { -1, 0, 0 } },
    { "anterior-to-posterior", { 0, 1, 0 } }, { "posterior-to-anterior", { 0, -1, 0 } },
    { "inferior-to-superior", { 0, 0, 1 } },  { "superior-to-inferior", { 0, 0, -1 } },
  };
  const auto found = known.find(value);
  return found == known.end() ? std::nullopt : std::optional(found->second);
}

/** Which axes are in space, which are time and channels. Versions before 0.3 name none: t, c, z, y, x. */
void
ReadAxes(const fs::path & folder, const Json & multiscale, ZarrImage & image)
{
  const std::size_t        count = image.array.shape.size();
  Json                     axes = multiscale.value("axes", Json::array());
  const std::vector<Json>  usual{ "t", "c", "z", "y", "x" };
  std::vector<std::size_t> spatial;
  if (axes.empty() && count <= usual.size())
  {
    axes = Json(std::vector<Json>(usual.end() - static_cast<std::ptrdiff_t>(count), usual.end()));
  }
  if (axes.size() != count)
  {
    RefuseInput(folder,
                Text(axes.size(), " axes are described, the array has ", count),
                "the store is damaged: write it anew");
  }
  bool                   placed = true;
  std::array<Vector3, 3> oriented{};
  std::array<Vector3, 3> named{};
  bool                   hasNames = true;
  for (std::size_t a = 0; a < count; ++a)
  {
    const Json        axis = axes[a].is_object() ? axes[a] : Json{ { "name", axes[a] } };
    const std::string name = LowerCase(axis.value("name", ""));
    const bool        isSpace = name == "x" || name == "y" || name == "z";
    const std::string type = axis.value("type", isSpace ? "space" : name == "t" ? "time" : "channel");
    image.units.push_back(axis.value("unit", ""));
    if (type == "space" && spatial.size() < 3)
    {
      const auto lies = Orientation(axis);
      placed = placed && lies;
      oriented[spatial.size()] = lies.value_or(Vector3{});
      hasNames = hasNames && isSpace;
      named[spatial.size()] = { name == "x" ? 1.0 : 0.0, name == "y" ? 1.0 : 0.0, name == "z" ? 1.0 : 0.0 };
      spatial.push_back(a);
    }
    else if (type == "time" && !image.time)
    {
      image.time = a;
    }
    else if (type != "space" && type != "time" && !image.channel)
    {
      image.channel = a;
    }
    else if (image.array.shape[a] != 1)
    {
      RefuseInput(folder, Text("an axis '", Printable(name, 20), "' too many"), "write a volume of its own");
    }
  }
  if (spatial.size() < 3)
  {
    RefuseInput(folder, Text(spatial.size(), "-D image"), "save one volume with three axes in space");
  }
  std::copy(spatial.begin(), spatial.end(), image.spatial.begin());
  // Without names, as with them in the usual order: k, j, i are z, y, x.
  image.axes = placed     ? oriented
               : hasNames ? named
                          : std::array<Vector3, 3>{ { { 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 } } };
  image.isPlaced = placed;
}

/** OME's "image-label": names and colours of values. */
void
ReadLabels(const Json & attributes, ZarrImage & image)
{
  const Json about = attributes.value("image-label", Json::object());
  const auto each = [&](const char * key, auto && take) {
    for (const Json & one : about.value(key, Json::array()))
    {
      if (one.is_object() && one.contains("label-value") && one.at("label-value").is_number_integer())
      {
        take(one.at("label-value").get<std::int64_t>(), one);
      }
    }
  };
  each("colors", [&](std::int64_t value, const Json & one) {
    const Json rgba = one.value("rgba", Json::array());
    if (rgba.size() >= 3 && std::all_of(rgba.begin(), rgba.end(), [](const Json & part) {
          return part.is_number() && part.get<double>() >= 0 && part.get<double>() <= 255;
        }))
    {
      image.labels[value].color =
        Color{ rgba[0].get<double>() / 255, rgba[1].get<double>() / 255, rgba[2].get<double>() / 255 };
    }
  });
  each("properties", [&](std::int64_t value, const Json & one) {
    for (const char * key : { "name", "label", "class", "label-name" })
    {
      if (image.labels[value].name.empty() && one.contains(key) && one.at(key).is_string())
      {
        image.labels[value].name = Printable(Trim(one.at(key).get<std::string>()), 200);
      }
    }
  });
}

/** A resolution of an image. `chosen`: the array that was named, whose level is looked for. */
ZarrImage
ReadLevel(const fs::path & folder, const ReadOptions & options, const fs::path & chosen)
{
  const Json attributes = UserMetadata(folder);
  const Json multiscale = attributes.at("multiscales").at(0);
  const Json levels = multiscale.value("datasets", Json::array());
  if (!levels.is_array() || levels.empty())
  {
    RefuseInput(folder,
                "an image without a resolution",
                "the store is damaged or not written to the end: write it anew");
  }
  std::size_t level = static_cast<std::size_t>(options.level.value_or(0));
  if (options.level && (*options.level < 0 || level >= levels.size()))
  {
    throw UsageError(Text("--level ", *options.level, ": ", folder.string(), " has levels 0 to ", levels.size() - 1));
  }
  for (std::size_t n = 0; n < levels.size() && !chosen.empty(); ++n)
  {
    level = fs::path(levels[n].value("path", "")).lexically_normal() == chosen ? n : level;
  }
  ZarrImage image;
  image.levels = levels.size();
  image.version = multiscale.value("version", attributes.value("version", "0.5"));
  image.array = ReadZarrArray(Within(folder, levels[level].value("path", "")));
  image.scale.assign(image.array.shape.size(), 1);
  image.translation.assign(image.array.shape.size(), 0);
  ReadAxes(folder, multiscale, image);
  Transform(folder, levels[level], image);
  Transform(folder, multiscale, image);
  ReadLabels(attributes, image);
  return image;
}

/** An array that nothing is said of. Sides of 1 in front of the last three are passed over. */
ZarrImage
ReadBareArray(const fs::path & folder, const ReadOptions & options)
{
  ZarrImage image;
  image.array = ReadZarrArray(folder);
  const auto & shape = image.array.shape;
  if (options.level)
  {
    throw UsageError(Text("--level: ", folder.string(), " is one array, without resolutions; leave it out"));
  }
  if (shape.size() < 3)
  {
    RefuseInput(folder, Text(shape.size(), "-D array"), "save one volume with three axes in space");
  }
  if (std::any_of(shape.begin(), shape.end() - 3, [](std::uint64_t side) { return side != 1; }))
  {
    RefuseInput(folder,
                Text("an array of ", shape.size(), " axes that says nothing of what they are"),
                "write it as OME-Zarr, or as an array of three axes");
  }
  std::iota(image.spatial.begin(), image.spatial.end(), shape.size() - 3);
  image.scale.assign(shape.size(), 1);
  image.translation.assign(shape.size(), 0);
  image.units.resize(shape.size());
  image.axes = { { { 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 } } };
  return image;
}

} // namespace

ZarrImage
ReadZarrImage(const fs::path & path, const ReadOptions & options)
{
  const fs::path whole = path.has_filename() ? path : path.parent_path(); // "folder/"
  try
  {
    if (IsImage(whole))
    {
      return ReadLevel(whole, options, {});
    }
    if (!IsZarrArray(whole))
    {
      const fs::path within = ImageWithin(whole);
      return IsImage(within) ? ReadLevel(within, options, {}) : ReadBareArray(within, options);
    }
    const fs::path parent = whole.parent_path().empty() ? fs::path(".") : whole.parent_path();
    if (IsImage(parent))
    {
      for (const Json & level : UserMetadata(parent).at("multiscales").at(0).value("datasets", Json::array()))
      {
        if (fs::path(level.value("path", "")).lexically_normal() == whole.filename())
        {
          if (options.level)
          {
            throw UsageError(Text("--level: ", whole.string(), " is one resolution; name the folder it lies in"));
          }
          return ReadLevel(parent, options, whole.filename());
        }
      }
    }
    return ReadBareArray(whole, options);
  }
  catch (const Json::exception &)
  {
    RefuseInput(path,
                "its metadata hold something of another type than they should",
                "the store is damaged: write it anew");
  }
}

} // namespace voxelcore
