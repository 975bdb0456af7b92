#include "file/data_budget.h"

#include "file/read_file.h"

#include <bdpt/error.h>

#include <fmt/format.h>

namespace bdpt::io {

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
    try {
        spend_memory(count * size);
    } catch (const Error& error) {
        throw Error(error.code(), place + ": " + error.what());
    }
}

void DataBudget::spend_memory(std::uint64_t bytes)
{
    // What was there before may be more than the limit.
    if (memory_ > memory_limit_ || bytes > memory_limit_ - memory_) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("the scene needs more than {} of memory in all",
                                human_bytes(static_cast<long double>(memory_limit_))));
    }
    memory_ += bytes;
}

}  // namespace bdpt::io
