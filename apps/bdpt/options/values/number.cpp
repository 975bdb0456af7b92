#include "options/values/number.h"

#include <fmt/core.h>

#include <charconv>
#include <string>

namespace bdpt::app {

CLI::Validator whole_number(std::int64_t least, std::int64_t most)
{
    const auto check = [least, most](const std::string& word) {
        std::int64_t value = 0;
        const char* const end = word.data() + word.size();
        const auto [stop, error] = std::from_chars(word.data(), end, value);
        const bool good = error == std::errc{} && stop == end && value >= least && value <= most;
        return good ? std::string()
                    : fmt::format("expected a whole number from {} to {}, but got \"{}\"", least,
                                  most, word);
    };
    return CLI::Validator(check, "");
}

CLI::Validator number(double least, double most)
{
    const auto check = [least, most](const std::string& word) {
        double value = 0.0;
        const char* const end = word.data() + word.size();
        const auto [stop, error] = std::from_chars(word.data(), end, value);
        const bool good = error == std::errc{} && stop == end && value >= least && value <= most;
        return good ? std::string()
                    : fmt::format("expected a number from {} to {}, but got \"{}\"", least, most,
                                  word);
    };
    return CLI::Validator(check, "");
}

}  // namespace bdpt::app
