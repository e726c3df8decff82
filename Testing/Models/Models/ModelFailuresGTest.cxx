#include "ModelCells.h"
#include "Models/Models/ModelFixtures.h"
#include "VoxelCoreTesting/Messages.h"
#include "VoxelCoreTesting/UnpackedVtp.h"
#include "voxelcore/Models/SkeletonModel.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <random>
#include <utility>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

const std::vector<std::string> kFormats{ "a.vtp", "a.vtk", "a.ply", "a.obj", "a.stl", "a.ma" };

std::string
Quoted(const std::filesystem::path & path)
{
  std::string quoted = "'";
  quoted += path.string();
  quoted += "'";
  return quoted;
}

/** Reading must give InputError in one line that names the file, and print nothing. */
void
ExpectUnreadable(const std::filesystem::path & path)
{
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  const std::string message = MessageOf<InputError>([&] { ReadModel(path); });
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_NE(message.find(Quoted(path)), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

std::string
Replaced(std::string bytes, const std::string & what, const std::string & with)
{
  const auto at = bytes.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? bytes : bytes.replace(at, what.size(), with);
}

} // namespace

TEST(ModelFailures, MissingAndForeignFilesAreRefusedInOneLine)
{
  const TemporaryFolder folder;
  ExpectUnreadable(folder / "missing.vtp");
  ExpectUnreadable(folder.Path());
  WriteAll(folder / "empty.vtp", "");
  ExpectUnreadable(folder / "empty.vtp");
  WriteAll(folder / "text.vtp", "hello\n");
  ExpectUnreadable(folder / "text.vtp");
  WriteModel(folder / "a.vtk", "a.vtk", MixedModel());
  std::filesystem::rename(folder / "a.vtk", folder / "legacy.vtp");
  ExpectUnreadable(folder / "legacy.vtp");
  WriteAll(folder / "foreign.vtp",
           "<VTKFile type=\"PolyData\" version=\"0.1\"><PolyData><Piece NumberOfPoints=\"1\" NumberOfVerts=\"1\">"
           "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0</DataArray></Points>"
           "<Verts><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0</DataArray>"
           "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">1</DataArray></Verts>"
           "</Piece></PolyData></VTKFile>");
  ExpectUnreadable(folder / "foreign.vtp");
  WriteAll(folder / "grid.vtp", "<VTKFile type=\"ImageData\" version=\"0.1\"></VTKFile>");
  ExpectUnreadable(folder / "grid.vtp");
}

TEST(ModelFailures, ATruncatedFileIsRefusedWhereverItEnds)
{
  const TemporaryFolder folder;
  WriteModel(folder / "a.vtp", "a.vtp", MixedModel(), { .triangles = false, .keepEdges = true });
  const std::string packed = ReadAll(folder / "a.vtp");
  for (const std::string & bytes : { packed, UnpackedVtp(packed) })
  {
    // The very last bytes close the XML elements; before them the data must be all there.
    const auto data = bytes.rfind("\n  </AppendedData>");
    ASSERT_NE(data, std::string::npos);
    for (std::size_t length = 0; length < data; length += length < 100 ? 9 : 61)
    {
      SCOPED_TRACE(length);
      WriteAll(folder / "b.vtp", bytes.substr(0, length));
      ExpectUnreadable(folder / "b.vtp");
    }
    WriteAll(folder / "b.vtp", bytes.substr(0, data - 1));
    ExpectUnreadable(folder / "b.vtp");
  }
}

TEST(ModelFailures, BlocksThatCannotBeAreRefusedBeforeMemoryIsAskedFor)
{
  const TemporaryFolder folder;
  WriteModel(folder / "a.vtp", "a.vtp", MixedModel());
  const std::string bytes = ReadAll(folder / "a.vtp");
  const std::size_t begin = bytes.find('_', bytes.find("<AppendedData")) + 1;
  const std::size_t array = bytes.find("Name=\"Radius\"");
  const std::size_t at = begin + std::stoul(bytes.substr(bytes.find("offset=\"", array) + 8, 20));
  // Number of blocks, their size, that of the last, packed size of the first.
  for (const std::size_t number : { 0, 1, 2, 3 })
  {
    for (const std::uint64_t value : { std::uint64_t{ 0 },
                                       std::uint64_t{ 7 },
                                       std::uint64_t{ 1 } << 32U,
                                       std::uint64_t{ 1 } << 61U,
                                       ~std::uint64_t{ 0 } })
    {
      if (number == 1)
      {
        continue; // says nothing where the only block is the last
      }
      SCOPED_TRACE(std::to_string(number) + ": " + std::to_string(value));
      std::string damaged = bytes;
      std::memcpy(damaged.data() + at + 8 * number, &value, sizeof value);
      WriteAll(folder / "b.vtp", damaged);
      ExpectUnreadable(folder / "b.vtp");
    }
  }
}

TEST(ModelFailures, MissingArraysAndWrongSpaceAreRefused)
{
  const TemporaryFolder folder;
  WriteModel(folder / "a.vtp", "a.vtp", MixedModel(), { .triangles = false, .keepEdges = true });
  const std::string bytes = UnpackedVtp(ReadAll(folder / "a.vtp"));
  for (const auto & [what, with] :
       std::vector<std::pair<std::string, std::string>>{ { "Name=\"Radius\"", "Name=\"radius\"" },
                                                         { "Name=\"Lambda\"", "Name=\"lambda\"" },
                                                         { "Name=\"Label\"", "Name=\"label\"" },
                                                         { "Name=\"SPACE\"", "Name=\"SPACf\"" },
                                                         { "Name=\"Units\"", "Name=\"units\"" },
                                                         { "Name=\"EdgeLambda\"", "Name=\"EdgelAmbda\"" },
                                                         { "Name=\"EdgeVertices\"", "Name=\"EdgeVErtices\"" },
                                                         { "LPS", "RAS" },
                                                         { "type=\"PolyData\"", "type=\"PolyDatx\"" } })
  {
    SCOPED_TRACE(what);
    WriteAll(folder / "b.vtp", Replaced(bytes, what, with));
    ExpectUnreadable(folder / "b.vtp");
  }
}

TEST(ModelFailures, NumbersThatNoShapeHasAreRefusedInOneLine)
{
  const TemporaryFolder folder;
  const auto            refused = [&](const std::function<void(ModelPart &)> & change) {
    MedialModel model = MixedModel();
    change(model.parts.front());
    for (const char * name : { "b.vtp", "b.vtk" })
    {
      WriteModel(folder / name, name, model, { .triangles = false, .keepEdges = true });
      ExpectUnreadable(folder / name);
    }
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double value : { -0.25, 1e17, nan, infinity, -infinity })
  {
    SCOPED_TRACE(value);
    refused([&](ModelPart & part) { part.core.radius[2] = value; });
    if (value != 1e17)
    {
      refused([&](ModelPart & part) { part.core.vertexLambda[2] = value; });
      refused([&](ModelPart & part) { part.core.faceLambda[1] = value; });
    }
    if (value != -0.25)
    {
      refused([&](ModelPart & part) { part.core.positions[5][1] = value; }); // alone
      refused([&](ModelPart & part) { part.core.positions[2][0] = value; });
    }
  }
}

TEST(ModelFailures, NumbersThatNoSkeletonHasAreRefusedInOneLine)
{
  const TemporaryFolder folder;
  SkeletonModel         model;
  model.parts.emplace_back();
  SkeletonGraph & graph = model.parts.front().graph;
  graph.positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } };
  graph.radius = { 1, 1, 1 };
  graph.sectionRadius = { 1, 1, 1 };
  graph.erosionThickness = { 0, 0, std::numeric_limits<double>::infinity() };
  SortBranches(graph, { { 0, 1, 2 } }, false);
  model.parts.front().table = MeasureBranches(graph);
  WriteSkeletonVtp(folder / "a.vtp", model);
  EXPECT_EQ(ReadSkeletonVtp(folder / "a.vtp").parts.front().graph.radius, graph.radius);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double value : { -1.0, nan, -std::numeric_limits<double>::infinity() })
  {
    SCOPED_TRACE(value);
    for (auto * values : { &graph.radius, &graph.sectionRadius, &graph.erosionThickness })
    {
      const double before = std::exchange(values->at(1), value);
      WriteSkeletonVtp(folder / "b.vtp", model);
      EXPECT_THROW(ReadSkeletonVtp(folder / "b.vtp"), InputError);
      values->at(1) = before;
    }
  }
  graph.positions[1][2] = nan;
  WriteSkeletonVtp(folder / "b.vtp", model);
  EXPECT_THROW(ReadSkeletonVtp(folder / "b.vtp"), InputError);
}

TEST(ModelFailures, TheNameOfAnArrayStaysOnItsLine)
{
  const TemporaryFolder folder;
  WriteModel(folder / "a.vtp", "a.vtp", MixedModel());
  std::string       bytes = ReadAll(folder / "a.vtp");
  const std::size_t at = bytes.find("Name=\"offsets\"");
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at,
                14,
                "Name=\"off\n\x1b"
                "ts\"");
  WriteAll(folder / "a.vtp", bytes);
  const std::string message = MessageOf([&] { ReadModel(folder / "a.vtp"); });
  EXPECT_EQ(message.find_first_of("\n\x1b"), std::string::npos) << message;
}

TEST(ModelFailures, FacesThatAllMeetAtOneVertexTakeNoLongerThanOthers)
{
  constexpr ElementIndex faces = 200000;
  CellComplex            cells;
  cells.vertexCount = faces + 2;
  for (ElementIndex face = 0; face < faces; ++face)
  {
    cells.faceVertices.insert(cells.faceVertices.end(), { 0, face + 1, face + 2 });
    cells.faceOffsets.push_back(cells.faceVertices.size());
  }
  const std::clock_t begin = std::clock();
  BuildEdges(cells, {});
  EXPECT_LT(std::clock() - begin, 5 * CLOCKS_PER_SEC);
  EXPECT_EQ(cells.edges.size(), 2 * std::size_t{ faces } + 1);
}

TEST(ModelFailures, FlippedBitsNeverCrashNorPrint)
{
  const TemporaryFolder folder;
  WriteModel(folder / "a.vtp", "a.vtp", MixedModel(), { .triangles = false, .keepEdges = true });
  const std::string packed = ReadAll(folder / "a.vtp");
  const std::string plain = UnpackedVtp(packed);
  std::mt19937_64   random(20);
  std::cout << "seed 20\n";
  int refused = 0;
  ::testing::internal::CaptureStderr();
  for (int run = 0; run < 1500; ++run)
  {
    std::string damaged = run % 2 == 0 ? packed : plain;
    for (std::uint64_t flips = 1 + random() % 3; flips > 0; --flips)
    {
      damaged[random() % damaged.size()] ^= static_cast<char>(1U << (random() % 8));
    }
    WriteAll(folder / "b.vtp", damaged);
    try
    {
      const MedialModel read = ReadModel(folder / "b.vtp");
      WriteModel(folder / "c.vtp", "c.vtp", read); // what is accepted fits together
    }
    catch (const InputError & error)
    {
      ++refused;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_GT(refused, 750); // of a plain file most is numbers any of which could be meant
}

TEST(ModelFailures, UnwritablePathsAreOneLineAndNoFile)
{
  const TemporaryFolder folder;
  WriteAll(folder / "file", "x");
  for (const std::string & format : kFormats)
  {
    for (const auto & path : { folder / "no/such/folder/a", folder / "file/a", folder.Path() })
    {
      ::testing::internal::CaptureStderr();
      const std::string message = MessageOf<OutputError>([&] { WriteModel(path, format, MixedModel()); });
      EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
      EXPECT_NE(message.find(Quoted(path)), std::string::npos) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos);
    }
  }
  EXPECT_EQ(ReadAll(folder / "file"), "x");
}

TEST(ModelFailures, DevicesAreRefusedAndLeftAlone)
{
  for (const std::string & format : kFormats)
  {
    EXPECT_THROW(WriteModel("/dev/full", format, MixedModel()), OutputError);
  }
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(ModelFailures, AFullDiskLeavesNoFile)
{
  const TemporaryFolder folder;
  const MedialModel     model = RandomModel(3, 24, 2);
  for (const std::string & format : kFormats)
  {
    WriteModel(folder / "whole", format, model);
    const auto size = std::filesystem::file_size(folder / "whole");
    ASSERT_GT(size, 200000U);
    for (const auto limit : { size - 1, size / 2, std::uintmax_t{ 100 } })
    {
      // In a child of its own: the limit on file sizes cannot be told from a full disk by those who write.
      const pid_t child = fork();
      if (child == 0)
      {
        std::signal(SIGXFSZ, SIG_IGN);
        if (!std::freopen((folder / "stderr").c_str(), "w", stderr))
        {
          _exit(9);
        }
        const rlimit rule{ limit, limit };
        setrlimit(RLIMIT_FSIZE, &rule);
        const std::string message = MessageOf<OutputError>([&] { WriteModel(folder / "part", format, model); });
        const bool good = message.find("cannot write") == 0 && message.find("free some space") != std::string::npos &&
                          message.find('\n') == std::string::npos;
        std::fflush(stderr);
        _exit(good ? 0 : 8);
      }
      int status = 0;
      ASSERT_EQ(waitpid(child, &status, 0), child);
      EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0)
        << format << " limit " << limit << " status " << status;
      EXPECT_FALSE(std::filesystem::exists(folder / "part")) << format << " limit " << limit;
      EXPECT_EQ(ReadAll(folder / "stderr"), "") << format << " limit " << limit;
    }
  }
}

TEST(ModelFailures, ModelsThatDoNotFitTogetherAreRefused)
{
  const TemporaryFolder folder;
  MedialModel           twice = MixedModel();
  twice.parts[1].label = 3;
  EXPECT_THROW(WriteModel(folder / "a.vtp", "a.vtp", twice), Error);
  MedialModel shorter = MixedModel();
  shorter.parts[0].core.radius.pop_back();
  EXPECT_THROW(WriteModel(folder / "a.vtp", "a.vtp", shorter), Error);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.vtp"));
}
