#pragma once

#include "file/json.h"

namespace bdpt::io {

/// Checks that the nodes are a forest: no node has two parents or is its own ancestor [glTF 2.0,
/// sec. 3.5.2], and none is deeper than the limits allow. Relies on check_schema. Throws `Error`
/// (invalid_input).
void check_node_graph(const JsonPlace& root, const ReadLimits& limits);

}  // namespace bdpt::io
