#include "report/part/part_command.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "terminal/text.h"

namespace bdpt::app {
namespace {

constexpr std::array<std::string_view, 17> with_value{
    "-o",      "--output",  "--spp",        "--samples",        "--time",       "--part",
    "--plan",  "--task",    "--stats",      "--threads",        "--max-memory", "--cameras",
    "--noise", "--display", "--strategies", "--strategy-depth", "--save-rates"};
constexpr std::array<std::string_view, 5> flags{"--restart", "-q", "--quiet", "--json",
                                                "--profile"};

template <typename Names>
bool has(const Names& names, std::string_view word)
{
    return std::find(names.begin(), names.end(), word) != names.end();
}

}  // namespace

std::vector<std::string> render_words(const std::vector<std::string>& words)
{
    std::vector<std::string> result{"bdpt"};
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::string& word = words[i];
        const std::string name = word.substr(0, word.find('='));
        if (has(with_value, name)) {
            i += std::size_t{name.size() == word.size() ? 1U : 0U};  // else it has the value
        } else if (!has(flags, word) && !(word.starts_with("-o") && word.size() > 2)) {
            result.push_back(one_line(word));
        }
    }
    return result;
}

std::vector<std::string> commands_for(const std::vector<std::string>& words,
                                      const SampleSet& samples, const std::filesystem::path& folder)
{
    std::vector<std::string> result;
    for (const SampleRange& range : samples.ranges()) {
        if (words.empty()) {
            break;
        }
        std::string command;
        for (const std::string& word : words) {
            command += shell_word(word) + " ";
        }
        const auto file = folder / fmt::format("{}-{}.part.exr", range.begin, range.end);
        result.push_back(fmt::format("{}--samples {}:{} --part {}", command, range.begin, range.end,
                                     shell_word(one_line(file.string()))));
    }
    return result;
}

std::vector<std::string> commands_for(const std::filesystem::path& file,
                                      const std::vector<std::size_t>& tasks)
{
    std::vector<std::string> result;
    for (const std::size_t task : tasks) {
        result.push_back(fmt::format("bdpt render --plan {} --task {}",
                                     shell_word(one_line(file.string())), task));
    }
    return result;
}

}  // namespace bdpt::app
