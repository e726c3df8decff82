// How fast scans are read: file -> voxel shape -> boundary vertices, format by format, each run a process of its own,
// beside zlib's inflate alone on the same file; and an atlas of 724 labels beside the same file as one label.

#include "ChildProcess.h"
#include "ReadingTasks.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace voxelcore::performance
{
namespace
{

struct Choice
{
  std::string           size = "1560,789,1041";
  std::string           atlas = "/usr/share/mricron/templates/inia19-NeuroMaps.nii.gz";
  std::filesystem::path folder; // kept when given
  int                   repetitions = 3;
};

/** What a reading child prints: seconds and processor seconds of reading, seconds of the boundary vertices, their
 *  number, voxels, labels, peak MB. Of several runs the one that read quickest. */
struct Reading
{
  double seconds = std::numeric_limits<double>::infinity();
  double cpuSeconds = 0;
  double boundarySeconds = 0;
  double vertices = 0;
  double voxels = 0;
  double labels = 0;
  double megabytes = 0;
};

Reading
Read(const std::string & self, const std::string & scan, const std::string & how, int repetitions)
{
  Reading best;
  for (int i = 0; i < repetitions; ++i)
  {
    std::istringstream text(RunChild({ self, "--task", "read", scan, how }).output);
    Reading            one;
    if (!(text >> one.seconds >> one.cpuSeconds >> one.boundarySeconds >> one.vertices >> one.voxels >> one.labels >>
          one.megabytes))
    {
      throw std::runtime_error("no figures of " + scan);
    }
    best = one.seconds < best.seconds ? one : best;
  }
  return best;
}

struct Inflating
{
  double seconds = std::numeric_limits<double>::infinity();
  double cpuSeconds = 0;
};

Inflating
InflateAlone(const std::string & self, const std::string & scan, int repetitions)
{
  Inflating best;
  for (int i = 0; i < repetitions; ++i)
  {
    std::istringstream text(RunChild({ self, "--task", "inflate", scan }).output);
    Inflating          one;
    if (!(text >> one.seconds >> one.cpuSeconds))
    {
      throw std::runtime_error("no figures of " + scan);
    }
    best = one.seconds < best.seconds ? one : best;
  }
  return best;
}

double
Megabytes(const std::filesystem::path & path)
{
  double bytes = 0;
  if (std::filesystem::is_directory(path))
  {
    for (const auto & entry : std::filesystem::directory_iterator(path))
    {
      bytes += static_cast<double>(entry.file_size());
    }
    return bytes * 1e-6;
  }
  return static_cast<double>(std::filesystem::file_size(path)) * 1e-6;
}

void
PrintRow(const std::string & name, double fileMegabytes, const Reading & r, const std::optional<Inflating> & inflate)
{
  std::printf("%-22s %9.1f %8.3f %8.3f %10.0f %10.0f %9.3f %8.0f",
              name.c_str(),
              fileMegabytes,
              r.seconds,
              r.cpuSeconds,
              1e-6 * r.voxels / r.seconds,
              1e-6 * r.voxels / r.cpuSeconds,
              r.boundarySeconds,
              r.megabytes);
  if (inflate)
  {
    std::printf(" %9.3f %6.2f %8.3f %6.2f",
                inflate->seconds,
                r.seconds / inflate->seconds,
                inflate->cpuSeconds,
                r.cpuSeconds / inflate->cpuSeconds);
  }
  std::printf("\n");
  std::fflush(stdout);
}

void
PrintHeader(const std::string & what)
{
  std::printf("\n%s\n\n%-22s %9s %8s %8s %10s %10s %9s %8s %9s %6s %8s %6s\n",
              what.c_str(),
              "format",
              "file MB",
              "read s",
              "cpu s",
              "Mvoxel/s",
              "and core",
              "vertices",
              "peak MB",
              "inflate s",
              "ratio",
              "cpu s",
              "ratio");
}

void
CompareLabels(const std::string & self, const Choice & choice)
{
  if (!std::filesystem::exists(choice.atlas))
  {
    std::printf("\n%s is not there: many labels are not compared with one (package mricron-data)\n",
                choice.atlas.c_str());
    return;
  }
  PrintHeader("An atlas, all labels and as one");
  const double    megabytes = Megabytes(choice.atlas);
  const Inflating inflate = InflateAlone(self, choice.atlas, choice.repetitions);
  const auto      many = Read(self, choice.atlas, "labels", choice.repetitions);
  const auto      one = Read(self, choice.atlas, "binary", choice.repetitions);
  PrintRow(std::to_string(static_cast<int>(many.labels)) + " labels", megabytes, many, inflate);
  PrintRow("1 label", megabytes, one, inflate);
}

Choice
Parse(int argc, char ** argv)
{
  Choice choice;
  for (int i = 1; i + 1 < argc; i += 2)
  {
    const std::string name = argv[i];
    const std::string value = argv[i + 1];
    if (name == "--size")
    {
      choice.size = value;
    }
    else if (name == "--atlas")
    {
      choice.atlas = value;
    }
    else if (name == "--folder")
    {
      choice.folder = value;
    }
    else if (name == "--repetitions")
    {
      choice.repetitions = std::max(1, std::stoi(value));
    }
    else
    {
      throw std::invalid_argument("unknown option " + name);
    }
  }
  if (argc % 2 == 0)
  {
    throw std::invalid_argument("each option needs a value: --size X,Y,Z --repetitions N --folder DIR --atlas FILE");
  }
  return choice;
}

int
Run(int argc, char ** argv)
{
  Choice            choice = Parse(argc, argv);
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  const bool        keep = !choice.folder.empty();
  if (!keep)
  {
    std::string pattern = (std::filesystem::temp_directory_path() / "voxelcore-reading-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
    {
      throw std::runtime_error("cannot make a temporary folder");
    }
    choice.folder = pattern;
  }
  int failed = 0;
  try
  {
    const std::string folder = choice.folder.string();
    std::fprintf(stderr, "writing %s voxels of a root in every format to %s\n", choice.size.c_str(), folder.c_str());
    RunChild({ self, "--task", "write", choice.size, folder });
    PrintHeader("A root of " + choice.size + " voxels, best of " + std::to_string(choice.repetitions));
    for (const auto & [name, file, packed] : ReadingScans())
    {
      const std::string        scan = folder + '/' + file;
      std::optional<Inflating> inflate;
      if (packed)
      {
        inflate = InflateAlone(self, scan, choice.repetitions);
      }
      PrintRow(name, Megabytes(scan), Read(self, scan, "labels", choice.repetitions), inflate);
    }
    CompareLabels(self, choice);
  }
  catch (const std::exception & error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    failed = 1;
  }
  if (!keep)
  {
    std::filesystem::remove_all(choice.folder);
  }
  return failed;
}

} // namespace
} // namespace voxelcore::performance

int
main(int argc, char ** argv)
{
  try
  {
    if (argc > 1 && std::string(argv[1]) == "--task")
    {
      return voxelcore::performance::RunReadingTask(argc, argv);
    }
    return voxelcore::performance::Run(argc, argv);
  }
  catch (const std::exception & error)
  {
    std::cerr << error.what() << '\n';
    return 2;
  }
}
