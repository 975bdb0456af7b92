#include "file/warnings.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>

namespace bdpt::io {

void Warnings::add(WarningKind kind, const std::string& text, const std::string& place)
{
    if (silent_) {
        return;
    }
    const auto [found, inserted] = index_.try_emplace(text, entries_.size());
    if (inserted) {
        entries_.push_back({kind, text, place, 0});
    }
    ++entries_[found->second].count;
}

std::string Warnings::line(const Entry& entry)
{
    std::string line =
        entry.first_place.empty() ? entry.text : entry.first_place + ": " + entry.text;
    if (entry.count > 1) {
        line += fmt::format(" (and {} more of this kind)", entry.count - 1);
    }
    return line;
}

std::vector<std::string> Warnings::lines() const
{
    std::vector<std::string> lines;
    for (const Entry& entry : entries_) {
        if (entry.kind != WarningKind::draft) {
            lines.push_back(line(entry));
        }
    }
    return lines;
}

std::vector<std::string> Warnings::drafts() const
{
    std::vector<std::string> lines;
    for (const Entry& entry : entries_) {
        if (entry.kind == WarningKind::draft) {
            lines.push_back(line(entry));
        }
    }
    return lines;
}

void Warnings::refuse_harm() const
{
    const auto is_harm = [](const Entry& entry) { return entry.kind != WarningKind::harmless; };
    const auto first = std::find_if(entries_.begin(), entries_.end(), is_harm);
    if (first == entries_.end()) {
        return;
    }
    const auto others = std::count_if(first + 1, entries_.end(), is_harm);
    throw Error(ErrorCode::unsupported,
                line(*first) + "; --strict refuses this" +
                    (others == 0 ? "" : fmt::format(", and {} more warnings", others)));
}

}  // namespace bdpt::io
