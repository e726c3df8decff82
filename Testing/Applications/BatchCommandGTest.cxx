// `voxelcore batch` as a user runs it.

#include "CohortFolder.h"
#include "VoxelCoreTesting/TemporaryFolder.h"
#include "Program.h"
#include "Scans.h"

#include <algorithm>
#include <csignal>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

namespace voxelcore::testing
{
namespace
{

using Json = nlohmann::json;
using ::testing::HasSubstr;

/** A field of a row of CSV without quoted fields before it. */
std::string
Field(const std::string & head, const std::string & line, const std::string & name)
{
  const auto         before = ("," + head).substr(0, ("," + head + ",").find("," + name + ",") + 1);
  auto               skip = std::count(before.begin(), before.end(), ',') - 1;
  std::istringstream fields(line);
  std::string        field;
  for (std::getline(fields, field, ','); skip > 0; --skip)
  {
    std::getline(fields, field, ',');
  }
  return field;
}

class BatchCommand : public ::testing::Test
{
protected:
  ProgramResult
  Batch(const std::vector<std::string> & more, const Watcher & watcher = {})
  {
    return RunBatch(m_Folder, more, {}, watcher);
  }
  Json
  Record(const std::string & folder)
  {
    return Json::parse(ReadAll(m_Folder / ("out/" + folder + "/" + folder + "_case.json")));
  }
  TemporaryFolder m_Folder;
};

TEST_F(BatchCommand, EachCaseGetsItsFolderAndAFailingOneCostsOnlyItself)
{
  WriteTinyScans(m_Folder.Path(), 3);
  WriteAll(m_Folder / "bad.nrrd", "this is no scan");
  const ProgramResult result = Batch({ m_Folder.Path() });
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.output, HasSubstr("3 of 4 cases done"));
  EXPECT_THAT(result.output, HasSubstr("failed: bad: "));
  EXPECT_THAT(result.error, HasSubstr("1 of 4 cases failed"));
  EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1);
  for (const char * file : { "medial.vtp", "skeleton.vtp", "skeleton.swc", "report.json", "thumbnail.png" })
  {
    EXPECT_TRUE(std::filesystem::exists(m_Folder / ("out/sub-s1/sub-s1_" + std::string(file)))) << file;
  }
  EXPECT_EQ(Record("sub-s1")["status"], "done");
  EXPECT_EQ(Record("sub-bad")["status"], "failed");
  EXPECT_THAT(Record("sub-bad")["reason"], HasSubstr("NRRD"));
  EXPECT_THAT(ReadAll(m_Folder / "out/cases.csv"), HasSubstr("bad,sub-bad,failed,"));
  EXPECT_THAT(ReadAll(m_Folder / "out/dataset_description.json"), HasSubstr("derivative"));
  EXPECT_FALSE(std::filesystem::exists(m_Folder / "out/.voxelcore"));
}

TEST_F(BatchCommand, ASeasonOfRootsIsComparedByTraitsAndTheOddPlantIsMarked)
{
  std::filesystem::create_directory(m_Folder / "season");
  for (int plant = 1; plant <= 6; ++plant)
  {
    const bool isOdd = plant == 6;
    RunProgram({ "phantom",
                 "root",
                 "--size",
                 "64",
                 "--radius",
                 "5",
                 "--laterals",
                 isOdd ? "16" : "4",
                 "--sub-laterals",
                 "0",
                 "--seed",
                 std::to_string(plant),
                 "--grey-values",
                 "--noise-level",
                 "0.03",
                 "-o",
                 m_Folder / ("season/p" + std::to_string(plant) + ".nrrd"),
                 "-q" });
  }
  WriteAll(m_Folder / "season/m.csv",
           "id,scan,up\np1,p1.nrrd,\np2,p2.nrrd,z+\np3,p3.nrrd,z-\np4,p4.nrrd,\n"
           "p5,p5.nrrd,\np6,p6.nrrd,\n");
  const ProgramResult result = Batch({ "--roots", "--up", "z+", m_Folder / "season/m.csv" });
  EXPECT_EQ(result.code, 0) << result.error;
  const auto plant = [&](int number) {
    const std::string name = "sub-p" + std::to_string(number);
    return Json::parse(ReadAll(m_Folder / ("out/" + name + "/" + name + "_report.json"))).at("roots");
  };
  EXPECT_EQ(plant(1).at("up"), "z+");
  EXPECT_EQ(plant(3).at("up"), "z-") << "a case's own option comes first";
  for (const char * file : { "roots.csv", "roots.rsml", "plant.csv", "mask.nrrd", "page.html", "thumbnail.png" })
  {
    EXPECT_TRUE(std::filesystem::exists(m_Folder / ("out/sub-p6/sub-p6_" + std::string(file)))) << file;
  }
  std::istringstream lines(ReadAll(m_Folder / "out/labels.csv"));
  std::string        head;
  std::getline(lines, head);
  int number = 0;
  for (std::string line; std::getline(lines, line);)
  {
    ++number;
    EXPECT_NEAR(std::stod(Field(head, line, "plant_total_length_mm")),
                plant(number).at("plant").at("total_length_mm").get<double>(),
                1e-6);
    EXPECT_EQ(Field(head, line, "outliers").find("plant_total_length_mm+") != std::string::npos, number == 6) << number;
  }
  EXPECT_EQ(number, 6);
  EXPECT_THAT(ReadAll(m_Folder / "out/index.html"), HasSubstr("stem diameter mm"));
  EXPECT_THAT(Batch({ "--roots", "--up", "z+", m_Folder / "season/m.csv" }).output, HasSubstr("6 of them before"));
}

TEST_F(BatchCommand, ComparisonsOfManyScansHaveTheNumbersOfEachTheirMeansAndIntervals)
{
  std::filesystem::create_directory(m_Folder / "pairs");
  std::string manifest = "id,scan,b,no-skeletons\n";
  for (int pair = 1; pair <= 3; ++pair)
  {
    const auto ball = [&](const std::string & name, int size) {
      RunProgram(
        { "phantom", "ball", "--size", std::to_string(size), "-o", m_Folder / ("pairs/" + name + ".nrrd"), "-q" });
      return name + ".nrrd";
    };
    const std::string number = std::to_string(pair);
    manifest += "p" + number + "," + ball("a" + number, 20) + "," + ball("b" + number, 20 + 2 * (pair - 1)) + ",yes\n";
  }
  WriteAll(m_Folder / "pairs/m.csv", manifest);
  const ProgramResult result = Batch({ "--compare", m_Folder / "pairs/m.csv" });
  EXPECT_EQ(result.code, 0) << result.error;
  std::istringstream lines(ReadAll(m_Folder / "out/labels.csv"));
  std::string        head;
  std::getline(lines, head);
  std::vector<double> dice;
  for (std::string line; std::getline(lines, line);)
  {
    dice.push_back(std::stod(Field(head, line, "compare_dice")));
    EXPECT_FALSE(Field(head, line, "compare_hausdorff_mm").empty()) << line;
  }
  ASSERT_EQ(dice.size(), 3U);
  EXPECT_EQ(dice[0], 1);
  EXPECT_LT(dice[1], 1);
  const std::string means = ReadAll(m_Folder / "out/means.csv");
  const std::size_t at = means.find(",dice,");
  ASSERT_NE(at, std::string::npos) << means;
  std::istringstream numbers(means.substr(at + 6, means.find('\n', at) - at - 6));
  std::string        cases;
  std::string        mean;
  std::getline(numbers, cases, ',');
  std::getline(numbers, mean, ',');
  EXPECT_EQ(cases, "3");
  EXPECT_NEAR(std::stod(mean), (dice[0] + dice[1] + dice[2]) / 3, 1e-9);
  EXPECT_THAT(ReadAll(m_Folder / "out/index.html"), HasSubstr("Hausdorff 95 %"));
  EXPECT_THAT(Batch({ "--compare", m_Folder / "pairs/m.csv" }).output, HasSubstr("3 of them before"));
  // The file beside the scan counts as the scan does.
  std::filesystem::copy_file(m_Folder / "pairs/a1.nrrd",
                             m_Folder / "pairs/b3.nrrd",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_THAT(Batch({ "--compare", m_Folder / "pairs/m.csv" }).output, HasSubstr("2 of them before"));
  const ProgramResult without = Batch({ "--compare", m_Folder / "pairs/a1.nrrd" });
  EXPECT_EQ(without.code, 2);
  EXPECT_THAT(without.error, HasSubstr("columns id, scan and b"));
}

TEST_F(BatchCommand, ThicknessOfManyScansHasTheNumbersOfEachAndTheOddOneIsMarked)
{
  std::filesystem::create_directory(m_Folder / "bones");
  for (int bone = 1; bone <= 6; ++bone)
  {
    RunProgram({ "phantom",
                 "porous",
                 "--size",
                 "24",
                 "--density",
                 "0.4",
                 "--period",
                 bone == 6 ? "12" : "6",
                 "--seed",
                 std::to_string(10 + bone), // of means that are spread, as four alike make a fifth odd
                 "-o",
                 m_Folder / ("bones/b" + std::to_string(bone) + ".nrrd"),
                 "-q" });
  }
  const std::vector<std::string> command{ "--thickness", "--separation", "box", m_Folder / "bones" };
  const ProgramResult            result = Batch(command);
  EXPECT_EQ(result.code, 0) << result.error;
  for (const char * file :
       { "thickness.nrrd", "thickness_separation.nrrd", "thickness.csv", "thickness_histogram.csv" })
  {
    EXPECT_TRUE(std::filesystem::exists(m_Folder / ("out/sub-b6/sub-b6_" + std::string(file)))) << file;
  }
  EXPECT_FALSE(std::filesystem::exists(m_Folder / "out/sub-b6/sub-b6_medial.vtp"));
  std::istringstream lines(ReadAll(m_Folder / "out/labels.csv"));
  std::string        head;
  std::getline(lines, head);
  int rows = 0;
  for (std::string line; std::getline(lines, line); ++rows)
  {
    const std::string folder = Field(head, line, "folder");
    const bool        isSeparation = Field(head, line, "name") == "separation";
    const Json        numbers = Json::parse(ReadAll(m_Folder / ("out/" + folder + "/" + folder + "_report.json")))
                           .at("thickness")
                           .at(isSeparation ? 1 : 0);
    EXPECT_NEAR(std::stod(Field(head, line, "thickness_mean_mm")), numbers.at("mean_mm").get<double>(), 1e-6);
    std::istringstream counts(Field(head, line, "thickness_histogram"));
    std::uint64_t      sum = 0;
    for (std::uint64_t count = 0; counts >> count;)
    {
      sum += count;
    }
    EXPECT_EQ(sum, numbers.at("voxels").get<std::uint64_t>());
    if (!isSeparation)
    {
      EXPECT_EQ(Field(head, line, "outliers").find("thickness_mean_mm+") != std::string::npos, folder == "sub-b6");
    }
  }
  EXPECT_EQ(rows, 12);
  EXPECT_THAT(ReadAll(m_Folder / "out/index.html"), HasSubstr("mean thickness mm"));
  EXPECT_THAT(Batch(command).output, HasSubstr("6 of them before"));
}

TEST_F(BatchCommand, OptionsOfACommandThatIsNotRunAreRefused)
{
  WriteTinyScans(m_Folder.Path(), 1);
  ExpectRefusal(Batch({ "--border", "drop", m_Folder.Path() }), 2, { "'voxelcore thickness'", "--thickness" });
  ExpectRefusal(Batch({ "--thickness", "--lambda", "1vox", m_Folder.Path() }), 2, { "--lambda", "no option" });
  ExpectRefusal(Batch({ "--thickness", "--roots", m_Folder.Path() }), 2, { "--roots", "--thickness" });
  ExpectRefusal(Batch({ "--thickness", "--no-skeleton", m_Folder.Path() }), 2, { "--no-skeleton", "--thickness" });
}

TEST_F(BatchCommand, OnlyWhatIsNotDoneIsDone)
{
  WriteTinyScans(m_Folder.Path(), 3);
  ASSERT_EQ(Batch({ m_Folder.Path() }).code, 0);
  const auto before = FolderContents(m_Folder / "out", false);
  EXPECT_THAT(Batch({ m_Folder.Path() }).output, HasSubstr("3 of them before"));
  EXPECT_EQ(FolderContents(m_Folder / "out", false), before); // also the times: nothing was done again
  WriteAll(m_Folder / "out/sub-s1/sub-s1_medial.vtp", "damaged");
  WriteTinyScan(m_Folder / "s2.nrrd", 77);
  EXPECT_THAT(Batch({ m_Folder.Path() }).output, HasSubstr("1 of them before"));
  EXPECT_THAT(Batch({ m_Folder.Path() }).output, HasSubstr("3 of them before"));
  EXPECT_EQ(Batch({ m_Folder.Path(), "--lambda", "2vox" }).output, "3 of 3 cases done\n");
  EXPECT_EQ(Batch({ m_Folder.Path(), "--lambda", "2vox", "--force" }).output, "3 of 3 cases done\n");
  EXPECT_EQ(Json::parse(ReadAll(m_Folder / "out/sub-s1/sub-s1_report.json"))["parameters"]["lambda"][0], "2vox");
}

TEST_F(BatchCommand, ColumnsOfTheManifestComeBeforeTheOptionsOfTheBatch)
{
  WriteTinyScans(m_Folder.Path(), 2);
  WriteAll(m_Folder / "m.csv",
           "id,scan,lambda,with-skeleton\na,s0.nrrd,0,no\nb,s1.nrrd,,\nc,s1.nrrd,-1mm,\nd,s9.nrrd,,\n");
  const ProgramResult result = Batch({ m_Folder / "m.csv", "--lambda", "1vox" });
  EXPECT_EQ(result.code, 1);
  const auto report = [&](const std::string & id) {
    return Json::parse(ReadAll(m_Folder / ("out/sub-" + id + "/sub-" + id + "_report.json")));
  };
  EXPECT_EQ(report("a")["parameters"]["lambda"][0], "0");
  EXPECT_FALSE(report("a").contains("skeleton"));
  EXPECT_EQ(report("b")["parameters"]["lambda"][0], "1vox");
  EXPECT_TRUE(report("b").contains("skeleton"));
  EXPECT_THAT(Record("sub-c")["reason"], HasSubstr("lambda"));
  EXPECT_THAT(Record("sub-d")["reason"], HasSubstr("s9.nrrd"));
}

TEST_F(BatchCommand, WhatHangsOrWantsTooMuchMemoryIsListed)
{
  ASSERT_EQ(RunProgram({ "phantom", "gyroid", "--size", "256", "-o", m_Folder / "large.nrrd" }).code, 0);
  WriteTinyScan(m_Folder / "small.nrrd", 1);
  const ProgramResult late = Batch({ m_Folder.Path(), "--timeout", "3s", "--jobs", "1" });
  EXPECT_THAT(late.output, HasSubstr("failed: large: took longer than --timeout"));
  EXPECT_THAT(late.output, HasSubstr("1 of 2 cases done"));
  const ProgramResult poor = Batch({ m_Folder.Path(), "--memory", "100MB" });
  EXPECT_THAT(poor.output, HasSubstr("failed: large: needs about"));
  EXPECT_THAT(poor.output, HasSubstr("1 of 2 cases done, 1 of them before"));
}

TEST_F(BatchCommand, MemoryDecidesHowManyRunSideBySide)
{
  WriteTinyScans(m_Folder.Path(), 4);
  // Room for one case at a time: they wait for each other, and all are done.
  EXPECT_EQ(Batch({ m_Folder.Path(), "--memory", "60MB", "--jobs", "4" }).code, 0);
}

TEST_F(BatchCommand, AnInterruptKeepsWhatIsDoneAndLeavesNoCaseRunning)
{
  WriteTinyScans(m_Folder.Path(), 60);
  bool                sent = false;
  const ProgramResult result =
    Batch({ m_Folder.Path(), "--progress", "plain" }, [&](pid_t process, const std::string & error) {
      if (!sent && error.find("1 of 60 done") != std::string::npos)
      {
        sent = true;
        kill(process, SIGINT);
      }
    });
  EXPECT_EQ(result.code, 130);
  EXPECT_THAT(result.error, HasSubstr("what is done stays"));
  EXPECT_THAT(Batch({ m_Folder.Path() }).output, HasSubstr("of them before"));
}

TEST_F(BatchCommand, OneCaseAtATimeAndGatheredGiveTheSameFolder)
{
  WriteTinyScans(m_Folder.Path(), 3);
  WriteAll(m_Folder / "m.csv", "id,scan\na,s0.nrrd\nb,s1.nrrd\nc,none.nrrd\n");
  EXPECT_EQ(Batch({ m_Folder / "m.csv" }).code, 1);
  const auto whole = FolderContents(m_Folder / "out");
  std::filesystem::remove_all(m_Folder / "out");
  EXPECT_THAT(Batch({ m_Folder / "m.csv", "--list" }).output,
              HasSubstr("3\tsub-c\tc\t" + (m_Folder / "none.nrrd").string() + "\n"));
  EXPECT_EQ(Batch({ m_Folder / "m.csv", "--case", "1" }).code, 0);
  EXPECT_EQ(Batch({ m_Folder / "m.csv", "--case", "2" }).code, 0);
  const ProgramResult early = Batch({ m_Folder / "m.csv", "--gather" });
  EXPECT_EQ(early.code, 1);
  EXPECT_THAT(early.output, HasSubstr("failed: c: left no result"));
  EXPECT_EQ(Batch({ m_Folder / "m.csv", "--case", "3" }).code, 1);
  EXPECT_EQ(Batch({ "--gather" }).code, 1);
  EXPECT_EQ(FolderContents(m_Folder / "out"), whole);
  ExpectRefusal(Batch({ m_Folder / "m.csv", "--case", "4" }), 2, { "--case 4", "1 to 3" });
}

TEST_F(BatchCommand, TwoBatchesOnOneFolderDoNotHarmEachOther)
{
  WriteTinyScans(m_Folder.Path(), 24);
  ASSERT_EQ(Batch({ m_Folder.Path() }).code, 0);
  const auto alone = FolderContents(m_Folder / "out");
  std::filesystem::remove_all(m_Folder / "out");
  ProgramResult other;
  std::thread   second([&] { other = Batch({ m_Folder.Path() }); });
  const auto    first = Batch({ m_Folder.Path() });
  second.join();
  EXPECT_EQ(first.code, 0) << first.error;
  EXPECT_EQ(other.code, 0) << other.error;
  EXPECT_EQ(FolderContents(m_Folder / "out"), alone);
}

TEST_F(BatchCommand, HostileIdsStayInTheOutputFolder)
{
  WriteTinyScans(m_Folder.Path(), 1);
  const std::vector<std::string> ids{ "../../up",           "..",       "/etc/x", "a b",        "\"q\"",         "日本",
                                      "=cmd|' /C calc'!A0", "<b>x</b>", "-o",     "a;rm -rf .", "$(touch pwned)" };
  std::string                    text = "\xEF\xBB\xBFid,scan\r\n";
  for (const std::string & id : ids)
  {
    std::string field;
    for (const char c : id)
    {
      field += c == '"' ? "\"\"" : std::string(1, c);
    }
    text += "\"" + field + "\",s0.nrrd\r\n";
  }
  WriteAll(m_Folder / "m.csv", text);
  const auto before = m_Folder.Names();
  EXPECT_EQ(Batch({ m_Folder / "m.csv", "--no-skeleton" }).code, 0);
  auto after = m_Folder.Names();
  EXPECT_EQ(after.erase("out"), 1U);
  EXPECT_EQ(after, before);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(m_Folder / "out"), {}), 5 + std::ptrdiff_t(ids.size()));
  const std::string table = ReadAll(m_Folder / "out/cases.csv");
  EXPECT_THAT(table, HasSubstr("\n'=cmd|"));
  EXPECT_THAT(table, HasSubstr(",parameters_labels,"));
  EXPECT_THAT(table, ::testing::Not(HasSubstr("parameters_labels_0"))); // an atlas has hundreds
  EXPECT_THAT(table, HasSubstr("日本"));
  EXPECT_THAT(ReadAll(m_Folder / "out/index.html"), ::testing::Not(HasSubstr("<b>x")));
}

TEST_F(BatchCommand, ALinkInTheWayIsNotFollowed)
{
  WriteTinyScans(m_Folder.Path(), 1);
  std::filesystem::create_directory(m_Folder / "out");
  std::filesystem::create_directory(m_Folder / "elsewhere");
  std::filesystem::create_directory_symlink(m_Folder / "elsewhere", m_Folder / "out/sub-s0");
  const ProgramResult result = Batch({ m_Folder / "s0.nrrd" });
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.error, HasSubstr("sub-s0: is a link"));
  EXPECT_TRUE(std::filesystem::is_empty(m_Folder / "elsewhere"));
}

TEST_F(BatchCommand, WrongUseIsSaidInOneLine)
{
  WriteAll(m_Folder / "m.csv", "id,scan\na,b\na,c\n");
  WriteTinyScans(m_Folder.Path(), 1);
  ExpectRefusal(Batch({}), 2, { "INPUT" });
  ExpectRefusal(Batch({ m_Folder / "none" }), 3, { "none" });
  ExpectRefusal(Batch({ m_Folder / "m.csv" }), 3, { "m.csv", "line 3", "line 2" });
  ExpectRefusal(Batch({ m_Folder / "s0.nrrd", "--memory", "lots" }), 2, { "--memory lots", "GB" });
  ExpectRefusal(Batch({ m_Folder / "s0.nrrd", "--timeout", "-3" }), 2, { "--timeout -3" });
  ExpectRefusal(Batch({ m_Folder / "s0.nrrd", "--jobs", "x" }), 2, { "--jobs x" });
  ExpectRefusal(Batch({ m_Folder / "s0.nrrd", "--up", "z+" }), 2, { "--up", "--roots" });
  ExpectRefusal(Batch({ m_Folder / "s0.nrrd", "--roots", "--lambda", "2vox" }), 2, { "--lambda", "voxelcore roots" });
  ExpectRefusal(Batch({ m_Folder / "s0.nrrd", "--roots", "--no-skeleton" }), 2, { "--no-skeleton", "--roots" });
  EXPECT_FALSE(std::filesystem::exists(m_Folder / "out"));
}

} // namespace
} // namespace voxelcore::testing
