#pragma once

#include <bdpt/error.h>
#include <bdpt/io/read_limits.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace bdpt::fuzz {

/// Limits that an input of some kilobytes comes near, so that a fuzzer is fast and what passes them
/// unseen is noticed.
inline constexpr io::ReadLimits small_limits{
    .file_bytes = 1u << 20,
    .buffer_bytes = 4u << 20,
    .json_bytes = 1u << 20,
    .json_values = 100'000,
    .nodes = 2000,
    .node_depth = 64,
    .instances = 5000,
    .mesh_bytes = 16u << 20,
    .triangles = 100'000,
    .image_side = 512,
    .image_bytes = 4u << 20,
    .texture_bytes = 8u << 20,
};

/// Ends the process, so that a fuzzer keeps the input.
[[noreturn]] inline void broken(std::string_view promise, std::string_view what)
{
    std::fprintf(stderr, "broken promise: %.*s: %.*s\n", static_cast<int>(promise.size()),
                 promise.data(), static_cast<int>(what.size()), what.data());
    std::abort();
}

inline void promise(bool kept, std::string_view promise, std::string_view what = {})
{
    if (!kept) {
        broken(promise, what);
    }
}

/// What a refusal must be: foreseen, and one line.
inline void check_refusal(const Error& error)
{
    const std::string_view what = error.what();
    promise(error.code() == ErrorCode::invalid_input || error.code() == ErrorCode::unsupported ||
                error.code() == ErrorCode::not_found,
            "bad input is refused as such", what);
    promise(!what.empty() && what.find('\n') == std::string_view::npos, "a message is one line",
            what);
}

}  // namespace bdpt::fuzz
