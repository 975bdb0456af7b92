#pragma once

#include "file/bytes.h"
#include "file/load_context.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace bdpt::io {

/// Offsets of the chunks in a binary glTF file [glTF 2.0, sec. 4.4].
struct GlbChunks {
    struct Range {
        std::size_t offset = 0;
        std::size_t size = 0;
    };
    Range json;
    std::optional<Range> bin;
};

/// Tests whether a file is binary glTF, by its first bytes.
[[nodiscard]] bool is_glb(ByteView file);

/// Returns how much of a stream with this start is worth reading [bytes]: the length that a GLB
/// file states and one byte more, `json_bytes` and one more of text, and just `start` for anything
/// else.
[[nodiscard]] std::uint64_t worth_reading(ByteView start, const ReadLimits& limits);

/// Finds the chunks; both lie within the file. Throws `Error`: unsupported for another container
/// version than 2, invalid_input for inconsistent lengths.
[[nodiscard]] GlbChunks find_glb_chunks(ByteView file, LoadContext& context);

}  // namespace bdpt::io
