#pragma once

#include <bdpt/io/read_limits.h>

#include <cstdint>
#include <string>

namespace bdpt::io {

/// What the decoded vertices, triangles, key frames, light profiles and instances of one file cost.
/// An accessor counts each time it is used: a few bytes of JSON may name one of gigabytes a
/// thousand times.
class DataBudget {
public:
    explicit DataBudget(const ReadLimits& limits) : limit_(limits.mesh_bytes) {}

    /// Takes `count` elements of `size` bytes. `place` is the JSON pointer to what needs them.
    /// Throws `Error` (invalid_input) that names place, need and limit when there is no more.
    void spend(const std::string& place, std::uint64_t count, std::uint64_t size);

private:
    std::uint64_t limit_ = 0;  // [bytes]
    std::uint64_t spent_ = 0;  // [bytes]
};

}  // namespace bdpt::io
