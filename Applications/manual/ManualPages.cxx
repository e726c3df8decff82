#include "Texts.h"

#include "voxelcore/Report/CoreReport.h"

#include <algorithm>
#include <optional>

namespace voxelcore
{
namespace
{

/** Text as roff prints it: no character of it is a request. */
std::string
Roff(std::string_view text)
{
  std::string escaped;
  bool        lineBegins = true;
  for (const char c : text)
  {
    if (lineBegins && (c == '.' || c == '\''))
    {
      escaped += "\\&";
    }
    lineBegins = c == '\n';
    switch (c)
    {
      case '\\':
        escaped += "\\e";
        break;
      case '-':
        escaped += "\\-";
        break;
      case '\'':
        escaped += "\\(aq";
        break;
      case '^':
        escaped += "\\(ha";
        break;
      case '~':
        escaped += "\\(ti";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string
Head(const std::string & name, std::string_view description)
{
  std::string upper = name;
  std::transform(upper.begin(), upper.end(), upper.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? char(c - 32) : c;
  });
  return ".TH " + Roff(upper) + " 1 \"\" \"voxelcore " + VoxelCoreVersion() + "\" \"VoxelCore\"\n.SH NAME\n" +
         Roff(name) + " \\- " + Roff(description) + "\n";
}

std::string
Preformatted(std::string_view text)
{
  return ".nf\n" + Roff(text) + "\n.fi\n";
}

constexpr std::string_view kExitStatus = R"(.SH EXIT STATUS
.TP
.B 0
done
.TP
.B 1
failed, e.g. output that cannot be written
.TP
.B 2
wrong usage
.TP
.B 3
input unreadable or unfit
.TP
.B 4
a certificate failed, or
.B verify
disagrees
.TP
.B 130
interrupted
.PP
Results appear complete or not at all; one line on standard error says what was wrong and what to do.
)";

} // namespace

std::string
ProgramManual()
{
  std::string text = Head("voxelcore", "certified medial surfaces of segmented CT and MRI volumes");
  text +=
    ".SH SYNOPSIS\n.B voxelcore\n.I COMMAND\n[options]\n.br\n.B voxelcore \\-\\-version\n.br\n"
    ".B voxelcore\n.I COMMAND\n.B \\-\\-help\n.SH DESCRIPTION\n" +
    Roff(
      "Turns a segmented volume into its medial surface, a thin sheet through the middle of each structure with "
      "the same pieces, loops and cavities, and into curve skeletons and measurements. Lengths are in mm, "
      "positions in files are LPS.") +
    "\n.SH COMMANDS\n";
  for (const Command & command : Commands())
  {
    text += ".TP\n.BR voxelcore\\-" + Roff(command.name) + " (1)\n" + Roff(command.description) + "\n";
  }
  return text + std::string(kExitStatus);
}

std::string
CommandManual(const Command & command)
{
  std::string                   text = Head("voxelcore-" + std::string(command.name), command.description);
  std::string                   synopsis = ".B voxelcore " + Roff(command.name) + "\n";
  std::string                   options;
  std::optional<ParameterGroup> group;
  for (const Parameter & parameter : command.rows)
  {
    if (group != parameter.group)
    {
      group = parameter.group;
      options += ".SS " + Roff(GroupHeading(*group)) + "\n";
    }
    const auto        flags = FlagsOf(parameter);
    const std::string value = Roff(parameter.placeholder);
    if (flags.empty())
    {
      synopsis += ".I " + value + "\n";
      options += ".TP\n.I " + value + "\n";
    }
    else
    {
      options += ".TP\n";
      std::string names;
      for (const std::string & flag : flags)
      {
        names += names.empty() ? "\\fB" : ", \\fB";
        names += Roff(flag) + "\\fR";
      }
      options += names;
      options += value.empty() ? "\n" : " \\fI" + value + "\\fR\n";
      if (parameter.required)
      {
        synopsis += "\\fB" + Roff(flags.front()) + "\\fR \\fI" + value + "\\fR\n";
      }
    }
    options += Roff(parameter.description);
    if (!parameter.defaultValue.empty())
    {
      options += Roff(" (default: " + std::string(parameter.defaultValue) + ")");
    }
    options += "\n";
  }
  text += ".SH SYNOPSIS\n" + synopsis + "[options]\n.SH OPTIONS\n" + options;
  const std::string_view footer = command.footer;
  const std::size_t      examples = footer.rfind("Example");
  if (examples > 0)
  {
    text += ".SH NOTES\n" + Preformatted(footer.substr(0, std::min(examples, footer.size())));
  }
  if (examples != std::string_view::npos)
  {
    text += ".SH EXAMPLES\n" + Preformatted(footer.substr(footer.find('\n', examples) + 1));
  }
  return text + std::string(kExitStatus) + ".SH SEE ALSO\n.BR voxelcore (1)\n";
}

} // namespace voxelcore
