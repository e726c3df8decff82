// Images of OME-Zarr: which array of a store is meant, where it lies, and which files it is made of.

#include "ZarrStores.h"
#include "VoxelCoreTesting/Messages.h"
#include "voxelcore/Formats/FormatOpeners.h"

namespace voxelcore::testing::zarr
{

namespace
{

class ZarrImages : public Stores
{
protected:
  static ReadOptions
  Level(std::int64_t level)
  {
    ReadOptions options;
    options.level = level;
    return options;
  }
};

} // namespace

TEST_F(ZarrImages, WithMetadataWithoutSenseAreRefused)
{
  for (const Refusal & one : std::vector<Refusal>{
         { R"({"datasets": []})", "without a resolution" },
         { R"({"datasets": null})", "without a resolution" },
         { R"({"datasets": "0"})", "without a resolution" },
         { R"({"datasets": [7]})", "of another type" },
         { R"({"datasets": [{"path": ""}]})", "does not lie in it" },
         { R"({"datasets": [{"path": "/etc"}]})", "'/etc', which does not lie in it" },
         { R"({"datasets": [{"path": "0/../../b"}]})", "does not lie in it" },
         { R"({"datasets": [{"path": "1"}]})", "no Zarr array" },
         { R"({"coordinateTransformations": [{"type": "affine"}]})", "of type 'affine'" },
         { R"({"coordinateTransformations": [{"type": "scale"}]})", "of type 'scale'" },
         { R"({"coordinateTransformations": [{"type": "scale", "scale": [1, 1]}]})", "2 numbers for 3 axes" },
         { R"({"coordinateTransformations": [{"type": "scale", "scale": 2}]})", "0 numbers for 3 axes" },
         { R"({"coordinateTransformations": [{"type": "scale", "scale": [1, "x", 1]}]})", "is not a number" },
         { R"({"coordinateTransformations": [{"type": "scale", "scale": [1, 0, 1]}]})", "axis j" },
         { R"({"coordinateTransformations": [3]})", "of another type" },
         { R"({"axes": ["z", "y", "x", "w"]})", "4 axes are described, the array has 3" },
         { R"({"axes": [{"name": 7}, {"name": "y"}, {"name": "x"}]})", "of another type" },
         { R"({"axes": ["c", "y", "x"]})", "2-D image" },
         { R"({"axes": [{"name": "z", "type": "space", "unit": "ell"}, "y", "x"]})", "'ell'" },
       })
  {
    SCOPED_TRACE(one.change);
    ExpectRefused(Image("a.zarr", one.change), { one.text });
  }
  ExpectRefused(Attributes("b.zarr", R"({"multiscales": [7]})"), { "of another type" });
  ExpectRefused(Attributes("c.zarr", R"({"multiscales": []})"), { "without an image or labels" });
  ExpectRefused(Attributes("d.zarr", R"({"multiscales": 3, "ome": 4})"), { "without an image or labels" });
}

TEST_F(ZarrImages, WithMetadataNestedSoDeeplyThatTheStackWouldEndAreRefused)
{
  const std::string deep = std::string(200000, '[') + std::string(200000, ']');
  const auto        image = Image("a.zarr");
  for (const std::string & text : { R"({"multiscales": [{"datasets": [{"path": "0"}], "x": )" + deep + "}]}",
                                    R"({"multiscales": [{"datasets": [{"path": "0"}]}], "x": )" + deep + "}" })
  {
    ExpectRefused(Attributes("a.zarr", text), { ".zattrs", "no JSON object" });
  }
}

TEST_F(ZarrImages, TransformationsOfAResolutionAndOfTheImageFollowEachOther)
{
  const LabelMap volume = ReadLabelVolume(Image("a.zarr", R"({"coordinateTransformations": [{"type": "identity"},
    {"type": "translation", "translation": [10, 20, 30]}, {"type": "scale", "scale": [2, 2, 2]}]})"));
  nrrd::ExpectValues(volume);
  ExpectNear(volume.geometry.spacing, { 2, 4, 6 });
  ExpectNear(volume.geometry.origin, { 60, 40, 20 });
  ReadOptions options;
  options.spacing = Vector3{ 1, 1, 1 };
  const auto ell = Image("b.zarr", R"({"axes": [{"name": "z", "type": "space", "unit": "ell"}, "y", "x"]})");
  ExpectNear(ReadLabelVolume(ell, options).geometry.spacing, { 1, 1, 1 });
}

TEST_F(ZarrImages, AxesAreTakenByNameTypeAndOrientation)
{
  // Before 0.3 none are named; in 0.3 they are names alone.
  for (const char * axes : { R"({"axes": null})", R"({"axes": ["z", "y", "x"]})", R"({"axes": ["k", "j", "i"]})" })
  {
    SCOPED_TRACE(axes);
    Json types = Json::parse(axes);
    if (types["axes"].is_array() && types["axes"][0] == "k")
    {
      for (Json & axis : types["axes"])
      {
        axis = Json{ { "name", axis }, { "type", "space" } };
      }
    }
    ExpectRead(Image("a.zarr", types.dump().c_str()));
  }
  const LabelMap turned = ReadLabelVolume(Image("b.zarr", R"({"axes": [
    {"name": "z", "type": "space", "unit": "millimeter", "orientation": "superior-to-inferior"},
    {"name": "y", "type": "space", "unit": "millimeter", "orientation": {"value": "anterior-to-posterior"}},
    {"name": "x", "type": "space", "unit": "millimeter", "orientation": {"value": "left-to-right"}}]})"));
  ExpectNear(CentreOf(turned, 2, 1, 1), { -2, 2, -3 });
  const char * const five = R"({"shape": [1, 1, 2, 2, 3], "chunks": [1, 1, 2, 2, 3]})";
  m_Folder.Write("c.zarr/0/0.0.0.0.0", kBytes);
  ExpectRead(Image("c.zarr", R"({"axes": null, "datasets": [{"path": "0"}]})", five));
  ExpectRead(Image("c.zarr",
                   R"({"axes": ["t", {"name": "u", "type": "time"}, "z", "y", "x"], "datasets": [{"path": "0"}]})",
                   five));
  const char * const many = R"({"shape": [4, 4, 2, 2, 3], "chunks": [1, 1, 2, 2, 3]})";
  ExpectRefused(Image("d.zarr", R"({"axes": ["c", "d", "z", "y", "x"], "datasets": [{"path": "0"}]})", many),
                { "an axis 'd' too many" });
  ExpectRefused(Image("d.zarr", R"({"axes": ["t", {"name": "u", "type": "time"}, "z", "y", "x"]})", many),
                { "an axis 'u' too many" });
  ExpectRefused(Image("d.zarr", R"({"axes": null})", R"({"shape": [1, 1, 1, 2, 2, 3], "chunks": [1, 1, 1, 2, 2, 3]})"),
                { "0 axes are described, the array has 6" });
}

TEST_F(ZarrImages, TheOnlyOneWithinAStoreIsMeantAndSeveralAreNamed)
{
  Image("a.zarr/labels/cells");
  Attributes("a.zarr/labels", R"({"labels": ["cells"]})");
  ExpectRead(Attributes("a.zarr", "{}"));
  Image("b.zarr/0"); // as bioformats2raw lays them out
  ExpectRead(Attributes("b.zarr", "{}"));
  Image("b.zarr/1");
  ExpectRefused(m_Folder / "b.zarr", { "several images", "0, 1" });
  Array2("c.zarr/0");
  ExpectRead(Attributes("c.zarr", R"({"labels": "none"})"));
  ExpectRefused(Attributes("d.zarr", R"({"labels": ["..", "cells"]})"), { "several images", ".., cells" });
  ExpectRefused(Attributes("d.zarr", R"({"labels": [".."]})"), { "does not lie in it" });
  ExpectRefused(Attributes("d.zarr", R"({"labels": [5]})"), { "does not lie in it" });
  for (const char * itself : { ".", "./", "cells/..", "./." })
  {
    ExpectRefused(Attributes("d.zarr", R"({"labels": [")" + std::string(itself) + "\"]}"), { "the folder itself" });
  }
  std::string many = R"({"labels": [)";
  for (int n = 0; n < 30; ++n)
  {
    many += (n > 0 ? ", \"n" : "\"n") + std::to_string(n) + "\"";
  }
  const std::string text = MessageOf([&] { OpenZarr(Attributes("e.zarr", many + "]}"), {}); });
  EXPECT_NE(text.find("n19"), std::string::npos) << text;
  EXPECT_EQ(text.find("n20"), std::string::npos) << text;
}

TEST_F(ZarrImages, AResolutionThatIsNotThereIsAMistakeOfTheUser)
{
  const auto path = Image("a.zarr");
  ExpectRead(path, Level(0));
  for (const std::int64_t level : { -1, 1, 7 })
  {
    const std::string text = MessageOf<UsageError>([&] { OpenZarr(path, Level(level)); });
    EXPECT_NE(text.find("levels 0 to 0"), std::string::npos) << text;
  }
  EXPECT_NE(MessageOf<UsageError>([&] { OpenZarr(path / "0", Level(0)); }).find("is one resolution"),
            std::string::npos);
  EXPECT_NE(MessageOf<UsageError>([&] { OpenZarr(Array3("b.zarr"), Level(0)); }).find("is one array"),
            std::string::npos);
  // An array beside those of the image has no resolution, and no place.
  const LabelMap beside = ReadLabelVolume(Array2("a.zarr/beside"));
  EXPECT_EQ(beside.format, "Zarr");
  EXPECT_EQ(beside.geometry.unit, SpatialUnit::Voxels);
}

TEST_F(ZarrImages, NamesAndColoursOfLabelsAreTakenWhereTheyMakeSense)
{
  Image("a.zarr");
  Json attributes = Json::parse(ReadAll(m_Folder / "a.zarr/.zattrs"));
  attributes["image-label"] = Json::parse(R"({"colors": [{"label-value": 1, "rgba": [255, 51, 0, 255]},
      {"label-value": 2, "rgba": [255, 51]}, {"label-value": 3, "rgba": [0, 0, 256]},
      {"label-value": 7, "rgba": [-1, 0, 0]}, {"label-value": 250, "rgba": ["red", 0, 0]}, 5],
    "properties": [{"label-value": 1, "label": "first", "class": "second"}, {"label-value": 2, "name": 9},
      {"label-value": "3", "name": "text"}, {"name": "none"}]})");
  const LabelMap volume = ReadLabelVolume(Attributes("a.zarr", attributes.dump()));
  ASSERT_EQ(volume.labels.size(), 5U);
  EXPECT_EQ(volume.labels[0].name, "first");
  ASSERT_TRUE(volume.labels[0].color);
  EXPECT_NEAR((*volume.labels[0].color)[1], 0.2, 1e-12);
  for (std::size_t label = 1; label < 5; ++label)
  {
    EXPECT_FALSE(volume.labels[label].color) << label;
    EXPECT_TRUE(volume.labels[label].name.starts_with("label-")) << volume.labels[label].name;
  }
  attributes["image-label"] = 7;
  ExpectRefused(Attributes("a.zarr", attributes.dump()), { "of another type" });
}

TEST_F(ZarrImages, ALinkThatLeadsOutOfTheStoreIsRefused)
{
  namespace fs = std::filesystem;
  const fs::path other = Image("other.zarr");
  const auto     refused = [&](const fs::path & part) { // a file or folder of a store, which is moved out of it
    const fs::path store = Image("a.zarr");
    ExpectRead(store);
    fs::remove_all(m_Folder / "moved");
    fs::rename(store / part, m_Folder / "moved");
    fs::create_symlink(m_Folder / "moved", store / part);
    ExpectRefused(store, { "leads out of the store" });
    fs::remove_all(store);
  };
  refused("0/0.0.0");
  refused("0/.zarray");
  refused(".zattrs");
  refused("0");
  // Within the store a link may lead anywhere, and the store itself may be a link.
  const fs::path store = Image("b.zarr");
  fs::rename(store / "0/0.0.0", store / "0/chunk");
  fs::create_symlink("chunk", store / "0/0.0.0");
  fs::create_directory_symlink(store, m_Folder / "linked.zarr");
  ExpectRead(m_Folder / "linked.zarr");
}

TEST_F(ZarrImages, FilesAreMetadataAndThoseChunksThatThePartLiesIn)
{
  using Paths = std::vector<std::filesystem::path>;
  const auto path = Image("a.zarr", "{}", R"({"chunks": [1, 2, 2]})"); // four chunks, of which three are there
  const auto array = path / "0";
  std::filesystem::remove(array / "0.0.0");
  for (const char * chunk : { "0.0.1", "1.0.0", "1.0.1" })
  {
    m_Folder.Write(std::string("a.zarr/0/") + chunk, "1234");
  }
  const Paths all{ path / ".zattrs", path / ".zgroup", array / ".zarray",
                   array / "0.0.1",  array / "1.0.0",  array / "1.0.1" };
  EXPECT_EQ(ZarrFiles(path, {}), all);
  ReadOptions part;
  part.crop = CropRange{ { 0, 0, 0 }, { 2, 2, 2 } };
  EXPECT_EQ(ZarrFiles(path, part), (Paths{ path / ".zattrs", path / ".zgroup", array / ".zarray", array / "1.0.0" }));
  part.crop = CropRange{ { 2, 0, 0 }, { 3, 2, 2 } };
  EXPECT_EQ(ZarrFiles(path, part),
            (Paths{ path / ".zattrs", path / ".zgroup", array / ".zarray", array / "0.0.1", array / "1.0.1" }));
  part.crop = CropRange{ { 0, 0, 0 }, { 9, 2, 2 } };
  EXPECT_THROW(ZarrFiles(path, part), InputError);
}

TEST_F(ZarrImages, BeyondThePartVoxelsAreZeroAndNoChunkIsRead)
{
  const auto path = Image("a.zarr", "{}", R"({"chunks": [1, 1, 3]})"); // a chunk a row
  for (int row = 0; row < 4; ++row)
  {
    m_Folder.Write("a.zarr/0/" + std::to_string(row / 2) + "." + std::to_string(row % 2) + ".0",
                   row == 2 ? kBytes.substr(6, 3) : "damaged");
  }
  ReadOptions options;
  options.crop = CropRange{ { 0, 0, 1 }, { 3, 1, 2 } };
  ScanFile    scan = OpenZarr(path, options);
  std::string bytes(12, '?');
  scan.voxels->Read(reinterpret_cast<std::byte *>(bytes.data()), bytes.size());
  EXPECT_EQ(bytes, std::string(6, '\0') + kBytes.substr(6, 3) + std::string(3, '\0'));
  std::byte more{};
  EXPECT_EQ(scan.voxels->ReadSome(&more, 1), 0U);
}

} // namespace voxelcore::testing::zarr
