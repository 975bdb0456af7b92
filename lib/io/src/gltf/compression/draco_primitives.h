#pragma once

#include "file/bytes.h"
#include "file/json.h"
#include "file/load_context.h"

#include <vector>

namespace bdpt::io {

/// Decodes all primitives of KHR_draco_mesh_compression into buffers of their own and makes the
/// document say so. The document has to be checked again afterwards. In builds without Draco,
/// primitives that have plain data too are left as they are. Throws `Error` (invalid_input,
/// unsupported).
void decode_draco_primitives(Json& document, std::vector<Bytes>& buffers, LoadContext& context);

}  // namespace bdpt::io
