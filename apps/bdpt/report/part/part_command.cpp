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
constexpr std::array<std::string_view, 6> flags{"--restart", "-q",        "--quiet",
                                                "-v",        "--verbose", "--json"};

template <typename Names>
bool has(const Names& names, std::string_view word)
{
    return std::find(names.begin(), names.end(), word) != names.end();
}

/// Returns the text of the first `command(i)` of `count` that fit.
template <typename Command>
std::string text_of_commands(std::size_t count, const Command& command)
{
    constexpr std::size_t max_shown = 3;
    std::string text;
    for (std::size_t i = 0; i < std::min(count, max_shown); ++i) {
        text += (i == 0 ? "; to render them: " : " && ") + command(i);
    }
    return count > max_shown ? fmt::format("{} && ... ({} more)", text, count - max_shown) : text;
}

}  // namespace

std::vector<std::string> render_words(const std::vector<std::string>& words)
{
    std::vector<std::string> result{"bdpt"};
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::string& word = words[i];
        const std::string name = word.substr(0, word.find('='));
        if (has(with_value, name)) {
            // Skips the value, unless the word contains it.
            i += std::size_t{name.size() == word.size() ? 1U : 0U};
        } else if (!has(flags, word) && !(word.starts_with("-o") && word.size() > 2)) {
            result.push_back(one_line(word));
        }
    }
    return result;
}

std::string ranges_text(const SampleSet& samples)
{
    constexpr std::size_t max_shown = 16;
    const std::vector<SampleRange>& ranges = samples.ranges();
    if (ranges.size() <= max_shown) {
        return samples.text();
    }
    std::string text;
    for (std::size_t i = 0; i < max_shown; ++i) {
        text += fmt::format("{}:{},", ranges[i].begin, ranges[i].end);
    }
    return fmt::format("{}... ({} more)", text, ranges.size() - max_shown);
}

std::string commands_text(const std::vector<std::string>& words, const SampleSet& samples,
                          const std::filesystem::path& folder)
{
    if (words.empty()) {
        return "";
    }
    std::string start;
    for (const std::string& word : words) {
        start += shell_word(word) + " ";
    }
    return text_of_commands(samples.ranges().size(), [&](std::size_t i) {
        const SampleRange& range = samples.ranges()[i];
        const auto file = folder / fmt::format("{}-{}.part.exr", range.begin, range.end);
        return fmt::format("{}--samples {}:{} --part {}", start, range.begin, range.end,
                           shell_word(one_line(file.string())));
    });
}

std::string commands_text(const std::filesystem::path& file, const std::vector<std::size_t>& tasks)
{
    return text_of_commands(tasks.size(), [&](std::size_t i) {
        return fmt::format("bdpt render --plan {} --task {}", shell_word(one_line(file.string())),
                           tasks[i]);
    });
}

}  // namespace bdpt::app
