#include "parser/command_parser.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <utility>
#include <vector>

#include "options/output_files.h"

namespace bdpt::app {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 18> foreign_commands{
    {{"run", "render"},
     {"convert", "develop"},
     {"tonemap", "develop"},
     {"denoise", "develop"},
     {"serve", "view"},
     {"show", "view"},
     {"preview", "view"},
     {"open", "view"},
     {"gui", "view"},
     {"diff", "compare"},
     {"imgcmp", "compare"},
     {"benchmark", "bench"},
     {"test", "verify"},
     {"check", "verify"},
     {"debug", "inspect"},
     {"farm", "plan"},
     {"identify", "info"},
     {"imgtool", "develop"}}};

/// Returns "--resize" for "-resize"; other words are unchanged.
std::string with_two_dashes(std::string_view word)
{
    const bool has_one = word.size() > 2 && word[0] == '-' && word[1] != '-';
    return (has_one ? "-" : "") + std::string(word);
}

std::string typed_name(std::string_view word)
{
    return std::string(word.substr(0, word.find('=')));
}

}  // namespace

std::optional<std::string> advice_for_option(std::string_view word, const OptionList& options)
{
    const auto foreign = find_foreign(with_two_dashes(typed_name(word)), options);
    return foreign ? std::optional(std::string(foreign->advice)) : std::nullopt;
}

std::optional<std::string_view> command_for(std::string_view word)
{
    const auto* const found =
        std::find_if(foreign_commands.begin(), foreign_commands.end(),
                     [word](const auto& command) { return command.first == word; });
    return found != foreign_commands.end() ? std::optional(found->second) : std::nullopt;
}

void check_dashes(const std::vector<std::string>& words, const OptionList& options)
{
    for (const std::string& word : words) {
        const std::string name = typed_name(word);
        const std::string meant = with_two_dashes(name);
        if (word == "--") {
            return;
        }
        if (meant == name || std::isalpha(static_cast<unsigned char>(name[1])) == 0) {
            continue;
        }
        if (options.find(meant) != nullptr) {
            throw OptionError(fmt::format("unknown option {} (did you mean {}?)", name, meant));
        }
        if (const std::optional<std::string> advice = advice_for_option(name, options)) {
            throw OptionError(fmt::format("unknown option {}: {}", name, *advice));
        }
    }
}

void check_scene_word(const std::string& word, const OptionList& options)
{
    std::error_code ignored;
    if (word != "-" && find_type(word) && !options.given("--output")) {
        throw OptionError(
            fmt::format("{0}: is an image, not a scene; outputs are named by -o {0}", word));
    }
    if (std::filesystem::exists(word, ignored)) {
        return;
    }
    const bool is_number = !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
        return std::isdigit(static_cast<unsigned char>(c)) != 0;
    });
    if (is_number) {
        throw OptionError(fmt::format(
            "unexpected argument \"{}\": values of an option are one word, as in --size 640x480",
            word));
    }
    const std::string name = "--" + typed_name(word);
    if (word.find('=') != std::string::npos && options.find(name) != nullptr) {
        throw OptionError(fmt::format("unexpected argument \"{0}\" (did you mean --{0}?)", word));
    }
}

}  // namespace bdpt::app
