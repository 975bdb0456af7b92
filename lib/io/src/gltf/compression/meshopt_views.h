#pragma once

#include "file/bytes.h"
#include "file/json.h"
#include "file/load_context.h"

#include <vector>

namespace bdpt::io {

/// For each buffer: does it only stand in for compressed views [EXT_meshopt_compression,
/// KHR_meshopt_compression], so that nobody needs its bytes? Relies on check_schema. Throws `Error`
/// (unsupported) for one that has no bytes, in builds without meshoptimizer.
[[nodiscard]] std::vector<bool> find_fallback_buffers(const JsonPlace& root);

/// Decodes all compressed views into buffers of their own and makes the document say so; buffers
/// that only stood in for them shrink to a byte. The document has to be checked again afterwards.
/// Throws `Error` (invalid_input, unsupported).
void decode_meshopt_views(Json& document, std::vector<Bytes>& buffers, LoadContext& context);

}  // namespace bdpt::io
