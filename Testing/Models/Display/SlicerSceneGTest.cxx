#include "VoxelCoreTesting/TemporaryFolder.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Display/SlicerScene.h"

#include <gtest/gtest.h>
#include <zip.h>

#include <map>
#include <set>

namespace voxelcore::testing
{
namespace
{

/** Elements by name, each a list of attributes; only what MRML has: no text, no children. */
std::multimap<std::string, std::map<std::string, std::string>>
Elements(const std::string & xml)
{
  std::multimap<std::string, std::map<std::string, std::string>> elements;
  for (auto at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1))
  {
    const auto end = xml.find('>', at);
    if (end == std::string::npos || xml[at + 1] == '/' || xml[at + 1] == '?' || xml[at + 1] == '!')
    {
      continue;
    }
    const std::string                  element = xml.substr(at + 1, end - at - 1);
    std::map<std::string, std::string> attributes;
    for (auto equals = element.find("=\""); equals != std::string::npos;)
    {
      const auto        name = element.find_last_of(" \n", equals) + 1;
      const auto        close = element.find('"', equals + 2);
      const std::string key = element.substr(name, equals - name);
      EXPECT_TRUE(attributes.emplace(key, element.substr(equals + 2, close - equals - 2)).second) << key << " twice";
      equals = element.find("=\"", close + 1);
    }
    elements.emplace(element.substr(0, element.find_first_of(" \n/")), attributes);
  }
  return elements;
}

SceneDescription
Scene()
{
  SceneDescription scene;
  scene.segmentations = { { "labels", "view_Data/labels.seg.nrrd", {} } };
  scene.models = { { "liver & <bile>", "view_Data/liver 100%.vtp", { 1, 0, 0.5 } },
                   { "rib", "view_Data/rib.vtp", { 0, 1, 0 } } };
  scene.curves = { { "vessel", "view_Data/vessel.mrk.json", { 0, 0, 1 } } };
  return scene;
}

TEST(SlicerScene, EachItemIsANodeWithItsDisplayAndItsFile)
{
  const std::string     xml = SceneXml(Scene());
  const auto            elements = Elements(xml);
  std::set<std::string> ids;
  for (const auto & [element, attributes] : elements)
  {
    if (attributes.contains("id"))
    {
      EXPECT_TRUE(ids.insert(attributes.at("id")).second) << attributes.at("id") << " twice";
    }
  }
  EXPECT_EQ(elements.count("Segmentation"), 1U);
  EXPECT_EQ(elements.count("Model"), 2U);
  EXPECT_EQ(elements.count("MarkupsCurve"), 1U);
  std::set<std::string> names;
  for (const char * kind : { "Segmentation", "Model", "MarkupsCurve" })
  {
    const auto [first, last] = elements.equal_range(kind);
    for (auto node = first; node != last; ++node)
    {
      // What it refers to is there. References stand in one attribute, "role:id;", or in one each.
      const auto & attributes = node->second;
      names.insert(attributes.at("name"));
      std::size_t found = 0;
      for (const std::string & id : ids)
      {
        const auto & references = attributes.contains("references") ? attributes.at("references") : std::string();
        found += references.find(":" + id + ";") != std::string::npos ||
                     (attributes.contains("storageNodeRef") && attributes.at("storageNodeRef") == id) ||
                     (attributes.contains("displayNodeRef") && attributes.at("displayNodeRef") == id)
                   ? 1
                   : 0;
      }
      EXPECT_GE(found, 2U) << "display and storage of " << attributes.at("name");
    }
  }
  EXPECT_EQ(names, (std::set<std::string>{ "labels", "liver &amp; &lt;bile&gt;", "rib", "vessel" }));
  std::set<std::string> files;
  for (const auto & [element, attributes] : elements)
  {
    if (attributes.contains("fileName"))
    {
      files.insert(attributes.at("fileName"));
    }
  }
  EXPECT_EQ(files,
            (std::set<std::string>{ "view_Data/labels.seg.nrrd",
                                    "view_Data/liver%20100%25.vtp",
                                    "view_Data/rib.vtp",
                                    "view_Data/vessel.mrk.json" }));
}

TEST(SlicerScene, ModelsAreColouredByRadiusOverOneRangeOrTheirOwn)
{
  SceneDescription scene = Scene();
  const auto       ranges = [&] {
    std::multiset<std::string> found;
    for (const auto & [element, attributes] : Elements(SceneXml(scene)))
    {
      if (element == "ModelDisplay")
      {
        EXPECT_EQ(attributes.at("activeScalarName"), "Radius");
        found.insert(attributes.contains("scalarRange") ? attributes.at("scalarRange") : "");
      }
    }
    return found;
  };
  const auto own = ranges();
  EXPECT_EQ(own.size(), 2U);
  scene.radius = { 1.5, 4.25, 1, 9 };
  const auto shared = ranges();
  EXPECT_EQ(shared, (std::multiset<std::string>{ "1.5 4.25", "1.5 4.25" }));
  EXPECT_NE(own, shared);
}

TEST(SlicerScene, AnArchiveHoldsTheFilesCompressedAndIsTheSameEachTime)
{
  const TemporaryFolder folder;
  const std::string     large(100000, 'a');
  WriteAll(folder / "one", large);
  WriteAll(folder / "two", "");
  const std::vector<std::pair<std::string, std::filesystem::path>> files{ { "scene/one.vtp", folder / "one" },
                                                                          { "scene/zwei \xC3\xBC.nrrd",
                                                                            folder / "two" } };
  WriteZip(folder / "a.mrb", files);
  WriteZip(folder / "b.mrb", files);
  EXPECT_EQ(ReadAll(folder / "a.mrb"), ReadAll(folder / "b.mrb"));
  EXPECT_LT(ReadAll(folder / "a.mrb").size(), large.size() / 10);
  int           error = 0;
  zip_t * const archive = zip_open((folder / "a.mrb").c_str(), ZIP_RDONLY | ZIP_CHECKCONS, &error);
  ASSERT_NE(archive, nullptr);
  EXPECT_EQ(zip_get_num_entries(archive, 0), 2);
  for (const auto & [name, file] : files)
  {
    zip_file_t * const entry = zip_fopen(archive, name.c_str(), 0);
    ASSERT_NE(entry, nullptr) << name;
    std::string bytes(large.size() + 1, '\0');
    const auto  size = zip_fread(entry, bytes.data(), bytes.size());
    bytes.resize(static_cast<std::size_t>(std::max<zip_int64_t>(0, size)));
    EXPECT_EQ(bytes, ReadAll(file)) << name;
    zip_fclose(entry);
  }
  zip_discard(archive);
}

TEST(SlicerScene, AnArchiveThatCannotBeWrittenIsAnError)
{
  const TemporaryFolder folder;
  WriteAll(folder / "one", "1");
  EXPECT_THROW(WriteZip(folder / "none/a.mrb", { { "one", folder / "one" } }), OutputError);
  EXPECT_THROW(WriteZip(folder / "a.mrb", { { "gone", folder / "gone" } }), OutputError) << "a file that is not there";
  EXPECT_EQ(folder.Names(), (std::set<std::string>{ "one" }));
}

} // namespace
} // namespace voxelcore::testing
