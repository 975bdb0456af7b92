#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "file/json.h"
#include "file/load_context.h"
#include "file/read_file.h"

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

/// Checks the types, lengths and indices of all properties that the loader reads [glTF 2.0, sec.
/// 5], so that none is silently replaced by its default. Throws `Error` (invalid_input); warns of
/// textures that are broken but not used.
void check_schema(const JsonPlace& root, LoadContext& context);

/// Returns the size of one component [bytes]; 0 for a type that glTF does not have [glTF 2.0, sec.
/// 5.1.3].
[[nodiscard]] std::uint64_t component_size(std::uint64_t component_type);

/// Returns the number of components of an accessor's type; 0 for one that glTF does not have [glTF
/// 2.0, sec. 5.1.4].
[[nodiscard]] std::uint64_t component_count(std::string_view type);

/// Checks that views lie within their buffers, and accessors and their sparse parts within their
/// views, in arithmetic that cannot overflow. Relies on check_schema. Throws `Error`
/// (invalid_input).
void check_layout(const JsonPlace& root, LoadContext& context);

/// Checks that the nodes are a forest: no node has two parents or is its own ancestor [glTF 2.0,
/// sec. 3.5.2], and none is deeper than the limits allow. Relies on check_schema. Throws `Error`
/// (invalid_input).
void check_node_graph(const JsonPlace& root, const ReadLimits& limits);

/// Checks that animations have all data needed to play them [glTF 2.0, sec. 5.5 to 5.8]; a channel
/// without a target needs no sampler. Warns of properties that are not animated. Relies on
/// check_schema. Throws `Error` (invalid_input).
void check_animations(const JsonPlace& root, std::span<const std::size_t> played,
                      LoadContext& context);

}  // namespace bdpt::io
