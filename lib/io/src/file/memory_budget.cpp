#include <bdpt/io/read_limits.h>

#include "file/read_file.h"

#include <fmt/format.h>

namespace bdpt::io {

void MemoryBudget::check(std::string_view what, std::uint64_t bytes) const
{
    if (bytes <= left()) {
        return;
    }
    const auto text = [](std::uint64_t count) {
        return human_bytes(static_cast<long double>(count));
    };
    const std::string rest =
        spent_ == 0 ? fmt::format("the limit is {}", text(limit_.bytes))
                    : fmt::format("{} of {} are left", text(left()), text(limit_.bytes));
    throw Error(limit_.code, fmt::format("{} needs {} of memory, but {} ({})", what, text(bytes),
                                         rest, limit_.source));
}

void MemoryBudget::spend(std::string_view what, std::uint64_t bytes)
{
    check(what, bytes);
    spent_ += bytes;
}

}  // namespace bdpt::io
