#include "voxelcore/Shape/LabelShape.h"

#include "voxelcore/Base/TextFields.h"

namespace voxelcore
{

namespace
{

constexpr std::uint64_t kNamed = 5;

} // namespace

std::string
LabelText(std::int64_t value, const std::string & name)
{
  return "label " + std::to_string(value) + " (" + name + ")";
}

void
LabelTexts::Add(const std::string & label, const std::string & text)
{
  if (!text.empty() && ++m_Count <= kNamed)
  {
    m_Text += (m_Count > 1 ? "; " : "") + label + ": " + text;
  }
}

std::string
LabelTexts::Text() const
{
  return m_Count <= kNamed ? m_Text
                           : m_Text + "; and those of " + Counted(m_Count - kNamed, "more label", "more labels");
}

} // namespace voxelcore
