#include "voxelcore/Labels/LabelNaming.h"

#include "voxelcore/Base/DidYouMean.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/TextFields.h"

#include <algorithm>

namespace voxelcore
{
namespace
{

bool
IsMeant(const LabelNaming::Request & request, const LabelNaming::Label & label)
{
  return ParseInteger(request.text) == label.value || request.text == label.name ||
         (request.anyCase && EqualIgnoringCase(request.text, label.name));
}

} // namespace

LabelNaming::LabelNaming(const StoredVoxels & scan, const LabelChoice & choice)
  : m_All(choice.labels == "all")
{
  std::set<std::int64_t> values;
  for (const Segment & segment : scan.segments)
  {
    m_Renumbered = !values.insert(segment.value).second || m_Renumbered;
  }
  for (const Segment & segment : scan.segments)
  {
    const std::int64_t value = m_Renumbered ? m_Largest + 1 : segment.value;
    m_Segments.emplace(std::pair(segment.layer, segment.value),
                       Label{ value, segment.name.empty() ? Text("label-", value) : segment.name, segment.color });
    m_Given.insert(value);
    m_Largest = std::max(m_Largest, value);
  }
  m_Names = scan.listed;
  for (std::size_t at = 0; !m_All && at <= choice.labels.size();)
  {
    const std::size_t comma = std::min(choice.labels.find(',', at), choice.labels.size());
    std::string       request(Trim(std::string_view(choice.labels).substr(at, comma - at)));
    const auto        number = ParseInteger(request);
    if (request.empty() || (number && *number <= 0))
    {
      throw UsageError(
        Text("--labels '", Printable(choice.labels), "': give all, or values above 0 or names (0 is background)"));
    }
    const bool isName =
      std::any_of(m_Segments.begin(), m_Segments.end(), [&](const auto & s) { return s.second.name == request; }) ||
      std::any_of(m_Names.begin(), m_Names.end(), [&](const auto & n) { return n.second.name == request; });
    m_Requested.push_back({ std::move(request), !isName });
    at = comma + 1;
  }
}

LabelNaming::Label
LabelNaming::Identify(std::size_t layer, std::int64_t value)
{
  const auto segment = m_Segments.find({ layer, value });
  if (segment != m_Segments.end())
  {
    return segment->second;
  }
  std::int64_t number = value;
  if (!m_Given.insert(number).second)
  {
    number = m_Largest + 1;
    m_Given.insert(number);
    m_Renumbered = true;
  }
  m_Largest = std::max(m_Largest, number);
  const auto listed = m_Names.find(number);
  const bool named = listed != m_Names.end() && !listed->second.name.empty();
  return { number,
           named ? listed->second.name : Text("label-", number),
           listed != m_Names.end() ? listed->second.color : std::nullopt };
}

bool
LabelNaming::IsWanted(const Label & label) const
{
  return m_All || std::any_of(m_Requested.begin(), m_Requested.end(), [&](const Request & request) {
           return IsMeant(request, label);
         });
}

void
LabelNaming::RefuseMissing(const std::filesystem::path & path,
                           const std::vector<Label> &    present,
                           const std::string &           where) const
{
  for (const Request & request : m_Requested)
  {
    if (std::any_of(present.begin(), present.end(), [&](const Label & label) { return IsMeant(request, label); }))
    {
      continue;
    }
    constexpr std::size_t         shown = 12;
    std::string                   list;
    std::vector<std::string_view> names;
    names.reserve(present.size());
    for (const Label & label : present)
    {
      names.emplace_back(label.name);
    }
    for (std::size_t i = 0; i < std::min(shown, present.size()); ++i)
    {
      list += Text(i == 0 ? "" : ", ", present[i].value);
      if (present[i].name != Text("label-", present[i].value))
      {
        list += Text(" ", Printable(present[i].name, 40));
      }
    }
    RefuseInput(path,
                Text("there is no label '", Printable(request.text), "'", where),
                Text("it has ",
                     list,
                     present.size() > shown ? Text(" and ", present.size() - shown, " more") : "",
                     Printable(DidYouMean(request.text, names))));
  }
}

} // namespace voxelcore
