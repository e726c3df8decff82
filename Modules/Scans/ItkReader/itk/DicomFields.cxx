#include "DicomFields.h"

#include "voxelcore/Base/TextFields.h"

#include <gdcmByteValue.h>

#include <algorithm>
#include <cstring>
#include <iconv.h>
#include <map>

namespace voxelcore::itkreader
{

std::string_view
FieldBytes(const gdcm::DataSet & set, const gdcm::Tag & tag)
{
  if (!set.FindDataElement(tag))
  {
    return {};
  }
  const gdcm::ByteValue * bytes = set.GetDataElement(tag).GetByteValue();
  return bytes == nullptr || bytes->GetPointer() == nullptr ? std::string_view()
                                                            : std::string_view(bytes->GetPointer(), bytes->GetLength());
}

std::string
FieldText(const gdcm::DataSet & set, const gdcm::Tag & tag)
{
  std::string_view bytes = FieldBytes(set, tag);
  bytes = bytes.substr(0, bytes.find('\0'));
  return std::string(Trim(bytes));
}

std::string
FieldName(const gdcm::DataSet & set, const gdcm::Tag & tag, const std::string & characterSet)
{
  std::string text = FieldText(set, tag);
  if (std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 128; }))
  {
    return text;
  }
  // Files that name no set have Latin letters where they have any.
  static const std::map<std::string, const char *> names{
    { "", "ISO-8859-1" },
    { "ISO_IR 100", "ISO-8859-1" },
    { "ISO_IR 101", "ISO-8859-2" },
    { "ISO_IR 109", "ISO-8859-3" },
    { "ISO_IR 110", "ISO-8859-4" },
    { "ISO_IR 144", "ISO-8859-5" },
    { "ISO_IR 127", "ISO-8859-6" },
    { "ISO_IR 126", "ISO-8859-7" },
    { "ISO_IR 138", "ISO-8859-8" },
    { "ISO_IR 148", "ISO-8859-9" },
    { "ISO_IR 203", "ISO-8859-15" },
    { "ISO_IR 166", "TIS-620" },
    { "ISO_IR 13", "SHIFT_JIS" },
    { "ISO_IR 192", "UTF-8" },
    { "GB18030", "GB18030" },
    { "GBK", "GBK" },
  };
  const auto    name = names.find(characterSet);
  const iconv_t converter = name == names.end() ? reinterpret_cast<iconv_t>(-1) : iconv_open("UTF-8", name->second);
  std::string   converted(4 * text.size(), '\0');
  char *        from = text.data();
  char *        to = converted.data();
  std::size_t   fromLeft = text.size();
  std::size_t   toLeft = converted.size();
  const bool    known = converter != reinterpret_cast<iconv_t>(-1) &&
                     iconv(converter, &from, &fromLeft, &to, &toLeft) != static_cast<std::size_t>(-1);
  if (converter != reinterpret_cast<iconv_t>(-1))
  {
    iconv_close(converter);
  }
  if (known)
  {
    converted.resize(converted.size() - toLeft);
    return converted;
  }
  std::replace_if(
    text.begin(),
    text.end(),
    [](char c) { return static_cast<unsigned char>(c) >= 128; },
    '?');
  return text;
}

std::optional<std::vector<double>>
FieldReals(const gdcm::DataSet & set, const gdcm::Tag & tag)
{
  std::string text = FieldText(set, tag);
  if (text.empty())
  {
    return std::nullopt;
  }
  for (char & c : text)
  {
    c = c == '\\' ? ' ' : c;
  }
  return ParseReals(text);
}

std::optional<double>
FieldReal(const gdcm::DataSet & set, const gdcm::Tag & tag)
{
  const auto values = FieldReals(set, tag);
  return values && !values->empty() ? std::optional(values->front()) : std::nullopt;
}

std::optional<Vector3>
FieldVector(const gdcm::DataSet & set, const gdcm::Tag & tag)
{
  const auto values = FieldReals(set, tag);
  return values && values->size() == 3 ? std::optional(Vector3{ (*values)[0], (*values)[1], (*values)[2] })
                                       : std::nullopt;
}

std::vector<std::uint16_t>
FieldShorts(const gdcm::DataSet & set, const gdcm::Tag & tag)
{
  const std::string_view     bytes = FieldBytes(set, tag);
  std::vector<std::uint16_t> values(bytes.size() / 2);
  if (!values.empty())
  {
    std::memcpy(values.data(), bytes.data(), 2 * values.size());
  }
  return values;
}

std::optional<std::uint16_t>
FieldShort(const gdcm::DataSet & set, const gdcm::Tag & tag)
{
  const auto values = FieldShorts(set, tag);
  return values.empty() ? std::nullopt : std::optional(values.front());
}

gdcm::SmartPointer<gdcm::SequenceOfItems>
FieldSequence(const gdcm::DataSet & set, const gdcm::Tag & tag)
{
  return set.FindDataElement(tag) ? set.GetDataElement(tag).GetValueAsSQ() : nullptr;
}

std::optional<gdcm::DataSet>
FirstItem(const gdcm::DataSet & set, const gdcm::Tag & tag)
{
  const auto sequence = FieldSequence(set, tag);
  return sequence && sequence->GetNumberOfItems() > 0 ? std::optional(sequence->GetItem(1).GetNestedDataSet())
                                                      : std::nullopt;
}

} // namespace voxelcore::itkreader
