#pragma once

#include "path/path_vertex.h"

namespace bdpt {

/// What joining two subpaths adds to the densities that the walks have stored: those of the ends
/// and of their neighbours, which now see a new vertex.
struct JoinDensities {
    AreaPdf light_at_camera_end;       ///< z_{t-1} sampled from y_{s-1}
    AreaPdf light_at_camera_neighbor;  ///< z_{t-2} sampled from z_{t-1}
    AreaPdf camera_at_light_end;       ///< y_{s-1} sampled from z_{t-1}
    AreaPdf camera_at_light_neighbor;  ///< y_{s-2} sampled from y_{s-1}
    AreaPdf next_event;                ///< x_0 sampled from x_1 by next-event estimation
};

/// Can a strategy join at this vertex, which lies inside of a subpath?
[[nodiscard]] inline bool joinable(const PathVertex& vertex)
{
    return vertex.kind != VertexKind::surface || (vertex.connectible && !vertex.scattered_delta);
}

}  // namespace bdpt
