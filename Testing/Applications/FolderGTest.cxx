// A folder of labels: each is there when it is done, and the same command goes on where it was stopped.

#include "CohortFolder.h"
#include "CommandFixture.h"

#include <csignal>
#include <filesystem>
#include <map>

namespace voxelcore::testing
{
namespace
{

namespace fs = std::filesystem;

class Folder : public CommandFixture
{
protected:
  void
  SetUp() override
  {
    Run({ "phantom", "cells", "--size", "40", "--cells", "25", "-o", Path("c.nrrd") });
  }

  std::vector<std::string>
  Command(const std::string & command, const std::string & folder, std::vector<std::string> more = {}) const
  {
    std::vector<std::string> arguments{ command, Path("c.nrrd"), "-o", Path(folder) + "/", "-q" };
    if (command == "skeleton")
    {
      arguments.insert(arguments.end(), { "--also", "csv,swc" });
    }
    else
    {
      arguments.insert(arguments.end(), { "--lambda", "1vox,2vox", "--with-skeleton" });
    }
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  /** Every result in a folder by name. The record of what is finished tells how long each label took. */
  std::map<std::string, std::string>
  Results(const std::string & folder) const
  {
    std::map<std::string, std::string> results;
    for (const auto & entry : fs::directory_iterator(m_Folder / folder))
    {
      const std::string name = entry.path().filename().string();
      if (!name.ends_with("_finished.jsonl") && name.find(".part") == std::string::npos)
      {
        results[name] = ReadAll(entry.path());
      }
    }
    return results;
  }

  std::size_t
  CountModels(const std::string & folder) const
  {
    std::size_t count = 0;
    if (fs::is_directory(m_Folder / folder))
    {
      for (const auto & entry : fs::directory_iterator(m_Folder / folder))
      {
        count += entry.path().extension() == ".vtp";
      }
    }
    return count;
  }

  void
  ExpectSameResults(const std::string & folder, const std::map<std::string, std::string> & expected) const
  {
    const auto results = Results(folder);
    EXPECT_EQ(results.size(), expected.size());
    for (const auto & [name, text] : expected)
    {
      const auto found = results.find(name);
      ASSERT_NE(found, results.end()) << name << " is missing";
      EXPECT_TRUE(found->second == text) << name << " differs";
    }
  }

  /** Runs until so many models are there, then kills. */
  bool
  KillAfter(const std::vector<std::string> & arguments, const std::string & folder, std::size_t models) const
  {
    return RunProgram(arguments, {}, [&](pid_t process, const std::string &) {
             if (CountModels(folder) >= models)
             {
               kill(process, SIGKILL);
             }
           }).signal == SIGKILL;
  }
};

} // namespace

TEST_F(Folder, AKilledRunGoesOnAndEndsWithTheSameFiles)
{
  for (const std::string command : { "skeleton", "core" })
  {
    SCOPED_TRACE(command);
    Run(Command(command, command + "-whole"));
    const auto        whole = Results(command + "-whole");
    const std::string folder = command + "-killed";
    int               hits = 0;
    for (const std::size_t models : { 1, 8, 16 })
    {
      hits += KillAfter(Command(command, folder, { "--threads", "1" }), folder, models);
    }
    EXPECT_GE(hits, 1);
    const std::size_t before = CountModels(folder);
    EXPECT_GT(before, 0U);
    Run(Command(command, folder));
    ExpectSameResults(folder, whole);
  }
}

TEST_F(Folder, FinishedLabelsAreKeptAndDamagedOnesDoneAgain)
{
  const auto command = Command("skeleton", "out");
  Run(command);
  const auto whole = Results("out");
  const auto kept = m_Folder / "out/c_label-7_skeleton.vtp";
  const auto damaged = m_Folder / "out/c_label-9_skeleton.vtp";
  const auto missing = m_Folder / "out/c_label-11_skeleton.swc";
  const auto time = fs::last_write_time(kept) - std::chrono::hours(1);
  fs::last_write_time(kept, time);
  fs::last_write_time(damaged, time);
  std::string text = ReadAll(damaged);
  text[text.size() / 2] = static_cast<char>(text[text.size() / 2] ^ 1);
  WriteAll(damaged, text);
  fs::remove(missing);
  Run(command);
  ExpectSameResults("out", whole);
  EXPECT_EQ(fs::last_write_time(kept), time);
}

TEST_F(Folder, ALineCutOffByAKillIsPassedOver)
{
  const auto command = Command("skeleton", "out");
  Run(command);
  const auto        whole = Results("out");
  const auto        record = m_Folder / "out/c_skeleton_finished.jsonl";
  const std::string lines = ReadAll(record);
  for (const double share : { 0.0, 0.3, 0.5, 0.999 })
  {
    const auto length = static_cast<std::size_t>(share * static_cast<double>(lines.size()));
    WriteAll(record, lines.substr(0, length));
    // Files of which nothing is known any more are others': they are not touched without being asked.
    EXPECT_EQ(RunProgram(command).code, 1);
    auto forced = command;
    forced.push_back("--force");
    Run(forced);
    ExpectSameResults("out", whole);
    Run(command);
    ExpectSameResults("out", whole);
  }
}

TEST_F(Folder, ALineNestedSoDeeplyThatTheStackWouldEndIsPassedOver)
{
  const auto command = Command("skeleton", "out");
  Run(command);
  const auto whole = Results("out");
  const auto record = m_Folder / "out/c_skeleton_finished.jsonl";
  WriteAll(record,
           R"({"sha256":"","x":)" + std::string(200000, '[') + std::string(200000, ']') + "}\n" + ReadAll(record));
  Run(command);
  ExpectSameResults("out", whole);
}

TEST_F(Folder, OtherOptionsOrAnotherScanDoEveryLabelAgainWhenForced)
{
  Run(Command("skeleton", "out"));
  const auto other = Command("skeleton", "out", { "--stand-out", "6vox" });
  Run(Command("skeleton", "expected", { "--stand-out", "6vox" }));
  const ProgramResult refused = RunProgram(other);
  ExpectRefusal(refused, 1, { "exists already", "--force" });
  auto forced = other;
  forced.push_back("--force");
  Run(forced);
  ExpectSameResults("out", Results("expected"));

  Run({ "phantom", "cells", "--size", "40", "--cells", "25", "--seed", "2", "-o", Path("c.nrrd"), "--force" });
  EXPECT_EQ(RunProgram(other).code, 1);
  Run(forced);
  Run(Command("skeleton", "expected2", { "--stand-out", "6vox" }));
  const auto expected = Results("expected2");
  const auto results = Results("out");
  for (const auto & [name, text] : expected)
  {
    EXPECT_TRUE(results.at(name) == text) << name;
  }
}

TEST_F(Folder, ThreadsChangeNothing)
{
  Run(Command("skeleton", "out-1", { "--threads", "1" }));
  const auto one = Results("out-1");
  for (const std::string threads : { "2", "7" })
  {
    Run(Command("skeleton", "out-" + threads, { "--threads", threads }));
    ExpectSameResults("out-" + threads, one);
  }
}

// What went on for an earlier run's labels counts in the report as if it had run through.
TEST_F(Folder, TheReportTellsOfAllLabels)
{
  Run(Command("core", "whole", { "--report", Path("whole.json") }));
  ASSERT_TRUE(KillAfter(Command("core", "killed", { "--threads", "1" }), "killed", 20));
  Run(Command("core", "killed", { "--report", Path("killed.json") }));
  auto whole = Report("whole.json");
  auto killed = Report("killed.json");
  ASSERT_EQ(whole["labels"].size(), killed["labels"].size());
  for (std::size_t i = 0; i < whole["labels"].size(); ++i)
  {
    for (auto * report : { &whole, &killed })
    {
      auto & label = (*report)["labels"][i];
      label["skeleton"].erase("output");
      for (auto & pruned : label["pruned"])
      {
        pruned.erase("output");
      }
    }
    EXPECT_EQ(whole["labels"][i], killed["labels"][i]);
  }
}

} // namespace voxelcore::testing
