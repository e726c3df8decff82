#pragma once
// One pass over the tags of an XML file, by expat, with which who includes this must link.

#include <expat.h>

#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace voxelcore
{

using XmlAttributes = std::map<std::string, std::string>;

/** The value of an attribute, or `otherwise` where it is not given. */
inline std::string
AttributeOf(const XmlAttributes & attributes, const std::string & name, const std::string & otherwise = {})
{
  const auto found = attributes.find(name);
  return found == attributes.end() ? otherwise : found->second;
}

/** Who derives is told of each tag in turn. What an override throws ends the walk and comes out of Walk. */
class XmlWalk
{
public:
  XmlWalk()
    : m_Parser(XML_ParserCreate(nullptr), &XML_ParserFree)
  {
    if (!m_Parser)
    {
      throw std::bad_alloc();
    }
    XML_SetUserData(m_Parser.get(), this);
    XML_SetElementHandler(m_Parser.get(), &XmlWalk::OnBegin, &XmlWalk::OnEnd);
    XML_SetCharacterDataHandler(m_Parser.get(), &XmlWalk::OnText);
    XML_SetStartDoctypeDeclHandler(m_Parser.get(), &XmlWalk::OnDoctype);
  }
  XmlWalk(const XmlWalk &) = delete;
  XmlWalk &
  operator=(const XmlWalk &) = delete;
  virtual ~XmlWalk() = default;

protected:
  /** Walks to the end of the file, or to where EndHere said. `supply(to, most)` gives the next bytes, 0 at the end.
   *  Returns what is wrong with the XML, a clause such as "line 3: mismatched tag"; empty when nothing is. */
  template <typename Supply>
  std::string
  Walk(const Supply & supply)
  {
    constexpr std::size_t step = std::size_t{ 1 } << 18;
    std::vector<char>     part(step);
    for (bool more = true; more;)
    {
      const std::size_t got = supply(part.data(), part.size());
      const bool isGood = XML_Parse(m_Parser.get(), part.data(), static_cast<int>(got), got == 0) == XML_STATUS_OK;
      if (m_Failure != nullptr)
      {
        std::rethrow_exception(m_Failure);
      }
      if (!isGood && m_Trouble.empty() && m_EndedAt == 0)
      {
        m_Trouble = "line " + std::to_string(XML_GetCurrentLineNumber(m_Parser.get())) + ": " +
                    XML_ErrorString(XML_GetErrorCode(m_Parser.get()));
      }
      more = isGood && got > 0;
    }
    return m_Trouble;
  }

  /** `within`: the tag around it; empty for the first. */
  virtual void
  Begin(const std::string & name, const XmlAttributes & attributes, const std::string & within) = 0;
  virtual void
  End(const std::string & /*name*/, const std::string & /*within*/)
  {}
  /** A part of the text in a tag, which may come in many. */
  virtual void
  Text(std::string_view /*text*/, const std::string & /*tag*/)
  {}

  /** To be called by Begin: what follows the tag may be no XML, and is left alone. */
  void
  EndHere()
  {
    m_EndedAt = static_cast<std::uint64_t>(XML_GetCurrentByteIndex(m_Parser.get())) +
                static_cast<std::uint64_t>(XML_GetCurrentByteCount(m_Parser.get()));
    XML_StopParser(m_Parser.get(), XML_FALSE);
  }
  /** The bytes up to there; 0 where EndHere was not called. */
  std::uint64_t
  EndedAt() const
  {
    return m_EndedAt;
  }

private:
  static void
  OnBegin(void * self, const char * name, const char ** attributes)
  {
    auto & walk = *static_cast<XmlWalk *>(self);
    walk.Guarded([&] {
      XmlAttributes all;
      for (; *attributes != nullptr; attributes += 2)
      {
        all.emplace(attributes[0], attributes[1]);
      }
      const std::string within = walk.m_Path.back();
      walk.m_Path.emplace_back(name);
      constexpr std::size_t most = 1000; // readers that go into tags by recursion still have room for so many
      if (walk.m_Path.size() > most)
      {
        walk.Refuse("its tags are nested too deeply");
        return;
      }
      walk.Begin(name, all, within);
    });
  }

  static void
  OnEnd(void * self, const char *)
  {
    auto & walk = *static_cast<XmlWalk *>(self);
    walk.Guarded([&] {
      const std::string name = std::move(walk.m_Path.back());
      walk.m_Path.pop_back();
      walk.End(name, walk.m_Path.back());
    });
  }

  static void
  OnText(void * self, const char * text, int length)
  {
    auto & walk = *static_cast<XmlWalk *>(self);
    walk.Guarded([&] { walk.Text({ text, static_cast<std::size_t>(length) }, walk.m_Path.back()); });
  }

  static void
  OnDoctype(void * self, const char *, const char *, const char *, int)
  {
    static_cast<XmlWalk *>(self)->Refuse("it declares a document type, which no such file does");
  }

  /** No exception may pass through expat: it is kept. */
  template <typename Work>
  void
  Guarded(const Work & work)
  {
    if (m_Failure != nullptr || !m_Trouble.empty() || m_EndedAt > 0)
    {
      return; // expat may still end a tag after it was stopped
    }
    try
    {
      work();
    }
    catch (...)
    {
      m_Failure = std::current_exception();
      XML_StopParser(m_Parser.get(), XML_FALSE);
    }
  }

  void
  Refuse(const char * trouble)
  {
    m_Trouble = trouble;
    XML_StopParser(m_Parser.get(), XML_FALSE);
  }

  std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> m_Parser;
  std::vector<std::string>                                     m_Path{ "" }; ///< nothing, then the tags that are open
  std::exception_ptr                                           m_Failure;
  std::string                                                  m_Trouble;
  std::uint64_t                                                m_EndedAt = 0;
};

} // namespace voxelcore
