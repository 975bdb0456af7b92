#include "options/values/value_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <span>
#include <utility>

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

CLI::Validator one_of(std::vector<std::string> words)
{
    const auto check = [words = std::move(words)](const std::string& word) {
        if (std::find(words.begin(), words.end(), word) != words.end()) {
            return std::string();
        }
        const std::span<const std::string> all(words);
        const std::string last = all.size() > 1 ? " or " + all.back() : all.back();
        const auto others = all.first(all.size() > 1 ? all.size() - 1 : 0);
        return fmt::format("expected {}{}, but got \"{}\"", fmt::join(others, ", "), last, word);
    };
    return CLI::Validator(check, "");
}

}  // namespace bdpt::app
