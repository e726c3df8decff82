// One whole file, damaged in memory again and again, and read: thousands a second. What is no InputError of one line, a
// crash, more than ten seconds of processor time, two minutes or 2 GB is found.
//
// usage: DamagedReads scan|mesh|model|skeleton|manifest|changes FOLDER NAME FIRST_SEED COUNT
// The damaged file stands in /dev/shm while it is read; its seed makes it again. Prints "READ REFUSED".

#include "ReadByKind.h"

#include "VoxelCoreTesting/Random.h"

#include "voxelcore/Base/Error.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

using namespace voxelcore;
using voxelcore::testing::Random;
using voxelcore::testing::ReadByKind;
using voxelcore::testing::StagedFile;

namespace
{

volatile std::uint64_t s_Seed = 0;

void
OnSignal(int signal)
{
  char      text[80];
  const int length =
    std::snprintf(text, sizeof(text), "seed %llu: signal %d\n", static_cast<unsigned long long>(s_Seed), signal);
  static_cast<void>(!write(STDOUT_FILENO, text, static_cast<std::size_t>(length)));
  _exit(1);
}

/** A signal ends the process after these seconds; 0: not any more. Processor time first: others may use the machine. */
void
Limit(unsigned ofProcessor, unsigned ofTime)
{
  const itimerval when{ { 0, 0 }, { static_cast<time_t>(ofProcessor), 0 } };
  setitimer(ITIMER_PROF, &when, nullptr);
  alarm(ofTime);
}

/** One to four changes; half of them where headers are. */
std::string
Damaged(std::string bytes, std::uint64_t seed)
{
  static const std::string numbers[] = { "-1",
                                         "0",
                                         "1",
                                         "7",
                                         "255",
                                         "65536",
                                         "2147483647",
                                         "2147483648",
                                         "4294967295",
                                         "4294967296",
                                         "1e308",
                                         "9223372036854775807",
                                         "nan",
                                         "inf",
                                         "",
                                         "18446744073709551616",
                                         "-9223372036854775808" };
  Random                   random(seed);
  const auto               below = [&](std::size_t most) {
    return static_cast<std::size_t>(random.Between(0, static_cast<std::int64_t>(most) - 1));
  };
  for (std::int64_t changes = random.Between(1, random.Chance(0.5) ? 1 : 4); changes > 0 && !bytes.empty(); --changes)
  {
    const std::size_t at = random.Chance(0.5) ? below(std::min<std::size_t>(bytes.size(), 600)) : below(bytes.size());
    switch (below(8))
    {
      case 0:
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 2:
        bytes[at] = static_cast<char>(random.Next());
        break;
      case 3:
        bytes.erase(at, 1 + below(40));
        break;
      case 4:
        bytes.insert(at, bytes.substr(below(bytes.size()), 1 + below(100)));
        break;
      case 5:
        for (std::size_t i = at; i < std::min(at + (std::size_t{ 1 } << below(4)), bytes.size()); ++i)
        {
          bytes[i] = random.Chance(0.5) ? '\xFF' : '\x7F';
        }
        break;
      case 6:
        if (random.Chance(0.3))
        {
          bytes.resize(at);
        }
        break;
      default:
      {
        const std::size_t begin = bytes.find_first_of("0123456789", at);
        if (begin != std::string::npos)
        {
          const std::size_t end = std::min(bytes.find_first_not_of("0123456789.-e", begin), bytes.size());
          bytes.replace(begin, end - begin, numbers[below(std::size(numbers))]);
        }
      }
    }
  }
  return bytes;
}

} // namespace

int
main(int argc, char ** argv)
{
  if (argc != 6)
  {
    std::cerr << "usage: DamagedReads scan|mesh|model|skeleton|manifest|changes FOLDER NAME FIRST_SEED COUNT\n";
    return 2;
  }
  const std::string           kind = argv[1];
  const std::filesystem::path folder = argv[2];
  const std::filesystem::path name = argv[3];
  std::ifstream               file(folder / name, std::ios::binary);
  const std::string           whole{ std::istreambuf_iterator<char>(file), {} };
  const std::uint64_t         first = std::strtoull(argv[4], nullptr, 10);
  const std::uint64_t         count = std::strtoull(argv[5], nullptr, 10);
  const StagedFile            staged(folder, name);
  const rlimit                memory{ rlim_t{ 2 } << 30, rlim_t{ 2 } << 30 };
  setrlimit(RLIMIT_AS, &memory);
  for (const int signal : { SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM, SIGPROF })
  {
    std::signal(signal, OnSignal);
  }
  ReadByKind(kind, staged.Read()); // whole, it must be taken
  std::uint64_t refused = 0;
  int           found = 0;
  for (std::uint64_t at = first; at < first + count; ++at)
  {
    s_Seed = at;
    const std::string damaged = Damaged(whole, at);
    staged.Write(damaged.data(), damaged.size());
    Limit(10, 120);
    std::string trouble;
    try
    {
      ReadByKind(kind, staged.Read());
    }
    catch (const InputError & error)
    {
      ++refused;
      const std::string said = error.what();
      trouble = said.empty() || said.find('\n') != std::string::npos ? "not one line: " + said : "";
    }
    catch (const std::exception & error)
    {
      trouble = std::string("no InputError, but ") + error.what();
    }
    Limit(0, 0);
    if (!trouble.empty())
    {
      std::cout << "seed " << at << ": " << trouble << std::endl;
      ++found;
    }
  }
  std::cout << count - refused << " " << refused << std::endl;
  return found > 0 ? 1 : 0;
}
