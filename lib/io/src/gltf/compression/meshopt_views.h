#pragma once

#include "file/bytes.h"
#include "file/json.h"
#include "file/load_context.h"

#include <vector>

namespace bdpt::io {

/// Tells for each buffer whether it is only a fallback for compressed views
/// [EXT_meshopt_compression, KHR_meshopt_compression], so that its bytes are not needed. Relies on
/// check_schema. Throws `Error` (unsupported) for a fallback without bytes, in builds without
/// meshoptimizer.
[[nodiscard]] std::vector<bool> find_fallback_buffers(const JsonPlace& root);

/// Decodes all compressed views into separate buffers and updates the document accordingly;
/// fallback buffers shrink to a byte. The document has to be checked again afterwards. Throws
/// `Error` (invalid_input, unsupported).
void decode_meshopt_views(Json& document, std::vector<Bytes>& buffers, LoadContext& context);

}  // namespace bdpt::io
