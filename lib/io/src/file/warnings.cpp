#include "file/warnings.h"

#include <fmt/format.h>

namespace bdpt::io {

void Warnings::add(const std::string& kind, const std::string& place)
{
    if (silent_) {
        return;
    }
    const auto [found, inserted] = index_.try_emplace(kind, entries_.size());
    if (inserted) {
        entries_.push_back({kind, place, 0});
    }
    ++entries_[found->second].count;
}

std::vector<std::string> Warnings::lines() const
{
    std::vector<std::string> lines;
    lines.reserve(entries_.size());
    for (const Entry& entry : entries_) {
        std::string line =
            entry.first_place.empty() ? entry.kind : entry.first_place + ": " + entry.kind;
        if (entry.count > 1) {
            line += fmt::format(" (and {} more of this kind)", entry.count - 1);
        }
        lines.push_back(std::move(line));
    }
    return lines;
}

}  // namespace bdpt::io
