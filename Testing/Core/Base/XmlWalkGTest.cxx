#include "voxelcore/Base/XmlWalk.h"

#include <gtest/gtest.h>

#include <stdexcept>

using namespace voxelcore;

namespace
{

/** Notes what it is told; throws at a tag `fail`, ends at a tag `data`. */
class Notes : public XmlWalk
{
public:
  /** In parts of `step` bytes. */
  Notes(std::string_view xml, std::size_t step)
  {
    const std::string_view all = xml;
    trouble = Walk([&](char * to, std::size_t most) {
      const std::size_t size = xml.copy(to, std::min(most, step));
      xml.remove_prefix(size);
      return size;
    });
    rest = EndedAt() == 0 ? "" : all.substr(static_cast<std::size_t>(EndedAt()));
  }

  std::string notes;
  std::string trouble;
  std::string rest;

private:
  void
  Begin(const std::string & name, const XmlAttributes & attributes, const std::string & within) override
  {
    notes += within + "/" + name + AttributeOf(attributes, "a", "-") + ";";
    if (name == "fail")
    {
      throw std::runtime_error("as told");
    }
    if (name == "data")
    {
      EndHere();
    }
  }
  void
  End(const std::string & name, const std::string & within) override
  {
    notes += within + "\\" + name + ";";
  }
  void
  Text(std::string_view text, const std::string & tag) override
  {
    notes += tag == "b" ? std::string(text) : "";
  }
};

} // namespace

TEST(XmlWalk, TellsOfEachTagWithTheOneAroundIt)
{
  for (const std::size_t step : { 1, 7, 1000 })
  {
    const Notes walk("<?xml version='1.0'?><x a='1'> <b>t&amp;u</b><b a='&lt;'/></x>", step);
    EXPECT_EQ(walk.trouble, "");
    EXPECT_EQ(walk.notes, "/x1;x/b-;t&ux\\b;x/b<;x\\b;\\x;");
  }
}

TEST(XmlWalk, SaysWhatIsWrongAndWhere)
{
  EXPECT_EQ(Notes("<x>\n</y>", 3).trouble, "line 2: mismatched tag");
  EXPECT_EQ(Notes("<x>", 3).trouble, "line 1: no element found");
  EXPECT_EQ(Notes("", 3).trouble, "line 1: no element found");
  EXPECT_NE(Notes("<!DOCTYPE x [<!ENTITY e 'e'>]><x>&e;</x>", 3).trouble.find("document type"), std::string::npos);
  std::string deep;
  for (int i = 0; i < 100000; ++i)
  {
    deep += "<x>";
  }
  EXPECT_EQ(Notes(deep, 1000).trouble, "its tags are nested too deeply");
}

TEST(XmlWalk, WhatIsThrownComesOut)
{
  EXPECT_THROW(Notes("<x><fail/><y", 4), std::runtime_error);
}

TEST(XmlWalk, EndsWhereItIsToldTo)
{
  for (const std::size_t step : { 1, 9, 1000 })
  {
    const Notes walk(std::string_view("<x><data a='2'>\0\1<&", 19), step);
    EXPECT_EQ(walk.trouble, "");
    EXPECT_EQ(walk.notes, "/x-;x/data2;");
    EXPECT_EQ(walk.rest, std::string("\0\1<&", 4));
  }
}
