// A batch that is killed again and again ends with what an undisturbed one gives.

#include "CohortFolder.h"
#include "Program.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iostream>
#include <random>
#include <thread>

namespace voxelcore::testing
{
namespace
{

/** Processes whose parent is `process`. */
std::vector<pid_t>
ChildrenOf(pid_t process)
{
  std::vector<pid_t> children;
  std::ifstream      file("/proc/" + std::to_string(process) + "/task/" + std::to_string(process) + "/children");
  for (pid_t child = 0; file >> child;)
  {
    children.push_back(child);
  }
  return children;
}

/** Kills the batch, or one of its cases and then the batch, `kills` times at random moments of the work: until
 *  `longest`
 * after a start. What comes to its end before it is hit begins anew. Returns how often it hit. */
int
KillAtRandom(const std::vector<std::string> & arguments,
             const std::filesystem::path &    output,
             int                              kills,
             std::chrono::milliseconds        longest,
             unsigned                         seed)
{
  std::mt19937 random(seed);
  int          hits = 0;
  for (int tries = 0; hits < kills && tries < 20 * kills; ++tries)
  {
    const auto delay = std::chrono::milliseconds(random() % longest.count());
    const bool child = random() % 4 == 0;
    const auto start = std::chrono::steady_clock::now();
    bool       sent = false;
    const auto result = RunProgram(arguments, {}, [&](pid_t process, const std::string &) {
      if (!sent && std::chrono::steady_clock::now() - start >= delay)
      {
        const auto children = ChildrenOf(process);
        const bool hitChild = child && !children.empty();
        sent = kill(hitChild ? children[random() % children.size()] : process, SIGKILL) == 0;
        if (hitChild)
        {
          std::this_thread::sleep_for(std::chrono::milliseconds(random() % 30));
          kill(process, SIGKILL);
        }
      }
    });
    if (result.signal == SIGKILL)
    {
      ++hits;
    }
    else
    {
      std::filesystem::remove_all(output);
    }
  }
  return hits;
}

void
ExpectTheSameAfterKills(unsigned cases, int kills, unsigned seed)
{
  std::cout << "seed " << seed << "\n";
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "scans");
  WriteTinyScans(folder / "scans", cases);
  WriteAll(folder / "scans/bad.nrrd", "no scan");
  const std::vector<std::string> batch{ "batch", folder / "scans", "-o", folder / "out", "--jobs", "2" };
  const auto                     start = std::chrono::steady_clock::now();
  ASSERT_EQ(RunProgram(batch).code, 1); // the bad one
  const auto whole = std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - start);
  const auto undisturbed = FolderContents(folder / "out");
  std::filesystem::remove_all(folder / "out");
  const auto longest = std::max(std::chrono::milliseconds(20), 2 * whole / kills);
  EXPECT_EQ(KillAtRandom(batch, folder / "out", kills, longest, seed), kills);
  ASSERT_EQ(RunProgram(batch).code, 1);
  const auto after = FolderContents(folder / "out");
  EXPECT_EQ(after.size(), undisturbed.size());
  for (const auto & [name, text] : undisturbed)
  {
    const auto found = after.find(name);
    ASSERT_NE(found, after.end()) << name << " is missing";
    EXPECT_EQ(found->second, text) << name;
  }
}

// As systems do that run out of memory: one case's end is not the batch's.
TEST(BatchKill, ACaseInterruptedFromOutsideFailsAlone)
{
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "in");
  ASSERT_EQ(RunProgram({ "phantom", "gyroid", "--size", "256", "-o", folder / "in/large.nrrd" }).code, 0);
  WriteTinyScans(folder / "in", 2);
  bool       sent = false;
  const auto result = RunProgram({ "batch", folder / "in", "-o", folder / "out", "--jobs", "1" },
                                 {},
                                 [&](pid_t process, const std::string &) {
                                   const auto children = ChildrenOf(process);
                                   // The large scan's is the first case, and takes seconds.
                                   sent = sent || (!children.empty() && kill(children.front(), SIGTERM) == 0);
                                 });
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.output.find("2 of 3 cases done"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("large: interrupted from outside"), std::string::npos) << result.output;
}

TEST(BatchKill, FiveKillsChangeNothing)
{
  ExpectTheSameAfterKills(8, 5, 20261121);
}

TEST(HeavyBatchKill, FiftyKillsInABatchOfAHundredCasesChangeNothing)
{
  ExpectTheSameAfterKills(100, 50, 4711);
}

} // namespace
} // namespace voxelcore::testing
