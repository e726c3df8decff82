#include "voxelcore/Base/TemporaryNames.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/SystemCalls.h"

#include <array>
#include <charconv>
#include <cstdio>
#include <string_view>

namespace voxelcore
{
namespace
{

namespace fs = std::filesystem;

constexpr std::string_view kMark = ".part-";
constexpr std::size_t      kLongestName = 255; // of Linux's file systems

/** FNV-1a: the same on every machine. */
std::uint32_t
Digest(std::string_view text)
{
  std::uint32_t digest = 2166136261U;
  for (const char c : text)
  {
    digest = (digest ^ static_cast<unsigned char>(c)) * 16777619U;
  }
  return digest;
}

template <typename Number>
bool
TakeNumber(std::string_view & text, Number & number, int base)
{
  const auto [end, error] = from_chars(text.data(), text.data() + text.size(), number, base);
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return error == std::errc();
}

} // namespace

WriterIdentity
ThisWriter()
{
  const ProcessFacts facts = ThisProcess();
  return { Digest(facts.machine), Digest(facts.space), facts.process, facts.start };
}

fs::path
TemporaryName(const fs::path & target, const WriterIdentity & writer)
{
  std::array<char, 80> suffix{};
  (void)std::snprintf(suffix.data(),
                      suffix.size(),
                      "%s%08x-%08x-%lld-%llx",
                      kMark.data(),
                      writer.machine,
                      writer.space,
                      static_cast<long long>(writer.process),
                      static_cast<unsigned long long>(writer.start));
  std::string       name = target.filename().string();
  const std::size_t room = kLongestName - std::string_view(suffix.data()).size();
  if (name.size() > room)
  {
    std::array<char, 12> digest{};
    (void)std::snprintf(digest.data(), digest.size(), "~%08x", Digest(name));
    name = name.substr(0, room - std::string_view(digest.data()).size()) + digest.data();
  }
  return target.parent_path() / (name + suffix.data());
}

std::optional<WriterIdentity>
WriterOf(const fs::path & path)
{
  const std::string name = path.filename().string();
  const std::size_t mark = name.rfind(kMark);
  if (mark == std::string::npos || mark == 0)
  {
    return std::nullopt;
  }
  std::string_view rest = std::string_view(name).substr(mark + kMark.size());
  WriterIdentity   writer;
  const auto       dash = [&rest] {
    const bool is = rest.starts_with('-');
    rest.remove_prefix(is ? 1 : 0);
    return is;
  };
  const bool fits = TakeNumber(rest, writer.machine, 16) && dash() && TakeNumber(rest, writer.space, 16) && dash() &&
                    TakeNumber(rest, writer.process, 10) && dash() && TakeNumber(rest, writer.start, 16) &&
                    rest.empty() && writer.process > 0;
  // Written the same way again: nothing else that only looks like it.
  return fits && TemporaryName("x", writer).string().substr(1) == name.substr(mark) ? std::optional(writer)
                                                                                    : std::nullopt;
}

fs::path
FinalName(const fs::path & path)
{
  fs::path final = path;
  for (fs::path part = path; part.has_filename(); part = part.parent_path())
  {
    if (WriterOf(part))
    {
      const std::string name = part.filename().string();
      final = part.parent_path() / name.substr(0, name.rfind(kMark));
    }
  }
  return final;
}

bool
HasEnded(const WriterIdentity & writer)
{
  const WriterIdentity here = ThisWriter();
  if (writer.machine != here.machine || writer.space != here.space)
  {
    return false;
  }
  return HasProcessEnded(writer.process, writer.start);
}

void
RemoveAbandoned(const fs::path & folder)
{
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
  {
    const auto writer = WriterOf(entry->path());
    if (writer && HasEnded(*writer))
    {
      std::error_code ignored;
      fs::remove_all(entry->path(), ignored);
    }
  }
}

} // namespace voxelcore
