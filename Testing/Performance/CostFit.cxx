// Fits the constants of CostModel to phantoms on this machine, prints them as they stand in CostModel.cxx, and then how far
// they miss on shapes they were not fitted to, and on scans named on the command line.
// usage: VoxelCoreCostFit FOLDER [SCAN...]     FOLDER: for volumes and results, about 100 MB

#include "ChildProcess.h"
#include "voxelcore/CostModel.h"
#include "voxelcore/LabelVolume.h"
#include "voxelcore/OutputNames.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace
{

using namespace voxelcore;
using performance::RunChild;
using Terms = std::array<double, CostTerms::kSize>;
namespace fs = std::filesystem;

struct Phantom
{
  std::string              kind;
  int                      side;
  std::vector<std::string> options;
};

const std::vector<Phantom> fitted{
  { "ellipsoid", 96, {} },
  { "ellipsoid", 320, {} },
  { "torus", 192, {} },
  { "gyroid", 96, {} },
  { "gyroid", 192, {} },
  { "gyroid", 256, { "--thickness", "3" } },
  { "porous", 96, {} },
  { "porous", 160, { "--density", "0.2" } },
  { "root", 192, {} },
  { "root", 448, {} },
  { "shell", 160, {} },
  { "plate", 192, {} },
  { "plate", 256, { "--thickness", "2" } },
  { "box", 128, {} },
  { "noise", 80, {} },
  { "noise", 64, { "--density", "0.1" } },
  { "noise", 48, { "--density", "0.9" } },
};

const std::vector<Phantom> heldOut{
  { "ball", 160, {} },
  { "capsule", 256, {} },
  { "tanglecube", 192, {} },
  { "rod", 192, {} },
  { "ellipsoid", 448, {} },
  { "gyroid", 224, { "--thickness", "4" } },
  { "gyroid", 160, { "--period", "20" } },
  { "porous", 192, {} },
  { "porous", 128, { "--period", "4" } },
  { "root", 384, { "--seed", "5" } },
  { "root", 640, { "--seed", "3" } },
  { "torus", 256, { "--radius", "9" } },
  { "plate", 256, { "--thickness", "9" } },
  { "box", 64, {} },
  { "noise", 64, { "--density", "0.3" } },
  { "noise", 64, { "--density", "0.7" } },
};

struct Run
{
  double bytes;
  double seconds; ///< without reading
};

/** The least of three runs: what others do on the machine only adds. */
Run
RunCore(const fs::path & scan, const fs::path & folder, int threads)
{
  const fs::path report = folder / "report.json";
  Run            least{ 1e300, 1e300 };
  for (int repetition = 0; repetition < 3; ++repetition)
  {
    RunChild({ VOXELCORE_PROGRAM,
               "core",
               scan.string(),
               "-o",
               (folder / "core.vtp").string(),
               "--report",
               report.string(),
               "--threads",
               std::to_string(threads),
               "--force",
               "-q" });
    std::ifstream file(report);
    const auto    json = nlohmann::json::parse(file);
    const auto &  seconds = json.at("seconds");
    least.bytes = std::min(least.bytes, 1e6 * json.at("peak_memory_mb").get<double>());
    least.seconds = std::min(least.seconds, seconds.at("total").get<double>() - seconds.at("read").get<double>());
  }
  return least;
}

fs::path
MakePhantom(const Phantom & phantom, const fs::path & folder)
{
  const fs::path           scan = folder / "phantom.nrrd";
  std::vector<std::string> command{
    VOXELCORE_PROGRAM, "phantom", phantom.kind, "--size", std::to_string(phantom.side), "-o",
    scan.string(),     "--force", "-q"
  };
  command.insert(command.end(), phantom.options.begin(), phantom.options.end());
  RunChild(command);
  return scan;
}

std::vector<BoundaryCounts>
CountScan(const fs::path & scan)
{
  std::vector<BoundaryCounts> counts;
  for (const LabelShape & label : ReadLabelVolume(scan).labels)
  {
    counts.push_back(CountBoundary(label.shape));
  }
  return counts;
}

/** The non-negative constants with the least squares of relative errors, one coordinate at a time. */
Terms
Fit(const std::vector<Terms> & terms, const std::vector<double> & measured)
{
  constexpr std::size_t                n = CostTerms::kSize;
  std::array<std::array<double, n>, n> squares{};
  std::array<double, n>                sums{};
  Terms                                constants{};
  for (std::size_t run = 0; run < terms.size(); ++run)
  {
    for (std::size_t i = 0; i < n; ++i)
    {
      sums[i] += terms[run][i] / measured[run];
      for (std::size_t j = 0; j < n; ++j)
      {
        squares[i][j] += terms[run][i] * terms[run][j] / (measured[run] * measured[run]);
      }
    }
  }
  for (int round = 0; round < 200000; ++round)
  {
    for (std::size_t i = 0; i < n; ++i)
    {
      double rest = sums[i];
      for (std::size_t j = 0; j < n; ++j)
      {
        rest -= squares[i][j] * constants[j];
      }
      constants[i] = std::max(0.0, constants[i] + rest / squares[i][i]);
    }
  }
  return constants;
}

void
PrintConstants(const Terms & constants)
{
  std::printf("  {");
  for (std::size_t i = 0; i < constants.size(); ++i)
  {
    std::printf("%s %.3g", i > 0 ? "," : "", constants[i]);
  }
  std::printf(" },\n");
}

std::string
NameOf(const Phantom & phantom)
{
  std::string name = phantom.kind + " " + std::to_string(phantom.side);
  for (const std::string & option : phantom.options)
  {
    name += " " + option;
  }
  return name;
}

void
PrintRow(const std::string & name, std::uint64_t vertices, const CostPrediction & foretold, const Run & run)
{
  std::printf("| %s | %llu | %.0f | %.0f | %+.0f %% | %.2f | %.2f | %+.0f %% |\n",
              name.c_str(),
              static_cast<unsigned long long>(vertices),
              static_cast<double>(foretold.memoryBytes) / 1e6,
              run.bytes / 1e6,
              100 * (static_cast<double>(foretold.memoryBytes) / run.bytes - 1),
              foretold.seconds,
              run.seconds,
              100 * (foretold.seconds / run.seconds - 1));
  std::fflush(stdout);
}

void
FitAndPrint(const fs::path & folder)
{
  std::vector<Terms>  terms;
  std::vector<double> bytes;
  std::vector<double> seconds;
  std::vector<double> serial;
  for (const Phantom & phantom : fitted)
  {
    const fs::path scan = MakePhantom(phantom, folder);
    const Run      one = RunCore(scan, folder, 1);
    terms.push_back(ComputeCostTerms(CountScan(scan).at(0)).values);
    bytes.push_back(one.bytes);
    seconds.push_back(one.seconds);
    if (one.seconds > 0.5)
    {
      // seconds of two threads = seconds of one * (serial + (1 - serial) / 2)
      serial.push_back(2 * RunCore(scan, folder, 2).seconds / one.seconds - 1);
    }
  }
  std::sort(serial.begin(), serial.end());
  std::printf("constexpr CostConstants kFitted{\n");
  PrintConstants(Fit(terms, bytes));
  PrintConstants(Fit(terms, seconds));
  std::printf("  %.2g,\n};\n\n", serial[serial.size() / 2]);
}

/** With the constants that are compiled in. */
void
PrintMisses(const fs::path & folder, int scans, char ** scan)
{
  std::printf(
    "| shape | boundary vertices | MB foretold | measured | miss | s foretold | measured | miss |\n"
    "| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  CoreOptions options;
  options.lambdas = ParseLambdas("1.5vox");
  options.output = folder / "core.vtp";
  const auto print = [&](const std::string & name, const fs::path & path, int threads) {
    const auto    counts = CountScan(path);
    std::uint64_t vertices = 0;
    for (const BoundaryCounts & one : counts)
    {
      vertices += one.vertices;
    }
    PrintRow(name + ", " + std::to_string(threads) + (threads == 1 ? " thread" : " threads"),
             vertices,
             PredictJob(counts, options, threads),
             RunCore(path, folder, threads));
  };
  for (const Phantom & phantom : heldOut)
  {
    const fs::path path = MakePhantom(phantom, folder);
    print(NameOf(phantom), path, 1);
    print(NameOf(phantom), path, 2);
  }
  for (int i = 0; i < scans; ++i)
  {
    print(ScanName(scan[i]), scan[i], 2);
  }
}

} // namespace

int
main(int argc, char ** argv)
{
  if (argc < 2)
  {
    std::fprintf(stderr, "usage: VoxelCoreCostFit FOLDER [SCAN...]\n");
    return 2;
  }
  try
  {
    fs::create_directories(argv[1]);
    FitAndPrint(argv[1]);
    PrintMisses(argv[1], argc - 2, argv + 2);
  }
  catch (const std::exception & error)
  {
    std::fprintf(stderr, "VoxelCoreCostFit: %s\n", error.what());
    return 1;
  }
  return 0;
}
