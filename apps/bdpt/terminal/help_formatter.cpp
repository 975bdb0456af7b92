#include "terminal/help_formatter.h"

#include <cstddef>
#include <sstream>

namespace bdpt::app {
namespace {

constexpr std::size_t name_columns = 32;
constexpr std::size_t text_columns = 100 - name_columns;

}  // namespace

std::string value_of(const CLI::Option& option)
{
    const std::string type = option.get_type_name();
    return type.substr(0, type.find(":{"));
}

HelpFormatter::HelpFormatter()
{
    column_width(name_columns);
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const
{
    const std::string value = value_of(*option);
    return value.empty() ? "" : " " + value;
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const
{
    std::istringstream words(option->get_description());
    std::string result;
    std::size_t column = 0;
    for (std::string word; words >> word;) {
        const bool wraps = column > 0 && column + 1 + word.size() > text_columns;
        column = wraps ? word.size() : column + word.size() + (column > 0 ? 1 : 0);
        result += result.empty() ? "" : wraps ? "\n" : " ";
        result += word;
    }
    return result;
}

}  // namespace bdpt::app
