// A run that is stopped leaves nothing under a final name.

#include "VoxelCoreTesting/TemporaryFolder.h"
#include "Program.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <gtest/gtest.h>
#include <optional>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace voxelcore::testing
{
namespace
{

using Names = std::set<std::string>;

class Interrupt : public ::testing::Test
{
protected:
  /** Runs a job of about a second and sends the signals, a moment apart, once `stage` shows on stderr. */
  ProgramResult
  StopAt(const std::string & stage, const std::vector<int> & signals, const std::string & engine = "lattice")
  {
    // Large enough that the stage still runs when the signal comes.
    const std::string size = stage == "delaunay" ? "128" : "80";
    EXPECT_EQ(RunProgram({ "phantom", "gyroid", "--size", size, "-o", m_Folder / "g.nrrd", "--force" }).code, 0);
    m_Sent = 0;
    return RunProgram({ "core",
                        m_Folder / "g.nrrd",
                        "-o",
                        m_Folder / "out.vtp",
                        "--report",
                        m_Folder / "out.json",
                        "--lambda",
                        "0,1.5vox",
                        "--progress",
                        "plain",
                        "--engine",
                        engine },
                      {},
                      [&](pid_t process, const std::string & error) {
                        if (error.find(stage) != std::string::npos && m_Sent < signals.size())
                        {
                          kill(process, signals[m_Sent++]);
                        }
                      });
  }

  std::string
  LastLine(const std::string & text)
  {
    const auto end = text.find_last_not_of('\n');
    return text.substr(text.rfind('\n', end) + 1);
  }

  TemporaryFolder m_Folder;
  std::size_t     m_Sent = 0;
};

TEST_F(Interrupt, CtrlCDuringLongWorkLeavesNothingAndIsPrompt)
{
  // auto: an engine of the build's choice, which may be one that cannot stop in the middle.
  for (const auto & [signal, engine] : { std::pair(SIGINT, "auto"), std::pair(SIGTERM, "lattice") })
  {
    const ProgramResult result = StopAt("delaunay", { signal }, engine);
    ASSERT_EQ(m_Sent, 1U);
    EXPECT_LT(result.seconds, 20);
    EXPECT_EQ(result.code, 130);
    EXPECT_EQ(LastLine(result.error), "voxelcore: interrupted; nothing was written\n");
    EXPECT_EQ(m_Folder.Names(), Names{ "g.nrrd" });
  }
}

/** A reader that waits for ever, as one that is lost in a damaged file does: nobody writes into the pipe it opens. */
TEST_F(Interrupt, AReaderThatNeverReturnsIsEnded)
{
  using namespace std::chrono_literals;
  using Clock = std::chrono::steady_clock;
  // Scans may not be pipes; lists of voxels may.
  const std::string scan = m_Folder / "ball.nrrd";
  const std::string pipe = m_Folder / "endless.txt";
  ASSERT_EQ(RunProgram({ "phantom", "ball", "--size", "8", "-o", scan }).code, 0);
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  ProgramLimits limits;
  limits.time = 10s;
  // The first Ctrl-C leaves the job half a second to end by itself.
  const std::vector<std::pair<std::vector<int>, double>> cases{ { { SIGINT }, 1.5 },
                                                                { { SIGTERM }, 0.5 },
                                                                { { SIGHUP }, 0.5 },
                                                                { { SIGINT, SIGINT }, 0.5 } };
  for (const auto & [signals, most] : cases)
  {
    const auto                       start = Clock::now();
    std::optional<Clock::time_point> sent;
    const std::vector<int> &         send = signals;

    const ProgramResult result = RunProgram({ "core", scan, "--change-voxels", pipe, "-o", m_Folder / "out.vtp" },
                                            limits,
                                            [&](pid_t process, const std::string &) {
                                              if (!sent && Clock::now() - start > 1500ms)
                                              {
                                                sent = Clock::now();
                                                for (const int signal : send)
                                                {
                                                  kill(process, signal);
                                                  usleep(20000);
                                                }
                                              }
                                            });
    ASSERT_TRUE(sent);
    EXPECT_EQ(result.code, 130) << strsignal(signals[0]);
    EXPECT_EQ(result.error, "voxelcore: interrupted; nothing was written\n");
    EXPECT_LT(std::chrono::duration<double>(Clock::now() - *sent).count(), most) << strsignal(signals[0]);
    EXPECT_EQ(m_Folder.Names(), (Names{ "ball.nrrd", "endless.txt" }));
  }
}

/** A volume of two files is written in a folder of its own. */
TEST_F(Interrupt, SigtermWhileTwoFilesAreWrittenLeavesNeither)
{
  bool                sent = false;
  const ProgramResult result =
    RunProgram({ "phantom", "gyroid", "--size", "300", "-o", m_Folder / "g.mhd" },
               {},
               [&](pid_t process, const std::string &) {
                 std::error_code ignored;
                 for (const auto & entry : std::filesystem::directory_iterator(m_Folder.Path(), ignored))
                 {
                   if (!sent && entry.is_directory() && !std::filesystem::is_empty(entry.path(), ignored))
                   {
                     sent = true;
                     kill(process, SIGTERM);
                   }
                 }
               });
  ASSERT_TRUE(sent) << "it was written before anybody could look";
  EXPECT_EQ(result.code, 130);
  EXPECT_EQ(m_Folder.Names(), Names{});
}

#ifdef VOXELCORE_EARLY_SIGNAL
// A library that is loaded with the program sends it the signal as it sets itself up, before main().
TEST_F(Interrupt, ASignalWhileLibrariesAreLoadedEndsWithTheCodeOfAnInterruption)
{
  for (const int signal : { SIGINT, SIGTERM, SIGHUP })
  {
    setenv("LD_PRELOAD", VOXELCORE_EARLY_SIGNAL, 1);
    setenv("VOXELCORE_TEST_SIGNAL", std::to_string(signal).c_str(), 1);
    const ProgramResult result = RunProgram({ "phantom", "ball", "--size", "8", "-o", m_Folder / "ball.nrrd" });
    unsetenv("LD_PRELOAD");
    EXPECT_EQ(result.code, 130) << strsignal(signal) << " " << result.signal;
    EXPECT_EQ(result.error, "voxelcore: interrupted; nothing was written\n");
    EXPECT_EQ(m_Folder.Names(), Names{});
  }
}
#endif

TEST_F(Interrupt, CtrlCDuringPruningLeavesNothing)
{
  const ProgramResult result = StopAt("prune", { SIGINT });
  EXPECT_EQ(result.code, 130);
  EXPECT_EQ(m_Folder.Names(), Names{ "g.nrrd" });
}

TEST_F(Interrupt, CtrlCWhileWritingLeavesNothing)
{
  const ProgramResult result = StopAt("writing", { SIGINT });
  EXPECT_EQ(result.code, 130);
  EXPECT_EQ(m_Folder.Names(), Names{ "g.nrrd" });
}

TEST_F(Interrupt, ASecondCtrlCEndsAtOnceAndStillLeavesNothing)
{
  const ProgramResult result = StopAt("writing", { SIGINT, SIGINT });
  EXPECT_EQ(result.code, 130);
  EXPECT_EQ(m_Folder.Names(), Names{ "g.nrrd" });
}

TEST_F(Interrupt, AFolderIsSaidToStayHoweverItIsGiven)
{
  EXPECT_EQ(RunProgram({ "phantom", "gyroid", "--size", "128", "-o", m_Folder / "g.nrrd" }).code, 0);
  for (const std::string & output : { "-o" + (m_Folder / "out/").string(), "--output=" + (m_Folder / "out/").string() })
  {
    bool                sent = false;
    const ProgramResult result = RunProgram({ "core", m_Folder / "g.nrrd", output, "--progress", "plain" },
                                            {},
                                            [&](pid_t process, const std::string & error) {
                                              if (!sent && error.find("delaunay") != std::string::npos)
                                              {
                                                kill(process, SIGINT);
                                                sent = true;
                                              }
                                            });
    EXPECT_EQ(result.code, 130);
    EXPECT_EQ(LastLine(result.error),
              "voxelcore: interrupted; what is done stays, and the same command goes on from there\n");
  }
}

TEST_F(Interrupt, AKilledRunLeavesNoFileUnderItsFinalName)
{
  for (const char * stage : { "delaunay", "writing" })
  {
    const ProgramResult result = StopAt(stage, { SIGKILL });
    EXPECT_EQ(result.signal, SIGKILL);
    for (const std::string & name : m_Folder.Names())
    {
      EXPECT_TRUE(name == "g.nrrd" || name.find(".part") != std::string::npos) << name;
    }
  }
}

TEST_F(Interrupt, WhatAKilledRunLeftIsRemovedByTheNext)
{
  const auto isPart = [](const std::string & name) { return name.find(".part-") != std::string::npos; };
  const auto parts = [&] {
    const Names names = m_Folder.Names();
    return std::count_if(names.begin(), names.end(), isPart);
  };
  ASSERT_EQ(RunProgram({ "phantom", "gyroid", "--size", "64", "-o", m_Folder / "g.nrrd" }).code, 0);
  const std::vector<std::string> core{ "core", m_Folder / "g.nrrd", "--lambda", "0", "-o", m_Folder / "out.vtp" };
  for (int tries = 0; parts() == 0; ++tries)
  {
    ASSERT_LT(tries, 20) << "no kill came while a file was being written";
    RunProgram(core, {}, [&](pid_t process, const std::string &) {
      if (parts() > 0)
      {
        kill(process, SIGKILL);
      }
    });
    std::filesystem::remove(m_Folder / "out.vtp");
  }
  const std::string other = "out.vtp.part-00000000-00000000-1-1"; // of another machine, that may still be running
  WriteAll(m_Folder / other, "x");
  const ProgramResult result = RunProgram({ "info", m_Folder / "g.nrrd" });
  EXPECT_EQ(result.code, 0) << result.error;
  EXPECT_GT(parts(), 1); // what writes nothing removes nothing
  ASSERT_EQ(RunProgram({ "phantom", "ball", "--size", "8", "-o", m_Folder / "ball.nrrd" }).code, 0);
  EXPECT_EQ(parts(), 1);
  EXPECT_TRUE(m_Folder.Names().contains(other));
}

TEST_F(Interrupt, ARunThatMayEndLeavesItsFilesAndNothingElse)
{
  const ProgramResult result = StopAt("no such stage", {});
  EXPECT_EQ(result.code, 0) << result.error;
  EXPECT_EQ(m_Folder.Names(), (Names{ "g.nrrd", "out.json", "out_lambda-0.vtp", "out_lambda-1.5vox.vtp" }));
}

} // namespace
} // namespace voxelcore::testing
