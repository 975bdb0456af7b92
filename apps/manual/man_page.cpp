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
std::string entry(const OptionInfo& option)
{
    std::string names;
    for (const std::string& name : option.names) {
        names += (names.empty() ? "\\fB" : ", \\fB") + escaped(name) + "\\fR";
    }
    if (!option.value.empty() && !option.group.empty()) {
        const bool optional = option.value_may_be_left_out;
        names += fmt::format("{}\\fI{}\\fR{}", optional ? "[=" : " ", escaped(option.value),
                             optional ? "]" : "");
    }
    return fmt::format(".TP\n{}\n{}.\n", names, escaped(option.text));
}

std::string options(const CommandInfo& command)
{
    std::string result;
    std::string group;
    for (const OptionInfo& option : command.options) {
        if (option.group != group) {
            group = option.group;
            result += fmt::format(".SH \"{}\"\n", in_capitals(group));
        }
        result += entry(option);
    }
    return result;
}

std::string format_synopsis(const CommandInfo& command)
{
    std::string result = fmt::format("\\fBbdpt {}\\fR [\\fIOPTION\\fR]...", command.name);
    for (const OptionInfo& argument : command.arguments) {
        const bool optional = argument.value_may_be_left_out;
        result += fmt::format(" {}\\fI{}\\fR{}{}", optional ? "[" : "",
                              escaped(in_capitals(argument.names.front())), optional ? "]" : "",
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
        for (const OptionInfo& argument : command.arguments) {
            OptionInfo shown = argument;
            shown.names = {in_capitals(argument.names.front())};
            result += entry(shown);
        }
    }
    return result + options(command) + last_sections(command) + ".SH \"SEE ALSO\"\n.BR bdpt (1)\n";
}

}  // namespace bdpt::manual
