// The page as one file. What is in its model is tested in PageModelGTest, and that browsers show it in
// Testing/Applications/page_test.py.

#include "VoxelCoreTesting/Shapes.h"
#include "VoxelCoreTesting/TemporaryFolder.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Display/HtmlPage.h"
#include "voxelcore/Display/LabelSurface.h"
#include "voxelcore/VoxelCore/VoxelCore.h"

#include <gtest/gtest.h>

#include <limits>

namespace voxelcore::testing
{
namespace
{

DisplayContent
BallContent(std::int32_t size)
{
  ImageGeometry geometry;
  geometry.size = { size, size, size };
  const VoxelShape shape = Ellipsoid(size);
  DisplayContent   content;
  content.labels.emplace_back();
  DisplayLabel & label = content.labels.back();
  label.label = 1;
  label.name = "@DATA@ @VIEWER@ </script>"; // words of the page's own
  label.surface = LabelSurface(shape, geometry);
  label.medial = ToPhysical(ComputeVoxelCore(shape, ComputeSpacingWeights(geometry.spacing)), geometry, 1);
  return content;
}

class HtmlPage : public ::testing::Test
{
protected:
  void
  SetUp() override
  {
    if (!HasHtml())
    {
      EXPECT_THROW(WriteHtml(m_Folder / "a.html", {}, {}), UsageError);
      GTEST_SKIP() << "this build has no three.js";
    }
  }
  std::string
  Page(const DisplayContent & content, const HtmlOptions & options = {}) const
  {
    WriteHtml(m_Folder / "a.html", content, options);
    return ReadAll(m_Folder / "a.html");
  }
  TemporaryFolder m_Folder;
};

std::size_t
Count(const std::string & text, const std::string & what)
{
  std::size_t count = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
  {
    ++count;
  }
  return count;
}

TEST_F(HtmlPage, AsksNothingOfAnyNetworkAndForbidsItselfTo)
{
  const std::string page = Page(BallContent(16));
  EXPECT_NE(page.find("Content-Security-Policy"), std::string::npos);
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(Count(page, "<link"), 0U);
  EXPECT_EQ(Count(page, " src=\"http"), 0U);
  EXPECT_NE(page.find("MIT"), std::string::npos) << "three.js' licence is named";
}

TEST_F(HtmlPage, WhatALabelIsCalledChangesNothingOfThePage)
{
  DisplayContent content = BallContent(12);
  const auto     ends = Count(Page(content), "</script>");
  content.labels[0].name = "plain";
  EXPECT_EQ(Count(Page(content), "</script>"), ends);
  const std::string page = Page(content);
  for (const char * mark : { "@VIEWER@", "@THREE@", "@DATA@", "@MODEL@", "@STYLE@" })
  {
    EXPECT_EQ(Count(page, mark), 0U) << mark;
  }
}

TEST_F(HtmlPage, IsTheSameForTheSameContentAndSmallerForFewerTriangles)
{
  const DisplayContent content = BallContent(32);
  const std::string    page = Page(content);
  EXPECT_EQ(Page(content), page);
  HtmlOptions few;
  few.triangles = 500;
  EXPECT_LT(Page(content, few).size(), page.size());
}

TEST_F(HtmlPage, WhatFailsLeavesNoFile)
{
  DisplayContent content = BallContent(12);
  EXPECT_THROW(WriteHtml(m_Folder / "none/a.html", content, {}), OutputError);
  EXPECT_THROW(WriteHtml(m_Folder / "a.html", content, {}, [](std::string_view, double) { return false; }), Cancelled);
  content.labels[0].medial.core.positions[0][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(WriteHtml(m_Folder / "a.html", content, {}), Error);
  EXPECT_TRUE(m_Folder.Names().empty());
}

} // namespace
} // namespace voxelcore::testing
