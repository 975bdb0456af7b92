#include "manual.h"

#include <bdpt/version.h>
#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

namespace bdpt::manual {
namespace {

constexpr std::string_view codes = "Exit codes: ";
constexpr std::string_view examples = "Examples:\n";

/// Text as roff prints it: hyphens that can be copied, and no line that looks like a macro.
std::string escaped(std::string_view text)
{
    std::string result;
    bool line_begins = true;
    for (const char c : text) {
        if (line_begins && (c == '.' || c == '\'')) {
            result += "\\&";
        }
        line_begins = c == '\n';
        switch (c) {
            case '\\':
                result += "\\e";
                break;
            case '-':
                result += "\\-";
                break;
            case '^':
                result += "\\(ha";
                break;
            case '~':
                result += "\\(ti";
                break;
            default:
                result += c;
        }
    }
    return result;
}

std::string in_capitals(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

std::string header(const std::string& title, const std::string& text)
{
    const std::string first(1, static_cast<char>(std::tolower(text.front())));
    return fmt::format(".TH \"{}\" \"1\" \"\" \"bdpt {}\" \"bdpt\"\n.SH NAME\n{} \\- {}\n",
                       in_capitals(title), BDPT_VERSION, escaped(title),
                       escaped(first + text.substr(1)));
}

/// ".TP" with names and value of an option, and its text.
std::string entry(const job::Option& option)
{
    std::string names;
    for (const std::string& name : list_names(option)) {
        names += (names.empty() ? "\\fB" : ", \\fB") + escaped(name) + "\\fR";
    }
    if (!option.is_flag() && !option.is_argument()) {
        names += fmt::format(" \\fI{}\\fR", escaped(option.value));
    }
    return fmt::format(".TP\n{}\n{}.\n", names, escaped(option.help));
}

std::string options(const CommandInfo& command)
{
    std::string result;
    std::string group;
    for (const job::Option& option : command.options) {
        const std::string own = option.section.empty() ? "Options" : option.section;
        if (own != group) {
            group = own;
            result += fmt::format(".SH \"{}\"\n", in_capitals(group));
        }
        result += entry(option);
    }
    return result;
}

std::string format_synopsis(const CommandInfo& command)
{
    std::string result = fmt::format("\\fBbdpt {}\\fR [\\fIOPTION\\fR]...", command.name);
    for (const job::Option& argument : command.arguments) {
        result += fmt::format(" \\fI{}\\fR{}", escaped(in_capitals(argument.names)),
                              argument.repeats ? "..." : "");
    }
    return ".SH SYNOPSIS\n" + result + "\n";
}

/// The paragraphs of the footer that are neither examples nor exit codes, as they come.
std::string description(const CommandInfo& command)
{
    std::string result =
        ".SH DESCRIPTION\n" + escaped(command.text) + (command.text.ends_with('.') ? "\n" : ".\n");
    for (const std::string& paragraph : command.footer) {
        if (!paragraph.starts_with(codes) && !paragraph.starts_with(examples)) {
            result += ".PP\n" + escaped(paragraph) + "\n";
        }
    }
    return result;
}

std::string last_sections(const CommandInfo& command)
{
    std::string result;
    for (const std::string& paragraph : command.footer) {
        if (paragraph.starts_with(codes)) {
            std::string text = paragraph.substr(codes.size());
            text.front() = static_cast<char>(std::toupper(text.front()));
            result += ".SH \"EXIT STATUS\"\n" + escaped(text) + "\n";
        }
    }
    for (const std::string& paragraph : command.footer) {
        if (paragraph.starts_with(examples)) {
            result += fmt::format(".SH EXAMPLES\n.nf\n{}\n.fi\n",
                                  escaped(std::string_view(paragraph).substr(examples.size())));
        }
    }
    return result;
}

}  // namespace

std::string man_page(const CommandInfo& program, std::span<const CommandInfo> commands)
{
    std::string result =
        header(program.name, "Render glTF 2.0 scenes by bidirectional path tracing");
    result += ".SH SYNOPSIS\n\\fBbdpt\\fR \\fICOMMAND\\fR [\\fIOPTION\\fR]... [\\fIFILE\\fR]...\n";
    result += description(program) + ".SH COMMANDS\n";
    std::string see_also;
    for (const CommandInfo& command : commands) {
        result += fmt::format(".TP\n\\fB{}\\fR\n{}.\n", command.name, escaped(command.text));
        if (command.options.size() > 1) {
            see_also += fmt::format("{}.BR bdpt\\-{} (1)", see_also.empty() ? "" : " ,\n",
                                    escaped(command.name));
        }
    }
    return result + options(program) + last_sections(program) + ".SH \"SEE ALSO\"\n" + see_also +
           "\n";
}

std::string man_page(const CommandInfo& command)
{
    std::string result = header("bdpt-" + command.name, command.text);
    result += format_synopsis(command) + description(command);
    if (!command.arguments.empty()) {
        result += ".SH ARGUMENTS\n";
        for (const job::Option& argument : command.arguments) {
            job::Option shown = argument;
            shown.names = in_capitals(argument.names);
            result += entry(shown);
        }
    }
    return result + options(command) + last_sections(command) + ".SH \"SEE ALSO\"\n.BR bdpt (1)\n";
}

}  // namespace bdpt::manual
