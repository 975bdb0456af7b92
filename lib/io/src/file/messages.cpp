#include <bdpt/error.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "file/messages.h"
#include "file/read_file.h"

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

namespace {

/// Returns line `name` of /proc/self/status [bytes]; 0 if there is none. Allocates nothing.
std::uint64_t read_status(std::string_view name)
{
    const int descriptor = ::open("/proc/self/status", O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) {
        return 0;
    }
    std::array<char, 4096> buffer{};
    const ssize_t length = ::read(descriptor, buffer.data(), buffer.size());
    ::close(descriptor);
    const std::string_view text(buffer.data(), length > 0 ? static_cast<std::size_t>(length) : 0);
    const std::size_t line = text.find(name);
    const std::size_t digit = text.find_first_of("0123456789", line);
    if (line == std::string_view::npos || digit == std::string_view::npos) {
        return 0;
    }
    std::uint64_t kilobytes = 0;
    std::from_chars(text.data() + digit, text.data() + text.size(), kilobytes);
    return kilobytes * 1024;
}

}  // namespace

std::string memory_figures()
{
    const auto text = [](std::uint64_t bytes) {
        return human_bytes(static_cast<long double>(bytes));
    };
    rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
        return fmt::format("the process used up to {} and needs more, but its limit is {}",
                           text(read_status("VmPeak:")), text(limit.rlim_cur));
    }
    const auto machine = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                         static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    return fmt::format("the process used up to {} and needs more; the machine has {}",
                       text(read_status("VmHWM:")), text(machine));
}

}  // namespace bdpt::io
