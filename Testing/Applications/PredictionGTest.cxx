// What `info` foretells and what `core` then takes.

#include "VoxelCoreTesting/TemporaryFolder.h"
#include "Program.h"
#include "Scans.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

namespace voxelcore::testing
{
namespace
{

using Json = nlohmann::json;

/** Of a processor, used by the programs that have been run. */
double
SecondsOfPrograms()
{
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval & time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

class Prediction : public ::testing::Test
{
protected:
  static std::string
  Run(const std::vector<std::string> & arguments)
  {
    const ProgramResult result = RunProgram(arguments);
    EXPECT_EQ(result.code, 0) << result.error;
    return result.output;
  }

  /** Of each phantom with each of these numbers of threads, or with one after the other in turn. */
  void
  ExpectMemoryWithinThirtyPercent(bool each) const;

  TemporaryFolder m_Folder;
};

using HeavyPrediction = Prediction;

void
Prediction::ExpectMemoryWithinThirtyPercent(bool each) const
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers need memory of their own";
#endif
  // None of these is among the shapes that the constants were fitted to (Testing/Performance/CostFit.cxx).
  const std::vector<std::vector<std::string>> phantoms{ { "ball", "--size", "128" },
                                                        { "capsule", "--size", "200" },
                                                        { "tanglecube", "--size", "160" },
                                                        { "gyroid", "--size", "128" },
                                                        { "root", "--size", "300", "--seed", "9" },
                                                        { "porous", "--size", "112" },
                                                        { "plate", "--size", "160", "--thickness", "7" },
                                                        { "noise", "--size", "64", "--density", "0.3" } };
  const std::string                           scan = m_Folder / "a.nrrd";
  int                                         number = 0;
  for (const auto & phantom : phantoms)
  {
    SCOPED_TRACE(phantom.front());
    ++number;
    std::vector<std::string> command{ "phantom" };
    command.insert(command.end(), phantom.begin(), phantom.end());
    command.insert(command.end(), { "-o", scan, "--force", "-q" });
    Run(command);
    for (const char * threads : { "1", "2" })
    {
      if (!each && (number % 2 == 0) != (*threads == '2'))
      {
        continue;
      }
      const Json info = Json::parse(Run({ "info", scan, "--json", "--threads", threads }));
      Run(
        { "core", scan, "-o", m_Folder / "a.vtp", "--force", "-q", "--threads", threads, "--report", m_Folder / "r" });
      std::ifstream file(m_Folder / "r");
      const double  measured = 1e6 * Json::parse(file)["peak_memory_mb"].get<double>();
      EXPECT_NEAR(info["core"]["memory_bytes"].get<double>() / measured, 1, 0.3) << threads << " threads";
      EXPECT_GT(info["core"]["seconds"], 0);
      EXPECT_EQ(info["labels"][0]["core_memory_bytes"], info["core"]["memory_bytes"]);
    }
  }
}

TEST_F(Prediction, OfMemoryIsWithinThirtyPercent)
{
  ExpectMemoryWithinThirtyPercent(false);
}

TEST_F(HeavyPrediction, OfMemoryIsWithinThirtyPercentWithAnyNumberOfThreads)
{
  ExpectMemoryWithinThirtyPercent(true);
}

TEST_F(Prediction, OfSkeletonAndPageIsWithinAFactor)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers need memory of their own";
#endif
  // None of these is among the shapes that the constants were fitted to (Testing/Performance/FurtherFit.cxx).
  const std::vector<std::vector<std::string>> phantoms{ { "capsule", "--size", "200" },
                                                        { "gyroid", "--size", "60" },
                                                        { "root", "--size", "220", "--seed", "9" },
                                                        { "cells", "--size", "60", "--cells", "200" } };
  const std::string                           scan = m_Folder / "a.nrrd";
  int                                         number = 0;
  for (const auto & phantom : phantoms)
  {
    SCOPED_TRACE(phantom.front());
    ++number;
    std::vector<std::string> command{ "phantom" };
    command.insert(command.end(), phantom.begin(), phantom.end());
    command.insert(command.end(), { "-o", scan, "--force", "-q" });
    Run(command);
    const Json info = Json::parse(Run({ "info", scan, "--json", "--threads", "1" }));
    const auto expectNear = [&](const char * job, std::vector<std::string> words) {
      words.insert(words.end(), { "--force", "-q", "--threads", "1", "--report", m_Folder / "r" });
      const double before = SecondsOfPrograms();
      Run(words);
      const double  seconds = SecondsOfPrograms() - before;
      std::ifstream file(m_Folder / "r");
      const double  bytes = 1e6 * Json::parse(file)["peak_memory_mb"].get<double>();
      EXPECT_GT(info[job]["memory_bytes"].get<double>(), bytes / 1.5) << job;
      EXPECT_LT(info[job]["memory_bytes"].get<double>(), bytes * 1.5) << job;
      // Machines differ, and other work beside this makes processors slower, too.
      EXPECT_GT(info[job]["seconds"].get<double>(), seconds / 10) << job;
      EXPECT_LT(info[job]["seconds"].get<double>(), seconds * 10) << job;
    };
    expectNear("skeleton", { "skeleton", scan, "-o", m_Folder / "s.vtp" });
    expectNear("page", { "core", scan, "-o", m_Folder / "a.vtp", "--html", m_Folder / "a.html" });
    EXPECT_GT(info["page"]["seconds"], info["core"]["seconds"]); // the page is of the same core
  }
}

TEST_F(Prediction, WhatIsForetoldIsAllowedAndLessIsRefused)
{
  const std::string scan = m_Folder / "a.nrrd";
  WriteNrrd(scan, ThreeBlocks());
  const auto needed =
    Json::parse(Run({ "info", scan, "--json", "--threads", "1" }))["core"]["memory_bytes"].get<std::uint64_t>();
  const auto core = [&](const std::string & memory) {
    return RunProgram(
      { "core", scan, "-o", m_Folder / "a.vtp", "-q", "--threads", "1", "--force", "--memory", memory });
  };
  EXPECT_EQ(core(std::to_string(needed) + "B").code, 0);
  std::filesystem::remove(m_Folder / "a.vtp");
  ExpectRefusal(core(std::to_string(needed - 1) + "B"), 3, { scan, "needs about", "--memory allows", "--crop" });
  EXPECT_FALSE(std::filesystem::exists(m_Folder / "a.vtp"));
  ExpectRefusal(core("8"), 2, { "--memory 8", "8GB" });
}

TEST_F(Prediction, IsSaidToPeople)
{
  WriteNrrd(m_Folder / "a.nrrd", ThreeBlocks());
  EXPECT_NE(Run({ "info", m_Folder / "a.nrrd", "--threads", "3" }).find("core needs   about "), std::string::npos);
  const std::string text = Run({ "info", m_Folder / "a.nrrd", "--threads", "3" });
  for (const char * words :
       { "(3 threads", "with a page  about ", "skeleton     at most about ", "within a factor of" })
  {
    EXPECT_NE(text.find(words), std::string::npos) << words;
  }
}

} // namespace
} // namespace voxelcore::testing
