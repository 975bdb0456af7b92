#include "file/data_budget.h"

#include "file/read_file.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <utility>

namespace bdpt::io {

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
