#pragma once

#include "file/bytes.h"
#include "file/json.h"
#include "file/load_context.h"

#include <vector>

namespace bdpt::io {

/// Decodes all primitives of KHR_draco_mesh_compression into separate buffers and updates the
/// document accordingly. The document has to be checked again afterwards. In builds without Draco,
/// primitives that also have uncompressed data are left as they are. Throws `Error` (invalid_input,
/// unsupported).
void decode_draco_primitives(Json& document, std::vector<Bytes>& buffers, LoadContext& context);

}  // namespace bdpt::io
