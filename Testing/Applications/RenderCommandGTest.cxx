// `voxelcore render` as a user without a screen runs it.

#include "VoxelCoreTesting/TemporaryFolder.h"
#include "Pictures.h"
#include "Program.h"
#include "Scans.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <gtest/gtest.h>

namespace voxelcore::testing
{
namespace
{

using Names = std::set<std::string>;

/** Children of a process that are called Xvfb. */
std::vector<pid_t>
ServersOf(pid_t parent)
{
  std::vector<pid_t> found;
  for (const auto & entry : std::filesystem::directory_iterator("/proc"))
  {
    std::ifstream file(entry.path() / "stat");
    pid_t         process = 0;
    std::string   name;
    char          state = 0;
    pid_t         owner = 0;
    if (file >> process >> name >> state >> owner && owner == parent && name == "(Xvfb)" && state != 'Z')
    {
      found.push_back(process);
    }
  }
  return found;
}

bool
IsRunning(pid_t process)
{
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  pid_t         same = 0;
  std::string   name;
  char          state = 'Z';
  file >> same >> name >> state;
  return state != 'Z';
}

/** A small block to the patient's right and back, a large one to the left and in front, one label; and its core. */
class RenderCommand : public ::testing::Test
{
protected:
  void
  SetUp() override
  {
    if (std::system("command -v Xvfb >/dev/null") != 0)
    {
      GTEST_SKIP() << "Xvfb is not installed";
    }
    unsetenv("DISPLAY");
    TestScan scan({ 44, 36, 24 });
    scan.Fill({ 2, 28, 10 }, { 7, 33, 15 }, 1);
    scan.Fill({ 20, 2, 2 }, { 41, 21, 21 }, 1);
    WriteNrrd(m_Folder / "s.nrrd", scan);
    Run({ "core", m_Folder / "s.nrrd", "-o", m_Folder / "c.vtp", "--lambda", "0", "--quiet" });
  }

  static ProgramResult
  Run(const std::vector<std::string> & arguments)
  {
    const ProgramResult result = RunProgram(arguments);
    EXPECT_EQ(result.code, 0) << result.error;
    EXPECT_EQ(result.error, "");
    return result;
  }

  Image
  Draw(std::vector<std::string> arguments)
  {
    for (const std::string word : { "render", "--size", "480x360", "--force", "-o" })
    {
      arguments.insert(word == "render" ? arguments.begin() : arguments.end(), word);
    }
    arguments.push_back(m_Folder / "p.png");
    Run(arguments);
    return ReadPng(m_Folder / "p.png");
  }

  TemporaryFolder m_Folder;
};

TEST_F(RenderCommand, ThickPartsAreOrangeAndWhereTheyBelong)
{
  const Image front = Draw({ m_Folder / "c.vtp", "--view", "front" });
  EXPECT_EQ(front.width, 480);
  EXPECT_EQ(front.height, 360);
  ASSERT_GT(Find(front, IsOrange).count, 50);
  ASSERT_GT(Find(front, IsViolet).count, 50);
  // The patient's left, where the thick block is, is on the picture's right.
  const Spot all = Find(front, IsDrawn);
  EXPECT_GT(Find(front, IsOrange).x, all.x);
  // From above, the front is up, and the patient's left on the left.
  const Image top = Draw({ m_Folder / "c.vtp", "--view", "top" });
  const int   middle = (Find(top, IsDrawn).top + Find(top, IsDrawn).bottom) / 2;
  EXPECT_LT(Find(top, IsOrange).y, middle);
  EXPECT_LT(Find(top, IsOrange).x, (Find(top, IsDrawn).left + Find(top, IsDrawn).right) / 2);
}

TEST_F(RenderCommand, LinesBesideFacesHaveTheirColor)
{
  // Below, a rod one voxel thick: its core is a line, without normals that light could fall on. Above, a block.
  TestScan scan({ 40, 12, 30 });
  scan.Fill({ 3, 6, 4 }, { 36, 6, 4 }, 1);
  scan.Fill({ 3, 2, 20 }, { 36, 9, 27 }, 1);
  WriteNrrd(m_Folder / "rod.nrrd", scan);
  Run({ "core", m_Folder / "rod.nrrd", "-o", m_Folder / "rod.vtp", "--lambda", "0", "--quiet" });
  Image      image = Draw({ m_Folder / "rod.vtp", "--view", "front" });
  const Spot all = Find(image, IsDrawn);
  std::fill_n(image.pixels.begin(), 3 * image.width * ((all.top + all.bottom) / 2), std::uint8_t{ 255 });
  EXPECT_GT(Find(image, IsViolet).count, 100);
  EXPECT_EQ(Find(image, [](const auto & c) { return std::max({ c[0], c[1], c[2] }) < 75; }).count, 0);
}

TEST_F(RenderCommand, ProportionsAreThoseOfTheScan)
{
  const Spot spot = Find(Draw({ m_Folder / "c.vtp", "--scan", m_Folder / "s.nrrd", "--view", "front" }), IsDrawn);
  // The two blocks together: 40 by 20 mm.
  EXPECT_NEAR((spot.right - spot.left + 1.0) / (spot.bottom - spot.top + 1.0), 2.0, 0.12);
}

TEST_F(RenderCommand, ADarkBackgroundIsDarkAndFrameNumbersRunThroughTheTurn)
{
  EXPECT_EQ(Draw({ m_Folder / "c.vtp", "--background", "dark" }).At(3, 3), (std::array{ 0, 0, 0 }));
  EXPECT_EQ(Draw({ m_Folder / "c.vtp" }).At(3, 3), (std::array{ 255, 255, 255 }));
  Run({ "render", m_Folder / "c.vtp", "--turntable", "3", "--size", "200x150", "-o", m_Folder / "t.png" });
  EXPECT_EQ(m_Folder.Names(), (Names{ "c.vtp", "p.png", "s.nrrd", "t_000.png", "t_001.png", "t_002.png" }));
  EXPECT_NE(ReadAll(m_Folder / "t_000.png"), ReadAll(m_Folder / "t_001.png"));
}

TEST_F(RenderCommand, TheScaleBarIsAsLongAsItSaysAndDirectionsAreGiven)
{
  const auto  isDark = [](const auto & c) { return std::max({ c[0], c[1], c[2] }) < 90; };
  const Image front = Draw({ m_Folder / "c.vtp", "--scan", m_Folder / "s.nrrd", "--view", "front" });
  const Image top = Draw({ m_Folder / "c.vtp", "--scan", m_Folder / "s.nrrd", "--view", "top" });
  // The longest dark line of pixels in the lower right corner; the two blocks together are 40 mm wide.
  int longest = 0;
  for (int y = front.height * 93 / 100; y < front.height; ++y)
  {
    for (int x = front.width * 84 / 100, run = 0; x < front.width; ++x)
    {
      run = isDark(front.At(x, y)) ? run + 1 : 0;
      longest = std::max(longest, run);
    }
  }
  const Spot   all = Find(front, IsDrawn);
  const double bar = 40.0 * longest / (all.right - all.left + 1);
  EXPECT_TRUE(std::abs(bar - 10) < 0.4 || std::abs(bar - 5) < 0.3 || std::abs(bar - 20) < 0.8) << bar << " mm";
  const auto isGrey = [](const auto & c) { return std::max({ c[0], c[1], c[2] }) < 200; }; // small letters are
  // Letters at the cross in the lower right corner: other ones from another side.
  int letters = 0;
  int changed = 0;
  for (int y = front.height * 70 / 100; y < front.height; ++y)
  {
    for (int x = front.width * 82 / 100; x < front.width; ++x)
    {
      letters += isGrey(front.At(x, y));
      changed += isGrey(front.At(x, y)) != isGrey(top.At(x, y));
    }
  }
  EXPECT_GT(letters, 60);
  EXPECT_GT(changed, 20);
}

TEST_F(RenderCommand, EachColoringAndEachViewShowsSomethingElse)
{
  std::set<std::vector<std::uint8_t>> pictures;
  for (const std::string color : { "Radius", "Lambda", "Label" })
  {
    const Image image = Draw({ m_Folder / "c.vtp", "--color", color, "--view", "front" });
    EXPECT_GT(Find(image, [](const auto & c) { return std::abs(c[0] - c[2]) > 30; }).count, 500) << color;
    pictures.insert(image.pixels);
  }
  for (const std::string view : { "top", "iso", "auto" })
  {
    pictures.insert(Draw({ m_Folder / "c.vtp", "--view", view }).pixels);
  }
  EXPECT_EQ(pictures.size(), 6U);
}

TEST_F(RenderCommand, PanelsShowSurfaceMedialSurfaceAndCurveSkeleton)
{
  Run({ "skeleton", m_Folder / "c.vtp", "-o", m_Folder / "k.vtp", "--quiet" });
  // They are twice as wide as high: one above the other.
  const Image image = Draw({ m_Folder / "c.vtp",
                             m_Folder / "k.vtp",
                             "--scan",
                             m_Folder / "s.nrrd",
                             "--panels",
                             "--view",
                             "front",
                             "--color",
                             "ErosionThickness" });
  const auto  isColored = [](const auto & c) { return std::abs(c[0] - c[2]) > 30; };
  for (int i = 0; i < 3; ++i)
  {
    const int top = image.height * i / 3 + 20; // below the title
    const int bottom = image.height * (i + 1) / 3;
    EXPECT_GT(Find(image, IsDrawn, top, bottom, 74).count, 300) << i;
    EXPECT_TRUE((Find(image, isColored, top, bottom, 74).count > 20) == (i > 0)) << i; // the surface alone is grey
  }
}

TEST_F(RenderCommand, PanelsAreFilledByWhatTheyShow)
{
  const std::string target = m_Folder / "panels.png";
  Run({ "render", m_Folder / "c.vtp", "--scan", m_Folder / "s.nrrd", "--panels", "--view", "front", "-o", target });
  const Image image = ReadPng(target);
  EXPECT_LE(image.width, 1600);
  EXPECT_LE(image.height, 1200);
  const int text = image.height / 40; // about; titles are two high
  for (int i = 0; i < 2; ++i)
  {
    const int  top = image.height * i / 2 + 2 * text;
    const int  bottom = image.height * (i + 1) / 2;
    const Spot spot = Find(image, IsDrawn, top, bottom);
    EXPECT_GT(spot.right - spot.left, image.width * 78 / 100) << i;
    EXPECT_GT(spot.bottom - spot.top, (bottom - top) * 85 / 100) << i;
  }
}

TEST_F(RenderCommand, LooseLinesAreAboutOnePixelWideAndCurvesThicker)
{
  TestScan scan({ 60, 12, 12 });
  scan.Fill({ 3, 6, 6 }, { 56, 6, 6 }, 1);
  WriteNrrd(m_Folder / "rod.nrrd", scan);
  Run({ "core", m_Folder / "rod.nrrd", "-o", m_Folder / "rod.vtp", "--lambda", "0", "--quiet" });
  Run({ "skeleton", m_Folder / "rod.nrrd", "-o", m_Folder / "k.vtp", "--quiet" });
  const auto width = [this](const std::string & file, const std::string & ground) {
    const Image image = Draw({ m_Folder / file, "--view", "front", "--background", ground });
    const Spot  spot = Find(image, [&](const auto & c) { return std::abs(c[0] - c[1]) > 20; });
    double      sum = 0; // of the colour of which a line has least
    const int   from = spot.left + (spot.right - spot.left) / 4;
    const int   to = spot.right - (spot.right - spot.left) / 4;
    for (int x = from; x < to; ++x)
    {
      for (int y = 0; y < image.height; ++y)
      {
        const auto & c = image.At(x, y);
        sum += ground == "white" ? (255 - std::min({ c[0], c[1], c[2] })) / 255.0 : c[0] / 180.0;
      }
    }
    return sum / (to - from);
  };
  EXPECT_GT(width("rod.vtp", "white"), 0.7);
  EXPECT_LT(width("rod.vtp", "white"), 1.5);
  EXPECT_GT(width("rod.vtp", "dark"), 0.7);
  EXPECT_GT(width("k.vtp", "white"), 2);
}

TEST_F(RenderCommand, AFewExtremesDoNotTakeTheColorsFromTheRest)
{
  // A wide wedge, two to ten voxels thick, and beside it a small cube, sixteen thick.
  TestScan scan({ 160, 150, 22 });
  for (std::size_t x = 2; x < 140; ++x)
  {
    scan.Fill({ x, 2, 2 }, { x, 147, 3 + 8 * x / 140 }, 1);
  }
  scan.Fill({ 143, 60, 3 }, { 158, 75, 18 }, 1);
  WriteNrrd(m_Folder / "e.nrrd", scan);
  Run({ "core", m_Folder / "e.nrrd", "-o", m_Folder / "e.vtp", "--lambda", "1vox", "--quiet" });
  const auto orange = [this](const std::vector<std::string> & options) {
    std::vector<std::string> all{ m_Folder / "e.vtp", "--view", "top" };
    all.insert(all.end(), options.begin(), options.end());
    return Find(Draw(all), IsOrange).count;
  };
  const int byDefault = orange({});
  EXPECT_GT(byDefault, 4 * orange({ "--range", "0%:100%" }));
  EXPECT_EQ(byDefault, orange({ "--range", "2%:98%" }));
  EXPECT_EQ(byDefault, orange({ "--each-label" })); // there is one
  EXPECT_EQ(orange({ "--range", "90:91" }), 0);
}

TEST_F(RenderCommand, ItsServerEndsWithItAlsoWhenInterrupted)
{
  for (const int signal : { 0, SIGTERM, SIGKILL })
  {
    std::set<pid_t> servers;
    bool            sent = false;
    const auto      result =
      RunProgram({ "render",
                   m_Folder / "c.vtp",
                   "--turntable",
                   signal == 0 ? "3" : "400",
                   "--size",
                   "200x150",
                   "--force",
                   "--progress",
                   "plain",
                   "-o",
                   m_Folder / "t.png" },
                 {},
                 [&](pid_t process, const std::string & error) {
                   for (const pid_t server : ServersOf(process))
                   {
                     servers.insert(server);
                   }
                   if (signal != 0 && !sent && !servers.empty() && error.find("drawing") != std::string::npos)
                   {
                     sent = true;
                     kill(process, signal);
                   }
                 });
    EXPECT_EQ(servers.size(), 1U);
    EXPECT_EQ(result.code, signal == 0 ? 0 : signal == SIGTERM ? 130 : -1) << result.error;
    for (int wait = 0; wait < 100 && std::any_of(servers.begin(), servers.end(), IsRunning); ++wait)
    {
      usleep(20000);
    }
    EXPECT_TRUE(std::none_of(servers.begin(), servers.end(), IsRunning)) << signal;
    if (signal == SIGTERM)
    {
      EXPECT_EQ(m_Folder.Names(), (Names{ "c.vtp", "s.nrrd", "t_000.png", "t_001.png", "t_002.png" }));
    }
  }
}

TEST_F(RenderCommand, WhereItsServerDiesOneLineSaysSoAndNothingIsLeft)
{
  // Xlib ends a program whose server is gone, by itself and without a word.
  const Names before = m_Folder.Names();
  int         failed = 0;
  for (int delay = 0; delay < 12 && failed < 3; ++delay)
  {
    int                 looks = 0;
    const ProgramResult result =
      RunProgram({ "render", m_Folder / "c.vtp", "--turntable", "40", "-o", m_Folder / "t.png" },
                 {},
                 [&](pid_t process, const std::string &) {
                   const auto servers = ServersOf(process);
                   if (!servers.empty() && ++looks > delay)
                   {
                     kill(servers.front(), SIGKILL);
                   }
                 });
    if (result.code == 0)
    {
      break;
    }
    ++failed;
    ExpectRefusal(result, 1, {});
    EXPECT_EQ(m_Folder.Names(), before) << result.error;
  }
  EXPECT_GT(failed, 0);
}

TEST_F(RenderCommand, WithoutADisplayAndWithoutXvfbOneLineSaysSo)
{
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  const ProgramResult result = RunProgram({ "render", m_Folder / "c.vtp", "-o", m_Folder / "p.png" });
  setenv("PATH", path.c_str(), 1);
  ExpectRefusal(result, 1, { "no display", "Xvfb", "install" });
  EXPECT_EQ(m_Folder.Names(), (Names{ "c.vtp", "s.nrrd" }));
}

TEST_F(RenderCommand, BadInputIsRefusedInOneLine)
{
  const std::string                                                                   core = m_Folder / "c.vtp";
  const std::string                                                                   out = m_Folder / "p.png";
  const std::pair<std::vector<std::string>, std::pair<int, std::vector<std::string>>> cases[] = {
    { { core, "-o", m_Folder / "p.jpg" }, { 2, { "p.jpg", ".png" } } },
    { { core, "-o", out, "--size", "10x10" }, { 2, { "--size", "64" } } },
    { { core, "-o", out, "--view", "back" }, { 2, { "--view", "front" } } },
    { { core, "-o", out, "--color", "Red" }, { 2, { "--color", "Radius" } } },
    { { core, "-o", out, "--range", "5:1" }, { 2, { "--range" } } },
    { { core, "-o", out, "--range", "2%:5" }, { 2, { "--range" } } },
    { { core, "-o", out, "--range", "0:5%" }, { 2, { "--range" } } },
    { { core, "-o", out, "--range", "0%:101%" }, { 2, { "--range" } } },
    { { core, "-o", out, "--range", "0:5", "--each-label" }, { 2, { "--each-label", "per cent" } } },
    { { core, "-o", out, "--labels", "9" }, { 3, { "'9'" } } },
    { { core, core, "-o", out }, { 2, { "already" } } },
    { { m_Folder / "s.nrrd", "-o", out }, { 2, { ".vtp" } } },
    { { m_Folder / "none.vtp", "-o", out }, { 3, { "none.vtp" } } },
    { { core, "--scan", m_Folder / "no.nrrd", "-o", out }, { 3, { "no.nrrd" } } },
  };
  for (const auto & [arguments, expected] : cases)
  {
    std::vector<std::string> all{ "render" };
    all.insert(all.end(), arguments.begin(), arguments.end());
    ExpectRefusal(RunProgram(all), expected.first, expected.second);
  }
  EXPECT_EQ(m_Folder.Names(), (Names{ "c.vtp", "s.nrrd" }));
}

} // namespace
} // namespace voxelcore::testing
