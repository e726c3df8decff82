// What holds whatever the format: labels, names, thresholds, and input that is bad.

#include "ScanBytes.h"

#include <cmath>
#include <iostream>
#include <map>
#include <random>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

template <typename T>
std::filesystem::path
WriteVolume(const TempFolder &         folder,
            const std::string &        type,
            const std::array<int, 3> & size,
            const std::vector<T> &     values,
            const std::string &        name = "scan.nrrd")
{
  return folder.Write(name, Nrrd(NrrdLines(type, size), RawAll<T>(values)));
}

std::map<std::int64_t, std::string>
NamesIn(const LabelMap & volume)
{
  std::map<std::int64_t, std::string> names;
  for (const LabelShape & label : volume.labels)
  {
    names[label.value] = label.name;
  }
  return names;
}

} // namespace

TEST(BadInput, EachIsOneLineThatNamesTheFileAndWhatToDo)
{
  const TempFolder folder;
  ExpectRefused(folder / "missing.nrrd", { "no such file" });
  ExpectRefused(folder.Write("empty.nrrd", ""), { "empty" });
  ExpectRefused(folder.Write("empty.nii.gz", ""), { "empty" });
  std::filesystem::create_directory(folder / "folder");
  ExpectRefused(folder / "folder", { "no TIFF, PNG, BMP or JPEG slices" });
  ExpectRefused(folder.Write("text.nrrd", "Dear colleague,\n\nplease find the scan attached.\n"), { "not an NRRD" });
  ExpectRefused(folder.Write("text.nii", std::string(1000, 'x')), { "no NIfTI" });
  ExpectRefused(folder.Write("text.nii.gz", std::string(1000, 'x')), { "no NIfTI" });
  ExpectRefused(folder.Write("text.mha", "Dear colleague,\n"), { "not a MetaImage" });
  ExpectRefused(folder.Write("text.tif", "Dear colleague,\n"), { "not a TIFF" });
  ExpectRefused(folder.Write("scan.xyz", "x"), { "unknown kind", ".nrrd" });
  try
  {
    ReadLabelVolume(folder.Write("new\nline.nrrd", "x"));
    FAIL();
  }
  catch (const InputError & error)
  {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

TEST(BadInput, NegativeLabelsAreRefusedWithTheirVoxel)
{
  const TempFolder          folder;
  std::vector<std::int16_t> values(24, 5);
  values[13] = -1024; // (1,1,1) of 4 x 3 x 2: 1 + 4 * (0 + 3) = 13 is (1,0,1)
  ExpectRefused(WriteVolume(folder, "int16", { 4, 3, 2 }, values), { "-1024", "(1,0,1)", "--threshold" });
}

TEST(BadInput, FractionsAndWhatIsNoNumberAreRefusedWithTheirVoxel)
{
  const TempFolder folder;
  for (const float bad : { 0.9999999F, 1.5F, -0.25F })
  {
    std::vector<float> values(24, 5);
    values[23] = bad;
    ExpectRefused(WriteVolume(folder, "float", { 4, 3, 2 }, values), { "(3,2,1)", "fraction" });
  }
  std::vector<double> values(24, 5);
  values[2] = std::nan("");
  ExpectRefused(WriteVolume(folder, "double", { 4, 3, 2 }, values), { "nan", "(2,0,0)" });
  values[2] = 1e300;
  ExpectRefused(WriteVolume(folder, "double", { 4, 3, 2 }, values), { "1e+300", "(2,0,0)", "too large" });
  std::vector<std::uint64_t> large(24, 5);
  large[3] = ~std::uint64_t{ 0 };
  ExpectRefused(WriteVolume(folder, "uint64", { 4, 3, 2 }, large), { "(3,0,0)", "too large" });
}

TEST(BadInput, NothingButBackgroundIsRefused)
{
  const TempFolder                folder;
  const std::vector<std::uint8_t> values(24, 0);
  ExpectRefused(WriteVolume(folder, "uint8", { 4, 3, 2 }, values), { "nothing but background" });
}

TEST(Labels, WideValuesAreExact)
{
  const TempFolder          folder;
  std::vector<std::int64_t> values(24, 0);
  values[3] = 9007199254740993; // 2^53 + 1, which no double holds
  values[4] = 9007199254740992;
  values[5] = INT64_MAX;
  const LabelMap volume = ReadLabelVolume(WriteVolume(folder, "int64", { 4, 3, 2 }, values));
  ASSERT_EQ(volume.labels.size(), 3U);
  EXPECT_EQ(volume.labels[0].value, 9007199254740992);
  EXPECT_EQ(volume.labels[1].value, 9007199254740993);
  EXPECT_EQ(volume.labels[2].value, INT64_MAX);
}

TEST(Labels, FloatsAreReadAsStoredAlsoBeyondSixteenBits)
{
  const TempFolder   folder;
  std::vector<float> values(24, 0);
  values[3] = 70000;
  values[4] = 4464; // what 70000 becomes in 16 bits
  const LabelMap volume = ReadLabelVolume(WriteVolume(folder, "float", { 4, 3, 2 }, values));
  ASSERT_EQ(volume.labels.size(), 2U);
  EXPECT_EQ(volume.labels[0].value, 4464);
  EXPECT_EQ(volume.labels[1].value, 70000);
}

TEST(Labels, MinusZeroIsBackground)
{
  const TempFolder   folder;
  std::vector<float> values(24, -0.0F);
  values[3] = 1;
  EXPECT_EQ(ReadLabelVolume(WriteVolume(folder, "float", { 4, 3, 2 }, values)).labels.size(), 1U);
}

TEST(Labels, AreChosenByValueAndByName)
{
  const TempFolder          folder;
  std::vector<std::uint8_t> values(24, 0);
  values[0] = 1;
  values[1] = 2;
  values[2] = 7;
  const auto path = WriteVolume(folder, "uint8", { 4, 3, 2 }, values);
  folder.Write("scan.nrrd.txt", "1 Liver\n2 Left kidney\n7 Spleen\n9 Heart\n");
  ReadOptions options;
  options.labels = "7, Left kidney";
  const LabelMap volume = ReadLabelVolume(path, options);
  ASSERT_EQ(volume.labels.size(), 2U);
  EXPECT_EQ(volume.labels[0].name, "Left kidney");
  EXPECT_EQ(volume.labels[1].name, "Spleen");
  options.labels = "9";
  ExpectRefused(path, { "there is no label '9'", "1 Liver, 2 Left kidney, 7 Spleen" }, options);
  options.labels = "1,Heart";
  ExpectRefused(path, { "there is no label 'Heart'" }, options);
  options.labels = "spleeen";
  ExpectRefused(path, { "there is no label 'spleeen'", "did you mean 'Spleen'?" }, options);
  for (const char * bad : { "", "1,,2", "0", "-3" })
  {
    options.labels = bad;
    EXPECT_THROW(ReadLabelVolume(path, options), UsageError) << bad;
  }
}

TEST(Labels, AMissingOneAmongManyIsShownInAShortLine)
{
  const TempFolder           folder;
  std::vector<std::uint16_t> values(1000);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = static_cast<std::uint16_t>(i);
  }
  ReadOptions options;
  options.labels = "5000";
  ExpectRefused(WriteVolume(folder, "uint16", { 10, 10, 10 }, values), { "1, 2, 3", "and 987 more" }, options);
}

TEST(Labels, BinaryUnitesWhatWasChosen)
{
  const TempFolder          folder;
  std::vector<std::uint8_t> values(24, 0);
  values[0] = 1;
  values[1] = 2;
  values[2] = 7;
  const auto  path = WriteVolume(folder, "uint8", { 4, 3, 2 }, values);
  ReadOptions options;
  options.binary = true;
  LabelMap volume = ReadLabelVolume(path, options);
  ASSERT_EQ(volume.labels.size(), 1U);
  EXPECT_EQ(volume.labels[0].value, 1);
  EXPECT_EQ(volume.labels[0].voxels, 3U);
  options.labels = "2,7";
  volume = ReadLabelVolume(path, options);
  ASSERT_EQ(volume.labels.size(), 1U);
  EXPECT_EQ(volume.labels[0].voxels, 2U);
}

TEST(LabelNames, IgnoreCaseUnlessALabelIsCalledExactlySo)
{
  const TempFolder          folder;
  std::vector<std::uint8_t> values(24, 0);
  values[1] = 1;
  values[2] = 2;
  values[7] = 7;
  const auto path = WriteVolume(folder, "uint8", { 4, 3, 2 }, values);
  folder.Write("scan.nrrd.txt", "1 Liver\n2 LIVER\n7 Spleen\n");
  const auto read = [&](const std::string & labels) {
    ReadOptions options;
    options.labels = labels;
    std::vector<std::int64_t> found;
    for (const LabelShape & label : ReadLabelVolume(path, options).labels)
    {
      found.push_back(label.value);
    }
    return found;
  };
  EXPECT_EQ(read("sPLEEN"), (std::vector<std::int64_t>{ 7 }));
  EXPECT_EQ(read("LIVER"), (std::vector<std::int64_t>{ 2 }));
  EXPECT_EQ(read("liver"), (std::vector<std::int64_t>{ 1, 2 }));
}

TEST(LabelNames, ComeFromTheListBesideTheScan)
{
  std::vector<std::uint8_t> values(24, 0);
  values[0] = 1;
  values[1] = 2;
  values[2] = 10;
  const auto names = [&](const std::string & scan, const std::string & list, const std::string & text) {
    const TempFolder folder;
    folder.Write(list, text);
    NiftiFields fields;
    fields.dim = { 4, 3, 2 };
    const std::string bytes = Nifti(fields, RawAll<std::uint8_t>(values));
    return NamesIn(ReadLabelVolume(folder.Write(scan, scan.ends_with(".gz") ? Gzip(bytes) : bytes)));
  };
  using Names = std::map<std::int64_t, std::string>;
  // A column of codes behind the names, as the AAL atlas has.
  EXPECT_EQ(names("a.nii.gz", "a.nii.txt", "1 Precentral_L 2001\n2 Precentral_R 2002\n10 Frontal_Mid_R 2202\n"),
            (Names{ { 1, "Precentral_L" }, { 2, "Precentral_R" }, { 10, "Frontal_Mid_R" } }));
  EXPECT_EQ(names("a.nii", "a.txt", "1\tCorpus callosum\r\n2\tFornix\tx\r\n# 10\tno\r\n"),
            (Names{ { 1, "Corpus callosum" }, { 2, "Fornix" }, { 10, "label-10" } }));
  // Not every line ends with a number: it belongs to the name.
  EXPECT_EQ(names("a.nii", "a.nii.txt", "0 Background\n1 Lobule 4\n2 Brain stem\n10 Area 7 A\n"),
            (Names{ { 1, "Lobule 4" }, { 2, "Brain stem" }, { 10, "Area 7 A" } }));
  // Colours, as FreeSurfer lists them.
  EXPECT_EQ(
    names("a.nii", "a.nii.txt", "#No. Label R G B A\n1 Left-Thalamus 0 118 14 0\n2 Left-Caudate 122 186 220 0\n"),
    (Names{ { 1, "Left-Thalamus" }, { 2, "Left-Caudate" }, { 10, "label-10" } }));
}

TEST(Threshold, MakesOneShapeOfAGreyScan)
{
  const TempFolder folder;
  const auto       check = [&](const std::string & type, auto zero) {
    using T = decltype(zero);
    std::vector<T> values(130);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      values[i] = static_cast<T>(static_cast<int>(i) - (std::is_signed_v<T> ? 50 : 0));
    }
    const auto  path = WriteVolume(folder, type, { 13, 5, 2 }, values);
    ReadOptions options;
    options.threshold = { 10, 19.5 };
    const LabelMap volume = ReadLabelVolume(path, options);
    ASSERT_EQ(volume.labels.size(), 1U) << type;
    EXPECT_EQ(volume.labels[0].value, 1);
    EXPECT_EQ(volume.labels[0].voxels, 10U) << type;
    for (int z = 0; z < 2; ++z)
    {
      for (int y = 0; y < 5; ++y)
      {
        for (int x = 0; x < 13; ++x)
        {
          const auto value = values[static_cast<std::size_t>(x + 13 * (y + 5 * z))];
          EXPECT_EQ(volume.labels[0].shape.Contains(x, y, z), value >= 10 && value <= 19) << type;
        }
      }
    }
    options.threshold = { 500, 600 };
    ExpectRefused(path, { "threshold" }, options);
    options.threshold = { 3, 2 };
    EXPECT_THROW(ReadLabelVolume(path, options), UsageError);
  };
  check("uint8", std::uint8_t{});
  check("int8", std::int8_t{});
  check("int16", std::int16_t{});
  check("uint16", std::uint16_t{});
  check("int32", std::int32_t{});
  check("uint32", std::uint32_t{});
  check("int64", std::int64_t{});
  check("float", float{});
  check("double", double{});
}

TEST(Threshold, TakesZeroAndScaledValues)
{
  const TempFolder folder;
  NiftiFields      fields;
  fields.dim = { 4, 3, 2 };
  fields.datatype = 4;
  fields.slope = 2;
  fields.intercept = -1000;
  std::vector<int> values(24, 0);
  values[5] = 500; // 0 HU; all others -1000
  const auto  path = folder.Write("a.nii", Nifti(fields, RawAll<std::int16_t>(values)));
  ReadOptions options;
  options.threshold = { -10, 10 };
  EXPECT_EQ(ReadLabelVolume(path, options).labels[0].voxels, 1U);
  options.threshold = { -1000, -1000 };
  EXPECT_EQ(ReadLabelVolume(path, options).labels[0].voxels, 23U);
}

TEST(LabelsAtRandom, EveryVoxelCountAndBoxIsThatOfAPlainLoop)
{
  const TempFolder folder;
  const unsigned   seed = std::random_device()();
  std::cout << "seed " << seed << "\n";
  ::testing::Test::RecordProperty("seed", std::to_string(seed));
  std::mt19937 random(seed);
  for (int round = 0; round < 60; ++round)
  {
    const std::array<int, 3>   size{ 1 + static_cast<int>(random() % 150),
                                   1 + static_cast<int>(random() % 12),
                                   1 + static_cast<int>(random() % 12) };
    const auto                 labels = static_cast<unsigned>(1 + random() % 6);
    const auto                 longest = static_cast<unsigned>(1 + random() % 80); // runs
    std::vector<std::uint16_t> values(static_cast<std::size_t>(size[0]) * size[1] * size[2]);
    for (std::size_t at = 0; at < values.size();)
    {
      const auto value = static_cast<std::uint16_t>(random() % (labels + 1) * 100);
      for (std::size_t left = 1 + random() % longest; left > 0 && at < values.size(); --left)
      {
        values[at++] = value;
      }
    }
    if (std::all_of(values.begin(), values.end(), [](auto value) { return value == 0; }))
    {
      continue;
    }
    for (const std::string type : { "uint16", "int32", "double" })
    {
      const std::string data = type == "uint16"  ? RawAll<std::uint16_t>(values)
                               : type == "int32" ? RawAll<std::int32_t>(values)
                                                 : RawAll<double>(values);
      const LabelMap    volume = ReadLabelVolume(folder.Write("a.nrrd", Nrrd(NrrdLines(type, size), data)));
      ASSERT_EQ(AllValues(volume), std::vector<std::int64_t>(values.begin(), values.end()));
      std::uint64_t total = 0;
      for (const LabelShape & label : volume.labels)
      {
        total += label.voxels;
        EXPECT_EQ(label.voxels, label.shape.CountVoxels());
        const VoxelBox tight = CropToVoxels(label.shape).Box();
        EXPECT_EQ(label.shape.Box().lower, tight.lower);
        EXPECT_EQ(label.shape.Box().size, tight.size);
      }
      EXPECT_EQ(total, static_cast<std::uint64_t>(std::count_if(values.begin(), values.end(), [](auto value) {
                  return value != 0;
                })));
    }
  }
}

TEST(LabelsAtRandom, VolumesOfManySlabsAreJoinedRight)
{
  // 3 x 17 MB of noise: pieces of many slabs as bits; and one long thin rod: pieces as runs.
  const TempFolder          folder;
  const std::array<int, 3>  size{ 700, 190, 130 };
  std::vector<std::uint8_t> values(static_cast<std::size_t>(size[0]) * size[1] * size[2], 0);
  std::mt19937              random(11);
  std::uint64_t             ones = 0;
  for (int z = 3; z < size[2] - 2; ++z)
  {
    for (int y = 5; y < size[1]; ++y)
    {
      for (int x = 61; x < 641; ++x)
      {
        const bool in = (random() & 1U) != 0;
        values[static_cast<std::size_t>(x + size[0] * (y + size[1] * z))] = in ? 1 : 0;
        ones += in ? 1 : 0;
      }
    }
    values[static_cast<std::size_t>(650 + size[0] * (z + size[1] * z))] = 2;
  }
  const LabelMap volume = ReadLabelVolume(WriteVolume(folder, "uint8", size, values));
  ASSERT_EQ(volume.labels.size(), 2U);
  EXPECT_EQ(volume.labels[0].voxels, ones);
  EXPECT_EQ(volume.labels[1].voxels, 125U);
  for (int z = 0; z < size[2]; ++z)
  {
    for (int y = 0; y < size[1]; ++y)
    {
      for (int x = 0; x < size[0]; ++x)
      {
        const auto value = values[static_cast<std::size_t>(x + size[0] * (y + size[1] * z))];
        if (volume.labels[0].shape.Contains(x, y, z) != (value == 1) ||
            volume.labels[1].shape.Contains(x, y, z) != (value == 2))
        {
          FAIL() << x << " " << y << " " << z;
        }
      }
    }
  }
}

TEST(Labels, AScanOfScatteredGreyValuesIsRefusedBeforeItTakesMemory)
{
  const TempFolder           folder;
  std::mt19937               random(3);
  std::vector<std::uint16_t> values(100 * 100 * 100);
  for (std::uint16_t & value : values)
  {
    value = static_cast<std::uint16_t>(random());
  }
  ExpectRefused(WriteVolume(folder, "uint16", { 100, 100, 100 }, values), { "grey values", "--threshold" });
}

TEST(Progress, RunsFromZeroToOneAndStopsWhenAsked)
{
  const TempFolder                folder;
  const std::vector<std::uint8_t> values(300 * 200 * 200, 1);
  const auto                      path = WriteVolume(folder, "uint8", { 300, 200, 200 }, values);
  std::vector<double>             fractions;
  ReadLabelVolume(path, {}, [&](std::string_view, double fraction) {
    fractions.push_back(fraction);
    return true;
  });
  EXPECT_EQ(fractions.front(), 0.0);
  EXPECT_EQ(fractions.back(), 1.0);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GT(fractions.size(), 2U);
  EXPECT_THROW(ReadLabelVolume(path, {}, [](std::string_view, double fraction) { return fraction < 0.3; }), Cancelled);
}
