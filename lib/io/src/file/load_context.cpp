#include <bdpt/error.h>
#include <bdpt/io/read_limits.h>
#include <fmt/format.h>

#include <utility>

#include "file/load_context.h"
#include "file/read_file.h"

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

DataBudget::DataBudget(const ReadLimits& limits, std::shared_ptr<MemoryBudget> memory)
    : limit_(limits.mesh_bytes), memory_(std::move(memory))
{
    if (!memory_) {
        memory_ = std::make_shared<MemoryBudget>(
            MemoryLimit{.bytes = limits.memory_bytes, .source = "the limit memory_bytes"});
    }
}

void DataBudget::spend(const std::string& place, std::uint64_t count, std::uint64_t size)
{
    const std::uint64_t left = limit_ - spent_;
    if (size != 0 && count > left / size) {
        const long double need = static_cast<long double>(count) * static_cast<long double>(size) +
                                 static_cast<long double>(spent_);
        throw Error(
            ErrorCode::invalid_input,
            fmt::format("{}: vertices, key frames, light profiles and instances need {}, but the "
                        "limit is {}",
                        place, human_bytes(need), human_bytes(static_cast<long double>(limit_))));
    }
    spent_ += count * size;
    memory_->spend(place, count * size);
}

}  // namespace bdpt::io
