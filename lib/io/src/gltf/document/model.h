#pragma once

#include "file/bytes.h"
#include "file/load_context.h"
#include "gltf/document/prepass.h"
#include "gltf/document/tinygltf.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace bdpt::io {

/// Name under which the indices of a primitive stand among its attributes: tinygltf refuses some
/// that are sound where they belong.
inline constexpr const char* indices_attribute = "INDICES";

/// Light `index` of an extension of the document, which must have it.
[[nodiscard]] const tinygltf::Value& light_of(const tinygltf::Model& model, const char* extension,
                                              std::size_t index);

/// The bytes of a file, of data, or, where there is no URI, of a view (-1: none). Throws `Error`:
/// not_found for a file that is missing, invalid_input when it is larger than `limit` bytes, or
/// neither is given.
[[nodiscard]] Bytes read_source(const tinygltf::Model& model, const std::string& uri,
                                int buffer_view, std::uint64_t limit, const LoadContext& context);

/// A checked document as the structs of tinygltf, which have all that the loader reads. Images have
/// their `uri` as the file has it, or their `bufferView`; nothing is decoded. Animations but those
/// that are `played` are empty; check_animations must have seen these. See indices_attribute.
/// Throws `Error` (invalid_input) for what the checks before let through and tinygltf does not.
[[nodiscard]] tinygltf::Model build_model(CheckedGltf checked, std::span<const std::size_t> played);

}  // namespace bdpt::io
