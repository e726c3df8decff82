#include "voxelcore/Display/SlicerScene.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/OutputFile.h"
#include "voxelcore/Base/TemporaryNames.h"
#include "voxelcore/Base/Text.h"

#include <cerrno>
#include <cstdio>
#include <zip.h>

namespace voxelcore
{

namespace
{

std::string
Attribute(const std::string & text)
{
  std::string result;
  for (const char c : text)
  {
    switch (c)
    {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return result;
}

/** A file's name as MRML has it: percent signs and blanks encoded. */
std::string
FileAttribute(const std::string & name)
{
  std::string result;
  for (const char c : name)
  {
    result += c == '%' ? "%25" : c == ' ' ? "%20" : std::string(1, c);
  }
  return Attribute(result);
}

std::string
ColorText(const Color & color)
{
  char text[64];
  (void)std::snprintf(text, sizeof(text), "%.4g %.4g %.4g", color[0], color[1], color[2]);
  return text;
}

/** As vtkMRMLDisplayNode writes it. */
std::string
RangeAttributes(const ColorRange & range)
{
  return range.IsEmpty()
           ? "scalarRangeFlag=\"UseData\""
           : "scalarRangeFlag=\"UseManual\" scalarRange=\"" + ShortText(range.low) + " " + ShortText(range.high) + "\"";
}

/** The three nodes of one item. `kind` is the tag of the data node; the others are named after `displayKind` and
 *  `storageKind`. */
std::string
Nodes(const SceneItem &   item,
      std::size_t         number,
      const std::string & kind,
      const std::string & displayKind,
      const std::string & displayAttributes,
      const std::string & storageKind,
      const std::string & storageAttributes)
{
  const auto id = [number](const std::string & tag) { return "vtkMRML" + tag + "Node" + std::to_string(number); };
  return " <" + displayKind + " id=\"" + id(displayKind) + "\" name=\"" + Attribute(item.name) + " display\" " +
         displayAttributes + "/>\n <" + storageKind + " id=\"" + id(storageKind) + "\" name=\"" + Attribute(item.name) +
         " storage\" fileName=\"" + FileAttribute(item.file) + "\" " + storageAttributes + "/>\n <" + kind + " id=\"" +
         id(kind) + "\" name=\"" + Attribute(item.name) + "\" references=\"display:" + id(displayKind) +
         ";storage:" + id(storageKind) + ";\"/>\n";
}

} // namespace

std::string
SceneXml(const SceneDescription & scene)
{
  // Name, version and revision: without all three Slicer takes models to be in RAS.
  std::string text =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<MRML version=\"Slicer 5.8.1 33241\" userTags=\"\">\n";
  std::size_t number = 0;
  for (const SceneItem & item : scene.segmentations)
  {
    text += Nodes(item,
                  ++number,
                  "Segmentation",
                  "SegmentationDisplay",
                  "visibility=\"true\" opacity3D=\"0.25\" Visibility3D=\"true\"",
                  "SegmentationStorage",
                  "useCompression=\"1\"");
  }
  number = 0;
  for (const SceneItem & item : scene.models)
  {
    text += Nodes(item,
                  ++number,
                  "Model",
                  "ModelDisplay",
                  "color=\"" + ColorText(item.color) +
                    "\" opacity=\"1\" visibility=\"true\" backfaceCulling=\"false\" scalarVisibility=\"true\" "
                    "activeScalarName=\"" +
                    scene.coloring +
                    "\" activeAttributeLocation=\"point\" "
                    "colorNodeID=\"vtkMRMLColorTableNodeFilePlasma.txt\" " +
                    RangeAttributes(scene.radius),
                  "ModelStorage",
                  "useCompression=\"1\" coordinateSystem=\"LPS\"");
  }
  number = 0;
  for (const SceneItem & item : scene.curves)
  {
    text += Nodes(item,
                  ++number,
                  "MarkupsCurve",
                  "MarkupsDisplay",
                  "color=\"" + ColorText(item.color) + "\" selectedColor=\"" + ColorText(item.color) +
                    "\" visibility=\"true\" pointLabelsVisibility=\"false\" propertiesLabelVisibility=\"false\"",
                  "MarkupsJsonStorage",
                  "coordinateSystem=\"LPS\"");
  }
  return text + "</MRML>\n";
}

void
WriteZip(const std::filesystem::path & path, const std::vector<std::pair<std::string, std::filesystem::path>> & files)
{
  const auto fail = [&path](const std::string & why) {
    throw OutputError("cannot write '" + FinalName(path).string() + "': " + why);
  };
  int           error = 0;
  zip_t * const archive = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &error);
  if (archive == nullptr)
  {
    zip_error_t reason;
    zip_error_init_with_code(&reason, error); // takes the system's number along
    const int systemError = zip_error_code_system(&reason);
    zip_error_fini(&reason);
    FailOutput(path, systemError != 0 ? systemError : EIO);
  }
  for (const auto & [name, file] : files)
  {
    zip_source_t * const source = zip_source_file(archive, file.c_str(), 0, -1);
    const zip_int64_t    index =
      source != nullptr ? zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8) : zip_int64_t{ -1 };
    if (index < 0)
    {
      zip_source_free(source);
      zip_discard(archive);
      fail("no room for " + name);
    }
    zip_file_set_mtime(archive, static_cast<zip_uint64_t>(index), 315532800, 0); // equal scenes, equal bytes
  }
  if (zip_close(archive) != 0)
  {
    const std::string why = zip_strerror(archive);
    const int         systemError = zip_error_code_system(zip_get_error(archive));
    zip_discard(archive);
    if (systemError != 0)
    {
      FailOutput(path, systemError);
    }
    fail(why);
  }
}

} // namespace voxelcore
