#include "view/inspected.h"

#include <bdpt/error.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

#include "options/groups/transport_arguments.h"
#include "report/inspect_report.h"
#include "view/view_camera.h"

namespace bdpt::app {
namespace {

using nlohmann::ordered_json;

void add_places(ordered_json& vertices, const std::vector<InspectedVertex>& path,
                const PreparedScene& stage)
{
    for (std::size_t i = 0; i < path.size(); ++i) {
        const bool is_infinite = path[i].kind == InspectedKind::infinite;
        const std::optional<Vec2> place =
            is_infinite ? project_direction(stage.camera, stage.size, path[i].position)
                        : project_point(stage.camera, stage.size, path[i].position);
        vertices[i]["raster"] = place ? ordered_json::array({place->x, place->y}) : ordered_json();
    }
}

}  // namespace

std::string inspected_text(const PreparedScene& stage, RenderOptions options,
                           const PixelSample& pixel)
{
    options.film.width = stage.size.width;
    options.film.height = stage.size.height;
    const InspectedSample sample = inspect_sample(stage.scene, stage.camera, options, pixel);
    ordered_json json = inspect_json(sample, pixel, stage.scene.description().origin);
    add_places(json["camera_path"], sample.camera_path, stage);
    add_places(json["light_path"], sample.light_path, stage);
    json["settings"] = transport_json(options);
    return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace bdpt::app
