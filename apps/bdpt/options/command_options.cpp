#include "options/command_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

namespace bdpt::app {
namespace {

bool takes_one_value_at_most(const CLI::Option& option)
{
    return !option.get_positional() && option.get_items_expected_max() <= 1;
}

/// Those of `group` that take one value at most.
std::vector<const CLI::Option*> options_of(const CLI::App& command, std::string_view group)
{
    std::vector<const CLI::Option*> result;
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_group() == group && takes_one_value_at_most(*option)) {
            result.push_back(option);
        }
    }
    return result;
}

std::string name_of(const CLI::Option& option)
{
    return "--" + option.get_lnames().front();
}

}  // namespace

void let_the_last_count(CLI::App& command)
{
    for (CLI::Option* option : command.get_options()) {
        if (takes_one_value_at_most(*option)) {
            option->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
        }
    }
}

std::vector<std::string> words_for_parser(std::span<const std::string> words)
{
    std::vector<std::string> result;
    bool takes_options = true;
    for (const std::string& word : words) {
        takes_options = takes_options && word != "--";
        const bool is_empty =
            takes_options && word.starts_with("--") && word.find('=') == word.size() - 1;
        result.push_back(is_empty ? word.substr(0, word.size() - 1) : word);
        if (is_empty) {
            result.emplace_back();
        }
    }
    std::reverse(result.begin(), result.end());
    return result;
}

std::vector<std::string> given_options(const CLI::App& command, std::string_view group)
{
    std::vector<std::string> result;
    for (const CLI::Option* option : options_of(command, group)) {
        if (option->count() == 0) {
            continue;
        }
        const bool is_flag = option->get_items_expected_max() == 0;
        const std::string value = option->results().back();
        result.push_back(is_flag && value == "true" ? name_of(*option)
                                                    : name_of(*option) + "=" + value);
    }
    return result;
}

std::vector<std::string> option_names(const CLI::App& command, std::string_view group)
{
    std::vector<std::string> result;
    for (const CLI::Option* option : options_of(command, group)) {
        result.push_back(name_of(*option));
    }
    return result;
}

}  // namespace bdpt::app
