#pragma once

#include <bdpt/io/read_limits.h>

#include <cstdint>
#include <string>

namespace bdpt::io {

/// What the decoded vertices, triangles, key frames, light profiles and instances of one file cost,
/// and all that it takes together. An accessor counts each time it is used: a few bytes of JSON may
/// name one of gigabytes a thousand times.
class DataBudget {
public:
    explicit DataBudget(const ReadLimits& limits)
        : limit_(limits.mesh_bytes), memory_limit_(limits.memory_bytes)
    {}

    /// Counts bytes that are in memory already, whether the limit allows them or not.
    void hold(std::uint64_t bytes) { memory_ += bytes; }

    /// Takes `count` elements of `size` bytes. `place` is the JSON pointer to what needs them.
    /// Throws `Error` (invalid_input) that names place, need and limit when there is no more.
    void spend(const std::string& place, std::uint64_t count, std::uint64_t size);

    /// Takes `bytes` for something else; only the limit of all memory counts. Throws `Error`
    /// (invalid_input), which names no place, when there is no more.
    void spend_memory(std::uint64_t bytes);

private:
    std::uint64_t limit_ = 0;         // [bytes]
    std::uint64_t spent_ = 0;         // [bytes]
    std::uint64_t memory_limit_ = 0;  // [bytes]
    std::uint64_t memory_ = 0;        // that all takes [bytes]
};

}  // namespace bdpt::io
