#include "integrator/bidirectional/light_vertex_block.h"

#include "math/elementary.h"

#include <algorithm>

namespace bdpt {

void LightVertexBlock::set(std::size_t i, std::span<const PathVertex> light, double count)
{
    const PathVertex& vertex = light.back();
    const auto normal = vertex.bsdf->opaque_normal();
    const Vec3 n = normal.value_or(Vec3(0.0f));
    x[i] = vertex.end.p.x;
    y[i] = vertex.end.p.y;
    z[i] = vertex.end.p.z;
    nx[i] = n.x;
    ny[i] = n.y;
    nz[i] = n.z;
    any_side[i] = normal ? 0.0f : 1.0f;
    const Rgb power = estimated_power(vertex);
    red[i] = power.x;
    green[i] = power.y;
    blue[i] = power.z;
    area[i] = nearby_area(light, count);
    s[i] = static_cast<std::int32_t>(light.size());
}

Rgb estimated_power(const PathVertex& vertex)
{
    constexpr float least_albedo = 0.04f;  // of usual dielectrics
    return vertex.beta * max(vertex.bsdf->base_color(), Rgb(least_albedo));
}

float nearby_area(std::span<const PathVertex> subpath, double count)
{
    constexpr float least_pdf = 1e-36f;  // [1/m^2]; below it the area would be infinite
    if (!joinable(subpath[subpath.size() - 2])) {
        return 0.0f;
    }
    const float pdf = std::max(subpath.back().pdf_fwd.value, least_pdf);
    return inv_pi / (static_cast<float>(count) * pdf);
}

}  // namespace bdpt
